/**
 * @file MoverMemory.h
 * @brief What a NodeMover has found out of nodes and edges, which is the same in all trials of a
 * ladder.
 */
#ifndef MoverMemory_h
#define MoverMemory_h

#include "Jacobian.h"
#include "NodeConstraint.h"
#include "NodeMove.h"
#include "Remembered.h"
#include "RememberedLast.h"
#include "SkinRing.h"
#include "TrimmingSurface.h"

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

namespace trim
{

/// How a node is held.
struct NodeHold
{
  NodeConstraint Constraint;
  std::shared_ptr<const SkinRings> Rings; ///< faces that it may come to lie on
  bool Straight;                          ///< on a border that does not turn there
  bool Smooth;                            ///< a layer's, on a border that turns little there
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
    , AskedOffCut(band.NumberOfNodes())
    , EdgesBefore(band.NumberOfElements())
    , QualityBefore(band.NumberOfElements())
    , Starts(band.NumberOfNodes())
    , Middles(band.NumberOfNodes())
  {
  }

  Remembered<NodeMove> Projected;             ///< by node
  Remembered<NodeMove> Slid;                  ///< by edge, from its first node and from its second
  Remembered<std::vector<int>> SlidingEdges;  ///< by node
  Remembered<NodeHold> HeldByStatus;          ///< by node
  Remembered<NodeHold> HeldAsKept;            ///< by node, as if there were no cut
  std::vector<std::atomic<char>> AskedOffCut; ///< by node: how it is held behind the cut mattered
  Remembered<EdgeSquares> EdgesBefore;        ///< by element of eight nodes
  Remembered<double> QualityBefore;           ///< by element
  /// By node: the foot of the place from which it was relaxed last.
  RememberedLast<Vec3, nurbs::Foot> Starts;
  /// By node: where it was to lie between its neighbours last, in the plane with this normal.
  RememberedLast<std::pair<Vec3, Vec3>, NodeMove> Middles;
};

/**
 * Whether a mover whose nodes slide behind the cut (see NodeMover) would do otherwise than those
 * of this memory, whose nodes do not: it would be asked for the same nodes, one of which the border
 * beyond the surface holds in another way.
 */
bool SlidingMatters(const Band& band, const Columns& columns, const MoverMemory& memory);

}

#endif
