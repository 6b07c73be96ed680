/**
 * @file EdgeCrossing.h
 * @brief Where the trimming surface crosses a straight edge of the mesh (paper, eqs. 12-14).
 */
#ifndef EdgeCrossing_h
#define EdgeCrossing_h

#include "TrimmingSurface.h"

#include <optional>

namespace trim
{
using nurbs::Vec3;

struct EdgeCrossing
{
  double Beyond; ///< share of the edge, 0 to 1
  Vec3 Normal;   ///< of the surface where it is crossed first
};

/**
 * How much of an edge from an eliminated end to a kept one lies beyond the surface; none if the
 * edge does not meet it.
 *
 * @param gap distance up to which a gap between two faces counts as closed: where the edge
 * slips through one, the place where the signed distance changes its sign is taken.
 */
std::optional<EdgeCrossing> CrossEdge(
  const nurbs::TrimmingSurface& surface, const Vec3& eliminated, const Vec3& kept, double gap);

}

#endif
