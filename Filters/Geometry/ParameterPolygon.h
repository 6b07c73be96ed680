/**
 * @file ParameterPolygon.h
 * @brief Closed polygons in (u, v), as trim loops are: the first point is not repeated.
 */
#ifndef ParameterPolygon_h
#define ParameterPolygon_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{
/// Positive counter-clockwise.
double SignedArea(const std::vector<Vec2>& polygon);

/// How many different points there are, counted up to 3: with fewer it encloses nothing.
int CountCorners(const std::vector<Vec2>& polygon);

/**
 * Whether every edge lies along one side of the parameter rectangle of a surface and the polygon
 * encloses all of it.
 *
 * @param tolerance in widths and heights of the rectangle.
 */
bool IsWholeRectangle(
  const std::vector<Vec2>& polygon, const NurbsSurface& surface, double tolerance);

}

#endif
