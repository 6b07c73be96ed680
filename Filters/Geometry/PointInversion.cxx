#include "PointInversion.h"

#include "BezierEvaluation.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{

/// One Newton step of eqs. 9-11 in the variables that no bound holds.
struct Step
{
  double S = 0, T = 0;
  double Length() const { return std::max(std::abs(this->S), std::abs(this->T)); }
};

/// A parameter a rounding error away from a bound is on it; else the bound is never held.
double SnapToBounds(double x, double low, double high)
{
  constexpr double Rounding = 4e-16;
  return x <= low + Rounding ? low : (x >= high - Rounding ? high : x);
}

/// What rounding leaves of a derivative at a pole, as a share of what it is where the side at the
/// other end of the patch is open.
constexpr double PoleRounding = 1e-10;

Step NewtonStep(const SurfaceJet& jet, const Vec3& r, bool heldS, bool heldT)
{
  const double f = jet.Su.dot(r), g = jet.Sv.dot(r);
  const double e = jet.Su.squaredNorm(), h = jet.Sv.squaredNorm();
  // At a pole nothing moves along one parameter: that is no way to go.
  const double pole = PoleRounding * PoleRounding * jet.Suv.squaredNorm();
  heldS = heldS || e <= pole;
  heldT = heldT || h <= pole;
  const double a = e + r.dot(jet.Suu), c = h + r.dot(jet.Svv);
  Step step;
  // Where the Hessian is not positive the part without curvature (Gauss-Newton) still descends.
  if (heldS && heldT)
  {
    return step;
  }
  if (heldT)
  {
    step.S = a > 1e-3 * e ? -f / a : (e > 0 ? -f / e : 0);
    return step;
  }
  if (heldS)
  {
    step.T = c > 1e-3 * h ? -g / c : (h > 0 ? -g / h : 0);
    return step;
  }
  const double m = jet.Su.dot(jet.Sv), b = m + r.dot(jet.Suv);
  const double det = a * c - b * b;
  if (a > 0 && c > 0 && det > 1e-6 * a * c)
  {
    step.S = (b * g - c * f) / det;
    step.T = (b * f - a * g) / det;
    return step;
  }
  const double metric = e * h - m * m;
  if (metric > 1e-8 * e * h)
  {
    step.S = (m * g - h * f) / metric;
    step.T = (m * f - e * g) / metric;
    return step;
  }
  step.S = e > 0 ? -0.5 * f / (e + 1e-12 * h) : 0;
  step.T = h > 0 ? -0.5 * g / (h + 1e-12 * e) : 0;
  return step;
}

/// A step that would leave through a bound where the point already lies slides along it.
Step BoundedStep(
  const SurfaceJet& jet, const Vec3& r, const LocalFoot& foot, const PartDomain& domain, bool curve)
{
  const double f = jet.Su.dot(r), g = jet.Sv.dot(r);
  bool heldS = (foot.S <= domain.S0 && f >= 0) || (foot.S >= domain.S1 && f <= 0);
  bool heldT = curve || (foot.T <= domain.T0 && g >= 0) || (foot.T >= domain.T1 && g <= 0);
  Step step = NewtonStep(jet, r, heldS, heldT);
  const auto leaves = [](double x, double dx, double low, double high)
  { return (x <= low && dx < 0) || (x >= high && dx > 0); };
  if (!heldS && leaves(foot.S, step.S, domain.S0, domain.S1))
  {
    heldS = true;
    step = NewtonStep(jet, r, heldS, heldT);
  }
  if (!heldT && leaves(foot.T, step.T, domain.T0, domain.T1))
  {
    heldT = true;
    step = NewtonStep(jet, r, heldS, heldT);
  }
  return step;
}

/// How much of a step fits before the first bound it meets.
double FractionWithin(const LocalFoot& foot, const Step& step, const PartDomain& domain)
{
  double fraction = 1.0;
  const auto cut = [&fraction](double x, double dx, double low, double high)
  {
    if (x + dx < low)
    {
      fraction = std::min(fraction, (low - x) / dx);
    }
    if (x + dx > high)
    {
      fraction = std::min(fraction, (high - x) / dx);
    }
  };
  cut(foot.S, step.S, domain.S0, domain.S1);
  cut(foot.T, step.T, domain.T0, domain.T1);
  return fraction;
}

/**
 * Takes a step, or as much of it as brings the foot nearer, halved each time.
 *
 * @param fraction of the step to begin with; what was taken of it.
 * @return false if nothing of it does.
 */
bool Descend(const BezierPatch& patch, const Vec4* net, const Vec3& p, const PartDomain& domain,
  const Step& step, double& fraction, LocalFoot& foot, SurfaceJet& jet)
{
  for (int halving = 0; halving < 40; ++halving, fraction *= 0.5)
  {
    const double s = SnapToBounds(foot.S + fraction * step.S, domain.S0, domain.S1);
    const double t = SnapToBounds(foot.T + fraction * step.T, domain.T0, domain.T1);
    if (s == foot.S && t == foot.T)
    {
      return false;
    }
    SurfaceJet next;
    EvaluateBezier(patch, net, s, t, next);
    const double squared = (next.S - p).squaredNorm();
    // Equality up to rounding is progress: the gradient decides then, not the value.
    if (squared <= foot.Squared * (1 + 1e-15) ||
      (halving == 0 && step.Length() < 1e-6 && squared <= foot.Squared * (1 + 1e-12)))
    {
      foot = { s, t, next.S, squared };
      jet = next;
      return true;
    }
  }
  return false;
}

}

LocalFoot InvertPoint(const BezierPatch& patch, const Vec4* net, const Vec3& p, double s, double t,
  const PartDomain& domain)
{
  constexpr int MaximumSteps = 60;
  constexpr double Small = 2e-8; // the step after one this small is below rounding
  LocalFoot foot;
  foot.S = std::clamp(s, domain.S0, domain.S1);
  foot.T = std::clamp(t, domain.T0, domain.T1);
  SurfaceJet jet;
  EvaluateBezier(patch, net, foot.S, foot.T, jet);
  foot.Point = jet.S;
  foot.Squared = (jet.S - p).squaredNorm();
  double before = 1.0;
  for (int i = 0; i < MaximumSteps; ++i)
  {
    const Step step = BoundedStep(jet, jet.S - p, foot, domain, patch.DegreeV == 0);
    const double length = step.Length();
    if (!(length > 0))
    {
      break;
    }
    double fraction = FractionWithin(foot, step, domain);
    const Vec3 first = step.S * jet.Su + step.T * jet.Sv;
    const Vec3 second = (0.5 * step.S * step.S) * jet.Suu + (step.S * step.T) * jet.Suv +
      (0.5 * step.T * step.T) * jet.Svv;
    // The last step is taken by Taylor's formula; its remainder goes like second^2 / first.
    if (fraction == 1.0 && length < Small && (length < 0.1 * before || length < 1e-14) &&
      second.squaredNorm() <= 1e-17 * first.norm() * std::max(jet.Su.norm(), jet.Sv.norm()))
    {
      foot.S += step.S;
      foot.T += step.T;
      foot.Point = jet.S + first + second;
      foot.Squared = (foot.Point - p).squaredNorm();
      break;
    }
    if (!Descend(patch, net, p, domain, step, fraction, foot, jet))
    {
      break;
    }
    before = fraction * length;
  }
  return foot;
}

}
