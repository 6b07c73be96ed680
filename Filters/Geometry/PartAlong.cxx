#include "PartAlong.h"

#include <algorithm>

namespace nurbs
{

Eigen::Matrix2d PartAlong::MeanGradients() const
{
  const int p = this->P, q = this->Q, nu = p + 1;
  const Vec2* g = this->Across;
  Vec2 meanS = Vec2::Zero(), meanT = Vec2::Zero();
  for (int j = 0; j <= q; ++j)
  {
    meanS += (g[p + j * nu] - g[j * nu]) / (q + 1);
  }
  for (int i = 0; i <= p; ++i)
  {
    meanT += (g[i + q * nu] - g[i]) / (p + 1);
  }
  Eigen::Matrix2d m;
  m << meanS, meanT;
  return m;
}

bool PartAlong::IsPassed(const Eigen::Matrix2d& inverse, double tolerance) const
{
  Vec2 low = Vec2::Constant(HUGE_VAL), high = -low;
  for (int k = 0; k < (this->P + 1) * (this->Q + 1); ++k)
  {
    const Vec2 x = inverse * this->Across[k];
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vec2 slack = inverse.cwiseAbs() * Vec2::Constant(tolerance * this->Net[0].w());
  return ((low - 2 * slack).array() > 0).any() || ((high + 2 * slack).array() < 0).any();
}

double PartAlong::MeasureDeviation(const Eigen::Matrix2d& inverse) const
{
  const int p = this->P, q = this->Q, nu = p + 1;
  const Vec2* g = this->Across;
  double deviation = 0;
  for (int j = 0; j <= q; ++j)
  {
    for (int i = 0; i <= p; ++i)
    {
      if (i < p)
      {
        const Vec2 d = inverse * (p * (g[i + 1 + j * nu] - g[i + j * nu])) - Vec2::UnitX();
        deviation = std::max(deviation, d.lpNorm<1>());
      }
      if (j < q)
      {
        const Vec2 d = inverse * (q * (g[i + (j + 1) * nu] - g[i + j * nu])) - Vec2::UnitY();
        deviation = std::max(deviation, d.lpNorm<1>());
      }
    }
  }
  return deviation;
}

}
