#include "KnotVector.h"
#include "NurbsSurface.h"

#include <algorithm>

namespace nurbs
{
namespace
{

constexpr int MaximumOrder = MaximumDegree + 1;

/// Non-zero basis functions of one span with their first and second derivatives.
struct Basis
{
  int Span;
  double N[3][MaximumOrder]; ///< [derivative][function]
};

/**
 * The Cox-de Boor triangle (eq. 2; NURBS Book, A2.2). Derivatives come from the functions of
 * degree p-1 and p-2, which the triangle passes through (NURBS Book, eq. 2.9).
 */
void EvaluateBasis(
  int degree, int count, const std::vector<double>& knots, double u, int order, Basis& basis)
{
  const int k = basis.Span = FindSpan(degree, count, knots, u);
  double left[MaximumOrder + 1], right[MaximumOrder + 1];
  double lower[2][MaximumOrder] = {}; // degree p-1 and p-2
  double* n = basis.N[0];
  n[0] = 1.0;
  for (int j = 1; j <= degree; ++j)
  {
    if (j == degree)
    {
      std::copy(n, n + j, lower[0]);
    }
    if (j == degree - 1)
    {
      std::copy(n, n + j, lower[1]);
    }
    left[j] = u - knots[k + 1 - j];
    right[j] = knots[k + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r)
    {
      const double share = n[r] / (right[r + 1] + left[j - r]);
      n[r] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    n[j] = saved;
  }
  // Differences of the functions of degree d = p - 1, divided by their knot differences.
  const auto differentiate = [&](const double* from, int d, double* to)
  {
    for (int i = 0; i <= d + 1; ++i)
    {
      double sum = 0.0;
      const int g = k - d - 1 + i; // global index of function i of degree d + 1
      if (i > 0)
      {
        sum += from[i - 1] / (knots[g + d + 1] - knots[g]);
      }
      if (i <= d)
      {
        sum -= from[i] / (knots[g + d + 2] - knots[g + 1]);
      }
      to[i] = (d + 1) * sum;
    }
  };
  if (order > 0)
  {
    differentiate(lower[0], degree - 1, basis.N[1]);
  }
  if (order > 1)
  {
    std::fill(basis.N[2], basis.N[2] + degree + 1, 0.0);
    if (degree > 1)
    {
      double first[MaximumOrder];
      differentiate(lower[1], degree - 2, first);
      differentiate(first, degree - 1, basis.N[2]);
    }
  }
}

/// Homogeneous sum over the net for the derivative (a, b), about a local origin.
Vec4 SumNet(
  const NurbsSurface& surface, const Basis& bu, const Basis& bv, int a, int b, const Vec3& origin)
{
  Vec4 sum = Vec4::Zero();
  for (int j = 0; j <= surface.DegreeV; ++j)
  {
    Vec4 row = Vec4::Zero();
    const Vec4* points = surface.ControlPoints.data() +
      static_cast<std::size_t>(bv.Span - surface.DegreeV + j) * surface.CountU +
      (bu.Span - surface.DegreeU);
    for (int i = 0; i <= surface.DegreeU; ++i)
    {
      const Vec4& point = points[i];
      const double weighted = bu.N[a][i] * point.w();
      row.head<3>() += weighted * (point.head<3>() - origin);
      row.w() += weighted;
    }
    sum += bv.N[b][j] * row;
  }
  return sum;
}

/// A control point of the span as origin keeps the digits of models far from zero.
Vec3 LocalOrigin(const NurbsSurface& surface, const Basis& bu, const Basis& bv)
{
  return surface.ControlPoints[static_cast<std::size_t>(bv.Span) * surface.CountU + bu.Span]
    .head<3>();
}

/// Of both directions, at parameters that are clamped to the domain.
void EvaluateBases(const NurbsSurface& surface, double u, double v, int order, Basis& bu, Basis& bv)
{
  u = std::clamp(u, surface.FirstU(), surface.LastU());
  v = std::clamp(v, surface.FirstV(), surface.LastV());
  EvaluateBasis(surface.DegreeU, surface.CountU, surface.KnotsU, u, order, bu);
  EvaluateBasis(surface.DegreeV, surface.CountV, surface.KnotsV, v, order, bv);
}

}

Vec3 Evaluate(const NurbsSurface& surface, double u, double v)
{
  Basis bu, bv;
  EvaluateBases(surface, u, v, 0, bu, bv);
  const Vec3 origin = LocalOrigin(surface, bu, bv);
  const Vec4 sum = SumNet(surface, bu, bv, 0, 0, origin);
  return origin + sum.head<3>() / sum.w();
}

SurfaceJet EvaluateJet(const NurbsSurface& surface, double u, double v)
{
  Basis bu, bv;
  EvaluateBases(surface, u, v, 2, bu, bv);
  const Vec3 origin = LocalOrigin(surface, bu, bv);
  const auto sum = [&](int a, int b) { return SumNet(surface, bu, bv, a, b, origin); };
  const Vec4 a = sum(0, 0), au = sum(1, 0), av = sum(0, 1);
  const Vec4 auu = sum(2, 0), auv = sum(1, 1), avv = sum(0, 2);
  const double inverse = 1.0 / a.w();
  SurfaceJet jet; // quotient rule (NURBS Book, eq. 4.20)
  jet.S = a.head<3>() * inverse;
  jet.Su = (au.head<3>() - au.w() * jet.S) * inverse;
  jet.Sv = (av.head<3>() - av.w() * jet.S) * inverse;
  jet.Suu = (auu.head<3>() - 2 * au.w() * jet.Su - auu.w() * jet.S) * inverse;
  jet.Suv = (auv.head<3>() - au.w() * jet.Sv - av.w() * jet.Su - auv.w() * jet.S) * inverse;
  jet.Svv = (avv.head<3>() - 2 * av.w() * jet.Sv - avv.w() * jet.S) * inverse;
  jet.S += origin;
  return jet;
}

}
