#include "ElementMap.h"

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

bool FindParameters(const ElementPoints& points, int count, const Vec3& place, Vec3& parameters)
{
  parameters = count == 8 ? Vec3(0.5, 0.5, 0.5) : Vec3(1.0 / 3.0, 1.0 / 3.0, 0.5);
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
