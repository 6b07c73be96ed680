/**
 * @file Pillars.h
 * @brief Groups of nodes that a numbering keeps together: those above one another in a sheet.
 *
 * In a sheet of few layers the nodes through the thickness belong next to each other in any good
 * numbering, so the search for one runs on the pillars, a few times fewer than the nodes. A pillar
 * follows the shortest of an element's three directions. Any grouping gives valid numbers; where
 * this one makes no sense, as in a solid block, every node is a pillar of its own.
 */
#ifndef Pillars_h
#define Pillars_h

#include "NodeOrdering.h"

namespace trim
{

struct Pillars
{
  int Count = 0;
  PageVector<int> Pillar; ///< of each node
  PageVector<int> Start;  ///< of each pillar in Node; Count + 1
  PageVector<int> Node;   ///< nodes by pillar, from one skin to the other
  PageVector<Vec3> Centre;

  int Size(int pillar) const { return this->Start[pillar + 1] - this->Start[pillar]; }
};

Pillars FindPillars(const NodeGraph& graph, const NodePlaces& position);

/// Every node for itself.
Pillars SingleNodes(const NodePlaces& position, int numberOfNodes);

/// The number of each pillar's first node where the nodes are numbered pillar after pillar.
PageVector<int> FirstNumbers(const Pillars& pillars, const PageVector<int>& order);

}

#endif
