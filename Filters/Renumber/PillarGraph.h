/**
 * @file PillarGraph.h
 * @brief Which pillars share an element, with the searches that order them.
 *
 * Neighbours are not listed: pillars share a column of elements, and a search goes from a pillar by
 * its columns to their pillars, through each column once.
 *
 * Numberings of the nodes keep pillars together. They are told by the *first number* of each
 * pillar, that of its first node; the others of the pillar follow, as Pillars has them.
 */
#ifndef PillarGraph_h
#define PillarGraph_h

#include "Pillars.h"

namespace trim
{

/// Groups of pillars or of columns, in flat arrays.
struct IndexGroups
{
  PageVector<int> Offset; ///< number of groups + 1
  PageVector<int> Member;

  int Count() const { return static_cast<int>(this->Offset.size()) - 1; }
  const int* begin(int group) const { return this->Member.data() + this->Offset[group]; }
  const int* end(int group) const { return this->Member.data() + this->Offset[group + 1]; }
};

class PillarGraph
{
public:
  PillarGraph(const NodeGraph& graph, const Pillars& pillars);

  int Count() const { return this->ThePillars.Count; }

  /// Breadth-first levels from a pillar.
  struct Levels
  {
    int Depth = 0;
    int Last = 0;    ///< a pillar of the last level with the fewest neighbours
    int Reached = 0; ///< nodes
  };
  Levels FindLevels(int root) const;

  /**
   * First numbers by reverse Cuthill-McKee: breadth first, neighbours by rising degree and among
   * equals by `rank`. Parts that the roots do not reach follow, each from its pillar of least
   * degree. Empty once the bandwidth is seen to be no less than `enough`.
   *
   * @param roots where the search starts, all at once.
   */
  PageVector<int> ReverseCuthillMcKee(
    const PageVector<int>& roots, const PageVector<int>& rank, int enough) const;

  /// The node bandwidth that first numbers give, but for the layers of one element; once it is no
  /// less than `enough`, any such value.
  int Bandwidth(const PageVector<int>& first, int enough) const;

private:
  class BreadthFirst;
  class Degrees;
  class CuthillMcKee;

  const Pillars& ThePillars;
  IndexGroups PillarsOf; ///< of each column
  IndexGroups ColumnsOf; ///< of each pillar
};

}

#endif
