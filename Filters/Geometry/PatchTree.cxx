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

/// Greatest first and second derivatives by the control net, about a centre.
struct NetBounds
{
  Vec3 MeanU = Vec3::Zero(), MeanV = Vec3::Zero();
  double DeviationU = 0, DeviationV = 0; ///< of the first derivative from its mean
  double NormalU = 0, NormalV = 0;       ///< component of the first derivative along the normal
  double WeightU = 0, WeightV = 0;       ///< first derivative of the weight
  double SecondUU = 0, SecondUV = 0, SecondVV = 0;
  double NormalUU = 0, NormalUV = 0, NormalVV = 0; ///< second derivatives along the normal
  double WeightUU = 0, WeightUV = 0, WeightVV = 0;
  double Extent = 0, NormalExtent = 0, MaxWeight = 0;
  double Radius = 0; ///< of the Cartesian points
};

/// Greatest lengths of the differences of a net; of three parts of them.
struct DifferenceBounds
{
  double Length = 0, Normal = 0, Weight = 0;
  void Add(const Vec4& d, const Vec3& normal, const Vec3& mean)
  {
    const Vec3 x = d.head<3>() - mean;
    this->Length = std::max(this->Length, x.squaredNorm());
    this->Normal = std::max(this->Normal, std::abs(normal.dot(d.head<3>())));
    this->Weight = std::max(this->Weight, std::abs(d.w()));
  }
  void Store(double factor, double& length, double& normal, double& weight) const
  {
    length = factor * std::sqrt(this->Length);
    normal = factor * this->Normal;
    weight = factor * this->Weight;
  }
};

/// @param net about the centre; its mean derivatives and normal are found first.
NetBounds BoundNet(int p, int q, const Vec4* net)
{
  const int nu = p + 1, nv = q + 1;
  NetBounds b;
  for (int j = 0; j < nv; ++j)
  {
    b.MeanU += (net[p + j * nu] - net[j * nu]).head<3>() / nv;
  }
  for (int i = 0; i < nu && q > 0; ++i)
  {
    b.MeanV += (net[i + q * nu] - net[i]).head<3>() / nu;
  }
  Vec3 normal = b.MeanU.cross(b.MeanV);
  // A curve has no normal: all directions across it count, so the lengths themselves are used.
  const double area = normal.norm();
  normal = area > 0 ? Vec3(normal / area) : Vec3(Vec3::Zero());
  const Vec3 zero = Vec3::Zero();
  const Vec3 stepU = b.MeanU / std::max(p, 1), stepV = b.MeanV / std::max(q, 1);
  DifferenceBounds points, u, v, uu, uv, vv;
  Vec4 row[MaximumBezierDegree + 1]; // differences along v of the row above
  for (int j = 0; j < nv; ++j)
  {
    const Vec4* c = net + j * nu;
    for (int i = 0; i < nu; ++i)
    {
      points.Add(c[i], normal, zero);
      b.MaxWeight = std::max(b.MaxWeight, c[i].w());
      b.Radius = std::max(b.Radius, c[i].head<3>().squaredNorm() / (c[i].w() * c[i].w()));
      if (i < p)
      {
        u.Add(c[i + 1] - c[i], normal, stepU);
      }
      if (i + 1 < p)
      {
        uu.Add(c[i + 2] - 2 * c[i + 1] + c[i], normal, zero);
      }
      if (j < q)
      {
        const Vec4 d = c[i + nu] - c[i];
        v.Add(d, normal, stepV);
        if (j > 0)
        {
          vv.Add(d - row[i], normal, zero);
        }
        row[i] = d;
        if (i > 0)
        {
          uv.Add(d - row[i - 1], normal, zero);
        }
      }
    }
  }
  double unused;
  points.Store(1, b.Extent, b.NormalExtent, unused);
  b.Radius = std::sqrt(b.Radius);
  u.Store(p, b.DeviationU, b.NormalU, b.WeightU);
  v.Store(q, b.DeviationV, b.NormalV, b.WeightV);
  uu.Store(p * (p - 1), b.SecondUU, b.NormalUU, b.WeightUU);
  uv.Store(p * q, b.SecondUV, b.NormalUV, b.WeightUV);
  vv.Store(q * (q - 1), b.SecondVV, b.NormalVV, b.WeightVV);
  if (area == 0)
  {
    b.NormalU = b.DeviationU;
    b.NormalUU = b.SecondUU;
    b.NormalExtent = b.Extent;
  }
  return b;
}

/// Moves a net so that the centre is its origin.
void CenterNet(const Vec3& center, int size, const Vec4* net, Vec4* centered)
{
  for (int k = 0; k < size; ++k)
  {
    centered[k] = net[k];
    centered[k].head<3>() -= net[k].w() * center;
  }
}

/// std::hypot guards against overflow at ten times the cost.
inline double Hypotenuse(double a, double b)
{
  return std::sqrt(a * a + b * b);
}

/**
 * Steps (s, t) = (Along y1 + Back y2, Across y2) with y of unit length reach every step of unit
 * length on the plane of the mean derivatives (Gram-Schmidt); Back is an absolute value.
 */
struct UnitSteps
{
  double Along = 0, Back = 0, Across = 0;

  /// Bound of a linear map whose columns have the lengths u and v.
  double Linear(double u, double v) const
  {
    return Hypotenuse(this->Along * u, this->Across * v + this->Back * u);
  }
  /// Bound of a quadratic form whose entries are at most uu, uv, vv.
  double Quadratic(double uu, double uv, double vv) const
  {
    const double a = this->Along * this->Along * uu;
    const double b = this->Along * (this->Across * uv + this->Back * uu);
    const double c = this->Across * this->Across * vv + 2 * this->Across * this->Back * uv +
      this->Back * this->Back * uu;
    return 0.5 * (a + c) + Hypotenuse(0.5 * (a - c), b);
  }
};

/// False if the mean derivatives have lost rank.
bool FindUnitSteps(const NetBounds& b, bool curve, UnitSteps& steps)
{
  const double e = b.MeanU.squaredNorm(), g = b.MeanV.squaredNorm(), f = b.MeanU.dot(b.MeanV);
  if (!(e > 0))
  {
    return false;
  }
  steps.Along = 1.0 / std::sqrt(e);
  if (curve)
  {
    return true;
  }
  const double across = g - f * f / e;
  if (!(across > 1e-12 * g))
  {
    return false;
  }
  steps.Across = 1.0 / std::sqrt(across);
  steps.Back = std::abs(f) / e * steps.Across;
  return true;
}

/**
 * When F(s, t) = |A - w P|^2 - d^2 w^2 is convex over the leaf, for every d that occurs on it; A is
 * the homogeneous net about the leaf's centre. Then {S : |S - P| <= d} is a convex set of
 * parameters, so a point of the leaf that fulfils the Kuhn-Tucker conditions is its closest
 * point. With subscripts for derivatives along a unit step,
 *   F_uu / 2 = |A_u|^2 - 2 w_u A_u.P + A.A_uu - w_uu A.P - w A_uu.P + (w_u^2 + w w_uu)(P^2 - d^2)
 * where |P^2 - d^2| <= 2 |P| R + R^2; each term is bounded by the net and is linear in the
 * components of P across (side) and along the normal (height).
 */
void MeasureReach(const NetBounds& b, const UnitSteps& steps, Leaf& leaf)
{
  const double first = steps.Linear(b.DeviationU, b.DeviationV);
  const double firstNormal = steps.Linear(b.NormalU, b.NormalV);
  const double second = steps.Quadratic(b.SecondUU, b.SecondUV, b.SecondVV);
  const double secondNormal = steps.Quadratic(b.NormalUU, b.NormalUV, b.NormalVV);
  const double weight = steps.Linear(b.WeightU, b.WeightV);
  const double weight2 = steps.Quadratic(b.WeightUU, b.WeightUV, b.WeightVV);
  const double w = b.MaxWeight, r = b.Radius;
  const double twist = weight * weight + w * weight2;
  const double fixed = 0.999 * ((1 - first) * (1 - first) - b.Extent * second - twist * r * r);
  if (!(first < 1) || !(fixed > 0))
  {
    return;
  }
  const double side = 2 * weight * (1 + first) + weight2 * b.Extent + w * second + 2 * twist * r;
  const double height =
    2 * weight * firstNormal + weight2 * b.NormalExtent + w * secondNormal + 2 * twist * r;
  leaf.SideCost = static_cast<float>(side / fixed);
  leaf.HeightCost = static_cast<float>(height / fixed);
}

}

Vec2 MeasureBend(const BezierPatch& patch, const Vec4* net)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
  CenterNet(BezierPoint(patch, net, 0.5, 0.5), (p + 1) * (q + 1), net, centered);
  const NetBounds b = BoundNet(p, q, centered);
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

void MeasureLeaf(const BezierPatch& patch, const LeafDomain& domain, const Vec4* part, Leaf& leaf,
  LeafBox& oriented, Eigen::AlignedBox3f& aligned)
{
  const int p = patch.DegreeU, q = patch.DegreeV, size = (p + 1) * (q + 1);
  leaf.Center = BezierPoint(patch, part, 0.5, 0.5);
  Vec4 centered[(MaximumDegree + 1) * (MaximumDegree + 1)];
  CenterNet(leaf.Center, size, part, centered);
  const NetBounds b = BoundNet(p, q, centered);

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
    const Vec3 d = centered[k].head<3>() / part[k].w();
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
  MeasureReach(b, steps, leaf);
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
  std::vector<int>& order, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  TreeBuilder builder(order, boxes);
  builder.Build(0, static_cast<int>(order.size()));
  return std::move(builder.Nodes);
}

}
