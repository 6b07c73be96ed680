#include "EarClipping.h"

namespace nurbs
{
namespace
{

/// Twice the area of a triangle, positive if it is counter-clockwise.
double Cross(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}

//------------------------------------------------------------------------------
void TriangulatePolygon(const std::vector<Vec2>& points, const std::vector<int>& polygon,
  std::vector<std::vector<int>>& triangles)
{
  std::vector<int> rest = polygon;
  size_t at = 0;
  size_t failures = 0;
  while (rest.size() > 3)
  {
    const size_t n = rest.size();
    const size_t before = (at + n - 1) % n;
    const size_t after = (at + 1) % n;
    const Vec2& a = points[rest[before]];
    const Vec2& b = points[rest[at]];
    const Vec2& c = points[rest[after]];
    bool ear = Cross(a, b, c) > 0.0;
    for (size_t k = 0; ear && k < n; ++k)
    {
      const Vec2& p = points[rest[k]];
      ear = k == before || k == at || k == after || p == a || p == b || p == c ||
        Cross(a, b, p) < 0.0 || Cross(b, c, p) < 0.0 || Cross(c, a, p) < 0.0;
    }
    // A round without an ear: the polygon is degenerate or crosses itself; go on regardless.
    if (ear || failures >= n)
    {
      triangles.push_back({ rest[before], rest[at], rest[after] });
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
      // Go on at the next but one corner, so that the ears are spread round the polygon.
      at = (at + 1) % rest.size();
      failures = 0;
    }
    else
    {
      at = after;
      ++failures;
    }
  }
  if (rest.size() == 3)
  {
    triangles.push_back(rest);
  }
}

}
