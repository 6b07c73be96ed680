#include "DirectionBehind.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>

namespace trim
{
namespace
{

/// Of the nearest point, by products of unit vectors: normals that turn by 3e-5 count as one.
constexpr double Rounding = 1e-9;
/// Of what such normals span: points in a line, or at one place.
constexpr double NoLength = 1e-18, NoArea = 1e-30;

/// Takes away what leads out of the planes held.
Eigen::Matrix3d ProjectionInto(const std::vector<Vec3>& held, double turn)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vec3& normal : held)
  {
    sum += normal * normal.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(sum);
  // Half of the normals to either side of the middle.
  const double least = static_cast<double>(held.size()) * std::pow(std::sin(0.5 * turn), 2);
  Eigen::Matrix3d projection = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i)
  {
    if (axes.eigenvalues()[i] > least)
    {
      const Vec3 axis = axes.eigenvectors().col(i);
      projection -= axis * axis.transpose();
    }
  }
  return projection;
}

/// The point of a plane, line or single point nearest to the origin, zero if it is not between the
/// points that span it.
Vec3 NearestOf(const Vec3& a)
{
  return a;
}

Vec3 NearestOf(const Vec3& a, const Vec3& b)
{
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double share = length > NoLength ? -a.dot(along) / length : -1.0;
  return share > 0.0 && share < 1.0 ? Vec3(a + share * along) : Vec3(Vec3::Zero());
}

Vec3 NearestOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (!(area > NoArea))
  {
    return Vec3::Zero();
  }
  const Vec3 nearest = normal * (a.dot(normal) / area);
  const auto isInside = [&](const Vec3& from, const Vec3& to)
  { return (to - from).cross(nearest - from).dot(normal) > 0.0; };
  return isInside(a, b) && isInside(b, c) && isInside(c, a) ? nearest : Vec3(Vec3::Zero());
}

/// Whether no point lies before the plane through the nearest one.
bool IsNearest(const std::vector<Vec3>& points, const Vec3& nearest)
{
  const double squared = nearest.squaredNorm();
  return squared > Rounding &&
    std::all_of(points.begin(), points.end(),
      [&](const Vec3& point) { return point.dot(nearest) > squared - Rounding; });
}

/// The point of the hull of a few points that is nearest to the origin, zero if it is the origin.
Vec3 NearestOfFew(const std::vector<Vec3>& points)
{
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (Vec3 nearest = NearestOf(points[i]); IsNearest(points, nearest))
    {
      return nearest;
    }
    for (std::size_t j = 0; j < i; ++j)
    {
      if (Vec3 nearest = NearestOf(points[i], points[j]); IsNearest(points, nearest))
      {
        return nearest;
      }
      for (std::size_t k = 0; k < j; ++k)
      {
        if (Vec3 nearest = NearestOf(points[i], points[j], points[k]); IsNearest(points, nearest))
        {
          return nearest;
        }
      }
    }
  }
  return Vec3::Zero();
}

/// The same of any number of points, by the simplex that comes nearer point by point (Gilbert,
/// Johnson, Keerthi 1988): hundreds of facets meet at the axis of a disc of wedges.
Vec3 NearestOfHull(const std::vector<Vec3>& points)
{
  if (points.empty())
  {
    return Vec3::Zero();
  }
  const auto shortest = std::min_element(points.begin(), points.end(),
    [](const Vec3& a, const Vec3& b) { return a.squaredNorm() < b.squaredNorm(); });
  std::set<std::ptrdiff_t> simplex{ shortest - points.begin() };
  for (std::size_t round = 0; round < 4 * points.size(); ++round)
  {
    std::vector<Vec3> few;
    for (const std::ptrdiff_t i : simplex)
    {
      few.push_back(points[i]);
    }
    const Vec3 nearest = NearestOfFew(few);
    if (nearest.isZero(0.0) || IsNearest(points, nearest))
    {
      return nearest;
    }
    const auto along = [&](const Vec3& point) { return point.dot(nearest); };
    const auto before = std::min_element(points.begin(), points.end(),
      [&](const Vec3& a, const Vec3& b) { return along(a) < along(b); });
    for (auto i = simplex.begin(); i != simplex.end();)
    {
      const bool spans = along(points[*i]) < nearest.squaredNorm() + Rounding;
      i = spans ? std::next(i) : simplex.erase(i);
    }
    simplex.insert(before - points.begin());
  }
  return Vec3::Zero(); // only rounding can tell it from the origin
}

}

DirectionBehind FindDirectionBehind(
  const std::vector<Vec3>& normals, const std::vector<Vec3>& held, double turn)
{
  const Eigen::Matrix3d projection = ProjectionInto(held, turn);
  std::vector<Vec3> points;
  for (const Vec3& normal : normals)
  {
    points.emplace_back(projection * normal);
  }
  const Vec3 nearest = NearestOfHull(points);
  const double sine = nearest.norm();
  return sine > 0.0 ? DirectionBehind{ -nearest / sine, sine } : DirectionBehind();
}

}
