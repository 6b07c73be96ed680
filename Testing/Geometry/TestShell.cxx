// Sides, seams, poles, sharp edges, free borders, gaps, bends and box queries of shells.
#include "Check.h"
#include "Curvature.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "Sectors.h"
#include "ShellTesting.h"
#include "SurfaceGaps.h"
#include "TrimmingSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace nurbs;
using samples::Place;
using samples::Random;
using samples::RandomVector;
using samples::Shuffled;
using samples::Uniform;
using samples::UprightFace;

namespace
{
/// A closed surface (within the box asked) against its signed distance in closed form.
void TestSigns(const std::string& name, const std::vector<NurbsSurface>& faces, const Vec3& low,
  const Vec3& high, const std::function<double(const Vec3&)>& exact)
{
  for (int turn = 0; turn < 4; ++turn)
  {
    TrimmingSurface surface(turn == 0 ? faces : Shuffled(faces), 1e-7);
    if (turn == 3)
    {
      surface.Flip();
    }
    double orientation = 0;
    for (int k = 0; k < check::Trials(4000); ++k)
    {
      Vec3 p = low + 0.5 * (RandomVector() + Vec3::Ones()).cwiseProduct(high - low);
      if (k % 3 == 0) // near the surface
      {
        p = surface.ClosestPoint(p).Point + 0.01 * RandomVector();
      }
      if (k % 5 == 0) // on a grid, so that feet fall on edges, seams and poles
      {
        p = (p * 8).array().round() / 8;
      }
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any())
      {
        continue;
      }
      const double distance = exact(p);
      const Foot foot = surface.ClosestPoint(p);
      check::Near(foot.Distance, std::abs(distance), 1e-11,
        [&] { return name + ": the distance" + Place(p, foot); });
      check::That(
        foot.Kind == FootKind::Interior, [&] { return name + ": no border" + Place(p, foot); });
      check::Near(
        foot.Normal.norm(), 1, 1e-12, [&] { return name + ": unit normal" + Place(p, foot); });
      if (std::abs(distance) < 1e-9)
      {
        continue;
      }
      const double side = foot.SignedDistance * distance > 0 ? 1 : -1;
      orientation = orientation == 0 ? side : orientation;
      check::That(side == orientation, [&] { return name + ": the side" + Place(p, foot); });
    }
  }
}

void TestClosedSurfaces()
{
  const auto box = [](const Vec3& p)
  {
    const Vec3 q = (p - Vec3(0.5, 0.5, 0.5)).cwiseAbs() - Vec3(0.5, 0.5, 0.5);
    const double outside = q.cwiseMax(0).norm();
    return outside > 0 ? outside : q.maxCoeff();
  };
  TestSigns(
    "box", samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1)), Vec3(-1, -1, -1), Vec3(2, 2, 2), box);
  const auto rounded = [](const Vec3& p)
  {
    const double x = std::abs(p.x()) - 0.7, y = std::abs(p.y()) - 0.5;
    return std::hypot(std::max(x, 0.0), std::max(y, 0.0)) + std::min(std::max(x, y), 0.0) - 0.3;
  };
  TestSigns("rounded shell", samples::RoundedShell(1, 0.8, 0.3, 1), Vec3(-1.5, -1.4, 0.01),
    Vec3(1.5, 1.4, 0.99), rounded);
  TestSigns("cylinder", { samples::Cylinder(1, 2) }, Vec3(-1.6, -1.6, 0.01), Vec3(1.6, 1.6, 1.99),
    [](const Vec3& p) { return p.head<2>().norm() - 1; });
  TestSigns("sphere", { samples::Sphere(1) }, Vec3(-2, -2, -2), Vec3(2, 2, 2),
    [](const Vec3& p) { return p.norm() - 1; });
  TestSigns("torus", { samples::Torus(1, 0.4) }, Vec3(-2, -2, -1), Vec3(2, 2, 1),
    [](const Vec3& p) { return std::hypot(p.head<2>().norm() - 1, p.z()) - 0.4; });
  // A cone with its apex, capped by a disc that is a cone of no height.
  const auto cone = [](const Vec3& p)
  {
    const double r = p.head<2>().norm(), z = p.z();
    const Vec2 a(1, 0), d = Vec2(-1, 1.5), q(r, z);
    const double t = std::clamp((q - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    const double slope = (q - a - t * d).norm();
    const double base = std::hypot(std::max(r - 1, 0.0), z);
    const bool inside = z > 0 && z < 1.5 * (1 - r);
    return inside ? -std::min(slope, base) : std::min(slope, base);
  };
  TestSigns("cone", { samples::Cone(1, 1.5), samples::Cone(1, 0) }, Vec3(-2, -2, -1),
    Vec3(2, 2, 2.5), cone);
}

/// The distance in the plane from the part under y = x^2 / 2 from 0 to 1, which ends in a cusp.
double DistanceFromCusp(const Vec2& p)
{
  const auto fromSegment = [&p](const Vec2& a, const Vec2& b)
  {
    return (p - a - std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) * (b - a))
      .norm();
  };
  const auto curve = [](double t) { return Vec2(t, 0.5 * t * t); };
  double squared = (p - curve(1)).squaredNorm();
  // A foot is a root of (t - x) + (t^2 / 2 - y) t.
  const auto slope = [&p](double t) { return t - p.x() + (0.5 * t * t - p.y()) * t; };
  constexpr int Steps = 64;
  for (int i = 0; i < Steps; ++i)
  {
    double low = i / double(Steps), high = (i + 1) / double(Steps);
    squared = std::min(squared, (p - curve(low)).squaredNorm());
    for (int k = 0; k < 60 && slope(low) * slope(high) <= 0; ++k)
    {
      const double middle = 0.5 * (low + high);
      (slope(low) * slope(middle) <= 0 ? high : low) = middle;
    }
    squared = std::min(squared, (p - curve(low)).squaredNorm());
  }
  const double distance = std::min({ std::sqrt(squared), fromSegment(Vec2(0, 0), Vec2(1, 0)),
    fromSegment(Vec2(1, 0), Vec2(1, 0.5)) });
  const bool inside = p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 0.5 * p.x() * p.x();
  return inside ? -distance : distance;
}

/// Two faces that meet under no angle: nothing of their normals tells what is beyond the edge.
void TestCusps()
{
  const auto face = [](int degreeU, const std::function<Vec3(double, double)>& at)
  {
    return samples::FromNet(degreeU, 1, degreeU + 1, 2,
      [&](double u, double v)
      {
        Vec4 x;
        x << at(u, v), 1;
        return x;
      });
  };
  // Heights of the control points of the parabola are 0, 0 and a half.
  const auto height = [](double u) { return u > 0.75 ? 0.5 : 0.0; };
  std::vector<NurbsSurface> faces = { samples::Plane(Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 0, 2)),
    samples::Plane(Vec3(1, 0, -1), Vec3(0, 0.5, 0), Vec3(0, 0, 2)),
    face(2, [&](double u, double v) { return Vec3(u, height(u), 2 * v - 1); }) };
  TestSigns("a cusp", faces, Vec3(-1, -1, -0.9), Vec3(2, 1, 0.9),
    [](const Vec3& p) { return DistanceFromCusp(p.head<2>()); });
  for (const double z : { -1.0, 1.0 })
  {
    faces.push_back(face(2, [&](double u, double v) { return Vec3(u, v * height(u), z); }));
  }
  TestSigns("a cusp with ends", faces, Vec3(-1, -1, -2), Vec3(2, 1, 2),
    [](const Vec3& p)
    {
      const double x = DistanceFromCusp(p.head<2>()), z = std::abs(p.z()) - 1;
      return std::hypot(std::max(x, 0.0), std::max(z, 0.0)) + std::min(std::max(x, z), 0.0);
    });
}

/// Gaps a little wider than the faces' tolerances tell are closed: these are measured at places.
void TestToldGaps()
{
  std::vector<NurbsSurface> faces = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1));
  for (NurbsSurface& face : faces)
  {
    const Vec3 center =
      0.5 * (face.ControlPoints.front().head<3>() + face.ControlPoints.back().head<3>());
    for (Vec4& point : face.ControlPoints)
    {
      point.head<3>() += 0.005 * (center - point.head<3>());
    }
    face.Tolerance = 0.00165; // the borders are apart by 0.0025 * sqrt(2)
  }
  const TrimmingSurface box(faces, 1e-6, FindWidestGap(faces, std::sqrt(3.0)));
  for (int k = 0; k < check::Trials(4000); ++k)
  {
    const Vec3 p = Vec3(0.5, 0.5, 0.5) + 1.2 * RandomVector();
    const Foot foot = box.ClosestPoint(p);
    check::That(
      foot.Kind == FootKind::Interior, [&] { return "gaps wider than told" + Place(p, foot); });
  }
}

/// Small gaps and overlaps at the edges of a box are no borders.
void TestGaps()
{
  for (double gap : { 5e-5, -5e-5 })
  {
    std::vector<NurbsSurface> faces = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1));
    for (NurbsSurface& face : faces)
    {
      Vec3 center = Vec3::Zero();
      for (const Vec4& point : face.ControlPoints)
      {
        center += 0.25 * point.head<3>();
      }
      for (Vec4& point : face.ControlPoints)
      {
        point.head<3>() += gap * (center - point.head<3>());
      }
    }
    // Turned round, so that its neighbours have to be found to set it right.
    std::swap(faces[1].ControlPoints[0], faces[1].ControlPoints[1]);
    std::swap(faces[1].ControlPoints[2], faces[1].ControlPoints[3]);
    const TrimmingSurface tight(faces, 1e-3), wide(faces, 1e-6, 1e-3), loose(faces, 1e-6);
    int borders = 0;
    for (int k = 0; k < check::Trials(4000); ++k)
    {
      const Vec3 p = Vec3(0.5, 0.5, 0.5) + 1.2 * RandomVector();
      const Vec3 q = (p - Vec3(0.5, 0.5, 0.5)).cwiseAbs() - Vec3(0.5, 0.5, 0.5);
      if (std::abs(q.maxCoeff()) < 1e-3)
      {
        continue;
      }
      for (const TrimmingSurface* surface : { &tight, &wide })
      {
        const Foot foot = surface->ClosestPoint(p);
        check::That(
          foot.Kind == FootKind::Interior, [&] { return "gaps are closed" + Place(p, foot); });
        check::That((foot.SignedDistance > 0) == (q.maxCoeff() > 0),
          [&] { return "the side beside a gap" + Place(p, foot); });
      }
      borders += loose.ClosestPoint(p).Kind == FootKind::Border;
    }
    check::That(
      gap < 0 || borders > check::Trials(4000) / 40, "gaps beyond the tolerance are borders");
  }
}

void TestFreeBorders()
{
  const TrimmingSurface plane(
    { samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)) }, 1e-9);
  const TrimmingSurface tube({ samples::Cylinder(1, 2) }, 1e-9);
  // An L of two planes: the edge they share is none, its ends are.
  const TrimmingSurface angle({ samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                                samples::Plane(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0)) },
    1e-9);
  // T-junction: one long face beside two short ones.
  const TrimmingSurface tee({ samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0)),
                              samples::Plane(Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0.7, 0)),
                              samples::Plane(Vec3(0, 0.7, 0), Vec3(0, 0, 1), Vec3(0, 1.3, 0)) },
    1e-9);
  const TrimmingSurface dome({ samples::Revolve(2, { 0, 0, 0, 1, 1, 1 },
                               { { 1, 0, 1 }, { 1, 1, std::sqrt(0.5) }, { 0, 1, 1 } }) },
    1e-9);
  const TrimmingSurface quarter({ samples::Revolve(2, { 0, 0, 0, 1, 1, 1 },
                                  { { 1, 0, 1 }, { 1, 1, std::sqrt(0.5) }, { 0, 1, 1 } }, 1) },
    1e-9);
  const auto expect =
    [](const TrimmingSurface& surface, const Vec3& p, FootKind kind, const char* what)
  {
    const Foot foot = surface.ClosestPoint(p);
    check::That(foot.Kind == kind, [&] { return what + Place(p, foot); });
    check::That(
      kind == FootKind::Border || foot.Normal.norm() > 0.999, what + std::string(" has a normal"));
  };
  expect(plane, Vec3(1.2, 0.5, 0.1), FootKind::Border, "beyond the edge of a plane");
  expect(plane, Vec3(1.2, 1.5, 0.1), FootKind::Border, "beyond the corner of a plane");
  expect(plane, Vec3(1, 0.5, 0.1), FootKind::Border, "over the edge of a plane");
  expect(plane, Vec3(0.9999999, 0.5, 0.1), FootKind::Interior, "just inside the edge");
  expect(tube, Vec3(1.1, 0, 1), FootKind::Interior, "beside the seam of a tube");
  expect(tube, Vec3(1.1, 0, 2.2), FootKind::Border, "beyond the end of a tube, at the seam");
  expect(tube, Vec3(0, 1.1, -0.2), FootKind::Border, "beyond the end of a tube");
  expect(angle, Vec3(-0.1, 0.5, -0.1), FootKind::Interior, "outside the edge of an angle");
  expect(angle, Vec3(-0.1, 0, -0.1), FootKind::Border, "at the end of the edge of an angle");
  expect(angle, Vec3(-0.1, 1.3, -0.1), FootKind::Border, "beyond the end of the edge of an angle");
  expect(tee, Vec3(-0.1, 0.7, -0.1), FootKind::Interior, "at a T-junction");
  expect(tee, Vec3(-0.1, 0.3, -0.1), FootKind::Interior, "beside a T-junction");
  expect(tee, Vec3(-0.1, 2.1, -0.1), FootKind::Border, "beyond the T");
  expect(dome, Vec3(0, 0, 1.5), FootKind::Interior, "over the pole of a dome");
  expect(dome, Vec3(0, 0, 0.9), FootKind::Interior, "under the pole of a dome");
  expect(dome, Vec3(1.2, 0, -0.2), FootKind::Border, "under the rim of a dome");
  expect(quarter, Vec3(0, 0, 1.5), FootKind::Border, "over the pole of a quarter of a dome");
  expect(quarter, Vec3(0.5, -0.2, 0.5), FootKind::Border, "beside a quarter of a dome");
  check::That(dome.ClosestPoint(Vec3(0, 0, 1.5)).Normal.cwiseAbs().isApprox(Vec3(0, 0, 1), 1e-6),
    "the normal at a pole is the limit");
  check::That(plane.ClosestPoint(Vec3(0.5, 0.5, 1), 0.5).Kind == FootKind::None,
    "nothing within the distance");
  check::Near(angle.ClosestPoint(Vec3(-0.1, 0.5, -0.1)).Normal.cwiseAbs().dot(Vec3(1, 0, 1)),
    std::sqrt(2.0), 1e-12, "mean normal on an edge");
}

/// Two quarters of a drop, sheared: along their common edge each finds the other, close to the pole
/// as well, where rounding leaves a little of the derivative that vanishes.
void TestEdgeToPole()
{
  const std::vector<Eigen::Vector3d> profile = { { 0, -3, 1 }, { 1.5, -2.5, 1 }, { 2.4, 0.3, 1 },
    { 1.7, 2.2, 1 }, { 0, 3.4, 1 } };
  const NurbsSurface quarter = samples::Revolve(4, samples::UniformKnots(4, 5), profile, 1);
  int border = 0, places = 0;
  for (int k = 0; k < 20; ++k)
  {
    Eigen::Matrix3d turn;
    turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear.col(0) += 0.4 * RandomVector();
    shear.col(1) += 0.4 * RandomVector();
    const NurbsSurface first = samples::Transformed(quarter, shear, RandomVector());
    const Vec3 shift = Evaluate(first, 0, 0) - shear * Evaluate(quarter, 0, 0);
    const TrimmingSurface drop({ first, samples::Transformed(quarter, shear * turn, shift) }, 1e-4);
    for (int i = 0; i < 200; ++i, ++places)
    {
      const double away = 0.0003 + 0.01 * Uniform(0, 1); // free edges end at the pole itself
      const double v = i % 2 == 0 ? 1 - away : away;
      border += drop.ClosestPoint(Evaluate(first, 1, v)).Kind != FootKind::Interior;
    }
  }
  check::That(border == 0,
    "an edge to a pole: " + std::to_string(border) + " of " + std::to_string(places) +
      " places on a border");
}

/// A face with a pocket beside its border, which leaves a strip narrower than the gap: of the two
/// loops that counts which is nearer, or the pocket's wall would be joined to the border behind.
void TestStripBesidePocket()
{
  for (int k = 0; k < check::Trials(100); ++k)
  {
    const double gap = 1e-4, strip = Uniform(0.05, 0.9) * gap;
    const Vec2 low(k % 4 == 0 ? strip : Uniform(0.1, 0.4), k % 4 == 1 ? strip : Uniform(0.1, 0.4));
    const Vec2 high(
      1 - (k % 4 == 2 ? strip : Uniform(0.1, 0.4)), 1 - (k % 4 == 3 ? strip : Uniform(0.1, 0.4)));
    NurbsSurface face = samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    face.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1) },
      { low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y()) } };
    if (k % 8 > 3)
    {
      std::swap(face.TrimLoops[0], face.TrimLoops[1]);
    }
    const SurfaceModel model({ face }, gap, gap);
    const Vec2 middle = 0.5 * (low + high);
    const Vec3 at[4] = { Vec3(low.x(), middle.y(), 0), Vec3(middle.x(), low.y(), 0),
      Vec3(high.x(), middle.y(), 0), Vec3(middle.x(), high.y(), 0) };
    const std::vector<Sector> sectors = FindSectors(model, at[k % 4] - model.Origin, gap);
    check::That(!sectors.empty() && sectors[0].Away < 1e-9,
      "of two borders the nearer one, " + std::to_string(k));
  }
}

/// The same as files have them: the faces meet under a tiny angle, on either side, or are bounded
/// by loops.
void TestNearlyCusps()
{
  for (const double slope : { -1e-5, 1e-5, 5e-3 })
  {
    for (const bool byLoop : { false, true })
    {
      const double reach = byLoop ? 3.0 : 1.0; // of the patch along x, from -1 if there is a loop
      const double first = byLoop ? -1.0 : 0.0;
      const auto curve = [slope](double x) { return slope * x + 0.5 * x * x; };
      const double middle = curve(first) + 0.5 * reach * (slope + first);
      NurbsSurface roof = samples::FromNet(2, 1, 3, 2,
        [&](double u, double v)
        {
          const double x = first + reach * u;
          Vec4 point;
          point << x, u == 0.5 ? middle : curve(x), 2 * v - 1, 1;
          return point;
        });
      if (byLoop)
      {
        const double a = 1.0 / 3.0, b = 2.0 / 3.0;
        roof.TrimLoops = { { Vec2(a, 0), Vec2(b, 0), Vec2(b, 1), Vec2(a, 1) } };
      }
      const TrimmingSurface surface({ roof, UprightFace(Vec2(0, 0), Vec2(1, 0), 1, byLoop),
                                      UprightFace(Vec2(1, 0), Vec2(1, curve(1)), 1, byLoop) },
        1e-5, 4e-4);
      const bool outside = surface.ClosestPoint(Vec3(3, 0.2, 0)).SignedDistance > 0;
      for (int k = 0; k < check::Trials(500); ++k)
      {
        const Vec3 p(Uniform(-2, -0.01), k % 5 == 0 ? 0 : Uniform(-2, 2), Uniform(-0.9, 0.9));
        const Foot foot = surface.ClosestPoint(p);
        check::That(foot.Kind == FootKind::Interior && (foot.SignedDistance > 0) == outside,
          "a cusp of slope " + std::to_string(slope) + (byLoop ? " by loops" : "") +
            Place(p, foot));
      }
    }
  }
}

/// Points that end in a needle, whose normals at its tip cancel; also where it is what a body
/// leaves.
void TestNeedles()
{
  using Profile = std::vector<Eigen::Vector3d>;
  const std::vector<double> knots = { 0, 0, 0, 1, 1, 1 };
  // Radii at height z, times z or its square.
  for (const double steepness : { 0.3, 1e-2, 1e-4 })
  {
    for (const bool straight : { false, true })
    {
      const double middle = straight ? 0.5 * steepness : 0.0;
      const NurbsSurface needle =
        samples::Revolve(2, knots, Profile{ { 0, 0, 1 }, { middle, 0.5, 1 }, { steepness, 1, 1 } });
      NurbsSurface disc = samples::Cone(steepness, 0);
      for (Vec4& point : disc.ControlPoints)
      {
        point.z() = 1;
      }
      for (const std::vector<NurbsSurface>& faces :
        { std::vector<NurbsSurface>{ needle, disc }, std::vector<NurbsSurface>{ needle } })
      {
        const TrimmingSurface surface(Shuffled(faces), 1e-7);
        const double outside = surface.ClosestPoint(Vec3(1, 0.3, 0.5)).SignedDistance;
        for (int k = 0; k < check::Trials(300); ++k)
        {
          const Vec3 p(Uniform(-1, 1), k % 5 == 0 ? 0 : Uniform(-1, 1), Uniform(-2, 0.4));
          const Foot foot = surface.ClosestPoint(p);
          const double radius = p.head<2>().norm(), inner = steepness * (straight ? 1 : p.z());
          if (p.z() < 0 || radius > 1.01 * inner * p.z())
          {
            check::That(foot.Kind == FootKind::Interior && foot.SignedDistance * outside > 0,
              "a needle of " + std::to_string(steepness) + (straight ? ", straight" : "") +
                Place(p, foot));
          }
        }
      }
    }
  }
}

/// An edge that repeated control points make where the knots alone would join smoothly.
void TestEdgeOfControlPoints()
{
  constexpr double Slope = 3.0; // steep: the normals of the two sides turn by more than 90 degrees
  const double places[] = { -9, -6, -3, 0, 0, 0, 3, 6, 9 };
  for (const int degreeV : { 1, 3 })
  {
    const NurbsSurface roof = samples::FromNet(3, degreeV, 9, 7,
      [&](double u, double v)
      {
        const double x = places[static_cast<int>(std::lround(8 * u))];
        Vec4 point;
        point << x, -Slope * std::abs(x), 20 * v - 10, 1;
        return point;
      });
    TestSigns("an edge of control points", { roof }, Vec3(-1, -1, -2), Vec3(1, 2, 2),
      [](const Vec3& p)
      {
        const double x = std::abs(p.x()), length = std::hypot(1, Slope);
        const double along = (x - Slope * p.y()) / length, off = (Slope * x + p.y()) / length;
        return along < 0 ? std::hypot(x, p.y()) : off;
      });
  }
}

/// Bodies that have an edge in common: what lies on either side of it between two faces is told by
/// those that are next to each other, not by all four.
void TestBodiesThatTouch()
{
  std::vector<NurbsSurface> boxes = samples::BoxShell(Vec3(-0.97, -0.97, -1), Vec3(0.03, 0.03, 1));
  for (const NurbsSurface& face : samples::BoxShell(Vec3(0.03, 0.03, -1), Vec3(1.03, 1.03, 1)))
  {
    boxes.push_back(face);
  }
  const auto box = [](const Vec3& p, double middle)
  {
    const Vec3 q = (p - Vec3(middle, middle, 0)).cwiseAbs() - Vec3(0.5, 0.5, 1);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  TestSigns("boxes that touch at an edge", boxes, Vec3(-2, -2, -2), Vec3(2, 2, 2),
    [&](const Vec3& p) { return std::min(box(p, -0.47), box(p, 0.53)); });

  // A slab on the line at the top of a vault, both in two halves: no angle tells which faces are
  // next to each other, so that each body is oriented by itself.
  const auto vault = [](double from, double to)
  {
    return samples::FromNet(2, 1, 3, 2,
      [&](double u, double v)
      {
        Vec4 point;
        point << from + u * (to - from),
          u == 0.5 ? -0.5 * from * to : -0.5 * std::pow(from + u * (to - from), 2), 2 * v - 1, 1;
        return point;
      });
  };
  std::vector<NurbsSurface> faces = { vault(1, 0), vault(0, -1) };
  const auto addLine = [&faces](const std::vector<Vec2>& line)
  {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
      faces.push_back(UprightFace(line[i], line[i + 1], 1, false));
    }
  };
  addLine({ Vec2(-1, -0.5), Vec2(-1, -2), Vec2(1, -2), Vec2(1, -0.5) });
  addLine({ Vec2(-1, 0), Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(-1, 1), Vec2(-1, 0) });
  for (int turn = 0; turn < 20; ++turn)
  {
    std::shuffle(faces.begin(), faces.end(), Random);
    const TrimmingSurface surface(faces, 1e-7);
    for (int k = 0; k < check::Trials(100); ++k)
    {
      const Vec3 p(Uniform(-2, 2), Uniform(-3, 2), Uniform(-0.9, 0.9));
      const bool inside = std::abs(p.x()) < 1 &&
        ((p.y() > 0 && p.y() < 1) || (p.y() > -2 && p.y() < -0.5 * p.x() * p.x()));
      const Foot foot = surface.ClosestPoint(p);
      check::That(
        (foot.SignedDistance < 0) == inside, [&] { return "a slab on a vault" + Place(p, foot); });
    }
  }
}

void TestBoxes()
{
  for (const samples::Named& sample : samples::All())
  {
    const TrimmingSurface surface({ sample.Surface }, 1e-9);
    const Box3 bounds = surface.Bounds();
    const double scale = bounds.diagonal().norm();
    int certain = 0, possible = 0;
    for (int k = 0; k < check::Trials(20000); ++k)
    {
      const Vec3 center = bounds.center() +
        0.6 * RandomVector().cwiseProduct(bounds.sizes() + Vec3::Constant(0.1 * scale));
      const Vec3 half =
        scale * std::pow(10.0, Uniform(-3, -1)) * (RandomVector().cwiseAbs() + Vec3::Constant(0.1));
      const bool answer = surface.MayIntersect(Box3(center - half, center + half));
      const Foot foot = surface.ClosestPoint(center);
      const bool inside = ((foot.Point - center).cwiseAbs().array() <= half.array()).all();
      check::That(answer || !inside, sample.Name + ": a box that holds the foot of its centre");
      // Farther than its corner: certainly apart. Most of these have to be found.
      if (foot.Distance > 1.2 * half.norm())
      {
        ++certain;
        possible += answer;
      }
    }
    check::That(possible < 0.2 * certain + 20,
      sample.Name + ": boxes are tight: " + std::to_string(possible) + " of " +
        std::to_string(certain));
    check::That(surface.MayIntersect(bounds), "the whole box");
    for (int k = 0; k < 500; ++k)
    {
      const NurbsSurface& s = sample.Surface;
      const Vec3 p = Evaluate(s, Uniform(s.FirstU(), s.LastU()), Uniform(s.FirstV(), s.LastV()));
      check::That(
        surface.MayIntersect(Box3(p, p)), sample.Name + ": a box that is one point of the surface");
      check::That(bounds.contains(p), sample.Name + ": the bounds hold the surface");
    }
  }
}

void TestBoxesBesideLeaningTube()
{
  const TrimmingSurface tube({ samples::LeaningTube() }, 1e-9);
  int far = 0, possible = 0;
  for (int k = 0; k < check::Trials(20000); ++k)
  {
    const Vec3 center = tube.Bounds().center() + RandomVector().cwiseProduct(Vec3(8, 8, 2));
    if (tube.ClosestPoint(center).Distance > 2)
    {
      ++far;
      possible +=
        tube.MayIntersect(Box3(center - Vec3::Constant(0.05), center + Vec3::Constant(0.05)));
    }
  }
  check::That(far > check::Trials(20000) / 20 && possible < 0.01 * far,
    "boxes beside a leaning tube: " + std::to_string(possible) + " of " + std::to_string(far));
}

/// Normals in boxes round points of the surface, against those of feet in the box.
void TestNormalCones()
{
  int asked = 0, certain = 0;
  for (const samples::Named& sample : samples::All())
  {
    TrimmingSurface surface({ sample.Surface }, 1e-9);
    const double scale = surface.Bounds().diagonal().norm();
    for (int k = 0; k < check::Trials(2000); ++k)
    {
      const NurbsSurface& s = sample.Surface;
      const Vec3 p = Evaluate(s, Uniform(s.FirstU(), s.LastU()), Uniform(s.FirstV(), s.LastV()));
      const Vec3 direction = surface.ClosestPoint(p).Normal;
      const double half = scale * std::pow(10.0, Uniform(-4, -1));
      const double angle = Uniform(0.1, 1.5);
      const Box3 box(p - Vec3::Constant(half), p + Vec3::Constant(half));
      const bool answer = surface.NormalsLieWithin(box, direction, angle);
      asked += half < 1e-3 * scale;
      certain += answer && half < 1e-3 * scale;
      for (int i = 0; i < 20 && answer; ++i)
      {
        const Foot foot = surface.ClosestPoint(p + half * RandomVector());
        check::That(!box.contains(foot.Point) || foot.Kind != FootKind::Interior ||
            std::acos(std::min(1.0, foot.Normal.dot(direction))) <= angle + 1e-6,
          sample.Name + ": a normal outside of the cone" + Place(p, foot));
      }
      check::That(!surface.NormalsLieWithin(box, -direction, angle),
        sample.Name + ": no cone the other way round");
    }
    surface.Flip();
    const Foot foot = surface.ClosestPoint(surface.Bounds().center());
    check::That(!surface.NormalsLieWithin(Box3(foot.Point, foot.Point), -foot.Normal, 1.5),
      sample.Name + ": cones of the surface turned round");
  }
  check::That(certain > 0.5 * asked,
    "cones of small boxes: " + std::to_string(certain) + " of " + std::to_string(asked));
}

void TestCurvature()
{
  const TrimmingSurface sphere({ samples::Sphere(2) }, 1e-9),
    torus({ samples::Torus(1, 0.25) }, 1e-9);
  const TrimmingSurface plane(
    { samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)) }, 1e-9);
  check::Near(
    RadiusOfCurvature(sphere, sphere.ClosestPoint(Vec3(3, 1, 1))), 2, 1e-6, "radius of the sphere");
  check::Near(
    RadiusOfCurvature(torus, torus.ClosestPoint(Vec3(1, 1, 1))), 0.25, 1e-9, "radius of the torus");
  check::That(
    std::isinf(RadiusOfCurvature(plane, plane.ClosestPoint(Vec3(0.5, 0.5, 1)))), "a plane is flat");

  // On the outer equator of the torus: 1.25 along it, 0.25 across.
  const Foot equator = torus.ClosestPoint(Vec3(1.2, 0.9, 0));
  const Vec3 along(-0.6, 0.8, 0);
  check::Near(
    RadiusOfCurvatureAlong(torus, equator, along), 1.25, 1e-9, "radius along the equator");
  check::Near(
    RadiusOfCurvatureAlong(torus, equator, Vec3::UnitZ()), 0.25, 1e-9, "across the equator");
  check::Near(RadiusOfCurvatureAlong(torus, equator, 3 * along + Vec3(8, 6, 0)), 1.25, 1e-9,
    "only the part in the tangent plane counts");
  check::That(
    std::isinf(RadiusOfCurvatureAlong(plane, plane.ClosestPoint(Vec3(0.5, 0.5, 1)), Vec3(1, 2, 0))),
    "a plane is flat in each direction");

  // The sphere becomes an ellipsoid with the half axes 1, 2 and 4.
  const Eigen::Matrix3d map = Vec3(0.5, 1, 2).asDiagonal();
  check::Near(RadiusOfCurvature(sphere, sphere.ClosestPoint(Vec3(0, 3, 0)), map), 0.5, 1e-6,
    "radius of an ellipsoid where it is the shortest axis that bends");
  check::Near(RadiusOfCurvature(sphere, sphere.ClosestPoint(Vec3(3, 0, 0)), map), 4, 1e-6,
    "and where the other two do");
}

/// Many faces: a strip of planes over a wave, one shell.
void TestManyFaces()
{
  std::vector<NurbsSurface> faces;
  constexpr int N = 32;
  const auto corner = [](int i, int j)
  { return Vec3(i, j, 3 * std::sin(0.3 * i) * std::cos(0.2 * j)); };
  for (int j = 0; j < N; ++j)
  {
    for (int i = 0; i < N; ++i)
    {
      faces.push_back(samples::FromNet(1, 1, 2, 2,
        [&](double u, double v)
        {
          Vec4 x;
          x << corner(i + int(u), j + int(v)), 1;
          return x;
        }));
    }
  }
  const TrimmingSurface surface(Shuffled(faces), 1e-6);
  double orientation = 0;
  for (int k = 0; k < check::Trials(5000); ++k)
  {
    const Vec3 p(Uniform(1, N - 1), Uniform(1, N - 1), Uniform(-4, 4));
    const auto above = surface.Intersect(p, p + Vec3(0, 0, 20)),
               below = surface.Intersect(p, p - Vec3(0, 0, 20));
    check::That(above.size() + below.size() == 1, "one face over or under each point");
    const Foot foot = surface.ClosestPoint(p);
    if (foot.Kind == FootKind::Border)
    {
      continue;
    }
    const double side = (below.size() == 1 ? 1 : -1) * (foot.SignedDistance > 0 ? 1 : -1);
    orientation = orientation == 0 ? side : orientation;
    check::That(side == orientation, [&] { return "one side over 1024 faces" + Place(p, foot); });
  }
}
}

int main()
{
  Random.seed(3);
  TestClosedSurfaces();
  TestCusps();
  TestNearlyCusps();
  TestNeedles();
  TestEdgeOfControlPoints();
  TestBodiesThatTouch();
  TestGaps();
  TestFreeBorders();
  TestEdgeToPole();
  TestStripBesidePocket();
  TestBoxes();
  TestBoxesBesideLeaningTube();
  TestNormalCones();
  TestCurvature();
  TestManyFaces();
  TestToldGaps();
  return check::Result();
}
