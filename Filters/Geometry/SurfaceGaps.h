/**
 * @file SurfaceGaps.h
 * @brief How wide a gap between faces of the trimming surface counts as closed.
 */
#ifndef SurfaceGaps_h
#define SurfaceGaps_h

#include "NurbsSurface.h"

#include <algorithm>
#include <vector>

namespace nurbs
{

/// Borders of faces that lie nearer than this share of the surface's diagonal are one edge.
constexpr double GapShare = 1e-5;

/// The same where a border would be free otherwise. CAD programs leave gaps of up to 3.2e-4 between
/// faces that they take for joined, most of them beside fillets.
constexpr double WidestGapShare = 4e-4;

/// The same where the CAD program says how far borders may lie from the edges they share: wider
/// ones would close what is meant to be open.
constexpr double WidestToldGapShare = 4e-3;

/// How far each of two faces may lie off their edge, in its tolerance: that is measured at places
/// along the edge, and between these borders lie farther off (two halves of a pipe 1.04 of it).
constexpr double ToldGapFactor = 1.25;

/// Gaps go by a surface of this many diagonals of the grid at most: those of a much larger one
/// would be wider than elements, and close holes of the surface, and the corners of bodies.
constexpr double LargestForGaps = 20.0;

/// By which size of the surface gaps go.
inline double SizeForGaps(double surface, double grid)
{
  return std::min(surface, LargestForGaps * grid);
}

/// How wide a gap may be where a border would be free otherwise. Of two faces each may lie off
/// their edge by its tolerance.
inline double FindWidestGap(const std::vector<NurbsSurface>& faces, double size)
{
  double told = 0.0;
  for (const NurbsSurface& face : faces)
  {
    told = std::max(told, 2.0 * ToldGapFactor * face.Tolerance);
  }
  return std::max(WidestGapShare * size, std::min(told, WidestToldGapShare * size));
}

}

#endif
