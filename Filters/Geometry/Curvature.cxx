#include "Curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nurbs
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Where a surface has a tangent plane.
struct Tangents
{
  SurfaceJet Jet;
  Vec3 Normal; ///< S_u x S_v
  double Area; ///< its square, > 0
};

/// @param map applied to the surface.
std::optional<Tangents> TangentsAt(
  const TrimmingSurface& surface, const Foot& foot, const Eigen::Matrix3d& map)
{
  if (foot.Face < 0 || foot.Face >= surface.NumberOfFaces())
  {
    return std::nullopt;
  }
  SurfaceJet jet = EvaluateJet(surface.Face(foot.Face), foot.U, foot.V);
  for (Vec3* derivative : { &jet.Su, &jet.Sv, &jet.Suu, &jet.Suv, &jet.Svv })
  {
    *derivative = map * *derivative;
  }
  const Vec3 normal = jet.Su.cross(jet.Sv);
  const double area = normal.squaredNorm();
  return area > 0 ? std::optional<Tangents>({ jet, normal, area }) : std::nullopt;
}

}

double RadiusOfCurvature(
  const TrimmingSurface& surface, const Foot& foot, const Eigen::Matrix3d& map)
{
  const auto tangents = TangentsAt(surface, foot, map);
  if (!tangents)
  {
    return Infinity;
  }
  const auto& [jet, n, area] = *tangents;
  // First and second fundamental forms; k^2 - 2 H k + K = 0.
  const double E = jet.Su.squaredNorm(), F = jet.Su.dot(jet.Sv), G = jet.Sv.squaredNorm();
  const Vec3 unit = n / std::sqrt(area);
  const double L = jet.Suu.dot(unit), M = jet.Suv.dot(unit), N = jet.Svv.dot(unit);
  const double H = 0.5 * (E * N - 2 * F * M + G * L) / area, K = (L * N - M * M) / area;
  const double k = std::abs(H) + std::sqrt(std::max(0.0, H * H - K));
  return k > 0 ? 1.0 / k : Infinity;
}

double RadiusOfCurvatureAlong(
  const TrimmingSurface& surface, const Foot& foot, const Vec3& direction)
{
  const auto tangents = TangentsAt(surface, foot, Eigen::Matrix3d::Identity());
  if (!tangents)
  {
    return Infinity;
  }
  const auto& [jet, n, area] = *tangents;
  // The direction as a Su + b Sv; its curvature is the second over the first fundamental form.
  const double a = direction.cross(jet.Sv).dot(n) / area;
  const double b = jet.Su.cross(direction).dot(n) / area;
  const double bend =
    std::abs((a * a * jet.Suu + 2 * a * b * jet.Suv + b * b * jet.Svv).dot(n)) / std::sqrt(area);
  return bend > 0 ? (a * jet.Su + b * jet.Sv).squaredNorm() / bend : Infinity;
}

}
