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

namespace
{

/// Greatest first and second differences of a homogeneous net about a centre.
struct NetBounds
{
  Vec3 MeanU = Vec3::Zero(), MeanV = Vec3::Zero();
  double DeviationU = 0, DeviationV = 0; ///< of the first derivative from its mean
  double WeightU = 0, WeightV = 0;       ///< first derivative of the weight
  double SecondUU = 0, SecondUV = 0, SecondVV = 0;
  double WeightUU = 0, WeightUV = 0, WeightVV = 0;
  double Extent = 0, MaxWeight = 0;
};

NetBounds BoundNet(int p, int q, const Vec4* net, const Vec3& center)
{
  const int nu = p + 1;
  NetBounds b;
  const auto at = [&](int i, int j) -> Vec4
  {
    Vec4 a = net[i + j * nu];
    a.head<3>() -= a.w() * center;
    return a;
  };
  const auto du = [&](int i, int j) -> Vec4 { return p * (at(i + 1, j) - at(i, j)); };
  const auto dv = [&](int i, int j) -> Vec4 { return q * (at(i, j + 1) - at(i, j)); };
  for (int j = 0; j <= q; ++j)
  {
    b.MeanU += (at(p, j) - at(0, j)).head<3>() / (q + 1);
  }
  for (int i = 0; i <= p && q > 0; ++i)
  {
    b.MeanV += (at(i, q) - at(i, 0)).head<3>() / (p + 1);
  }
  const auto raise = [](double& bound, double value) { bound = std::max(bound, value); };
  for (int j = 0; j <= q; ++j)
  {
    for (int i = 0; i <= p; ++i)
    {
      const Vec4 a = at(i, j);
      raise(b.Extent, a.head<3>().norm());
      raise(b.MaxWeight, a.w());
      if (i < p)
      {
        const Vec4 d = du(i, j);
        raise(b.DeviationU, (d.head<3>() - b.MeanU).norm());
        raise(b.WeightU, std::abs(d.w()));
      }
      if (j < q)
      {
        const Vec4 d = dv(i, j);
        raise(b.DeviationV, (d.head<3>() - b.MeanV).norm());
        raise(b.WeightV, std::abs(d.w()));
      }
      if (i + 1 < p)
      {
        const Vec4 d = (p - 1) * (du(i + 1, j) - du(i, j));
        raise(b.SecondUU, d.head<3>().norm());
        raise(b.WeightUU, std::abs(d.w()));
      }
      if (j + 1 < q)
      {
        const Vec4 d = (q - 1) * (dv(i, j + 1) - dv(i, j));
        raise(b.SecondVV, d.head<3>().norm());
        raise(b.WeightVV, std::abs(d.w()));
      }
      if (i < p && j < q)
      {
        const Vec4 d = q * (du(i, j + 1) - du(i, j));
        raise(b.SecondUV, d.head<3>().norm());
        raise(b.WeightUV, std::abs(d.w()));
      }
    }
  }
  return b;
}

/**
 * Row norms of T = (J^T J)^(-1/2) for J = [MeanU MeanV]: with x = T y and |y| = 1 every step x
 * of unit length on the surface is reached. False if J has lost rank.
 */
bool UnitSteps(const NetBounds& b, bool curve, double& stepU, double& stepV)
{
  const double e = b.MeanU.squaredNorm(), g = b.MeanV.squaredNorm(), f = b.MeanU.dot(b.MeanV);
  stepV = 0;
  if (curve)
  {
    stepU = e > 0 ? 1.0 / std::sqrt(e) : 0;
    return e > 0;
  }
  const double det = e * g - f * f;
  if (!(det > 1e-12 * e * g) || !(det > 0))
  {
    return false;
  }
  // Rows of any T with T T^T = (J^T J)^-1 have the norms of the diagonal of the inverse.
  stepU = std::sqrt(g / det);
  stepV = std::sqrt(e / det);
  return true;
}

/**
 * Largest r such that F(s, t) = |A - w P|^2 - d^2 w^2 is convex over the leaf for all |P| <= r,
 * d <= r, with A the homogeneous net about the leaf's centre. Then {S : |S - P| <= d} is a
 * convex set of parameters, so a point of the leaf that fulfils the Kuhn-Tucker conditions is
 * its closest point.
 */
double ConvexReach(const NetBounds& b, double stepU, double stepV)
{
  const double uu = stepU * stepU, uv = 2 * stepU * stepV, vv = stepV * stepV;
  const double first = stepU * b.DeviationU + stepV * b.DeviationV;
  const double second = uu * b.SecondUU + uv * b.SecondUV + vv * b.SecondVV;
  const double weight = stepU * b.WeightU + stepV * b.WeightV;
  const double weight2 = uu * b.WeightUU + uv * b.WeightUV + vv * b.WeightVV;
  const auto convex = [&](double r)
  {
    const double slope = 1 - first - weight * r;
    return slope > 0 &&
      slope * slope > (b.Extent + b.MaxWeight * r) * (second + weight2 * r) +
          r * r * (weight * weight + b.MaxWeight * weight2);
  };
  double low = 0, high = 1e6 * (b.Extent + 1e-300);
  if (!convex(low))
  {
    return -1;
  }
  if (convex(high))
  {
    return high;
  }
  for (int i = 0; i < 60; ++i)
  {
    const double middle = i < 30 ? std::sqrt((low + 1e-9 * high) * high) : 0.5 * (low + high);
    (convex(middle) ? low : high) = middle;
  }
  return 0.999 * low;
}

}

void ChooseGrid(const Vec4* net, BezierPatch& patch)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  const Vec3 center = BezierPoint(patch, net, 0.5, 0.5);
  const NetBounds b = BoundNet(p, q, net, center);
  const double radius = b.Extent / b.MaxWeight;
  // Lengths of the patch along s and t; a collapsed direction is not divided for its own sake.
  const double lengthU = std::max(b.MeanU.norm(), 1e-3 * b.Extent);
  const double lengthV = std::max(b.MeanV.norm(), 1e-3 * b.Extent);
  const double bendU = (b.SecondUU + radius * b.WeightUU) / lengthU +
    (b.SecondUV + radius * b.WeightUV) / lengthV;
  const double bendV = (b.SecondVV + radius * b.WeightVV) / lengthV +
    (b.SecondUV + radius * b.WeightUV) / lengthU;
  constexpr double Flat = 0.15;
  constexpr int Finest = 16;
  const auto divisions = [=](double bend)
  { return std::clamp(static_cast<int>(std::ceil(std::min(bend / Flat, 1e3) - 1e-6)), 1, Finest); };
  patch.GridU = divisions(bendU);
  patch.GridV = q > 0 ? divisions(bendV) : 1;
}

void MeasureLeaf(const BezierPatch& patch, const LeafDomain& domain, const Vec4* part, Leaf& leaf,
  Eigen::AlignedBox3f& box)
{
  const int p = patch.DegreeU, q = patch.DegreeV, size = (p + 1) * (q + 1);
  leaf.Center = BezierPoint(patch, part, 0.5, 0.5);
  const NetBounds b = BoundNet(p, q, part, leaf.Center);

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
  double radius = 0;
  for (int k = 0; k < size; ++k)
  {
    const Vec3 point = part[k].head<3>() / part[k].w();
    const Vec3 d = point - leaf.Center;
    const Vec3 local(x.dot(d), y.dot(d), z.dot(d));
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
    boxLow = boxLow.cwiseMin(point);
    boxHigh = boxHigh.cwiseMax(point);
    radius = std::max(radius, d.norm());
  }
  // Outwards by more than the rounding of float axes and of the net.
  const double margin = 1e-6 * radius + 1e-15 * leaf.Center.cwiseAbs().maxCoeff();
  leaf.X = x.cast<float>();
  leaf.Y = y.cast<float>();
  leaf.Z = z.cast<float>();
  leaf.Low = (low.array() - margin).matrix().cast<float>();
  leaf.High = (high.array() + margin).matrix().cast<float>();
  leaf.Radius = static_cast<float>(radius * (1 + 1e-6) + margin);
  const double boxMargin = 1e-7 * std::max(boxLow.cwiseAbs().maxCoeff(), boxHigh.cwiseAbs().maxCoeff());
  box.min() = (boxLow.array() - boxMargin).matrix().cast<float>();
  box.max() = (boxHigh.array() + boxMargin).matrix().cast<float>();

  const double sizeS = domain.S1 - domain.S0, sizeT = domain.T1 - domain.T0;
  double stepU, stepV;
  std::fill(leaf.Inverse, leaf.Inverse + 4, 0.0f);
  leaf.Reach = -1.0f;
  leaf.Deviation = 2.0f;
  if (!UnitSteps(b, q == 0, stepU, stepV))
  {
    return;
  }
  leaf.Reach = static_cast<float>(ConvexReach(b, stepU, stepV));
  leaf.Deviation = static_cast<float>(
    std::min(2.0, stepU * (b.DeviationU + radius * b.WeightU) + stepV * (b.DeviationV + radius * b.WeightV)) +
    1e-6);
  const double weight = part[size / 2].w(); // J0 holds derivatives of w S
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
  TreeBuilder(std::vector<int>& leaves, const std::vector<Eigen::AlignedBox3f>& boxes)
    : Leaves(leaves)
    , Boxes(boxes)
  {
  }

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
        box.extend(this->Boxes[this->Leaves[k]]);
      }
      const int child = last - first == 0
        ? TreeNode::Empty
        : (last - first == 1 ? ~this->Leaves[first] : this->Build(first, last));
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
      centers.extend(this->Boxes[this->Leaves[k]].center());
    }
    int axis;
    centers.sizes().maxCoeff(&axis);
    std::nth_element(this->Leaves.begin() + begin, this->Leaves.begin() + middle,
      this->Leaves.begin() + end,
      [&](int a, int b)
      {
        const float x = this->Boxes[a].min()[axis] + this->Boxes[a].max()[axis];
        const float y = this->Boxes[b].min()[axis] + this->Boxes[b].max()[axis];
        return x != y ? x < y : a < b;
      });
    return middle;
  }

  std::vector<int>& Leaves;
  const std::vector<Eigen::AlignedBox3f>& Boxes;
};

}

std::vector<TreeNode> BuildTree(
  std::vector<int> leaves, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  TreeBuilder builder(leaves, boxes);
  builder.Build(0, static_cast<int>(leaves.size()));
  return std::move(builder.Nodes);
}

}
