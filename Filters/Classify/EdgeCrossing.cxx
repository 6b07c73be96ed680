#include "EdgeCrossing.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// Share of the edge beyond the surface: walk along the hits, changing sides at each one that
/// truly crosses (the normal tells the direction); a touch changes nothing.
double ShareBeyond(const std::vector<nurbs::LineHit>& hits, const Vec3& direction, bool aIsKept)
{
  bool beyond = !aIsKept;
  double share = 0.0;
  double from = 0.0;
  for (const auto& hit : hits)
  {
    const double k = std::clamp(hit.K, 0.0, 1.0);
    const bool leadsBeyond = hit.Normal.dot(direction) > 0.0;
    if (leadsBeyond == beyond)
    {
      continue;
    }
    share += beyond ? k - from : 0.0;
    from = k;
    beyond = leadsBeyond;
  }
  return share + (beyond ? 1.0 - from : 0.0);
}

/// Bisection on the sign of the distance, for an edge that slips through a gap of a shell.
EdgeCrossing CrossGap(
  const nurbs::TrimmingSurface& surface, const Vec3& a, const Vec3& b, bool aIsKept, double gap)
{
  EdgeCrossing crossing;
  double low = 0.0;
  double high = 1.0;
  nurbs::Foot foot;
  for (int i = 0; i < 60; ++i)
  {
    const double mid = 0.5 * (low + high);
    foot = surface.ClosestPoint(a + mid * (b - a));
    const bool midIsKept = foot.SignedDistance < 0.0;
    (midIsKept == aIsKept ? low : high) = mid;
  }
  if (foot.Kind == nurbs::FootKind::Interior && foot.Distance <= gap)
  {
    crossing.Found = true;
    crossing.Count = 1;
    crossing.K = 0.5 * (low + high);
    crossing.Point = foot.Point;
    crossing.BeyondK = aIsKept ? 1.0 - crossing.K : crossing.K;
  }
  return crossing;
}

}

EdgeCrossing CrossEdge(
  const nurbs::TrimmingSurface& surface, const Vec3& a, const Vec3& b, bool aIsKept, double gap)
{
  const auto hits = surface.Intersect(a, b);
  if (hits.empty())
  {
    return CrossGap(surface, a, b, aIsKept, gap);
  }
  EdgeCrossing crossing;
  crossing.Found = true;
  crossing.Count = static_cast<int>(hits.size());
  crossing.K = std::clamp(hits.front().K, 0.0, 1.0);
  crossing.Point = hits.front().Point;
  crossing.BeyondK = ShareBeyond(hits, b - a, aIsKept);
  return crossing;
}

}
