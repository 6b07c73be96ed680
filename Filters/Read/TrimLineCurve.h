/**
 * @file TrimLineCurve.h
 * @brief The curve of ParaView's spline widget as an exact cubic B-spline, swept into a surface.
 */
#ifndef TrimLineCurve_h
#define TrimLineCurve_h

#include "NurbsSurface.h"

#include <string>
#include <vector>

namespace nurbs
{
/// A line of points and the sweep along it.
struct TrimLine
{
  std::vector<Vec3> Points;
  bool Closed = false;
  Vec3 Direction = Vec3(0.0, 0.0, 1.0); ///< of any length but zero
  double Length = 1.0;                  ///< how far the sweep reaches to either side
};

/**
 * Says what is wrong with a line: too few points (2, closed 3), values that are not finite,
 * consecutive points that coincide, a direction of length zero or along the line, a length that
 * is not positive, a closed line that encloses no area seen along the direction. The text names
 * the thing, its place (points counted from 0) and what to do; empty: nothing is wrong.
 */
std::string FindDefect(const TrimLine& line);

/**
 * S(u, v) = C(u) + v Direction / |Direction|, v from -Length to Length, where C is the curve of
 * vtkParametricSpline, which the spline widget draws: a cubic spline over the chord length, its
 * first derivative zero at open ends, periodic if closed. Degrees 3 x 1, knots u at the points,
 * each of multiplicity one inside; u is the length of the polygon up to there.
 *
 * The normal S_u x S_v of a closed line points to what it encloses, whatever its sense. That of
 * an open line points to its right for somebody who walks along it, head to `Direction`.
 *
 * @param line without defects.
 */
NurbsSurface SweepTrimLine(const TrimLine& line);
}

#endif
