#include "PatchTree.h"

#include "BezierEvaluation.h"
#include "BezierRestriction.h"
#include "NetBounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs
{

PartDomain DomainOf(const BezierPatch& patch, int leaf)
{
  const int cell = leaf - patch.FirstLeaf;
  const int i = cell % patch.GridU, j = cell / patch.GridU;
  return { static_cast<double>(i) / patch.GridU, static_cast<double>(i + 1) / patch.GridU,
    static_cast<double>(j) / patch.GridV, static_cast<double>(j + 1) / patch.GridV };
}

const Vec4* NetOfPart(
  const BezierPatch& patch, const Vec4* net, const PartDomain& domain, Vec4* part)
{
  if (domain.S0 == 0 && domain.S1 == 1 && domain.T0 == 0 && domain.T1 == 1)
  {
    return net;
  }
  RestrictNet(patch, net, domain.S0, domain.S1, domain.T0, domain.T1, part);
  return part;
}

void ChooseGrid(const PatchShape& shape, const LeafLimits& limits, BezierPatch& patch)
{
  static constexpr double Finest = 16;
  // Most patches of a large surface are not divided: rounding up is a call of its own.
  const auto roundUp = [](double x) { return x > 1.0 ? std::min(std::ceil(x), Finest) : 1.0; };
  Vec2 divisions(
    roundUp(shape.Bend.x() / limits.Flatness), roundUp(shape.Bend.y() / limits.Flatness));
  const Vec2 leaf = shape.Size.cwiseQuotient(divisions);
  for (int along = 0; along < 2; ++along)
  {
    const double width = leaf[1 - along];
    if (width > 0)
    {
      divisions[along] =
        std::max(divisions[along], roundUp(shape.Size[along] / (limits.Slenderness * width)));
    }
  }
  patch.GridU = static_cast<int>(divisions.x());
  patch.GridV = patch.DegreeV > 0 ? static_cast<int>(divisions.y()) : 1;
}

namespace
{

/// Axes of an oriented box.
struct Frame
{
  Vec3 X, Y, Z;
  Vec3 Local(const Vec3& d) const { return Vec3(this->X.dot(d), this->Y.dot(d), this->Z.dot(d)); }
};

/// For a curve or a collapsed leaf any frame will do. Along the longer sides, or the box would be
/// much too large where the sides of a slender leaf are not at right angles.
Frame FrameOf(const NetBounds& b)
{
  Vec3 x = b.MeanU.norm() >= b.MeanV.norm() ? b.MeanU : b.MeanV, z = b.MeanU.cross(b.MeanV);
  if (!(x.norm() > 0))
  {
    x = Vec3::UnitX();
  }
  x.normalize();
  z -= z.dot(x) * x;
  if (!(z.norm() > 1e-12 * b.MeanU.norm() * b.MeanV.norm()) || z.norm() == 0)
  {
    z = x.unitOrthogonal();
  }
  z.normalize();
  return { x, z.cross(x), z };
}

/// @param radius of the points of the net about the centre.
void MeasureOrientedBox(const Vec3& center, const Frame& frame, const Vec4* part, int size,
  double radius, LeafBox& oriented)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (int k = 0; k < size; ++k)
  {
    const Vec3 local = frame.Local((part[k].head<3>() - part[k].w() * center) / part[k].w());
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  oriented.X = frame.X.cast<float>();
  oriented.Y = frame.Y.cast<float>();
  // The rounding of the centre is made good; that of the axes and of the net by a margin. Without
  // volatile GCC 12 (-O2) takes the conversion to float and back for no conversion.
  Vec3 offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    volatile float rounded = static_cast<float>(center[axis]);
    oriented.Center[axis] = rounded;
    offset[axis] = center[axis] - static_cast<double>(rounded);
  }
  const Vec3 shift = frame.Local(offset);
  const double margin = 1e-6 * (radius + offset.norm()) + 1e-15 * center.cwiseAbs().maxCoeff();
  oriented.Low = (low + shift - Vec3::Constant(margin)).cast<float>();
  oriented.High = (high + shift + Vec3::Constant(margin)).cast<float>();
}

/**
 * The map from the plane of the box to the parameters.
 *
 * @param weight at the centre: the means are derivatives of w S.
 */
void InvertMeans(const NetBounds& b, double weight, const Frame& frame, const PartDomain& domain,
  bool curve, Leaf& leaf)
{
  const double sizeS = domain.S1 - domain.S0, sizeT = domain.T1 - domain.T0;
  const double ux = frame.X.dot(b.MeanU) / weight, uy = frame.Y.dot(b.MeanU) / weight;
  const double vx = frame.X.dot(b.MeanV) / weight, vy = frame.Y.dot(b.MeanV) / weight;
  if (curve)
  {
    leaf.Inverse[0] = static_cast<float>(sizeS / ux);
    return;
  }
  const double det = ux * vy - uy * vx;
  leaf.Inverse[0] = static_cast<float>(sizeS * vy / det);
  leaf.Inverse[1] = static_cast<float>(-sizeS * vx / det);
  leaf.Inverse[2] = static_cast<float>(-sizeT * uy / det);
  leaf.Inverse[3] = static_cast<float>(sizeT * ux / det);
}

}

void MeasureLeaf(const BezierPatch& patch, const PartDomain& domain, const Vec4* part, Leaf& leaf,
  LeafBox& oriented)
{
  const int p = patch.DegreeU, q = patch.DegreeV, size = (p + 1) * (q + 1);
  leaf.Center = BezierPoint(patch, part, 0.5, 0.5);
  Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
  CenterNet(leaf.Center, size, part, centered);
  const NetBounds b = BoundNet(p, q, centered);
  const Frame frame = FrameOf(b);
  leaf.X = frame.X.cast<float>();
  leaf.Y = frame.Y.cast<float>();
  leaf.Z = frame.Z.cast<float>();
  MeasureOrientedBox(leaf.Center, frame, part, size, b.Radius, oriented);

  std::fill(leaf.Inverse, leaf.Inverse + 4, 0.0f);
  leaf.SideCost = leaf.HeightCost = std::numeric_limits<float>::infinity();
  leaf.Deviation = 2.0f;
  UnitSteps steps;
  if (!FindUnitSteps(b, q == 0, steps))
  {
    return;
  }
  const ConvexReach reach = MeasureReach(b, steps);
  leaf.SideCost = reach.Side;
  leaf.HeightCost = reach.Height;
  const double deviation =
    steps.Linear(b.DeviationU + b.Radius * b.WeightU, b.DeviationV + b.Radius * b.WeightV);
  leaf.Deviation = static_cast<float>(std::min(2.0, deviation + 1e-6));
  const double weight = patch.Rational ? BezierWeight(patch, part, 0.5, 0.5) : 1.0;
  InvertMeans(b, weight, frame, domain, q == 0, leaf);
}

}
