/**
 * @file TrimmedParameterGrid.h
 * @brief Polygons in (u, v) that cover a parameter rectangle, or what trim loops leave of it.
 */
#ifndef TrimmedParameterGrid_h
#define TrimmedParameterGrid_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{
/// Polygons, counter-clockwise in (u, v), as indices into Points.
struct ParameterPolygons
{
  std::vector<Vec2> Points;
  std::vector<std::vector<int>> Polygons;
};

/// One quadrangle for each cell of the grid of rising parameter values.
ParameterPolygons DivideRectangle(
  const std::vector<double>& linesU, const std::vector<double>& linesV);

/**
 * The part of the grid inside `loops` (even-odd rule): quadrangles where no loop passes,
 * triangles along the loops. Polygons share their points, so there are no cracks.
 *
 * The lines are moved a little where a loop's corner lies on them, and one is added where a
 * loop would lie within a single cell: then loops cross lines at simple places only, every
 * piece of a cell is a simple polygon, and no case is special. Loops that cross themselves give
 * overlapping polygons, but nothing worse.
 */
ParameterPolygons DivideTrimmedRectangle(const std::vector<double>& linesU,
  const std::vector<double>& linesV, const std::vector<std::vector<Vec2>>& loops);

}

#endif
