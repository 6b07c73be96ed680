// Line-surface intersection (eqs. 12-14): closed forms, completeness against the distance along
// the line, lines through knots and corners, ends on the surface, tangency, gaps.
#include "Check.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace nurbs;
using samples::RandomVector;
using samples::Uniform;

namespace
{

std::string Describe(const std::vector<LineHit>& hits)
{
  std::ostringstream text;
  text.precision(15);
  text << hits.size() << " hits";
  for (const LineHit& hit : hits)
  {
    text << " " << hit.K;
  }
  return text.str();
}

std::string Points(const Vec3& a, const Vec3& b)
{
  std::ostringstream text;
  text.precision(17);
  text << " from (" << a.transpose() << ") to (" << b.transpose() << ")";
  return text.str();
}

void CheckHits(const TrimmingSurface& surface, const Vec3& a, const Vec3& b,
  const std::vector<LineHit>& hits, const std::string& name)
{
  const double scale = surface.Bounds().diagonal().norm();
  for (std::size_t k = 0; k < hits.size(); ++k)
  {
    const LineHit& hit = hits[k];
    check::That((a + hit.K * (b - a) - hit.Point).norm() < 1e-11 * scale, name + ": on the line");
    check::That((Evaluate(surface.Face(hit.Face), hit.U, hit.V) - hit.Point).norm() < 1e-11 * scale,
      name + ": on the surface");
    check::That(k == 0 || hits[k - 1].K < hit.K, name + ": sorted");
    check::That(
      hit.Normal.norm() > 0.999999 && hit.Normal.norm() < 1.000001, name + ": unit normal");
  }
}

bool Contains(const std::vector<LineHit>& hits, double k, double tolerance)
{
  return std::any_of(
    hits.begin(), hits.end(), [&](const LineHit& hit) { return std::abs(hit.K - k) <= tolerance; });
}

void TestClosedForms()
{
  const TrimmingSurface sphere({ samples::Sphere(1) }, 1e-9);
  const TrimmingSurface cylinder({ samples::Cylinder(1, 2) }, 1e-9);
  const TrimmingSurface plane(
    { samples::Plane(Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)) }, 1e-9);
  for (int k = 0; k < check::Trials(20000); ++k)
  {
    const Vec3 a = 1.5 * RandomVector(), b = 1.5 * RandomVector(), d = b - a;
    const auto roots = [&](double qa, double qb, double qc)
    {
      std::vector<double> result;
      const double discriminant = qb * qb - qa * qc;
      if (discriminant > 0)
      {
        for (double sign : { -1.0, 1.0 })
        {
          const double x = (-qb + sign * std::sqrt(discriminant)) / qa;
          if (x >= 0 && x <= 1)
          {
            result.push_back(x);
          }
        }
      }
      return result;
    };
    const auto compare =
      [&](const TrimmingSurface& surface, const std::vector<double>& expected, const char* name)
    {
      const auto hits = surface.Intersect(a, b);
      CheckHits(surface, a, b, hits, name);
      bool same = hits.size() == expected.size();
      for (std::size_t i = 0; same && i < expected.size(); ++i)
      {
        same = std::abs(hits[i].K - expected[i]) * d.norm() < 1e-8;
      }
      check::That(same,
        std::string(name) + ": " + Describe(hits) + " but " + std::to_string(expected.size()));
    };
    compare(sphere, roots(d.squaredNorm(), a.dot(d), a.squaredNorm() - 1), "sphere");
    std::vector<double> expected;
    for (double x :
      roots(d.head<2>().squaredNorm(), a.head<2>().dot(d.head<2>()), a.head<2>().squaredNorm() - 1))
    {
      const double z = a.z() + x * d.z();
      if (z >= 0 && z <= 2)
      {
        expected.push_back(x);
      }
    }
    compare(cylinder, expected, "cylinder");
    const double x = -a.z() / d.z();
    const Vec3 p = a + x * d;
    expected.clear();
    if (x >= 0 && x <= 1 && std::abs(p.x()) <= 1 && std::abs(p.y()) <= 1)
    {
      expected.push_back(x);
    }
    compare(plane, expected, "plane");
  }
}

/// Every zero of the (independently tested) distance along the line has to be a hit.
void TestCompleteness(const samples::Named& sample)
{
  const TrimmingSurface surface({ sample.Surface }, 1e-9);
  const Box3 box = surface.Bounds();
  const double scale = box.diagonal().norm();
  for (int k = 0; k < 40; ++k)
  {
    const Vec3 a =
      box.center() + 0.6 * RandomVector().cwiseProduct(box.sizes()) + 0.05 * scale * RandomVector();
    const Vec3 b =
      box.center() + 0.6 * RandomVector().cwiseProduct(box.sizes()) + 0.05 * scale * RandomVector();
    const auto hits = surface.Intersect(a, b);
    CheckHits(surface, a, b, hits, sample.Name);
    // Sphere tracing: steps of the distance itself cannot pass over a zero.
    const double length = (b - a).norm();
    double x = 0;
    for (int step = 0; step < 4000 && x < 1; ++step)
    {
      const double distance = surface.ClosestPoint(a + x * (b - a)).Distance;
      if (distance < 1e-9 * scale)
      {
        check::That(Contains(hits, x, 1e-6 * scale / length),
          sample.Name + ": a zero at " + std::to_string(x) + " among " + Describe(hits));
        x += 1e-4 * scale / length;
      }
      x += distance / length + 1e-12;
    }
  }
  // Lines in random directions through known points, segment ends on the point included.
  const NurbsSurface& s = sample.Surface;
  for (int k = 0; k < check::Trials(2000); ++k)
  {
    const Vec3 p = Evaluate(s, Uniform(s.FirstU(), s.LastU()), Uniform(s.FirstV(), s.LastV()));
    const Vec3 d = scale * RandomVector();
    const double before = k % 3 ? Uniform(0.1, 1) : 0.0, after = k % 3 == 1 ? 0.0 : Uniform(0.1, 1);
    const Vec3 a = p - before * d, b = p + after * d;
    if (before + after == 0)
    {
      continue;
    }
    const auto hits = surface.Intersect(a, b);
    CheckHits(surface, a, b, hits, sample.Name);
    // Two crossings of a nearly tangent line may be reported as one touch.
    double slope = 1;
    for (const LineHit& hit : hits)
    {
      slope = std::min(slope, std::abs(hit.Normal.dot(d.normalized())));
    }
    const double length = (b - a).norm();
    check::That(
      Contains(hits, before / (before + after), slope > 1e-3 ? 1e-8 : 1e-5 * scale / length),
      sample.Name + ": through a known point at " + std::to_string(before / (before + after)) +
        ", " + Describe(hits) + Points(a, b));
  }
}

/// Knots, corners of patches, borders of faces: never lost, never twice.
void TestPatchBorders()
{
  const NurbsSurface wavy = samples::Wavy();
  const TrimmingSurface surface({ wavy }, 1e-9);
  for (double u : wavy.KnotsU)
  {
    for (double v : wavy.KnotsV)
    {
      const SurfaceJet jet = EvaluateJet(wavy, u, v);
      const Vec3 n = jet.Su.cross(jet.Sv).normalized();
      const auto hits = surface.Intersect(jet.S - 0.05 * n, jet.S + 0.05 * n);
      check::That(hits.size() == 1 && std::abs(hits[0].K - 0.5) < 1e-10,
        "one hit at a corner of patches: " + Describe(hits));
    }
  }
  // A box: 17 x 17 lines along each axis, on edges and corners of its faces too.
  const TrimmingSurface box(samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1)), 1e-7);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= 16; ++i)
    {
      for (int j = 0; j <= 16; ++j)
      {
        Vec3 a = Vec3::Constant(-1), b = Vec3::Constant(3);
        a[(axis + 1) % 3] = b[(axis + 1) % 3] = i / 16.0;
        a[(axis + 2) % 3] = b[(axis + 2) % 3] = j / 16.0;
        const auto hits = box.Intersect(a, b);
        check::That(Contains(hits, 0.25, 1e-12) && Contains(hits, 0.5, 1e-12),
          "lines through the box: " + Describe(hits));
        const bool inner = i % 16 != 0 && j % 16 != 0;
        check::That(!inner || hits.size() == 2, "two hits through the box: " + Describe(hits));
      }
    }
  }
  // Oblique lines through the edges of the box and of a rounded shell.
  const TrimmingSurface rounded(samples::RoundedShell(1, 0.8, 0.3, 1), 1e-7);
  for (int k = 0; k < check::Trials(5000); ++k)
  {
    const Vec3 edge(0, 0, Uniform(0.01, 0.99)),
      d(Uniform(0.1, 1), Uniform(0.1, 1), Uniform(-0.01, 0.01));
    const auto hits = box.Intersect(edge - d, edge + 0.5 * d);
    check::That(hits.size() == 1 && Contains(hits, 2.0 / 3, 1e-11),
      "one hit on the edge of the box: " + Describe(hits));
    const Vec3 seam(1, 0.5, Uniform(0.2, 0.8)), t(Uniform(-1, -0.2), Uniform(-1, 1), 0);
    const auto other = rounded.Intersect(seam - 0.1 * t, seam + 0.1 * t);
    check::That(other.size() == 1 && Contains(other, 0.5, 1e-10),
      "one hit on the seam of the shell: " + Describe(other));
  }
}

void TestEnds()
{
  const NurbsSurface wavy = samples::Wavy();
  const TrimmingSurface surface({ wavy }, 1e-9);
  for (int k = 0; k < check::Trials(2000); ++k)
  {
    const Vec3 p = Evaluate(wavy, Uniform(0, 1), Uniform(0, 1)), q = p + Vec3(0.01, 0.02, 0.2);
    check::That(Contains(surface.Intersect(p, q), 0, 1e-10), "a hit at K = 0");
    check::That(Contains(surface.Intersect(q, p), 1, 1e-10), "a hit at K = 1");
    check::That(surface.Intersect(p, q, 1e-6, 1).empty() ||
        !Contains(surface.Intersect(p, q, 1e-6, 1), 0, 1e-7),
      "nothing before kMin");
    check::That(Contains(surface.Intersect(q, p + 1.0 / 3 * (q - p), 0, 1.5), 1.5, 1e-10),
      "a hit at kMax beyond 1");
    check::That(Contains(surface.Intersect(p, p), 0, 0), "a segment without length on the surface");
    check::That(surface.Intersect(q, q).empty(), "a segment without length off the surface");
  }
}

void TestTangency()
{
  const TrimmingSurface sphere({ samples::Sphere(1) }, 1e-9);
  const TrimmingSurface torus({ samples::Torus(1, 0.25) }, 1e-9);
  for (int k = 0; k < check::Trials(20000); ++k)
  {
    const Vec3 n = RandomVector().normalized(), t = n.cross(RandomVector()).normalized();
    auto hits = sphere.Intersect(n - 0.7 * t, n + 0.3 * t);
    check::That(
      hits.size() == 1 && Contains(hits, 0.7, 1e-5), "tangent of the sphere: " + Describe(hits));
    hits = sphere.Intersect(1.00001 * n - t, 1.00001 * n + t);
    check::That(hits.empty(), "just beside the sphere: " + Describe(hits));
    hits = sphere.Intersect(0.99999 * n - t, 0.99999 * n + t);
    check::That(hits.size() == 2, "just inside the sphere: " + Describe(hits));
  }
  auto hits = torus.Intersect(Vec3(-3, 0, 0.25), Vec3(3, 0, 0.25));
  check::That(hits.size() == 2, "a line that touches the torus twice: " + Describe(hits));
  // Within the surface: at least one, and an end to it.
  const TrimmingSurface plane(
    { samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)) }, 1e-9);
  check::That(!plane.Intersect(Vec3(-1, 0.3, 0), Vec3(2, 0.4, 0)).empty(), "a line within a plane");
  check::That(
    !plane.Intersect(Vec3(0.2, 0.3, 0), Vec3(0.6, 0.4, 0)).empty(), "a segment within a plane");
  check::That(plane.Intersect(Vec3(1.2, 0.3, 0), Vec3(1.6, 0.4, 0)).empty(),
    "a segment in the plane but beside it");
  const TrimmingSurface cylinder({ samples::Cylinder(1, 2) }, 1e-9);
  for (int k = 0; k < 50; ++k)
  {
    const double angle = Uniform(0, 6.3), x = std::cos(angle), y = std::sin(angle);
    check::That(
      !cylinder.Intersect(Vec3(x, y, -1), Vec3(x, y, 3)).empty(), "a ruling of the cylinder");
    check::That(
      !cylinder.Intersect(Vec3(x, y, 0.5), Vec3(x, y, 0.6)).empty(), "a piece of a ruling");
  }
}

/// Lines that graze a surface within the gap tolerance of its knots, seams and shared edges, where
/// nothing gapes: one hit, on the line all the same, and none before it.
void TestGrazingAtBorders()
{
  const TrimmingSurface cylinder({ samples::Cylinder(1, 2) }, 3e-5);
  const TrimmingSurface rounded(samples::RoundedShell(1, 0.8, 0.3, 1), 3e-5);
  for (int k = 0; k < check::Trials(4000); ++k)
  {
    const double slope = std::pow(10, Uniform(-1.5, 0)), past = Uniform(-1e-3, 1e-3);
    const auto compare = [&](const TrimmingSurface& surface, const Vec3& p, double angle)
    {
      const Vec3 n(std::cos(angle), std::sin(angle), 0), t(-n.y(), n.x(), 0);
      const Vec3 d = 0.02 * slope * (t - slope * n + Vec3(0, 0, Uniform(-1, 1)));
      auto hits = surface.Intersect(p - d, p + d);
      CheckHits(surface, p - d, p + d, hits, "grazing");
      check::That(hits.size() == 1 && Contains(hits, 0.5, 1e-8),
        "one hit of a line that grazes: " + Describe(hits) + Points(p - d, p + d));
      hits = surface.Intersect(p - d, p - 1e-3 * d);
      check::That(hits.empty(), "none before the surface: " + Describe(hits));
    };
    const double angle = 0.5 * M_PI * (k % 4) + past;
    compare(cylinder, Vec3(std::cos(angle), std::sin(angle), 0.7), angle);
    // From a plane face to a cylinder, of radius 0.3.
    compare(rounded,
      past < 0 ? Vec3(1, 0.5 + past, 0.4)
               : Vec3(0.7 + 0.3 * std::cos(past), 0.5 + 0.3 * std::sin(past), 0.4),
      std::max(past, 0.0));
  }
}

/// The same beside corners of patches, at a seam or not: the patch across the corner is within the
/// gap tolerance there, and farther away than any that meets the line's.
void TestGrazingAtCorners()
{
  const double gap = 3e-5;
  const TrimmingSurface sphere({ samples::Sphere(1) }, gap);
  for (int k = 0; k < check::Trials(8000); ++k)
  {
    const double angle = 0.5 * M_PI * (k % 4);
    const Vec3 corner(std::cos(angle), std::sin(angle), 0);
    const Vec3 p = (corner + Uniform(0, 1) * gap * RandomVector()).normalized();
    const Vec3 t = p.cross(RandomVector()).normalized();
    const Vec3 d = 0.1 * (t - std::pow(10, Uniform(-1, 0)) * p);
    auto hits = sphere.Intersect(p - d, p + d);
    CheckHits(sphere, p - d, p + d, hits, "beside a corner");
    check::That(hits.size() == 1 && Contains(hits, 0.5, 1e-8),
      "one hit beside a corner: " + Describe(hits) + Points(p - d, p + d));
    // The line ends before the surface, nearer to it than the gap tolerance.
    hits = sphere.Intersect(p - d, p - 1e-5 * d);
    check::That(hits.empty(), "none before it: " + Describe(hits) + Points(p - d, p - 1e-5 * d));
  }
}

/// A line exactly through the gap between two faces within the tolerance is caught once; one
/// past a free border is not.
void TestGaps()
{
  const double gap = 1e-6;
  const TrimmingSurface surface({ samples::Plane(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                                  samples::Plane(Vec3(gap, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)) },
    2e-6);
  for (double x : { 0.0, 0.25 * gap, 0.5 * gap, gap })
  {
    for (double slope : { 0.0, 0.5, -1.0 })
    {
      const auto hits = surface.Intersect(Vec3(x - slope, 0.4, -1), Vec3(x + slope, 0.4, 1));
      check::That(hits.size() == 1, "through the gap: " + Describe(hits));
    }
  }
  check::That(surface.Intersect(Vec3(1 + 1.5 * gap, 0.4, -1), Vec3(1 + 1.5 * gap, 0.4, 1)).empty(),
    "past the free border");
  check::That(
    surface.Intersect(Vec3(1, 0.4, -1), Vec3(1, 0.4, 1)).size() == 1, "past the other end");
}

}

int main()
{
  samples::Random.seed(5);
  TestClosedForms();
  for (const samples::Named& sample : samples::All())
  {
    TestCompleteness(sample);
  }
  TestPatchBorders();
  TestEnds();
  TestTangency();
  TestGrazingAtBorders();
  TestGrazingAtCorners();
  TestGaps();
  return check::Result();
}
