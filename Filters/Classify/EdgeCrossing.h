/**
 * @file EdgeCrossing.h
 * @brief Where the trimming surface crosses a straight edge of the mesh (paper, eqs. 12-14).
 */
#ifndef EdgeCrossing_h
#define EdgeCrossing_h

#include "TrimmingSurface.h"

namespace trim
{
using nurbs::Vec3;

struct EdgeCrossing
{
  bool Found = false;
  double K = 0;       ///< of the crossing nearest to A, as A + K (B - A)
  double BeyondK = 0; ///< share of the edge that lies on the eliminated side, 0..1
  int Count = 0;      ///< how often the edge meets the surface
  Vec3 Point = Vec3::Zero();
};

/**
 * Crossing of an edge whose ends lie on different sides.
 *
 * @param aIsKept which side A lies on; B lies on the other.
 * @param gap distance up to which a gap between two faces counts as closed: where the edge
 * slips through one, the place where the signed distance changes its sign is taken.
 */
EdgeCrossing CrossEdge(
  const nurbs::TrimmingSurface& surface, const Vec3& a, const Vec3& b, bool aIsKept, double gap);

}

#endif
