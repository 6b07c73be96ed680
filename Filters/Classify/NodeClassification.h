/**
 * @file NodeClassification.h
 * @brief STATUS(nodes) (paper, section 2.2, Fig. 4), by projection near the surface and by
 * carrying the side along the mesh everywhere else.
 *
 * The sign of (N - P) . n is certain only where the closest point P lies inside the surface and
 * near. So only the nodes of cells whose boxes meet the surface are projected; every other cell
 * lies on one side, and all its nodes share one status. A set of nodes joined this way that
 * receives both statuses has found a surface that does not part the mesh.
 */
#ifndef NodeClassification_h
#define NodeClassification_h

#include "HexMesh.h"
#include "MeshBlocks.h"
#include "Place.h"
#include "Status.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace trim
{

/// The closest points of the surface to the nodes of the candidate cells.
struct NodeFeet
{
  std::vector<Id> Ids; ///< ascending
  std::vector<nurbs::Foot> Feet;

  /// Position of a node of a candidate cell.
  int Find(Id node) const
  {
    return static_cast<int>(
      std::lower_bound(this->Ids.begin(), this->Ids.end(), node) - this->Ids.begin());
  }

  /// That of any node; null: it is of no candidate cell.
  const nurbs::Foot* FootOf(Id node) const
  {
    const std::size_t at = this->Find(node);
    return at < this->Ids.size() && this->Ids[at] == node ? &this->Feet[at] : nullptr;
  }
};

struct Piece;

struct NodeClassification
{
  UnsetVector<unsigned char> Status;                 ///< of every node
  std::vector<std::pair<Id, float>> SignedDistances; ///< of nodes that were projected, ascending
  std::vector<Id> CandidateCells;                    ///< whose boxes meet the surface, ascending
  /// Of each cluster of the mesh: the side of all its cells, if that is known. An empty second one
  /// of a run has that of the first.
  std::vector<unsigned char> ClusterSide;
  NodeFeet Near; ///< of the nodes of CandidateCells
  /// A node of each part of the mesh that lies beside the end of the surface, on both sides of
  /// where it would go on; ascending, on all ranks alike.
  std::vector<Place> PartsBesideEnd;
};

/**
 * @param nearRuns runs of cells, ascending; all whose boxes are within the tolerance of the surface
 * are among them.
 * @param piece the mesh among those of other ranks, whose nodes it may share.
 * @param tolerance absolute distance under which a node is on the surface.
 * @param aborted asked now and then, by all threads; true ends the work.
 * Collective.
 *
 * @return false without an error if the work was ended, on any rank; false with one that gives a
 * point where the surface ends, if it does not part the mesh.
 */
bool ClassifyNodes(const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& nearRuns,
  const Piece& piece, const nurbs::TrimmingSurface& surface, double tolerance,
  const std::function<bool()>& aborted, NodeClassification& result, std::string& error);

}

#endif
