#include "BlockReach.h"

#include <algorithm>

namespace nurbs
{

void BlockBounds::Add(int p, int q, const Vec4* net, double widthU, double widthV)
{
  const int nu = p + 1, nv = q + 1;
  Vec4 above[MaximumDegree + 1], beforeU[MaximumDegree + 1];
  Vec4 last = Vec4::Zero();
  double deviationU = 0, deviationV = 0;
  // Differences of the row, of the one above, and of those differences.
  for (int j = 0; j < nv; ++j)
  {
    Vec4 stepBefore = Vec4::Zero();
    for (int i = 0; i < nu; ++i)
    {
      const Vec4& given = net[i + j * nu];
      const Vec3 offset = given.head<3>() - given.w() * this->Center;
      Vec4 c;
      c << this->Axes * offset, given.w();
      this->Value.Add(c);
      this->Radius = std::max(this->Radius, c.head<3>().squaredNorm() / (c.w() * c.w()));
      if (i > 0)
      {
        const Vec4 d = (widthU * p) * (c - last);
        this->FirstU.Add(d);
        deviationU = std::max(deviationU, (d.head<3>() - this->U).squaredNorm());
        if (i > 1)
        {
          this->UU.Add((widthU * (p - 1)) * (d - stepBefore));
        }
        stepBefore = d;
      }
      if (j > 0)
      {
        const Vec4 d = (widthV * q) * (c - above[i]);
        this->FirstV.Add(d);
        deviationV = std::max(deviationV, (d.head<3>() - this->V).squaredNorm());
        if (j > 1)
        {
          this->VV.Add((widthV * (q - 1)) * (d - beforeU[i]));
        }
        if (i > 0)
        {
          this->UV.Add((widthU * p) * (d - beforeU[i - 1]));
        }
        beforeU[i] = d;
      }
      above[i] = c;
      last = c;
    }
  }
  this->DeviationU = std::max(this->DeviationU, std::sqrt(deviationU));
  this->DeviationV = std::max(this->DeviationV, std::sqrt(deviationV));
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
