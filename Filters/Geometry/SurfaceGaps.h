/**
 * @file SurfaceGaps.h
 * @brief How wide a gap between faces of the trimming surface counts as closed.
 */
#ifndef SurfaceGaps_h
#define SurfaceGaps_h

#include "TrimmingSurface.h"

namespace nurbs
{

/// Borders of faces that lie nearer than this share of the surface's diagonal are one edge.
constexpr double GapShare = 1e-5;

/// The same where a border would be free otherwise. CAD programs leave gaps of up to 3.2e-4 between
/// faces that they take for joined, most of them beside fillets.
constexpr double WidestGapShare = 4e-4;

/// The same as a length.
inline double WidestGapOf(const TrimmingSurface& surface)
{
  return WidestGapShare * surface.Bounds().diagonal().norm();
}

}

#endif
