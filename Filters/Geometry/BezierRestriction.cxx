#include "BezierRestriction.h"

#include <algorithm>

namespace nurbs
{
namespace
{

/// Restricts one row of coefficients to [x0, x1], 0 <= x0 < x1 <= 1, in place. D < 0: degree at run
/// time.
template <int D>
void RestrictRow(Vec4* c, int degree, std::size_t stride, double x0, double x1)
{
  const int p = D < 0 ? degree : D;
  if (x1 < 1.0)
  {
    for (int r = 1; r <= p; ++r)
    {
      for (int i = p; i >= r; --i)
      {
        c[i * stride] = (1.0 - x1) * c[(i - 1) * stride] + x1 * c[i * stride];
      }
    }
  }
  if (x0 > 0.0)
  {
    const double x = x0 / x1;
    for (int r = 1; r <= p; ++r)
    {
      for (int i = 0; i <= p - r; ++i)
      {
        c[i * stride] = (1.0 - x) * c[i * stride] + x * c[(i + 1) * stride];
      }
    }
  }
}

void RestrictRow(Vec4* c, int degree, std::size_t stride, double x0, double x1)
{
  return degree == 3 ? RestrictRow<3>(c, degree, stride, x0, x1)
                     : RestrictRow<-1>(c, degree, stride, x0, x1);
}

}

void RestrictNet(
  const BezierPatch& patch, const Vec4* net, double s0, double s1, double t0, double t1, Vec4* part)
{
  const int nu = patch.DegreeU + 1, nv = patch.DegreeV + 1;
  std::copy(net, net + nu * nv, part);
  if (s0 > 0.0 || s1 < 1.0)
  {
    for (int j = 0; j < nv; ++j)
    {
      RestrictRow(part + j * nu, patch.DegreeU, 1, s0, s1);
    }
  }
  if (t0 > 0.0 || t1 < 1.0)
  {
    for (int i = 0; i < nu; ++i)
    {
      RestrictRow(part + i, patch.DegreeV, nu, t0, t1);
    }
  }
}

}
