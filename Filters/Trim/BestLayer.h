/**
 * @file BestLayer.h
 * @brief Of several trims with an inserted layer that which leaves least off the surface.
 */
#ifndef BestLayer_h
#define BestLayer_h

#include "BandDecision.h"
#include "Shortcomings.h"

#include <array>
#include <memory>
#include <optional>

namespace trim
{

/// What it is given must outlive it.
class BestLayer
{
public:
  BestLayer(const TrimBand& near, const BandTask& task);

  /// The best trim, if that leaves less than a limit; else null, and it may be asked for again.
  /// @param known whether that is what the trim without leaves, not the least that it may.
  /// @param progress where it ends the work, the result is of no use.
  std::unique_ptr<TrimBand> Find(const Shortcomings& limit, bool known, const Progress& progress);

private:
  /// How much of the elements under the layer may lie beyond the surface: the less, the more there
  /// is for the layer to fill, which the border of the model may not let it.
  static constexpr std::array<double, 3> Shares = { 0.25, 0.5, 0.1 };

  std::unique_ptr<TrimBand> Make(std::size_t trim, const Progress& progress) const;
  void MakeAhead(std::size_t first, const Progress& progress);

  const TrimBand& Near;
  const BandTask& Task;
  std::shared_ptr<const Band> Before;
  bool GivesUp = true;               ///< see TrimWithLayer
  std::optional<Shortcomings> Limit; ///< the same
  /// By Shares: none is not made yet, null is of no use, as there is no room or another is better.
  std::array<std::optional<std::unique_ptr<TrimBand>>, Shares.size()> Trims;
};

}

#endif
