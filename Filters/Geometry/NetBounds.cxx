#include "NetBounds.h"

#include "BezierPatch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace nurbs
{
namespace
{

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

/// Derivatives between the first and the last row and column.
void FindMeans(int p, int q, const Vec4* net, NetBounds& b)
{
  const int nu = p + 1, nv = q + 1;
  for (int j = 0; j < nv; ++j)
  {
    b.MeanU += (net[p + j * nu] - net[j * nu]).head<3>() / nv;
  }
  for (int i = 0; i < nu && q > 0; ++i)
  {
    b.MeanV += (net[i + q * nu] - net[i]).head<3>() / nu;
  }
}

/// BoundBend; P < 0: degrees at run time.
template <int P, int Q>
NetBounds BoundSeconds(int degreeU, int degreeV, const Vec4* net)
{
  const int p = P < 0 ? degreeU : P, q = Q < 0 ? degreeV : Q, nu = p + 1;
  NetBounds b;
  FindMeans(p, q, net, b);
  double uu = 0, uv = 0, vv = 0;
  const auto add = [](double& most, const Vec4& d) { most = std::max(most, d.squaredNorm()); };
  for (int j = 0; j <= q; ++j)
  {
    const Vec4* c = net + j * nu;
    for (int i = 0; i <= p; ++i)
    {
      if (i + 1 < p)
      {
        add(uu, c[i + 2] - 2 * c[i + 1] + c[i]);
      }
      if (j + 1 < q)
      {
        add(vv, (c[i + 2 * nu] - c[i + nu]) - (c[i + nu] - c[i]));
      }
      if (i < p && j < q)
      {
        add(uv, (c[i + 1 + nu] - c[i + 1]) - (c[i + nu] - c[i]));
      }
    }
  }
  b.SecondUU = (p * (p - 1)) * std::sqrt(uu);
  b.SecondUV = (p * q) * std::sqrt(uv);
  b.SecondVV = (q * (q - 1)) * std::sqrt(vv);
  return b;
}

}

NetBounds BoundBend(int p, int q, const Vec4* net)
{
  return p == 3 && q == 3 ? BoundSeconds<3, 3>(p, q, net) : BoundSeconds<-1, -1>(p, q, net);
}

void CenterNet(const Vec3& center, int size, const Vec4* net, Vec4* centered)
{
  for (int k = 0; k < size; ++k)
  {
    centered[k] = net[k];
    centered[k].head<3>() -= net[k].w() * center;
  }
}

NetBounds BoundNet(int p, int q, const Vec4* net)
{
  const int nu = p + 1, nv = q + 1;
  NetBounds b;
  FindMeans(p, q, net, b);
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

ConvexReach MeasureReach(const NetBounds& b, const UnitSteps& steps)
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
    return { std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity() };
  }
  const double side = 2 * weight * (1 + first) + weight2 * b.Extent + w * second + 2 * twist * r;
  const double height =
    2 * weight * firstNormal + weight2 * b.NormalExtent + w * secondNormal + 2 * twist * r;
  return { static_cast<float>(side / fixed), static_cast<float>(height / fixed) };
}

}
