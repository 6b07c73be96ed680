/**
 * @file StretchTrims.h
 * @brief The trims of the stretches of a band, each by itself, and put together again.
 */
#ifndef StretchTrims_h
#define StretchTrims_h

#include "BandStretches.h"
#include "TrimBand.h"

#include <vector>

namespace trim
{

class StretchTrims
{
public:
  /// @param whole with mesh, structure and sheet axes; it must outlive this.
  explicit StretchTrims(TrimBand& whole);

  /// Where there is one stretch alone it is the whole band itself.
  int Count() const { return static_cast<int>(this->Stretches.size()); }
  TrimBand& operator[](int stretch) { return this->Own.empty() ? this->Whole : this->Own[stretch]; }

  /// Of all of them, without layers.
  int NumberOfElements() const { return this->Whole.Mesh.NumberOfElements(); }

  /// Puts the trims together to one of the whole band, which has the layers that were inserted.
  void Join();

private:
  void Add(const BandStretch& stretch, const TrimBand& own);

  TrimBand& Whole;
  std::vector<BandStretch> Stretches;
  std::vector<TrimBand> Own; ///< empty: there is one stretch alone
};

}

#endif
