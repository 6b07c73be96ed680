/**
 * @file EdgesCrossedTwice.h
 * @brief Finds the edges of elements that the surface crosses more than once.
 */
#ifndef EdgesCrossedTwice_h
#define EdgesCrossedTwice_h

#include "HexMesh.h"
#include "NodeClassification.h"
#include "TrimmingSurface.h"

#include <array>
#include <vector>

namespace trim
{

/// Ends of an edge of the mesh, the smaller id first.
using MeshEdge = std::array<Id, 2>;

/**
 * Among the edges of the candidate cells. A surface that merely touches an edge, or runs along it,
 * does not cross it. One that crosses it twice the same way is there twice, or its parts face the
 * same way.
 *
 * @param nodes classified by the surface, turned as it was for that.
 * @return ascending.
 */
std::vector<MeshEdge> FindEdgesCrossedTwice(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes);

/// Half-way between each two crossings of such an edge that follow each other.
std::vector<Vec3> PlacesBetweenCrossings(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& edge);

}

#endif
