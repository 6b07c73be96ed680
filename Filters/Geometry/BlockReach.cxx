#include "BlockReach.h"

#include "NetBounds.h"

#include <algorithm>

namespace nurbs
{

template <int P, int Q>
void BlockBounds::AddNet(int degreeU, int degreeV, const Vec4* net, double widthU, double widthV)
{
  constexpr int MostU = P < 0 ? MaximumDegree : P, MostV = Q < 0 ? MaximumDegree : Q;
  const int p = P < 0 ? degreeU : P, q = Q < 0 ? degreeV : Q, nu = p + 1;
  Vec4 points[(MostU + 1) * (MostV + 1)];
  // Bounds in variables of their own stay in registers, here and below.
  Bound value = this->Value;
  double radius = this->Radius;
  for (int k = 0; k < nu * (q + 1); ++k)
  {
    const double w = net[k].w();
    points[k] << this->Axes * (net[k].head<3>() - w * this->Center), w;
    value.Add(points[k]);
    const double squared = points[k].template head<3>().squaredNorm();
    radius = std::max(radius, w == 1.0 ? squared : squared / (w * w));
  }
  this->Value = value;
  this->Radius = radius;
  this->AddAlongU<P, Q>(p, q, points, widthU);
  this->AddAlongV<P, Q>(p, q, points, widthU, widthV);
}

template <int P, int Q>
void BlockBounds::AddAlongU(int degreeU, int degreeV, const Vec4* points, double widthU)
{
  const int p = P < 0 ? degreeU : P, q = Q < 0 ? degreeV : Q, nu = p + 1;
  Bound first = this->FirstU, second = this->UU;
  double deviation = 0;
  for (int j = 0; j <= q; ++j)
  {
    const Vec4* c = points + j * nu;
    Vec4 before = Vec4::Zero();
    for (int i = 1; i <= p; ++i)
    {
      const Vec4 d = (widthU * p) * (c[i] - c[i - 1]);
      first.Add(d);
      deviation = std::max(deviation, (d.head<3>() - this->U).squaredNorm());
      if (i > 1)
      {
        second.Add((widthU * (p - 1)) * (d - before));
      }
      before = d;
    }
  }
  this->FirstU = first;
  this->UU = second;
  this->DeviationU = std::max(this->DeviationU, std::sqrt(deviation));
}

template <int P, int Q>
void BlockBounds::AddAlongV(
  int degreeU, int degreeV, const Vec4* points, double widthU, double widthV)
{
  const int p = P < 0 ? degreeU : P, q = Q < 0 ? degreeV : Q, nu = p + 1;
  Bound first = this->FirstV, second = this->VV, mixed = this->UV;
  double deviation = 0;
  Vec4 above[(P < 0 ? MaximumDegree : P) + 1];
  for (int j = 1; j <= q; ++j)
  {
    const Vec4* c = points + j * nu;
    Vec4 before = Vec4::Zero();
    for (int i = 0; i <= p; ++i)
    {
      const Vec4 d = (widthV * q) * (c[i] - c[i - nu]);
      first.Add(d);
      deviation = std::max(deviation, (d.head<3>() - this->V).squaredNorm());
      if (j > 1)
      {
        second.Add((widthV * (q - 1)) * (d - above[i]));
      }
      if (i > 0)
      {
        mixed.Add((widthU * p) * (d - before));
      }
      before = above[i] = d;
    }
  }
  this->FirstV = first;
  this->VV = second;
  this->UV = mixed;
  this->DeviationV = std::max(this->DeviationV, std::sqrt(deviation));
}

void BlockBounds::Add(int p, int q, const Vec4* net, double widthU, double widthV)
{
  return p == 3 && q == 3 ? this->AddNet<3, 3>(p, q, net, widthU, widthV)
                          : this->AddNet<-1, -1>(p, q, net, widthU, widthV);
}

BlockReach::BlockReach(const BlockBounds& b)
{
  NetBounds means;
  means.MeanU = b.U;
  means.MeanV = b.V;
  UnitSteps steps;
  if (!FindUnitSteps(means, false, steps))
  {
    return;
  }
  constexpr double Around = 6; // the foot may lie beside the block
  const double radius = std::sqrt(b.Radius), r = Around * radius;
  const double first = steps.Linear(b.DeviationU, b.DeviationV);
  const double weight = steps.Linear(b.FirstU.Most.w(), b.FirstV.Most.w());
  const double weight2 = steps.Quadratic(b.UU.Most.w(), b.UV.Most.w(), b.VV.Most.w());
  const double twist = weight * weight + b.Value.Most.w() * weight2;
  Vec3 extent = b.Value.Most.head<3>(), change, second;
  for (int axis = 0; axis < 3; ++axis)
  {
    change[axis] = steps.Linear(b.FirstU.Most[axis], b.FirstV.Most[axis]);
    second[axis] = steps.Quadratic(b.UU.Most[axis], b.UV.Most[axis], b.VV.Most[axis]);
  }
  const double fixed = (1 - first) * (1 - first) - extent.dot(second) - twist * r * r;
  const double along = 1 - first - weight * radius;
  if (!(first < 1) || !(fixed > 0) || !(along > 0))
  {
    return;
  }
  // Rounding of the axes and of all this.
  constexpr double Safe = 1.001;
  const Vec3 cost = (Safe / fixed) *
    (2 * weight * change + weight2 * extent + b.Value.Most.w() * second +
      Vec3::Constant(2 * twist * r));
  this->Cost = cost.cast<float>();
  this->Radius = static_cast<float>(r);
  this->Tilt = static_cast<float>(1e-6 + Safe * (change.z() + weight * radius) / along);
}

}
