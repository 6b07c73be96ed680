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
#include "Status.h"

#include <functional>
#include <string>
#include <vector>

namespace trim
{

struct NodeClassification
{
  std::vector<unsigned char> Status; ///< of every node
  std::vector<float> SignedDistance; ///< NaN where the node was not projected
  std::vector<Id> CandidateCells;    ///< whose boxes meet the surface, ascending
  bool SurfaceMissesGrid = false;
};

/**
 * @param tolerance absolute distance under which a node is on the surface.
 * @param aborted asked now and then by one thread; true ends the work at once.
 * @return false with an error that gives a point where the surface ends, if it does not part
 * the mesh.
 */
bool ClassifyNodes(const HexMesh& mesh, const MeshBlocks& blocks,
  const nurbs::TrimmingSurface& surface, double tolerance, const std::function<bool()>& aborted,
  NodeClassification& result, std::string& error);

/// "(x, y, z)" for messages.
std::string PlaceText(const Vec3& p);

}

#endif
