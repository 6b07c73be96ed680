// The closest point against OpenCASCADE's and against brute force: 100 000 random queries over
// all sample surfaces. A query is wrong if either oracle knows a nearer point (1e-10 relative).
#include "BruteForce.h"
#include "Check.h"
#include "OpenCascadeSurface.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <GeomAPI_ProjectPointOnSurf.hxx>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <thread>

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
  const samples::BruteForce brute(surface);
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

/**
 * Surfaces of many patches, where one block holds several, and a tight one that leaves and comes
 * back: near points take the short way, which must be as right as the search.
 */
void TestManyPatches()
{
  const NurbsSurface tight = samples::FromNet(3, 3, 40, 24,
    [](double u, double v)
    { return Vec4(u, v, 0.02 * std::sin(40 * u) * std::cos(25 * v) + 0.1 * u * u, 1); });
  const NurbsSurface hairpin = samples::FromNet(3, 2, 60, 12,
    [](double u, double v)
    {
      const double angle = M_PI * std::clamp(4 * u - 1.5, 0.0, 1.0);
      const double up = u < 0.5 ? std::min(u, 0.375) : std::min(1 - u, 0.375);
      return Vec4(-0.02 * std::cos(angle), v, up + 0.02 * std::sin(angle), 1);
    });
  const std::vector<samples::Named> all = { { "wavy 48", samples::Wavy(48) }, { "tight", tight },
    { "hairpin", hairpin } };
  for (const samples::Named& sample : all)
  {
    const TrimmingSurface trimming({ sample.Surface }, 1e-9);
    const samples::BruteForce brute(sample.Surface);
    const double scale = trimming.Bounds().diagonal().norm();
    QueryMaker maker(sample.Surface, trimming.Bounds());
    for (int k = 0; k < check::Trials(1500); ++k)
    {
      const Vec3 p = maker.Next(k);
      const Foot foot = trimming.ClosestPoint(p);
      const double known = brute.Distance(p);
      check::That(known >= foot.Distance * (1 - 1e-10) - 1e-14 * scale,
        sample.Name + ": brute force knows nothing nearer" + Numbers(foot.Distance, known));
    }
  }
}

/// What is found out about the surface on the way must not depend on who asks first.
void TestAnyOrder()
{
  const NurbsSurface surface = samples::Wavy(20);
  const TrimmingSurface forwards({ surface }, 1e-9), together({ surface }, 1e-9);
  QueryMaker maker(surface, forwards.Bounds());
  std::vector<Vec3> points;
  for (int k = 0; k < check::Trials(4000); ++k)
  {
    points.push_back(maker.Next(k));
  }
  const int count = static_cast<int>(points.size());
  std::vector<Foot> feet(count), others(count);
  const auto project = [&](const TrimmingSurface& trimming, int first, int step, auto& result)
  {
    for (int k = first; k >= 0 && k < count; k += step)
    {
      result[k] = trimming.ClosestPoint(points[k]);
    }
  };
  project(forwards, 0, 1, feet);
  std::thread odd([&]() { project(together, count - 1, -2, others); });
  project(together, count - 2, -2, others);
  odd.join();
  for (int k = 0; k < count; ++k)
  {
    check::That(feet[k].Point == others[k].Point && feet[k].Normal == others[k].Normal &&
        feet[k].U == others[k].U && feet[k].V == others[k].V,
      "the same bits in any order and from two threads");
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

/// Feet followed from those of nearby points: of the surface, at right angles to it, and mostly
/// the closest ones.
void TestNearbyFeet()
{
  std::mt19937 random(8);
  const auto uniform = [&random](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto vector = [&uniform]() { return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)); };
  int asked = 0, closest = 0;
  for (const samples::Named& sample : samples::All())
  {
    const TrimmingSurface surface({ sample.Surface }, 1e-9);
    const double scale = surface.Bounds().diagonal().norm();
    const NurbsSurface& s = sample.Surface;
    for (int k = 0; k < check::Trials(2000); ++k)
    {
      const Vec3 on = Evaluate(s, uniform(s.FirstU(), s.LastU()), uniform(s.FirstV(), s.LastV()));
      const Vec3 p = on + 0.02 * scale * vector(), q = p + 0.01 * scale * vector();
      const Foot foot = surface.NearbyFoot(q, surface.ClosestPoint(p));
      check::Near((Evaluate(s, foot.U, foot.V) - foot.Point).norm(), 0, 1e-9 * scale,
        sample.Name + ": a nearby foot on the surface");
      const double nearest = surface.ClosestPoint(q).Distance;
      const bool isClosest = foot.Distance <= nearest + 1e-9 * scale;
      check::That(
        foot.Distance >= nearest - 1e-9 * scale, sample.Name + ": nearer than the closest");
      // The closest one may lie on a crease or border.
      check::That(isClosest || (q - foot.Point).cross(foot.Normal).norm() <= 1e-7 * scale,
        sample.Name + ": the way to a nearby foot is along the normal");
      ++asked;
      closest += isClosest;
    }
  }
  check::That(closest > 0.98 * asked,
    "nearby feet that are the closest: " + std::to_string(closest) + " of " +
      std::to_string(asked));
}

/// However far away a point is, it has a closest one.
void TestFarPoints()
{
  for (const samples::Named& sample : samples::All())
  {
    const TrimmingSurface surface({ sample.Surface }, 1e-9);
    const Vec3 way = Vec3(0.3, -0.5, 0.8).normalized();
    for (int exponent = 0; exponent < 150; ++exponent)
    {
      const double far = std::pow(10.0, exponent) * surface.Bounds().diagonal().norm();
      const Foot foot = surface.ClosestPoint(surface.Bounds().center() + far * way);
      check::That(foot.Kind != FootKind::None && surface.Bounds().contains(foot.Point),
        sample.Name + ": no foot of a point 1e" + std::to_string(exponent) + " sizes away");
      check::Near(
        foot.Distance / far, 1, 1e-14 + std::pow(10.0, -exponent), sample.Name + ": far away");
    }
  }
}

}

// A flat square whose weights differ by a factor of a million from one control point to the next,
// so that nearly all of it lies within a thousandth of the parameters of its patches.
void TestUnequalWeights(int degree, bool bothWays)
{
  NurbsSurface square =
    samples::FromNet(degree, degree, 6, 6, [](double u, double v) { return Vec4(u, v, 0, 1); });
  for (int i = 0; i < 36; ++i)
  {
    const bool heavy = (bothWays ? i + i / 6 : i) % 2 != 0;
    square.ControlPoints[i].w() = heavy ? 1e6 : 1.0;
  }
  const TrimmingSurface surface({ square }, 1e-9);
  const double up = surface.ClosestPoint(Vec3(0.5, 0.5, 1)).SignedDistance > 0.0 ? 1.0 : -1.0;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0.01, 0.99);
  for (int i = 0; i < check::Trials(2000); ++i)
  {
    const Vec3 below(any(random), any(random), 0);
    const double height = any(random) - 0.5;
    const Foot foot = surface.ClosestPoint(below + height * Vec3::UnitZ());
    check::Near((foot.Point - below).norm(), 0, 1e-9, "the foot under unequal weights");
    check::Near(foot.SignedDistance, up * height, 1e-9, "the distance under unequal weights");
    const auto hits = surface.Intersect(below - Vec3::UnitZ(), below + Vec3::UnitZ());
    check::That(hits.size() == 1 && (hits[0].Point - below).norm() < 1e-9,
      "a line through a surface with unequal weights");
  }
}

int main()
{
  const std::vector<samples::Named> all = samples::All();
  for (const samples::Named& sample : all)
  {
    TestSample(sample, check::Trials(Queries) / static_cast<int>(all.size()));
  }
  TestManyPatches();
  TestAnyOrder();
  TestEquidistant();
  TestFarFromOrigin();
  TestNearbyFeet();
  TestFarPoints();
  TestUnequalWeights(1, true);
  TestUnequalWeights(3, false);
  return check::Result();
}
