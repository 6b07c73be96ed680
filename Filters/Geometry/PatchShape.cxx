#include "PatchShape.h"

#include "BezierEvaluation.h"
#include "NetBounds.h"

#include <algorithm>
#include <limits>

namespace nurbs
{
namespace
{

/// @param extent of the patch, about.
Vec2 MeasureBend(const BezierPatch& patch, const Vec4* net, double extent)
{
  if (!(extent > 0))
  {
    return Vec2::Zero();
  }
  const int p = patch.DegreeU, q = patch.DegreeV;
  NetBounds b;
  if (patch.Rational)
  {
    Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
    CenterNet(BezierPoint(patch, net, 0.5, 0.5), (p + 1) * (q + 1), net, centered);
    b = BoundNet(p, q, centered);
  }
  else
  {
    b = BoundBend(p, q, net);
  }
  // Lengths of the patch along s and t; a collapsed direction is not divided for its own sake.
  const double lengthU = std::max(b.MeanU.norm(), 1e-3 * extent);
  const double lengthV = std::max(b.MeanV.norm(), 1e-3 * extent);
  const double twist = b.SecondUV + b.Radius * b.WeightUV;
  return Vec2((b.SecondUU + b.Radius * b.WeightUU) / lengthU + twist / lengthV,
    (b.SecondVV + b.Radius * b.WeightVV) / lengthV + twist / lengthU);
}

Vec2 MeasureSize(const BezierPatch& patch, const Vec4* net)
{
  const auto middle = [&](int side) -> Vec3 { return MiddleOfSide(patch, net, side); };
  return Vec2((middle(1) - middle(0)).norm(), (middle(3) - middle(2)).norm());
}

}

Eigen::AlignedBox3f BoxOfNet(const Vec4* net, int size)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (int k = 0; k < size; ++k)
  {
    const Vec3 point = CartesianPoint(net[k]);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double margin = 1e-7 * std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  return Eigen::AlignedBox3f(
    (low.array() - margin).matrix().cast<float>(), (high.array() + margin).matrix().cast<float>());
}

PatchShape MeasurePatch(const BezierPatch& patch, const Vec4* net)
{
  PatchShape shape;
  shape.Box = BoxOfNet(net, (patch.DegreeU + 1) * (patch.DegreeV + 1));
  shape.Bend = MeasureBend(patch, net, 0.5 * shape.Box.diagonal().norm());
  shape.Size = MeasureSize(patch, net);
  return shape;
}

}
