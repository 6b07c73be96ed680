#include "PatchTree.h"

#include "BezierEvaluation.h"
#include "BezierRestriction.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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

const Vec4* NetOfPart(
  const BezierPatch& patch, const Vec4* net, const LeafDomain& domain, Vec4* part)
{
  if (domain.S0 == 0 && domain.S1 == 1 && domain.T0 == 0 && domain.T1 == 1)
  {
    return net;
  }
  RestrictNet(patch, net, domain.S0, domain.S1, domain.T0, domain.T1, part);
  return part;
}

Vec2 MeasureBend(const BezierPatch& patch, const Vec4* net)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
  CenterNet(BezierPoint(patch, net, 0.5, 0.5), (p + 1) * (q + 1), net, centered);
  const NetBounds b = patch.Rational ? BoundNet(p, q, centered) : BoundBend(p, q, centered);
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

Vec2 MeasureSize(const BezierPatch& patch, const Vec4* net)
{
  const auto at = [&](double s, double t) -> Vec3 { return BezierPoint(patch, net, s, t); };
  return Vec2((at(1, 0.5) - at(0, 0.5)).norm(), (at(0.5, 1) - at(0.5, 0)).norm());
}

void ChooseGrid(const Vec2& bend, const Vec2& size, double flatness, BezierPatch& patch)
{
  constexpr double Finest = 16;
  Vec2 divisions = (bend / flatness).array().ceil().max(1.0).min(Finest).matrix();
  const Vec2 leaf = size.cwiseQuotient(divisions);
  for (int along = 0; along < 2; ++along)
  {
    const double width = leaf[1 - along];
    if (width > 0)
    {
      const double least = std::ceil(size[along] / (MostSlender * width));
      divisions[along] = std::max(divisions[along], std::min(least, Finest));
    }
  }
  patch.GridU = static_cast<int>(divisions.x());
  patch.GridV = patch.DegreeV > 0 ? static_cast<int>(divisions.y()) : 1;
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
void InvertMeans(const NetBounds& b, double weight, const Frame& frame, const LeafDomain& domain,
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

void MeasureLeaf(const BezierPatch& patch, const LeafDomain& domain, const Vec4* part, Leaf& leaf,
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

//------------------------------------------------------------------------------
namespace
{

/// A leaf behind the key it is sorted by, so that whole numbers are compared and moved.
using Item = std::uint64_t;

int LeafOf(Item item)
{
  return static_cast<int>(item & 0xffffffffu);
}

/// Items go by rising value, those of the same value by leaf.
Item MakeItem(float value, int leaf)
{
  const float x = value + 0.0f; // -0 is 0
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  constexpr std::uint32_t sign = 0x80000000u;
  bits ^= (bits & sign) != 0 ? ~0u : sign;
  return (static_cast<Item>(bits) << 32) | static_cast<std::uint32_t>(leaf);
}

/// Median of five items spread over a range.
Item FindPivot(const Item* begin, const Item* end)
{
  const std::ptrdiff_t step = (end - begin - 1) / 4;
  Item sample[5];
  for (int k = 0; k < 5; ++k)
  {
    sample[k] = begin[k * step];
  }
  std::sort(sample, sample + 5);
  return sample[2];
}

/// std::nth_element for items, all different; without branches that cannot be foreseen.
void SelectItem(Item* begin, Item* middle, Item* end)
{
  constexpr std::ptrdiff_t Short = 24;
  constexpr int MaximumRounds = 64; // bad pivots; beyond them the library's guarantee is taken
  for (int round = 0; end - begin > Short && round < MaximumRounds; ++round)
  {
    const Item pivot = FindPivot(begin, end);
    Item* below = begin;
    for (Item* it = begin; it != end; ++it)
    {
      const Item item = *it;
      *it = *below;
      *below = item;
      below += item < pivot ? 1 : 0;
    }
    if (middle < below)
    {
      end = below;
    }
    else
    {
      begin = below;
    }
  }
  std::nth_element(begin, middle, end);
}

class TreeBuilder
{
public:
  TreeBuilder(const std::vector<int>& leaves, const std::vector<Eigen::AlignedBox3f>& boxes)
    : Boxes(boxes)
  {
    this->Centers.reserve(boxes.size());
    for (const Eigen::AlignedBox3f& box : boxes)
    {
      this->Centers.emplace_back();
      this->Centers.back() << box.min() + box.max(), 0;
    }
    this->Items.reserve(leaves.size());
    for (const int leaf : leaves)
    {
      this->Items.push_back(MakeItem(0, leaf));
    }
    this->Nodes.reserve(leaves.size() / 2 + 1);
  }

  std::vector<Item> Items;
  std::vector<TreeNode> Nodes;

  /// @return the box of all.
  Eigen::AlignedBox3f Build(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    const std::size_t index = this->Nodes.size();
    this->Nodes.emplace_back();
    std::ptrdiff_t bounds[5] = { begin, begin, 0, end, end };
    bounds[2] = this->Split(begin, end);
    bounds[1] = this->Split(begin, bounds[2]);
    bounds[3] = this->Split(bounds[2], end);
    Eigen::AlignedBox3f all;
    for (int c = 0; c < 4; ++c)
    {
      const std::ptrdiff_t first = bounds[c], count = bounds[c + 1] - first;
      Eigen::AlignedBox3f box;
      int child = TreeNode::Empty;
      if (count == 1)
      {
        child = ~static_cast<int>(first);
        box = this->Boxes[LeafOf(this->Items[first])];
      }
      else if (count > 1)
      {
        child = static_cast<int>(this->Nodes.size());
        box = this->Build(first, first + count);
      }
      all.extend(box);
      TreeNode& node = this->Nodes[index]; // Build may have moved it
      node.Child[c] = child;
      for (int axis = 0; axis < 3; ++axis)
      {
        // Empty children lie too far away for any query, but not so far that squares overflow.
        node.Low[axis][c] = child == TreeNode::Empty ? 1e18f : box.min()[axis];
        node.High[axis][c] = child == TreeNode::Empty ? 1e18f : box.max()[axis];
      }
    }
    return all;
  }

private:
  /// Median along the longest axis of the centres; returns the index that parts the halves.
  std::ptrdiff_t Split(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    const std::ptrdiff_t middle = begin + (end - begin + 1) / 2;
    if (end - begin < 2)
    {
      return middle;
    }
    Eigen::Array4f low = this->Centers[LeafOf(this->Items[begin])], high = low;
    for (std::ptrdiff_t k = begin + 1; k < end; ++k)
    {
      const Eigen::Array4f& center = this->Centers[LeafOf(this->Items[k])];
      low = low.min(center);
      high = high.max(center);
    }
    int axis;
    (high - low).maxCoeff(&axis);
    for (std::ptrdiff_t k = begin; k < end; ++k)
    {
      const int leaf = LeafOf(this->Items[k]);
      this->Items[k] = MakeItem(this->Centers[leaf][axis], leaf);
    }
    Item* items = this->Items.data();
    SelectItem(items + begin, items + middle, items + end);
    return middle;
  }

  const std::vector<Eigen::AlignedBox3f>& Boxes;
  std::vector<Eigen::Array4f> Centers; ///< twice their coordinates
};

}

std::vector<TreeNode> BuildTree(
  std::vector<int>& order, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  TreeBuilder builder(order, boxes);
  builder.Build(0, static_cast<std::ptrdiff_t>(order.size()));
  std::transform(builder.Items.begin(), builder.Items.end(), order.begin(), LeafOf);
  return std::move(builder.Nodes);
}

}
