#include "ElementMap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

constexpr int MostSteps = 25;
/// A step, in parameters, after which nothing changes any more; and one that is small enough, as
/// rounding keeps steps from getting smaller in an element far from the origin.
constexpr double SmallestStep = 1e-13;
constexpr double SmallStep = 1e-6;
/// Parameters so far from the element are no place round it.
constexpr double FarthestParameter = 1e3;
/// Determinant of the map's derivative, of unit columns, below which it is not inverted.
constexpr double Singular = 1e-9;
/// How far outside of an element a place that it holds may come out.
constexpr double Rounding = 1e-9;
/// So far outside of it the map may come to a place in it once more.
constexpr double OtherPlace = 1.0;
/// Parameters near the corners of an element.
constexpr double NearFirst = 0.05, NearLast = 0.9;

}

NodeWeights ShapeFunctions(int count, const Vec3& parameters)
{
  const double r = parameters[0], s = parameters[1], t = parameters[2];
  if (count == 8)
  {
    const double c = (1.0 - r) * (1.0 - s), d = r * (1.0 - s), e = r * s, f = (1.0 - r) * s;
    return { c * (1.0 - t), d * (1.0 - t), e * (1.0 - t), f * (1.0 - t), c * t, d * t, e * t,
      f * t };
  }
  const double o = 1.0 - r - s;
  return { o * (1.0 - t), r * (1.0 - t), s * (1.0 - t), o * t, r * t, s * t, 0.0, 0.0 };
}

Vec3 MapToSpace(const ElementPoints& points, int count, const Vec3& parameters)
{
  // From the first node, so that an element far from the origin loses nothing.
  const NodeWeights weights = ShapeFunctions(count, parameters);
  Vec3 way = Vec3::Zero();
  for (int i = 1; i < count; ++i)
  {
    way += weights[i] * (points[i] - points[0]);
  }
  return points[0] + way;
}

Eigen::Matrix3d MapDerivative(const ElementPoints& p, int count, const Vec3& parameters)
{
  const double r = parameters[0], s = parameters[1], t = parameters[2];
  const auto blend = [](double x, const Vec3& a, const Vec3& b) -> Vec3
  { return (1.0 - x) * a + x * b; };
  Eigen::Matrix3d derivative;
  if (count == 8)
  {
    derivative.col(0) =
      blend(t, blend(s, p[1] - p[0], p[2] - p[3]), blend(s, p[5] - p[4], p[6] - p[7]));
    derivative.col(1) =
      blend(t, blend(r, p[3] - p[0], p[2] - p[1]), blend(r, p[7] - p[4], p[6] - p[5]));
    derivative.col(2) =
      blend(s, blend(r, p[4] - p[0], p[5] - p[1]), blend(r, p[7] - p[3], p[6] - p[2]));
    return derivative;
  }
  const auto [dr, ds, dt] = WedgeDerivatives(p, r, s, t);
  derivative << dr, ds, dt;
  return derivative;
}

namespace
{

/// Newton's method; false if it leads nowhere.
/// @param[in,out] parameters where it begins, and where it has led to.
bool Iterate(const ElementPoints& points, int count, const Vec3& place, Vec3& parameters)
{
  double moved = 1.0;
  for (int step = 0; step < MostSteps && moved > SmallestStep; ++step)
  {
    const Eigen::Matrix3d derivative = MapDerivative(points, count, parameters);
    const double size =
      derivative.col(0).norm() * derivative.col(1).norm() * derivative.col(2).norm();
    if (!(std::abs(derivative.determinant()) > Singular * size))
    {
      return false;
    }
    const Vec3 change = derivative.inverse() * (place - MapToSpace(points, count, parameters));
    parameters += change;
    if (!(parameters.cwiseAbs().maxCoeff() < FarthestParameter))
    {
      return false;
    }
    moved = change.cwiseAbs().maxCoeff();
  }
  return moved < SmallStep;
}

/// Within the box of the nodes, which holds the element.
bool IsInBox(const ElementPoints& points, int count, const Vec3& place)
{
  Eigen::AlignedBox3d box;
  std::for_each(points.begin(), points.begin() + count, [&box](const Vec3& p) { box.extend(p); });
  return box.exteriorDistance(place) <= Rounding * box.diagonal().norm();
}

/// How far outside of an element a place is, by the facet that it is farthest outside of.
double FarthestOutside(int count, const Vec3& parameters)
{
  const auto outside = Outside(count, parameters);
  return *std::max_element(outside.begin(), outside.end());
}

/// From each corner on; false, with the parameters as they were, if that leads to no place in the
/// element.
bool IterateFromCorners(const ElementPoints& points, int count, const Vec3& place, Vec3& parameters)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const auto near = [corner](int axis) { return corner >> axis & 1 ? NearLast : NearFirst; };
    Vec3 at(near(0), near(1), near(2));
    const bool isCorner = count == 8 || at[0] + at[1] < 1.0;
    if (isCorner && Iterate(points, count, place, at) && FarthestOutside(count, at) <= Rounding)
    {
      parameters = at;
      return true;
    }
  }
  return false;
}

}

bool FindParameters(const ElementPoints& points, int count, const Vec3& place, Vec3& parameters)
{
  parameters = count == 8 ? Vec3(0.5, 0.5, 0.5) : Vec3(1.0 / 3.0, 1.0 / 3.0, 0.5);
  const bool found = Iterate(points, count, place, parameters);
  if (found && FarthestOutside(count, parameters) < OtherPlace &&
    MapDerivative(points, count, parameters).determinant() > 0.0)
  {
    return true;
  }
  // In a distorted element the way from the middle may lead beyond where its map folds, though the
  // element holds the place.
  return (IsInBox(points, count, place) && IterateFromCorners(points, count, place, parameters)) ||
    found;
}

std::array<double, 6> Outside(int count, const Vec3& at)
{
  if (count == 8)
  {
    return { -at[0], at[0] - 1.0, -at[1], at[1] - 1.0, -at[2], at[2] - 1.0 };
  }
  return { -at[2], at[2] - 1.0, -at[1], at[0] + at[1] - 1.0, -at[0], -1.0 };
}

Vec3 ClampToElement(int count, const Vec3& parameters)
{
  Vec3 at = parameters.cwiseMax(0.0).cwiseMin(1.0);
  if (count == 6 && at[0] + at[1] > 1.0)
  {
    at.head<2>() /= at[0] + at[1];
  }
  return at;
}

}
