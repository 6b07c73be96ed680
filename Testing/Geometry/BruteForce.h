/**
 * @file BruteForce.h
 * @brief Distances to a surface without a hierarchy: the truth of tests and benchmarks.
 */
#ifndef BruteForce_h
#define BruteForce_h

#include "NurbsSurface.h"

#include <algorithm>
#include <cmath>

namespace samples
{
using nurbs::NurbsSurface;
using nurbs::SurfaceJet;
using nurbs::Vec3;

/// Dense grid, then Newton by the textbook evaluation from the best places of it.
class BruteForce
{
public:
  explicit BruteForce(const NurbsSurface& surface)
    : Surface(surface)
  {
    this->U = this->Samples(surface.DegreeU, surface.CountU, surface.KnotsU);
    this->V = this->Samples(surface.DegreeV, surface.CountV, surface.KnotsV);
    for (double v : this->V)
    {
      for (double u : this->U)
      {
        this->Points.push_back(Evaluate(surface, u, v).cast<float>());
      }
    }
  }

  double Distance(const Vec3& p) const
  {
    const int nu = static_cast<int>(this->U.size()), nv = static_cast<int>(this->V.size());
    const Eigen::Vector3f q = p.cast<float>();
    thread_local std::vector<float> squared;
    squared.resize(this->Points.size());
    for (std::size_t k = 0; k < squared.size(); ++k)
    {
      squared[k] = (this->Points[k] - q).squaredNorm();
    }
    // Local minima of the grid, the three best.
    std::vector<std::pair<float, int>> seeds;
    for (int j = 0; j < nv; ++j)
    {
      for (int i = 0; i < nu; ++i)
      {
        const int k = i + j * nu;
        if ((i == 0 || squared[k] <= squared[k - 1]) &&
          (i == nu - 1 || squared[k] <= squared[k + 1]) &&
          (j == 0 || squared[k] <= squared[k - nu]) &&
          (j == nv - 1 || squared[k] <= squared[k + nu]))
        {
          seeds.push_back({ squared[k], k });
        }
      }
    }
    const std::size_t count = std::min<std::size_t>(3, seeds.size());
    std::partial_sort(seeds.begin(), seeds.begin() + count, seeds.end());
    double best = HUGE_VAL;
    for (std::size_t k = 0; k < count; ++k)
    {
      best = std::min(best, this->Refine(p, seeds[k].second % nu, seeds[k].second / nu));
    }
    return best;
  }

private:
  static std::vector<double> Samples(int degree, int count, const std::vector<double>& knots)
  {
    std::vector<double> values;
    int spans = 0;
    for (int k = degree; k < count; ++k)
    {
      spans += knots[k + 1] > knots[k];
    }
    const int perSpan = std::max(4, 48 / spans);
    for (int k = degree; k < count; ++k)
    {
      for (int i = 0; i < perSpan && knots[k + 1] > knots[k]; ++i)
      {
        values.push_back(knots[k] + (knots[k + 1] - knots[k]) * i / perSpan);
      }
    }
    values.push_back(knots[count]);
    return values;
  }

  double Refine(const Vec3& p, int i, int j) const
  {
    double u = this->U[i], v = this->V[j];
    const double u0 = this->Surface.FirstU(), u1 = this->Surface.LastU();
    const double v0 = this->Surface.FirstV(), v1 = this->Surface.LastV();
    double best = (Evaluate(this->Surface, u, v) - p).norm();
    for (int step = 0; step < 12; ++step)
    {
      const SurfaceJet jet = EvaluateJet(this->Surface, u, v);
      const Vec3 r = jet.S - p;
      best = std::min(best, r.norm());
      const double f = r.dot(jet.Su), g = r.dot(jet.Sv);
      const double a = jet.Su.dot(jet.Su) + r.dot(jet.Suu), c = jet.Sv.dot(jet.Sv) + r.dot(jet.Svv);
      const double b = jet.Su.dot(jet.Sv) + r.dot(jet.Suv), det = a * c - b * b;
      double du, dv;
      if ((u == u0 && f > 0) || (u == u1 && f < 0))
      {
        du = 0;
        dv = c > 0 ? -g / c : 0;
      }
      else if ((v == v0 && g > 0) || (v == v1 && g < 0))
      {
        du = a > 0 ? -f / a : 0;
        dv = 0;
      }
      else
      {
        du = det > 0 && a > 0 ? (b * g - c * f) / det : -0.3 * f / jet.Su.squaredNorm();
        dv = det > 0 && a > 0 ? (b * f - a * g) / det : -0.3 * g / jet.Sv.squaredNorm();
      }
      if (!std::isfinite(du) || !std::isfinite(dv))
      {
        break;
      }
      u = std::clamp(u + du, u0, u1);
      v = std::clamp(v + dv, v0, v1);
    }
    return std::min(best, (Evaluate(this->Surface, u, v) - p).norm());
  }

  const NurbsSurface& Surface;
  std::vector<double> U, V;
  std::vector<Eigen::Vector3f> Points;
};

}

#endif
