// The closest point against OpenCASCADE's and against brute force: 100 000 random queries over
// all sample surfaces. A query is wrong if either oracle knows a nearer point (1e-10 relative).
#include "Check.h"
#include "OpenCascadeSurface.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <GeomAPI_ProjectPointOnSurf.hxx>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

using namespace nurbs;

namespace
{

constexpr int Queries = 100000;

std::string Numbers(double found, double known)
{
  std::ostringstream text;
  text.precision(17);
  text << ": " << found << " > " << known;
  return text.str();
}

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

class QueryMaker
{
public:
  QueryMaker(const NurbsSurface& surface, const Box3& box)
    : Surface(surface)
    , Box(box)
  {
  }
  /// In turn: near the surface, in a box around it, far away, on the surface, on its border.
  Vec3 Next(int k)
  {
    const double diagonal = this->Box.diagonal().norm();
    const auto random = [&]()
    { return Vec3(this->Draw(-1, 1), this->Draw(-1, 1), this->Draw(-1, 1)); };
    const double u = this->Draw(this->Surface.FirstU(), this->Surface.LastU());
    const double v = this->Draw(this->Surface.FirstV(), this->Surface.LastV());
    switch (k % 8)
    {
      case 0:
      case 1:
      case 2:
        return Evaluate(this->Surface, u, v) + 0.03 * diagonal * random();
      case 3:
      case 4:
        return this->Box.center() +
          0.7 * random().cwiseProduct(this->Box.sizes() + Vec3::Constant(0.2 * diagonal));
      case 5:
        return this->Box.center() + 10 * diagonal * random();
      case 6:
        return Evaluate(this->Surface, u, v);
      default:
        return Evaluate(this->Surface, k % 16 < 8 ? this->Surface.FirstU() : u,
                 k % 16 < 8 ? v : this->Surface.LastV()) +
          (k % 3 ? 0.05 * diagonal : 0.0) * random();
    }
  }

private:
  double Draw(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Random);
  }
  const NurbsSurface& Surface;
  const Box3 Box;
  std::mt19937 Random{ 11 };
};

void TestSample(const samples::Named& sample, int queries)
{
  const NurbsSurface& surface = sample.Surface;
  const TrimmingSurface trimming({ surface }, 1e-9);
  const BruteForce brute(surface);
  const bool jump = sample.Name == "jump";
  Handle(Geom_BSplineSurface) other;
  GeomAPI_ProjectPointOnSurf projector;
  if (!jump)
  {
    other = occ::Convert(surface);
    projector.Init(other, surface.FirstU(), surface.LastU(), surface.FirstV(), surface.LastV());
  }
  const double scale = trimming.Bounds().diagonal().norm();
  QueryMaker maker(surface, trimming.Bounds());
  Foot last;
  int missedByOther = 0;
  for (int k = 0; k < queries; ++k)
  {
    const Vec3 p = maker.Next(k);
    const Foot foot = trimming.ClosestPoint(p);
    const double bound = foot.Distance * (1 - 1e-10) - 1e-14 * scale;
    check::That(foot.Kind != FootKind::None, sample.Name + ": a foot is found");
    // u and v themselves are rounded, which steep weights make visible.
    const SurfaceJet jet = EvaluateJet(surface, foot.U, foot.V);
    check::Near((jet.S - foot.Point).norm(), 0,
      2e-13 * (scale + 1) + 1e-15 * (jet.Su.norm() + jet.Sv.norm()),
      sample.Name + ": the foot is S(u, v)");
    check::Near((foot.Point - p).norm(), foot.Distance, 1e-14 * (scale + p.norm()),
      sample.Name + ": the distance");
    const double grid = brute.Distance(p);
    check::That(grid >= bound,
      sample.Name + ": brute force knows nothing nearer" + Numbers(foot.Distance, grid));
    if (!jump && k % 2 == 0)
    {
      projector.Perform(gp_Pnt(p.x(), p.y(), p.z()));
      if (projector.NbPoints() > 0)
      {
        // It may leave the rectangle by its own tolerance, so the point is taken from inside.
        double u, v;
        projector.LowerDistanceParameters(u, v);
        const double distance = (Evaluate(surface, u, v) - p).norm();
        check::That(distance >= bound,
          sample.Name + ": OpenCASCADE knows nothing nearer" + Numbers(foot.Distance, distance));
        missedByOther += distance > foot.Distance * (1 + 1e-7) + 1e-9 * scale;
      }
      else
      {
        ++missedByOther;
      }
    }
    // A guess, good or bad, changes nothing; nor does a bound that is not below the distance.
    const Foot guessed = trimming.ClosestPoint(p, last, foot.Distance * (1 + 1e-9) + 1e-12 * scale);
    check::That(guessed.Kind != FootKind::None &&
        std::abs(guessed.Distance - foot.Distance) <= 1e-10 * foot.Distance + 1e-13 * scale,
      sample.Name + ": the same with a guess");
    if (foot.Distance > 1e-6 * scale && k % 16 == 0)
    {
      check::That(trimming.ClosestPoint(p, 0.999 * foot.Distance).Kind == FootKind::None,
        sample.Name + ": nothing within less than the distance");
    }
    last = foot;
  }
  std::cout << sample.Name << ": " << queries << " queries; OpenCASCADE misses " << missedByOther
            << "\n";
}

void TestFarFromOrigin()
{
  const Vec3 shift(1e6, -2e6, 1.5e6);
  for (const samples::Named& sample : samples::All())
  {
    const NurbsSurface moved =
      samples::Transformed(sample.Surface, Eigen::Matrix3d::Identity(), shift);
    const TrimmingSurface near({ sample.Surface }, 1e-9), far({ moved }, 1e-9);
    QueryMaker maker(sample.Surface, near.Bounds());
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 p = maker.Next(k);
      check::Near(near.ClosestPoint(p).Distance, far.ClosestPoint(p + shift).Distance, 1e-8,
        sample.Name + ": far from the origin");
    }
  }
}

/// Centres of curvature: every point, or a whole circle, is equally near.
void TestEquidistant()
{
  const TrimmingSurface sphere({ samples::Sphere(2) }, 1e-9);
  const TrimmingSurface cylinder({ samples::Cylinder(1.5, 2) }, 1e-9);
  const TrimmingSurface torus({ samples::Torus(1, 0.3) }, 1e-9);
  for (int k = -8; k <= 8; ++k)
  {
    const double shift = k == 0 ? 0.0 : std::copysign(std::pow(10.0, -2 * std::abs(k)), k);
    check::Near(sphere.ClosestPoint(Vec3(shift, 0, 0)).Distance, 2 - std::abs(shift), 1e-12,
      "centre of the sphere");
    check::Near(sphere.ClosestPoint(Vec3(0, 0, shift)).Distance, 2 - std::abs(shift), 1e-12,
      "axis of the sphere");
    check::Near(cylinder.ClosestPoint(Vec3(shift, 0, 1)).Distance, 1.5 - std::abs(shift), 1e-12,
      "axis of the cylinder");
    check::Near(torus.ClosestPoint(Vec3(0.6, 0.8 + shift, 0)).Distance,
      0.3 - std::abs(std::hypot(0.6, 0.8 + shift) - 1), 1e-12, "core of the torus");
    check::Near(torus.ClosestPoint(Vec3(shift, 0, 0)).Distance, 0.7 - std::abs(shift), 1e-12,
      "axis of the torus");
  }
}

}

int main()
{
  const std::vector<samples::Named> all = samples::All();
  for (const samples::Named& sample : all)
  {
    TestSample(sample, Queries / static_cast<int>(all.size()));
  }
  TestEquidistant();
  TestFarFromOrigin();
  return check::Result();
}
