/**
 * @file BorderSearch.h
 * @brief Whether places are on the border of the model, near one of its faces.
 */
#ifndef BorderSearch_h
#define BorderSearch_h

#include "Facet.h"

#include <vector>

namespace trim
{

/// Whether a place lies within a distance of a facet, and beside it by hardly more than rounding.
bool LiesOn(const FacetSearch& facet, const Vec3& place, double distance);

/// Exterior faces, and those of the border next to each on the same side of the model.
std::vector<int> BorderAround(const Band& band, const std::vector<int>& faces);

/// The side of the model round an exterior face, looked at no farther than it takes.
class BorderSearch
{
public:
  /// @param rings how many faces away from the first one it ends.
  BorderSearch(const Band& band, int face, int rings)
    : TheBand(band)
    , Rings(rings)
    , Around{ face }
  {
  }

  /// Whether a place lies on it, within a distance.
  bool Has(const Vec3& place, double distance);

private:
  /// Takes the next ring; false if there is none.
  bool Widen();

  const Band& TheBand;
  int Rings;                       ///< that may still come
  std::vector<int> Around;         ///< faces
  std::vector<FacetSearch> Facets; ///< of the first of them
};

}

#endif
