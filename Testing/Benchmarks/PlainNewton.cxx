#include "PlainNewton.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace benchmark
{
namespace
{

constexpr int Order = TextbookSurface::MaximumDegree + 1;

/// Binary search (A2.1).
int FindSpan(int degree, int count, const std::vector<double>& knots, double u)
{
  if (u >= knots[count])
  {
    return static_cast<int>(
             std::lower_bound(knots.begin() + degree, knots.begin() + count, knots[count]) -
             knots.begin()) -
      1;
  }
  return static_cast<int>(
           std::upper_bound(knots.begin() + degree, knots.begin() + count, u) - knots.begin()) -
    1;
}

/// The basis functions of a span with two derivatives (A2.3).
void DerivativesOfBasis(
  int span, double u, int p, const std::vector<double>& knots, double (&result)[3][Order])
{
  double ndu[Order][Order], a[2][Order], left[Order], right[Order];
  ndu[0][0] = 1.0;
  for (int j = 1; j <= p; ++j)
  {
    left[j] = u - knots[span + 1 - j];
    right[j] = knots[span + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r)
    {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double share = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    ndu[j][j] = saved;
  }
  for (int j = 0; j <= p; ++j)
  {
    result[0][j] = ndu[j][p];
    result[2][j] = 0.0;
  }
  const int derivatives = std::min(2, p);
  for (int r = 0; r <= p; ++r)
  {
    int s1 = 0, s2 = 1;
    a[0][0] = 1.0;
    for (int k = 1; k <= derivatives; ++k)
    {
      double d = 0.0;
      const int rk = r - k, pk = p - k;
      if (r >= k)
      {
        a[s2][0] = a[s1][0] / ndu[pk + 1][rk];
        d = a[s2][0] * ndu[rk][pk];
      }
      const int j1 = rk >= -1 ? 1 : -rk, j2 = r - 1 <= pk ? k - 1 : p - r;
      for (int j = j1; j <= j2; ++j)
      {
        a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pk + 1][rk + j];
        d += a[s2][j] * ndu[rk + j][pk];
      }
      if (r <= pk)
      {
        a[s2][k] = -a[s1][k - 1] / ndu[pk + 1][r];
        d += a[s2][k] * ndu[r][pk];
      }
      result[k][r] = d;
      std::swap(s1, s2);
    }
  }
  double factor = p;
  for (int k = 1; k <= derivatives; ++k)
  {
    for (int j = 0; j <= p; ++j)
    {
      result[k][j] *= factor;
    }
    factor *= p - k;
  }
}

std::vector<double> Distinct(const std::vector<double>& knots, int degree, int count)
{
  std::vector<double> values(knots.begin() + degree, knots.begin() + count + 1);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}

TextbookSurface::TextbookSurface(const nurbs::NurbsSurface& surface)
  : Surface(surface)
{
  if (surface.DegreeU > MaximumDegree || surface.DegreeV > MaximumDegree)
  {
    throw std::invalid_argument("TextbookSurface: the degree is too high");
  }
  for (const Vec4& given : surface.ControlPoints)
  {
    Vec4 point;
    point << given.w() * given.head<3>(), given.w();
    this->Weighted.push_back(point);
    this->Rational = this->Rational || given.w() != 1.0;
  }
}

nurbs::SurfaceJet TextbookSurface::Evaluate(double u, double v) const
{
  const nurbs::NurbsSurface& s = this->Surface;
  double nu[3][Order], nv[3][Order];
  const int spanU = FindSpan(s.DegreeU, s.CountU, s.KnotsU, u);
  const int spanV = FindSpan(s.DegreeV, s.CountV, s.KnotsV, v);
  DerivativesOfBasis(spanU, u, s.DegreeU, s.KnotsU, nu);
  DerivativesOfBasis(spanV, v, s.DegreeV, s.KnotsV, nv);
  Vec4 sum[3][3]; // [derivative along u][along v], order two in all
  for (int k = 0; k <= 2; ++k)
  {
    for (int l = 0; l <= 2 - k; ++l)
    {
      sum[k][l].setZero();
    }
    for (int j = 0; j <= s.DegreeV; ++j)
    {
      const Vec4* points = this->Weighted.data() +
        static_cast<std::size_t>(spanV - s.DegreeV + j) * s.CountU + (spanU - s.DegreeU);
      Vec4 row = nu[k][0] * points[0];
      for (int i = 1; i <= s.DegreeU; ++i)
      {
        row += nu[k][i] * points[i];
      }
      for (int l = 0; l <= 2 - k; ++l)
      {
        sum[k][l] += nv[l][j] * row;
      }
    }
  }
  const auto xyz = [&](int k, int l) -> Vec3 { return sum[k][l].head<3>(); };
  if (!this->Rational)
  {
    return { xyz(0, 0), xyz(1, 0), xyz(0, 1), xyz(2, 0), xyz(1, 1), xyz(0, 2) };
  }
  const auto w = [&](int k, int l) { return sum[k][l].w(); };
  const double inverse = 1.0 / w(0, 0);
  nurbs::SurfaceJet jet;
  jet.S = xyz(0, 0) * inverse;
  jet.Su = (xyz(1, 0) - w(1, 0) * jet.S) * inverse;
  jet.Sv = (xyz(0, 1) - w(0, 1) * jet.S) * inverse;
  jet.Suu = (xyz(2, 0) - 2 * w(1, 0) * jet.Su - w(2, 0) * jet.S) * inverse;
  jet.Suv = (xyz(1, 1) - w(1, 0) * jet.Sv - w(0, 1) * jet.Su - w(1, 1) * jet.S) * inverse;
  jet.Svv = (xyz(0, 2) - 2 * w(0, 1) * jet.Sv - w(0, 2) * jet.S) * inverse;
  return jet;
}

PlainNewton::PlainNewton(const nurbs::NurbsSurface& surface)
  : Textbook(surface)
  , Low(surface.FirstU(), surface.FirstV())
  , High(surface.LastU(), surface.LastV())
{
  Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
  for (double v : Distinct(surface.KnotsV, surface.DegreeV, surface.CountV))
  {
    for (double u : Distinct(surface.KnotsU, surface.DegreeU, surface.CountU))
    {
      this->Knots.push_back(Vec2(u, v));
      this->Points.push_back(this->Textbook.Evaluate(u, v).S);
      low = low.cwiseMin(this->Points.back());
      high = high.cwiseMax(this->Points.back());
    }
  }
  this->Scale = (high - low).norm();
}

Vec2 PlainNewton::NearestKnot(const Vec3& p) const
{
  std::size_t best = 0;
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < this->Points.size(); ++k)
  {
    const double squared = (this->Points[k] - p).squaredNorm();
    if (squared < nearest)
    {
      nearest = squared;
      best = k;
    }
  }
  return this->Knots[best];
}

PlainNewton::Result PlainNewton::Project(const Vec3& p, const Vec2& guess) const
{
  // Stop as the NURBS Book does (section 6.1): the step or the cosines are negligible.
  constexpr int MaximumSteps = 20;
  constexpr double Precision = 1e-9;
  Vec2 x = guess;
  nurbs::SurfaceJet jet;
  for (int i = 0; i <= MaximumSteps; ++i)
  {
    jet = this->Textbook.Evaluate(x.x(), x.y());
    const Vec3 r = jet.S - p;
    const double f = r.dot(jet.Su), g = r.dot(jet.Sv);
    const double e = jet.Su.squaredNorm(), h = jet.Sv.squaredNorm(), squared = r.squaredNorm();
    const double limit =
      Precision * Precision * std::max(squared, 1e-6 * this->Scale * this->Scale);
    if ((f * f <= limit * e && g * g <= limit * h) || i == MaximumSteps)
    {
      break;
    }
    const double a = e + r.dot(jet.Suu), c = h + r.dot(jet.Svv);
    const double b = jet.Su.dot(jet.Sv) + r.dot(jet.Suv), det = a * c - b * b;
    const Vec2 step((b * g - c * f) / det, (b * f - a * g) / det);
    const Vec2 next = (x + step).cwiseMax(this->Low).cwiseMin(this->High);
    const Vec2 moved = next - x;
    if (!moved.allFinite() ||
      (moved.x() * jet.Su + moved.y() * jet.Sv).squaredNorm() <=
        Precision * Precision * this->Scale * this->Scale)
    {
      break;
    }
    x = next;
  }
  return { x.x(), x.y(), jet.S, jet.Su.cross(jet.Sv), (jet.S - p).norm() };
}

}
