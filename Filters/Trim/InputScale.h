/**
 * @file InputScale.h
 * @brief Refuses sizes at which double precision cannot tell the nodes of the grid apart.
 */
#ifndef InputScale_h
#define InputScale_h

#include "TrimmingSurface.h"

#include <string>

namespace trim
{
/// A surface may be so many times as large as the grid: beyond, the rounding of its points nears
/// the tolerance of nodes, and nothing is left to trim by.
constexpr double LargestSurface = 1e6;
using nurbs::LargestCoordinate;

/// The largest absolute coordinate in a box.
double LargestCoordinateOf(const nurbs::Box3& bounds);

/// What is wrong with the extent of a grid, of which `bounds` are not empty; empty: nothing.
std::string FindGridScaleDefect(const nurbs::Box3& bounds);

/// What is wrong with the extent of the surface beside that of the grid; empty: nothing.
std::string FindSurfaceScaleDefect(const nurbs::Box3& grid, const nurbs::Box3& surface);

/// What to look at where sizes are so different that the units may be; empty: they are not.
std::string UnitsHint(const nurbs::Box3& grid, const nurbs::Box3& surface);

}

#endif
