/**
 * @file PillarOrdering.h
 * @brief The candidates of NodeOrdering on the pillars of a sheet: for large meshes all there are.
 */
#ifndef PillarOrdering_h
#define PillarOrdering_h

#include "Pillars.h"

namespace trim
{

/// New number of each node; the numbers as they came where nothing found is better.
PageVector<int> OrderByPillars(const NodeGraph& graph, const Pillars& pillars,
  const NodePlaces& position, const std::function<bool()>& aborted);

}

#endif
