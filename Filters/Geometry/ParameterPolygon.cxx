#include "ParameterPolygon.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{

double SignedArea(const std::vector<Vec2>& polygon)
{
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2 a = polygon[i] - polygon[0], b = polygon[(i + 1) % polygon.size()] - polygon[0];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

int CountCorners(const std::vector<Vec2>& polygon)
{
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < polygon.size() && corners.size() < 3; ++i)
  {
    if (std::find(corners.begin(), corners.end(), polygon[i]) == corners.end())
    {
      corners.push_back(polygon[i]);
    }
  }
  return static_cast<int>(corners.size());
}

bool IsWholeRectangle(
  const std::vector<Vec2>& polygon, const NurbsSurface& surface, double tolerance)
{
  const Vec2 low(surface.FirstU(), surface.FirstV()), high(surface.LastU(), surface.LastV());
  const Vec2 slack = tolerance * (high - low);
  const auto sides = [&](const Vec2& x)
  {
    int mask = 0;
    for (int axis = 0; axis < 2; ++axis)
    {
      mask |= (std::abs(x[axis] - low[axis]) <= slack[axis]) << (2 * axis);
      mask |= (std::abs(x[axis] - high[axis]) <= slack[axis]) << (2 * axis + 1);
    }
    return mask;
  };
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    if ((sides(polygon[i]) & sides(polygon[(i + 1) % polygon.size()])) == 0)
    {
      return false;
    }
  }
  const double whole = (high - low).prod();
  return std::abs(std::abs(SignedArea(polygon)) - whole) <= 10 * tolerance * whole;
}

}
