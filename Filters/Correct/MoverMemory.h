/**
 * @file MoverMemory.h
 * @brief What a NodeMover has found out of nodes and edges, which is the same in all trials of a
 * ladder.
 */
#ifndef MoverMemory_h
#define MoverMemory_h

#include "NodeConstraint.h"
#include "NodeMove.h"
#include "Remembered.h"
#include "SkinRing.h"

#include <memory>
#include <vector>

namespace trim
{

/// How a node is held.
struct NodeHold
{
  NodeConstraint Constraint;
  std::shared_ptr<const SkinRings> Rings; ///< faces that it may come to lie on
  bool Straight;                          ///< on a border that does not turn there
};

/// Of one band, its columns and a surface; for any number of movers and threads.
struct MoverMemory
{
  explicit MoverMemory(const Band& band)
    : Projected(band.NumberOfNodes())
    , Slid(2 * band.Edges.size())
    , SlidingEdges(band.NumberOfNodes())
    , HeldByStatus(band.NumberOfNodes())
    , HeldAsKept(band.NumberOfNodes())
    , EdgesBefore(band.NumberOfElements())
  {
  }

  Remembered<NodeMove> Projected;            ///< by node
  Remembered<NodeMove> Slid;                 ///< by edge, from its first node and from its second
  Remembered<std::vector<int>> SlidingEdges; ///< by node
  Remembered<NodeHold> HeldByStatus;         ///< by node
  Remembered<NodeHold> HeldAsKept;           ///< by node, as if there were no cut
  Remembered<EdgeSquares> EdgesBefore;       ///< by element of eight nodes
};

}

#endif
