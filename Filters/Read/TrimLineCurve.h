/**
 * @file TrimLineCurve.h
 * @brief The curves of ParaView's spline and polyline widgets as exact B-splines.
 */
#ifndef TrimLineCurve_h
#define TrimLineCurve_h

#include "SurfaceConstruction.h"

#include <string>
#include <vector>

namespace nurbs
{
/// A line to trim along: one curve, which a closed line ends at the very point where it began.
struct TrimLine
{
  ConvertedCurve Curve; ///< clamped; without a map
  bool Closed = false;
  std::string Name; ///< may be empty
};

/// Whether the last point is the first one again, but for the digits that a file gives.
bool EndsWhereItBegins(const std::vector<Vec3>& points);

/**
 * Says what is wrong with points for a line: too few (2, closed 3), values that are not finite,
 * consecutive points that coincide, an open line that ends beside its beginning. The text names the
 * thing, its place (points counted from 0) and what to do; empty: nothing is wrong.
 */
std::string FindPointDefect(const std::vector<Vec3>& points, bool closed);

/**
 * The curve of vtkParametricSpline, which the spline widget draws: a cubic spline over the chord
 * length, its first derivative zero at open ends, periodic if closed. Degree 3, knots at the
 * points, each of multiplicity one inside; the parameter is the length of the polygon up to there.
 *
 * @param points without defects.
 */
TrimLine MakeSpline(const std::vector<Vec3>& points, bool closed);

/// The points joined by straight pieces, as the polyline widget draws them: degree 1, knots as
/// above. Points without defects.
TrimLine MakePolyline(const std::vector<Vec3>& points, bool closed);
}

#endif
