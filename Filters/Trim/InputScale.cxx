#include "InputScale.h"

#include <algorithm>
#include <sstream>

namespace trim
{
namespace
{

/// An inch in millimetres, or nearly: units that are mistaken for each other differ by more.
constexpr double InchInMillimetres = 25.0;

}

double LargestCoordinateOf(const nurbs::Box3& bounds)
{
  return std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().cwiseAbs().maxCoeff());
}

std::string FindGridScaleDefect(const nurbs::Box3& bounds)
{
  std::ostringstream text;
  const double largest = LargestCoordinateOf(bounds);
  const double size = bounds.sizes().maxCoeff();
  if (!(largest <= LargestCoordinate))
  {
    text << "The grid reaches to the coordinate " << largest << ", more than " << LargestCoordinate
         << ": repair the mesh before trimming.";
  }
  else if (!(size > 1 / LargestCoordinate) || !(size > 1e-14 * largest))
  {
    text << "All nodes of the grid are at one place, (" << bounds.min().transpose()
         << "): repair the mesh, or move it nearer to the origin.";
  }
  return text.str();
}

std::string FindSurfaceScaleDefect(const nurbs::Box3& grid, const nurbs::Box3& surface)
{
  std::ostringstream text;
  const double size = surface.diagonal().norm();
  if (!(size <= LargestSurface * grid.diagonal().norm()))
  {
    text << "The trimming surface measures " << size << " from corner to corner of its box, more "
         << "than " << LargestSurface << " times the grid: correct the control point that is far "
         << "off, or the length unit.";
  }
  return text.str();
}

std::string UnitsHint(const nurbs::Box3& grid, const nurbs::Box3& surface)
{
  std::ostringstream text;
  const double ofGrid = grid.diagonal().norm();
  const double ofSurface = surface.diagonal().norm();
  if (std::max(ofGrid, ofSurface) > InchInMillimetres * std::min(ofGrid, ofSurface))
  {
    text << " The grid measures " << ofGrid << " from corner to corner and the surface "
         << ofSurface << ": if they are in different units, set LengthUnit where the surface is "
         << "read, or scale the grid.";
  }
  return text.str();
}

}
