#include "Facet.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// Coefficients of p = p0 + a u + b v.
Eigen::Vector2d LeastSquares(const Vec3& u, const Vec3& v, const Vec3& d)
{
  Eigen::Matrix2d m;
  m << u.dot(u), u.dot(v), u.dot(v), v.dot(v);
  return m.inverse() * Eigen::Vector2d(u.dot(d), v.dot(d));
}

/// Distance from the plane, in edges, up to which a facet counts as plane.
constexpr double PlaneSlack = 1e-12;

/// Step of an iteration, in edges, that rounding still allows.
constexpr double ConvergedStep = 1e-13;

/// A place that is so far beyond the edges does not come back inside after such a step.
constexpr double SurelyOutside = 0.05;
constexpr double SmallStep = 1e-3;

/// How far along the facet from the closest point, in edges, still counts as that point.
constexpr double SlackOfFoot = 1e-6;

double OutsideUnit(double s)
{
  return std::max({ 0.0, -s, s - 1.0 });
}

}

Facet::Facet(const std::vector<Vec3>& places, const BandFace& face)
  : Count(face.Count)
{
  for (int i = 0; i < face.Count; ++i)
  {
    this->Corner[i] = places[face.Node[i]];
  }
}

FacetFoot Facet::Project(const Vec3& x, FootSought sought) const
{
  const auto& c = this->Corner;
  FacetFoot foot;
  if (this->Count == 3)
  {
    const Vec3 u = c[1] - c[0];
    const Vec3 v = c[2] - c[0];
    const Eigen::Vector2d st = LeastSquares(u, v, x - c[0]);
    foot.Normal = u.cross(v).normalized();
    foot.Point = x - foot.Normal * foot.Normal.dot(x - c[0]);
    // Of one without area, as flat elements have, no place is inside.
    const bool isFlat = foot.Normal.isZero() || !st.allFinite();
    foot.Outside = isFlat ? 1.0 : std::max({ 0.0, -st[0], -st[1], st[0] + st[1] - 1.0 });
    return foot;
  }
  const Vec3 u = c[1] - c[0];
  const Vec3 v = c[3] - c[0];
  const Vec3 w = c[2] - c[1] - c[3] + c[0];
  // Gauss-Newton on the bilinear map; a plane parallelogram is done in one step.
  Eigen::Vector2d st(0.5, 0.5);
  for (int i = 0; i < 20; ++i)
  {
    const Vec3 p = c[0] + st[0] * u + st[1] * v + st[0] * st[1] * w;
    const Eigen::Vector2d step =
      LeastSquares(u + st[1] * w, v + st[0] * w, x - p).cwiseMax(-1.0).cwiseMin(1.0);
    st += step;
    st = st.cwiseMax(-2.0).cwiseMin(3.0);
    const bool surelyOutside = sought == FootSought::Inside &&
      std::max(OutsideUnit(st[0]), OutsideUnit(st[1])) > SurelyOutside;
    const double least = surelyOutside ? SmallStep : ConvergedStep;
    if (step.squaredNorm() < least * least)
    {
      break;
    }
  }
  const Vec3 su = u + st[1] * w;
  const Vec3 sv = v + st[0] * w;
  foot.Normal = su.cross(sv).normalized();
  const Vec3 p = c[0] + st[0] * u + st[1] * v + st[0] * st[1] * w;
  // The tangent plane's foot: equal to p where the iteration converged, and exact on planes.
  foot.Point = x - foot.Normal * foot.Normal.dot(x - p);
  foot.Outside = std::max(OutsideUnit(st[0]), OutsideUnit(st[1]));
  // Far from a facet that is strongly twisted it may not converge: that is no foot inside.
  if (!((foot.Point - p).norm() <= SlackOfFoot * (u.norm() + v.norm())))
  {
    foot.Outside = std::max(foot.Outside, 1.0);
  }
  return foot;
}

double Facet::LeadsInto(int corner, const Vec3& direction) const
{
  const Vec3& at = this->Corner[corner];
  const Vec3 u = this->Corner[(corner + 1) % this->Count] - at;
  const Vec3 v = this->Corner[(corner + this->Count - 1) % this->Count] - at;
  const double length = direction.norm();
  if (length == 0.0)
  {
    return 0.0;
  }
  const Eigen::Vector2d st = LeastSquares(u, v, direction);
  return std::min(st[0] * u.norm(), st[1] * v.norm()) / length;
}

double Facet::LengthInEdges(int corner, const Vec3& move) const
{
  const Vec3& at = this->Corner[corner];
  return LeastSquares(this->Corner[(corner + 1) % this->Count] - at,
    this->Corner[(corner + this->Count - 1) % this->Count] - at, move)
    .norm();
}

Vec3 Facet::NormalAt(int corner) const
{
  const Vec3& at = this->Corner[corner];
  return (this->Corner[(corner + 1) % this->Count] - at)
    .cross(this->Corner[(corner + this->Count - 1) % this->Count] - at)
    .normalized();
}

Vec3 Facet::MeanNormal() const
{
  const auto& c = this->Corner;
  return (c[2] - c[0]).cross(c[this->Count - 1] - c[1]).normalized();
}

FacetSearch::FacetSearch(const Facet& facet)
  : Searched(facet)
  , Middle(Vec3::Zero())
{
  const int count = facet.Count;
  const auto& c = facet.Corner;
  for (int i = 0; i < count; ++i)
  {
    this->Middle += c[i] / count;
  }
  double radius = 0.0;
  for (int i = 0; i < count; ++i)
  {
    radius = std::max(radius, (c[i] - this->Middle).squaredNorm());
  }
  this->Radius = std::sqrt(radius);
  this->Normal = facet.MeanNormal();
  this->PlaneAndConvex = this->FindPlaneAndConvex();
  for (int i = 0; i < count; ++i)
  {
    const Vec3 edge = c[(i + 1) % count] - c[i];
    this->Inward[i] = this->Normal.cross(edge);
    this->Squared[i] = edge.squaredNorm();
  }
}

bool FacetSearch::FindPlaneAndConvex() const
{
  const int count = this->Searched.Count;
  const auto& corner = this->Searched.Corner;
  for (int i = 0; i < count; ++i)
  {
    const Vec3& c = corner[i];
    const Vec3 to = corner[(i + 1) % count] - c;
    const Vec3 from = c - corner[(i + count - 1) % count];
    if (std::abs(this->Normal.dot(to)) > PlaneSlack * to.norm() ||
      !(this->Normal.dot(from.cross(to)) > 0.0))
    {
      return false;
    }
  }
  return true;
}

bool FacetSearch::FindInside(const Vec3& x, double slack, Vec3& place) const
{
  if (!this->PlaneAndConvex)
  {
    const FacetFoot foot = this->Searched.Project(x, FootSought::Inside);
    place = foot.Point;
    return foot.Outside <= slack;
  }
  const auto& corner = this->Searched.Corner;
  for (int i = 0; i < this->Searched.Count; ++i)
  {
    if (this->Inward[i].dot(x - corner[i]) < -slack * this->Squared[i])
    {
      return false;
    }
  }
  place = x - this->Normal * this->Normal.dot(x - corner[0]);
  return true;
}

}
