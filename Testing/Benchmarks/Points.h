/**
 * @file Points.h
 * @brief The points that the benchmarks of the kernel ask for.
 */
#ifndef Points_h
#define Points_h

#include "NurbsSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace benchmark
{
using nurbs::NurbsSurface;
using nurbs::Vec3;

/// A place of a surface and a point beside it, along the normal.
struct NearPoint
{
  Vec3 Foot, Point;
};

enum class Order
{
  Random, ///< nothing to do with each other
  Mesh    ///< row after row, like the nodes of a mesh along the surface
};

inline std::vector<NearPoint> PointsNear(
  const NurbsSurface& surface, int count, double height, Order order)
{
  std::mt19937 random(3);
  const auto draw = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  const int row = std::max(1, static_cast<int>(std::sqrt(count)));
  const int rows = (count + row - 1) / row;
  std::vector<NearPoint> points;
  for (int k = 0; k < count; ++k)
  {
    const double x = order == Order::Random ? draw(0, 1) : (k % row + draw(0.4, 0.6)) / row;
    const double y = order == Order::Random ? draw(0, 1) : (k / row + draw(0.4, 0.6)) / rows;
    const nurbs::SurfaceJet jet =
      nurbs::EvaluateJet(surface, surface.FirstU() + x * (surface.LastU() - surface.FirstU()),
        surface.FirstV() + y * (surface.LastV() - surface.FirstV()));
    points.push_back({ jet.S, jet.S + draw(-height, height) * jet.Su.cross(jet.Sv).normalized() });
  }
  return points;
}

/// Anywhere in the box of the surface, widened by a fifth of its diagonal.
inline std::vector<NearPoint> PointsAround(const NurbsSurface& surface, int count)
{
  const nurbs::Box3 box = nurbs::BoxOf(surface);
  const Vec3 half = 0.5 * box.sizes() + Vec3::Constant(0.2 * box.diagonal().norm());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> draw(-1, 1);
  std::vector<NearPoint> points(count);
  for (NearPoint& point : points)
  {
    const double x = draw(random), y = draw(random), z = draw(random);
    point.Point = box.center() + half.cwiseProduct(Vec3(x, y, z));
  }
  return points;
}
}

#endif
