/**
 * @file PillarGraph.h
 * @brief Which pillars share an element, in flat arrays, with the searches that order them.
 *
 * An *order* lists the pillars, first to last. Its bandwidth is that of the node numbers which it
 * stands for: pillar after pillar, the nodes of each as Pillars has them.
 */
#ifndef PillarGraph_h
#define PillarGraph_h

#include "Pillars.h"

namespace trim
{

/// The pillars of each column of elements, ascending, in flat arrays.
struct PillarColumns
{
  PageVector<int> Offset; ///< number of columns + 1
  PageVector<int> Member;
};

/// Elements above one another have the same pillars: they are one column.
PillarColumns FindPillarColumns(const NodeGraph& graph, const Pillars& pillars);

class PillarGraph
{
public:
  PillarGraph(const PillarColumns& columns, const Pillars& pillars);

  int Count() const { return static_cast<int>(this->Start.size()) - 1; }
  int Degree(int p) const { return this->Start[p + 1] - this->Start[p]; }

  /// Breadth-first levels from a pillar.
  struct Levels
  {
    int Depth = 0;
    int Last = 0;    ///< a pillar of the last level with the fewest neighbours
    int Reached = 0; ///< nodes
  };
  Levels FindLevels(int root) const;

  /**
   * Reverse Cuthill-McKee: breadth first, neighbours by rising degree and among equals by
   * `rank`. Parts that the roots do not reach follow, each from its pillar of least degree.
   *
   * @param roots where the search starts, all at once.
   */
  PageVector<int> ReverseCuthillMcKee(
    const PageVector<int>& roots, const PageVector<int>& rank) const;

  /// The node bandwidth that an order gives, but for the layers of one element; once it is no less
  /// than `enough`, any such value.
  int Bandwidth(const PageVector<int>& order, int enough) const;

private:
  const Pillars& ThePillars;
  PageVector<int> Start, Neighbour; ///< neighbours ascending
};

}

#endif
