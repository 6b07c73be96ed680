/**
 * @file CrossedEdges.h
 * @brief Finds the edges of elements that the surface crosses more than once, or against their
 * sides.
 */
#ifndef CrossedEdges_h
#define CrossedEdges_h

#include "HexMesh.h"
#include "NodeClassification.h"
#include "TrimmingSurface.h"

#include <array>
#include <vector>

namespace trim
{

/// Ends of an edge of the mesh, the smaller id first.
using MeshEdge = std::array<Id, 2>;

/// Ascending both.
struct CrossedEdges
{
  std::vector<MeshEdge> Twice; ///< there and back
  /// Those that it crosses twice the same way, or as the sides of their ends do not have it: it is
  /// there twice, or has parts beside each other that face the same way, of which one counts.
  std::vector<MeshEdge> AgainstSides;
};

/**
 * Among the edges of the candidate cells. A surface that merely touches an edge, or runs along it,
 * does not cross it.
 *
 * @param nodes classified by the surface, turned as it was for that.
 */
CrossedEdges FindCrossedEdges(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes);

/// Half-way between each two crossings of such an edge that follow each other.
std::vector<Vec3> PlacesBetweenCrossings(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& ends);

}

#endif
