/**
 * @file BestLayer.h
 * @brief Of several trims with an inserted layer that which leaves least off the surface.
 */
#ifndef BestLayer_h
#define BestLayer_h

#include "LayerTrim.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

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

  /// The first trim that leaves nothing; null: there is none. Those that were made for it are there
  /// for Find.
  /// @param most what the trim without a layer leaves so far: it is going to be less.
  std::unique_ptr<TrimBand> FindWhole(const Shortcomings& most, const Progress& progress);

private:
  /// The less of the elements under the layer may lie beyond the surface, the more there is for it
  /// to fill, which the border of the model may not let it. Last, where none of these is of use, it
  /// may be left out at some nodes.
  static constexpr std::array<LayerKind, 4> Kinds = { { { 0.25, false }, { 0.5, false },
    { 0.1, false }, { 0.25, true } } };

  std::unique_ptr<TrimBand> Make(std::size_t trim, const Progress& progress) const;
  void MakeAhead(std::size_t first, const Progress& progress);

  const TrimBand& Near;
  const BandTask& Task;
  std::shared_ptr<const Band> Before;
  bool GivesUp = true;               ///< see TrimWithLayer
  std::optional<Shortcomings> Limit; ///< the same
  std::vector<int> MadeFor; ///< by element of the band: its column, for which Trims are made
  /// By Kinds: none is not made yet, null is of no use, as there is no room or another is better.
  std::array<std::optional<std::unique_ptr<TrimBand>>, Kinds.size()> Trims;
};

}

#endif
