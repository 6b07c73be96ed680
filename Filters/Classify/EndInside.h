/**
 * @file EndInside.h
 * @brief Where a surface ends within the grid though no node tells of it.
 */
#ifndef EndInside_h
#define EndInside_h

#include "NodeClassification.h"
#include "SharedNodes.h"

#include <optional>

namespace trim
{

/**
 * A place on the free border of the surface that lies within the elements round it, whichever
 * pieces have these; none if there is no such next to an element with a node that the border is
 * nearest to. Of several the same one, however the mesh is divided and numbered. Collective.
 */
std::optional<Vec3> FindEndInside(const HexMesh& mesh, const Piece& piece,
  const NodeClassification& nodes, const nurbs::TrimmingSurface& surface);

/**
 * Where the surface ends beside an edge that joins its two sides without meeting it: in a hole, or
 * where faces leave a slit between them. None if it has no end there, but contradicts itself.
 */
std::optional<Vec3> FindEndBeside(
  const nurbs::TrimmingSurface& surface, const Vec3& eliminated, const Vec3& kept);

}

#endif
