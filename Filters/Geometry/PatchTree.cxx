#include "PatchTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs
{

LeafDomain DomainOf(const BezierPatch& patch, int leaf)
{
  const int cell = leaf - patch.FirstLeaf;
  const int i = cell % patch.GridU, j = cell / patch.GridU;
  return { static_cast<double>(i) / patch.GridU, static_cast<double>(i + 1) / patch.GridU,
    static_cast<double>(j) / patch.GridV, static_cast<double>(j + 1) / patch.GridV };
}

NetBounds BoundPatch(const BezierPatch& patch, const Vec4* net)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
  CenterNet(BezierPoint(patch, net, 0.5, 0.5), (p + 1) * (q + 1), net, centered);
  return BoundNet(p, q, centered);
}

Vec2 MeasureBend(const NetBounds& b)
{
  // Lengths of the patch along s and t; a collapsed direction is not divided for its own sake.
  const double lengthU = std::max(b.MeanU.norm(), 1e-3 * b.Extent);
  const double lengthV = std::max(b.MeanV.norm(), 1e-3 * b.Extent);
  if (!(b.Extent > 0))
  {
    return Vec2::Zero();
  }
  const double twist = b.SecondUV + b.Radius * b.WeightUV;
  return Vec2((b.SecondUU + b.Radius * b.WeightUU) / lengthU + twist / lengthV,
    (b.SecondVV + b.Radius * b.WeightVV) / lengthV + twist / lengthU);
}

void ChooseGrid(const Vec2& bend, double flatness, BezierPatch& patch)
{
  constexpr double Finest = 16;
  const Vec2 divisions = (bend / flatness).array().ceil().max(1.0).min(Finest).matrix();
  patch.GridU = static_cast<int>(divisions.x());
  patch.GridV = patch.DegreeV > 0 ? static_cast<int>(divisions.y()) : 1;
}

void MeasureLeaf(const BezierPatch& patch, const LeafDomain& domain, const Vec4* part,
  const NetBounds& b, Leaf& leaf, LeafBox& oriented, Eigen::AlignedBox3f& aligned)
{
  const int p = patch.DegreeU, q = patch.DegreeV, size = (p + 1) * (q + 1);
  leaf.Center = BezierPoint(patch, part, 0.5, 0.5);

  // Frame of the oriented box; for a curve or a collapsed leaf any frame will do.
  Vec3 x = b.MeanU, z = b.MeanU.cross(b.MeanV);
  if (!(x.norm() > 1e-12 * b.Extent))
  {
    x = b.MeanV;
  }
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
  const Vec3 y = z.cross(x);

  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  Vec3 boxLow = low, boxHigh = high;
  const double radius = b.Radius;
  for (int k = 0; k < size; ++k)
  {
    const Vec3 point = part[k].head<3>() / part[k].w();
    const Vec3 d = (part[k].head<3>() - part[k].w() * leaf.Center) / part[k].w();
    const Vec3 local(x.dot(d), y.dot(d), z.dot(d));
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
    boxLow = boxLow.cwiseMin(point);
    boxHigh = boxHigh.cwiseMax(point);
  }
  leaf.X = x.cast<float>();
  leaf.Y = y.cast<float>();
  leaf.Z = z.cast<float>();
  oriented.X = leaf.X;
  oriented.Y = leaf.Y;
  // The rounding of the centre is made good; that of the axes and of the net by a margin. Without
  // volatile GCC 12 (-O2) takes the conversion to float and back for no conversion.
  Vec3 offset;
  for (int axis = 0; axis < 3; ++axis)
  {
    volatile float rounded = static_cast<float>(leaf.Center[axis]);
    oriented.Center[axis] = rounded;
    offset[axis] = leaf.Center[axis] - static_cast<double>(rounded);
  }
  const Vec3 shift(x.dot(offset), y.dot(offset), z.dot(offset));
  const double margin = 1e-6 * (radius + offset.norm()) + 1e-15 * leaf.Center.cwiseAbs().maxCoeff();
  oriented.Low = (low + shift - Vec3::Constant(margin)).cast<float>();
  oriented.High = (high + shift + Vec3::Constant(margin)).cast<float>();
  const double boxMargin =
    1e-7 * std::max(boxLow.cwiseAbs().maxCoeff(), boxHigh.cwiseAbs().maxCoeff());
  aligned.min() = (boxLow.array() - boxMargin).matrix().cast<float>();
  aligned.max() = (boxHigh.array() + boxMargin).matrix().cast<float>();

  const double sizeS = domain.S1 - domain.S0, sizeT = domain.T1 - domain.T0;
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
    steps.Linear(b.DeviationU + radius * b.WeightU, b.DeviationV + radius * b.WeightV);
  leaf.Deviation = static_cast<float>(std::min(2.0, deviation + 1e-6));
  // J0 holds derivatives of w S.
  const double weight = patch.Rational ? BezierWeight(patch, part, 0.5, 0.5) : 1.0;
  const double ux = x.dot(b.MeanU) / weight, uy = y.dot(b.MeanU) / weight;
  const double vx = x.dot(b.MeanV) / weight, vy = y.dot(b.MeanV) / weight;
  if (q == 0)
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

//------------------------------------------------------------------------------
namespace
{

class TreeBuilder
{
public:
  explicit TreeBuilder(std::vector<int>& leaves, const std::vector<Eigen::AlignedBox3f>& boxes)
  {
    this->Items.reserve(leaves.size());
    for (const int leaf : leaves)
    {
      this->Items.push_back({ boxes[leaf], leaf });
    }
  }

  struct Item
  {
    Eigen::AlignedBox3f Box;
    int Leaf;
  };
  std::vector<Item> Items; ///< together with their boxes: what is sorted is looked at
  std::vector<TreeNode> Nodes;

  int Build(int begin, int end)
  {
    const int index = static_cast<int>(this->Nodes.size());
    this->Nodes.emplace_back();
    int bounds[5] = { begin, begin, 0, end, end };
    bounds[2] = this->Split(begin, end);
    bounds[1] = this->Split(begin, bounds[2]);
    bounds[3] = this->Split(bounds[2], end);
    for (int c = 0; c < 4; ++c)
    {
      const int first = bounds[c], last = bounds[c + 1];
      Eigen::AlignedBox3f box;
      for (int k = first; k < last; ++k)
      {
        box.extend(this->Items[k].Box);
      }
      const int child = last - first == 0 ? TreeNode::Empty
                                          : (last - first == 1 ? ~first : this->Build(first, last));
      TreeNode& node = this->Nodes[index]; // Build may have moved it
      node.Child[c] = child;
      for (int axis = 0; axis < 3; ++axis)
      {
        // Empty children lie too far away for any query, but not so far that squares overflow.
        node.Low[axis][c] = child == TreeNode::Empty ? 1e18f : box.min()[axis];
        node.High[axis][c] = child == TreeNode::Empty ? 1e18f : box.max()[axis];
      }
    }
    return index;
  }

private:
  /// Median along the longest axis of the centres; returns the index that parts the halves.
  int Split(int begin, int end)
  {
    const int middle = begin + (end - begin + 1) / 2;
    if (end - begin < 2)
    {
      return middle;
    }
    Eigen::AlignedBox3f centers;
    for (int k = begin; k < end; ++k)
    {
      centers.extend(this->Items[k].Box.center());
    }
    int axis;
    centers.sizes().maxCoeff(&axis);
    std::nth_element(this->Items.begin() + begin, this->Items.begin() + middle,
      this->Items.begin() + end,
      [axis](const Item& a, const Item& b)
      {
        const float x = a.Box.min()[axis] + a.Box.max()[axis];
        const float y = b.Box.min()[axis] + b.Box.max()[axis];
        return x != y ? x < y : a.Leaf < b.Leaf;
      });
    return middle;
  }
};

}

std::vector<TreeNode> BuildTree(
  std::vector<int>& order, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  TreeBuilder builder(order, boxes);
  builder.Nodes.reserve(order.size() / 2 + 1);
  builder.Build(0, static_cast<int>(order.size()));
  std::transform(builder.Items.begin(), builder.Items.end(), order.begin(),
    [](const TreeBuilder::Item& item) { return item.Leaf; });
  return std::move(builder.Nodes);
}

}
