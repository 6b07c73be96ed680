/**
 * @file LayerTrim.h
 * @brief The band trimmed with a layer of new elements along the cut.
 */
#ifndef LayerTrim_h
#define LayerTrim_h

#include "BandDecision.h"
#include "LayerSearch.h"
#include "Shortcomings.h"

#include <memory>
#include <optional>

namespace trim
{

/// When a layer is of no use.
struct LayerDemand
{
  /// Where a good part of the elements at it would stay below the quality floor: it takes most of
  /// the time to find out how many these are.
  bool GivesUp;
  /// Where it cannot but leave more than this; none: it may leave anything.
  std::optional<Shortcomings> Limit;
};

/**
 * Elements that reach no farther beyond the surface than its kind allows stay, and the layer on
 * them ends on it. If a node of it would stick out of the mesh, it is made once more with all of
 * them inside.
 *
 * @param near trimmed without.
 * @param before its mesh.
 * @param demand what a layer is not made to the end without.
 * @return null where there is no room for a layer, or none of use.
 */
std::unique_ptr<TrimBand> TrimWithLayer(const TrimBand& near,
  const std::shared_ptr<const Band>& before, const LayerKind& kind, const LayerDemand& demand,
  const BandTask& task, const Progress& progress);

}

#endif
