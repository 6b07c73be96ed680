/**
 * @file HalvedShare.h
 * @brief The share of an element beyond the surface where that bends strongly within it or has a
 * sharp edge there, which the tetrahedra of the paper's section 2.3 do not see.
 *
 * They take the surface for a plane between the places where it crosses their edges. Here the
 * element is halved in each direction, again and again where the surface is none yet. What tells
 * is the signed distance: that to a plane is affine. The halves that are left are small enough for
 * the plane of their middle's closest point.
 */
#ifndef HalvedShare_h
#define HalvedShare_h

#include "ElementMap.h"
#include "TrimmingSurface.h"

#include <optional>

namespace trim
{

/// Whether the surface certainly turns too little in an element to be anything but a plane to the
/// tetrahedra.
/// @param normal about the one it has there; zero: nothing is known.
bool IsNearlyPlane(const ElementPoints& points, int count, const nurbs::TrimmingSurface& surface,
  const Vec3& normal);

/**
 * Share of an element of 8 or 6 nodes that lies beyond the surface, to about a hundredth; none
 * where that has no side, as it ends there.
 *
 * @param share by the tetrahedra: what is returned where the surface turns out to be a plane.
 */
std::optional<double> HalveForShare(
  const ElementPoints& points, int count, const nurbs::TrimmingSurface& surface, double share);

}

#endif
