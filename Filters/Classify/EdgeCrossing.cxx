#include "EdgeCrossing.h"

#include <algorithm>

namespace trim
{
namespace
{

/// Walks along the hits, changing sides at each one that truly crosses (the normal tells the
/// direction); a touch changes nothing.
double ShareBeyond(const std::vector<nurbs::LineHit>& hits, const Vec3& direction)
{
  bool beyond = true;
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
std::optional<EdgeCrossing> CrossGap(
  const nurbs::TrimmingSurface& surface, const Vec3& eliminated, const Vec3& kept, double gap)
{
  double low = 0.0;
  double high = 1.0;
  nurbs::Foot foot;
  for (int i = 0; i < 60; ++i)
  {
    const double mid = 0.5 * (low + high);
    foot = surface.ClosestPoint(eliminated + mid * (kept - eliminated));
    (foot.SignedDistance < 0.0 ? high : low) = mid;
  }
  if (foot.Kind == nurbs::FootKind::Interior && foot.Distance <= gap)
  {
    return EdgeCrossing{ 0.5 * (low + high), foot.Normal };
  }
  return std::nullopt;
}

}

std::optional<EdgeCrossing> CrossEdge(
  const nurbs::TrimmingSurface& surface, const Vec3& eliminated, const Vec3& kept, double gap)
{
  const auto hits = surface.Intersect(eliminated, kept);
  if (hits.empty())
  {
    return CrossGap(surface, eliminated, kept, gap);
  }
  return EdgeCrossing{ ShareBeyond(hits, kept - eliminated), hits.front().Normal };
}

}
