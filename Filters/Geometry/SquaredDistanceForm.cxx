#include "SquaredDistanceForm.h"

#include "Binomials.h"

#include <cmath>

namespace nurbs
{

void SquaredDistanceForm::Set(int p, int q, const Vec4* net, double squaredDistance)
{
  const int nu = p + 1, nv = q + 1;
  this->CountU = 2 * p + 1;
  this->CountV = 2 * q + 1;
  std::fill(this->F, this->F + this->CountU * this->CountV, 0.0);
  // Coordinate by coordinate, so that the products of two rows run over neighbours in memory:
  // their number goes with the fourth power of the degree.
  double scaled[4][(MaximumDegree + 1) * (MaximumDegree + 1)];
  const double* cu = Binomials(p);
  const double* cv = Binomials(q);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const Vec4 a = cu[i] * cv[j] * net[i + j * nu];
      for (int k = 0; k < 4; ++k)
      {
        scaled[k][i + j * nu] = a[k];
      }
    }
  }
  for (int j = 0; j < nv; ++j)
  {
    for (int l = j; l < nv; ++l)
    {
      const int row = l * nu;
      const double times = l == j ? 1 : 2;
      for (int i = 0; i < nu; ++i)
      {
        const int at = i + j * nu;
        const double x = times * scaled[0][at], y = times * scaled[1][at];
        const double z = times * scaled[2][at], w = -times * squaredDistance * scaled[3][at];
        double* f = this->F + i + (j + l) * this->CountU;
        for (int k = 0; k < nu; ++k)
        {
          f[k] += x * scaled[0][row + k] + y * scaled[1][row + k] + z * scaled[2][row + k] +
            w * scaled[3][row + k];
        }
      }
    }
  }
  const double* du = Binomials(2 * p);
  const double* dv = Binomials(2 * q);
  for (int j = 0; j < this->CountV; ++j)
  {
    for (int i = 0; i < this->CountU; ++i)
    {
      this->F[i + j * this->CountU] /= du[i] * dv[j];
    }
  }
}

bool SquaredDistanceForm::IsConvex() const
{
  const int nu = this->CountU, nv = this->CountV;
  const auto f = [&](int i, int j) { return this->F[i + j * nu]; };
  double uu = HUGE_VAL, vv = HUGE_VAL, uv = 0;
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i + 2 < nu; ++i)
    {
      uu = std::min(uu, f(i + 2, j) - 2 * f(i + 1, j) + f(i, j));
    }
  }
  if (nv == 1)
  {
    return uu > 0;
  }
  for (int j = 0; j + 2 < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      vv = std::min(vv, f(i, j + 2) - 2 * f(i, j + 1) + f(i, j));
    }
  }
  for (int j = 0; j + 1 < nv; ++j)
  {
    for (int i = 0; i + 1 < nu; ++i)
    {
      uv = std::max(uv, std::abs(f(i + 1, j + 1) - f(i + 1, j) - f(i, j + 1) + f(i, j)));
    }
  }
  const double p = nu - 1, q = nv - 1;
  return uu > 0 && vv > 0 && uu * vv * (p - 1) * (q - 1) > uv * uv * p * q;
}

void SquaredDistanceForm::FindSlopes(const Vec4* net, int& slopeS, int& slopeT) const
{
  // D = F / w^2 + d^2 rises with s where w F_s - 2 w_s F > 0.
  const int nu = this->CountU, nv = this->CountV, p = (nu - 1) / 2, q = (nv - 1) / 2;
  double weight = HUGE_VAL, weightS = 0, weightT = 0, largest = 0;
  for (int j = 0; j <= q; ++j)
  {
    for (int i = 0; i <= p; ++i)
    {
      const double w = net[i + j * (p + 1)].w();
      weight = std::min(weight, w);
      weightS = std::max(weightS, i < p ? std::abs(net[i + 1 + j * (p + 1)].w() - w) : 0.0);
      weightT = std::max(weightT, j < q ? std::abs(net[i + (j + 1) * (p + 1)].w() - w) : 0.0);
    }
  }
  double lowS = HUGE_VAL, highS = -HUGE_VAL, lowT = HUGE_VAL, highT = -HUGE_VAL;
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const double f = this->F[i + j * nu];
      largest = std::max(largest, std::abs(f));
      if (i + 1 < nu)
      {
        lowS = std::min(lowS, this->F[i + 1 + j * nu] - f);
        highS = std::max(highS, this->F[i + 1 + j * nu] - f);
      }
      if (j + 1 < nv)
      {
        lowT = std::min(lowT, this->F[i + (j + 1) * nu] - f);
        highT = std::max(highT, this->F[i + (j + 1) * nu] - f);
      }
    }
  }
  // Differences of F stand for F_s / (2 p), those of w for w_s / p.
  const double marginS = weightS * largest / weight, marginT = weightT * largest / weight;
  slopeS = lowS > marginS ? 1 : (highS < -marginS ? -1 : 0);
  slopeT = q > 0 ? (lowT > marginT ? 1 : (highT < -marginT ? -1 : 0)) : 0;
}

}
