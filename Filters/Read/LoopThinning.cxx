#include "LoopThinning.h"

#include <algorithm>

namespace nurbs
{
namespace
{

/// Are the corners between two corners of a loop within the tolerance of their chord?
bool IsChord(
  const std::vector<Vec2>& loop, size_t first, size_t last, const Vec2& unit, double tolerance)
{
  const Vec2 origin = loop[first].cwiseQuotient(unit);
  const Vec2 chord = loop[last % loop.size()].cwiseQuotient(unit) - origin;
  for (size_t k = first + 1; k < last; ++k)
  {
    const Vec2 arm = loop[k].cwiseQuotient(unit) - origin;
    const double along =
      chord.squaredNorm() > 0.0 ? std::clamp(arm.dot(chord) / chord.squaredNorm(), 0.0, 1.0) : 0.0;
    if ((arm - along * chord).norm() > tolerance)
    {
      return false;
    }
  }
  return true;
}

}

//------------------------------------------------------------------------------
std::vector<std::vector<Vec2>> ThinLoops(
  const std::vector<std::vector<Vec2>>& loops, const Vec2& unit, double tolerance)
{
  std::vector<std::vector<Vec2>> thinned;
  for (const std::vector<Vec2>& loop : loops)
  {
    std::vector<Vec2> thin;
    const size_t n = loop.size();
    for (size_t anchor = 0; anchor < n;)
    {
      thin.push_back(loop[anchor]);
      // The farthest corner that a chord reaches, not more than a third of the loop away so
      // that a loop stays a loop.
      size_t end = anchor + 1;
      while (end < n && end + 1 - anchor <= std::max<size_t>(1, n / 3) &&
        IsChord(loop, anchor, end + 1, unit, tolerance))
      {
        ++end;
      }
      anchor = end;
    }
    thinned.push_back(thin.size() < 3 ? loop : thin);
  }
  return thinned;
}

}
