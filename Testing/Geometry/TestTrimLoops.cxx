// Faces restricted by trim loops: closest points, borders, sides and hits.
#include "Check.h"
#include "ParameterPolygon.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "TrimLoops.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace nurbs;
using samples::Random;
using samples::RandomVector;
using samples::Uniform;

namespace
{

std::string Place(const Vec3& p, const Foot& foot)
{
  std::ostringstream text;
  text.precision(17);
  text << " at (" << p.transpose() << "), foot (" << foot.Point.transpose() << ") at (" << foot.U
       << ", " << foot.V << ") of face " << foot.Face << ", distance " << foot.Distance;
  return text.str();
}

std::vector<Vec2> Circle(const Vec2& center, double radius, int points, bool clockwise = false)
{
  std::vector<Vec2> loop;
  for (int k = 0; k < points; ++k)
  {
    const double angle = (clockwise ? -2 : 2) * M_PI * k / points;
    loop.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

bool InsideLoops(const std::vector<std::vector<Vec2>>& loops, const Vec2& p)
{
  bool inside = false;
  for (const auto& loop : loops)
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      {
        inside = !inside;
      }
    }
  }
  return inside;
}

double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// In the plane the answer is known: an unit square with a hole and an outer loop of many points.
void TestPlane()
{
  NurbsSurface plane = samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  for (int variant = 0; variant < 4; ++variant)
  {
    // Even-odd: the sense of the loops does not matter.
    plane.TrimLoops = { Circle(Vec2(0.5, 0.5), 0.4, variant == 3 ? 4000 : 40, variant & 1),
      Circle(Vec2(0.55, 0.45), 0.2, variant == 3 ? 2500 : 17, variant & 2) };
    const TrimmingSurface surface({ plane }, 1e-9);
    Foot last;
    for (int k = 0; k < check::Trials(3000); ++k)
    {
      const Vec3 p(Uniform(-0.5, 1.5), Uniform(-0.5, 1.5), k % 2 ? Uniform(-0.3, 0.3) : 0.01);
      const Vec2 q = p.head<2>();
      const bool inside = InsideLoops(plane.TrimLoops, q);
      double expected = std::abs(p.z());
      if (!inside)
      {
        expected = HUGE_VAL;
        for (const auto& loop : plane.TrimLoops)
        {
          for (std::size_t i = 0; i < loop.size(); ++i)
          {
            const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
            expected = std::min(
              expected, DistanceToSegment(p, Vec3(a.x(), a.y(), 0), Vec3(b.x(), b.y(), 0)));
          }
        }
      }
      const Foot foot = surface.ClosestPoint(p);
      check::Near(foot.Distance, expected, 1e-12, "distance to the trimmed plane");
      check::That((foot.Kind == FootKind::Interior) == inside,
        "feet on the loops are on the border" + Place(p, foot) + " variant " +
          std::to_string(variant));
      check::That(!inside || (foot.SignedDistance > 0) == (p.z() > 0), "side of the trimmed plane");
      const auto hits = surface.Intersect(Vec3(q.x(), q.y(), -1), Vec3(q.x(), q.y(), 1));
      check::That(hits.size() == (inside ? 1u : 0u), "hits inside the loops only");
      const Foot guessed = surface.ClosestPoint(p, foot, 2);
      check::Near(guessed.Distance, foot.Distance, 1e-13, "with a guess");
      // On the plane there is one foot only, and none in the hole.
      check::Near(surface.NearbyFoot(p, last).Distance, expected, 1e-12,
        "from another foot of the trimmed plane" + Place(p, last));
      last = foot;
    }
    const double h = 0.004;
    for (int k = 0; k < check::Trials(3000); ++k)
    {
      const Vec3 c(Uniform(0, 1), Uniform(0, 1), Uniform(-0.01, 0.01)), half = Vec3::Constant(h);
      const Foot foot = surface.ClosestPoint(c);
      const bool meets = ((foot.Point - c).cwiseAbs().array() <= h).all();
      check::That(
        !meets || surface.MayIntersect(Box3(c - half, c + half)), "boxes of the trimmed plane");
      check::That(foot.Distance < 0.2 || !surface.MayIntersect(Box3(c - half, c + half)),
        "boxes in the hole");
    }
  }
}

/// Curved faces: the foot must be the best of the untrimmed foot (if inside) and the loop's
/// image, which is sampled densely and refined.
void TestCurved(const std::string& name, NurbsSurface surface)
{
  const Vec2 low(surface.FirstU(), surface.FirstV()),
    size(surface.LastU() - low.x(), surface.LastV() - low.y());
  const auto place = [&](std::vector<Vec2> loop)
  {
    for (Vec2& x : loop)
    {
      x = low + x.cwiseProduct(size);
    }
    return loop;
  };
  surface.TrimLoops = { place(Circle(Vec2(0.5, 0.5), 0.47, 60)),
    place(Circle(Vec2(0.4, 0.6), 0.2, 30)),
    place({ Vec2(0.35, 0.55), Vec2(0.45, 0.55), Vec2(0.45, 0.65), Vec2(0.35, 0.65) }) };
  const TrimmingSurface trimmed({ surface }, 1e-9);
  std::vector<Vec3> samples;
  constexpr int M = 160;
  for (int i = 0; i <= M; ++i)
  {
    for (int j = 0; j <= M; ++j)
    {
      const Vec2 x = low + Vec2(i, j).cwiseProduct(size) / M;
      if (InsideLoops(surface.TrimLoops, x))
      {
        samples.push_back(Evaluate(surface, x.x(), x.y()));
      }
    }
  }
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (const auto& loop : surface.TrimLoops)
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      edges.push_back({ loop[i], loop[(i + 1) % loop.size()] });
      for (int k = 0; k < 20; ++k)
      {
        const Vec2 x = loop[i] + k / 20.0 * (loop[(i + 1) % loop.size()] - loop[i]);
        samples.push_back(Evaluate(surface, x.x(), x.y()));
      }
    }
  }
  const Box3 box = trimmed.Bounds();
  const double scale = box.diagonal().norm();
  for (int k = 0; k < check::Trials(1500); ++k)
  {
    const Vec3 p = k % 2 ? Vec3(box.center() + 0.6 * RandomVector().cwiseProduct(box.sizes()))
                         : Vec3(samples[Random() % samples.size()] + 0.05 * scale * RandomVector());
    const Foot foot = trimmed.ClosestPoint(p);
    double best = HUGE_VAL;
    for (const Vec3& x : samples)
    {
      best = std::min(best, (x - p).norm());
    }
    check::That(foot.Distance <= best * (1 + 1e-10) + 1e-13 * scale,
      name + ": nothing nearer than " + std::to_string(best) + Place(p, foot));
    check::That((Evaluate(surface, foot.U, foot.V) - foot.Point).norm() < 1e-11 * scale,
      name + ": the foot is S(u, v)");
    // The foot is inside the loops or on them.
    double toLoop = HUGE_VAL;
    for (const auto& edge : edges)
    {
      const Vec2 d = edge.second - edge.first, x = Vec2(foot.U, foot.V) - edge.first;
      const double t = std::clamp(x.dot(d) / d.squaredNorm(), 0.0, 1.0);
      toLoop = std::min(toLoop, (x - t * d).cwiseQuotient(size).norm());
    }
    const bool onLoop = toLoop < 1e-9;
    check::That(onLoop || InsideLoops(surface.TrimLoops, Vec2(foot.U, foot.V)),
      name + ": the foot is inside");
    check::That((foot.Kind == FootKind::Border) == onLoop || toLoop < 1e-7,
      name + ": the loop is the border");
  }
}

/// A box whose faces are larger than its sides and trimmed to them: edges are shared by loops.
void TestTrimmedShell()
{
  for (int variant = 0; variant < 2; ++variant)
  {
    std::vector<NurbsSurface> faces = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1));
    for (NurbsSurface& face : faces)
    {
      // Twice as large about the middle of the face.
      Vec3 center = Vec3::Zero();
      for (const Vec4& point : face.ControlPoints)
      {
        center += 0.25 * point.head<3>();
      }
      for (Vec4& point : face.ControlPoints)
      {
        const Vec3 larger = center + 2 * (point.head<3>() - center);
        point.head<3>() = larger;
      }
      std::vector<Vec2> loop = { Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.75, 0.75),
        Vec2(0.25, 0.75) };
      if (variant == 1) // many points along the edges, and at random places
      {
        std::vector<Vec2> fine;
        for (int side = 0; side < 4; ++side)
        {
          std::vector<double> steps = { 0 };
          for (int k = 0; k < 40; ++k)
          {
            steps.push_back(Uniform(0, 1));
          }
          std::sort(steps.begin(), steps.end());
          for (double t : steps)
          {
            fine.push_back(loop[side] + t * (loop[(side + 1) % 4] - loop[side]));
          }
        }
        loop = fine;
      }
      if (Random() % 2)
      {
        std::reverse(loop.begin(), loop.end());
      }
      face.TrimLoops = { loop };
      if (Random() % 2)
      {
        face = samples::ReversedU(face);
      }
    }
    const TrimmingSurface surface(faces, 1e-7);
    double orientation = 0;
    for (int k = 0; k < check::Trials(6000); ++k)
    {
      Vec3 p = Vec3(0.5, 0.5, 0.5) + 1.2 * RandomVector();
      if (k % 3 == 0)
      {
        p = (8 * p).array().round() / 8;
      }
      const Vec3 q = (p - Vec3(0.5, 0.5, 0.5)).cwiseAbs() - Vec3(0.5, 0.5, 0.5);
      const double outside = q.cwiseMax(0).norm(), exact = outside > 0 ? outside : q.maxCoeff();
      const Foot foot = surface.ClosestPoint(p);
      check::Near(
        foot.Distance, std::abs(exact), 1e-12, "distance to the trimmed box" + Place(p, foot));
      check::That(foot.Kind == FootKind::Interior, "loops shared by two faces are no border");
      if (std::abs(exact) > 1e-9)
      {
        const double side = foot.SignedDistance * exact > 0 ? 1 : -1;
        orientation = orientation == 0 ? side : orientation;
        check::That(side == orientation, "the side of the trimmed box");
      }
      const Vec3 b = Vec3(0.5, 0.5, 0.5) + 0.499 * RandomVector();
      if (std::abs(exact) > 1e-6)
      {
        const auto hits = surface.Intersect(p, b);
        check::That((hits.size() % 2 == 1) == (exact > 0), "parity through the trimmed box");
      }
    }
    // Lines exactly through the edges and corners.
    for (int k = 0; k < check::Trials(3000); ++k)
    {
      Vec3 edge(Uniform(0, 1), 0, k % 2);
      if (k % 10 == 0)
      {
        edge.x() = k % 3 == 0;
      }
      const Vec3 inside(0.5, Uniform(0.2, 0.8), Uniform(0.2, 0.8));
      const auto hits = surface.Intersect(inside, edge + 0.5 * (edge - inside));
      check::That(hits.size() == 1 && std::abs(hits[0].K - 2.0 / 3) < 1e-10,
        "a line through an edge of loops");
    }
  }
}

/// A prism over a polygon with a corner that opens beyond 180 degrees; its ends are trimmed planes.
void TestPrism()
{
  const std::vector<Vec2> polygon = { Vec2(0.2, 0.2), Vec2(0.8, 0.2), Vec2(0.8, 0.5),
    Vec2(0.45, 0.4), Vec2(0.5, 0.8), Vec2(0.2, 0.8) };
  std::vector<NurbsSurface> faces;
  for (double z : { 0.0, 0.5 })
  {
    NurbsSurface end = samples::Plane(Vec3(0, 0, z), Vec3(1, 0, 0), Vec3(0, 1, 0));
    end.TrimLoops = { polygon };
    faces.push_back(z == 0 ? samples::ReversedU(end) : end);
  }
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2 &a = polygon[i], d = polygon[(i + 1) % polygon.size()] - a;
    faces.push_back(samples::Plane(Vec3(a.x(), a.y(), 0), Vec3(d.x(), d.y(), 0), Vec3(0, 0, 0.5)));
  }
  const TrimmingSurface surface(faces, 1e-9);
  // At each corner: the end with the polygon's angle there, two sides with right angles.
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vec2 &corner = polygon[i], a = polygon[(i + 1) % polygon.size()] - corner,
               b = polygon[(i + polygon.size() - 1) % polygon.size()] - corner;
    double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    angle = angle < 0 ? angle + 2 * M_PI : angle;
    Vec3 expected(0, 0, angle);
    expected += M_PI / 2 * Vec3(a.y(), -a.x(), 0).normalized();
    expected += M_PI / 2 * Vec3(-b.y(), b.x(), 0).normalized();
    for (double z : { 0.0, 0.5 })
    {
      expected.z() = z == 0 ? -angle : angle;
      const Foot foot = surface.ClosestPoint(Vec3(corner.x(), corner.y(), z));
      check::Near(std::abs(foot.Normal.dot(expected.normalized())), 1, 1e-9,
        "normal at corner " + std::to_string(i) + " of the prism");
    }
  }
  double orientation = 0;
  for (int k = 0; k < check::Trials(20000); ++k)
  {
    Vec3 p(Uniform(0, 1), Uniform(0, 1), Uniform(-0.3, 0.8));
    if (k % 2) // about the corners
    {
      const Vec2& corner = polygon[k % polygon.size()];
      p = Vec3(corner.x(), corner.y(), k % 4 == 1 ? 0 : 0.5) + 0.05 * RandomVector();
    }
    const bool inside = p.z() > 0 && p.z() < 0.5 && InsideLoops({ polygon }, Vec2(p.head<2>()));
    const Foot foot = surface.ClosestPoint(p);
    check::That(foot.Kind == FootKind::Interior, "a prism has no border" + Place(p, foot));
    const double side = inside == (foot.SignedDistance < 0) ? 1 : -1;
    orientation = orientation == 0 ? side : orientation;
    check::That(side == orientation, "the side of a prism" + Place(p, foot));
  }
}

/// Loops that say nothing, say everything, or run along the rectangle and the seam.
void TestWholeLoops()
{
  NurbsSurface cylinder = samples::Cylinder(1, 2);
  cylinder.TrimLoops = { { Vec2(0, 0), Vec2(2, 0), Vec2(4, 0), Vec2(4, 1), Vec2(0, 1) } };
  const TrimmingSurface whole({ cylinder }, 1e-9);
  // Cut slantwise: the loop runs along the seam on both sides.
  cylinder.TrimLoops = { { Vec2(0, 0.2), Vec2(1, 0.1), Vec2(2, 0.2), Vec2(3, 0.3), Vec2(4, 0.2),
    Vec2(4, 0.9), Vec2(0, 0.9) } };
  const TrimmingSurface slant({ cylinder }, 1e-9);
  for (const TrimmingSurface* surface : { &whole, &slant })
  {
    for (int k = 0; k < check::Trials(2000); ++k)
    {
      const double angle = k % 4 == 0 ? 0 : Uniform(0, 2 * M_PI), r = Uniform(0.5, 1.5);
      const Vec3 p(r * std::cos(angle), r * std::sin(angle), Uniform(0.7, 1.7));
      const Foot foot = surface->ClosestPoint(p);
      check::That(
        foot.Kind == FootKind::Interior, "the seam is no border under loops" + Place(p, foot));
      check::Near(foot.Distance, std::abs(r - 1), 1e-12, "distance to the trimmed cylinder");
      check::That((foot.SignedDistance > 0) == (r > 1), "side of the trimmed cylinder");
    }
    check::That(surface->ClosestPoint(Vec3(1.1, 0, 2.3)).Kind == FootKind::Border,
      "the end of the trimmed cylinder");
    check::That(
      surface->ClosestPoint(Vec3(0.3, 1.1, -0.3)).Kind == FootKind::Border, "the other end");
  }
  // A sphere with a loop round the whole rectangle, and one cut along a parallel: a pole inside.
  NurbsSurface sphere = samples::Sphere(1);
  sphere.TrimLoops = { { Vec2(0, 0.7), Vec2(4, 0.7), Vec2(4, 2), Vec2(0, 2) } };
  const TrimmingSurface cap({ sphere }, 1e-9);
  check::That(
    cap.ClosestPoint(Vec3(0, 0, 1.3)).Kind == FootKind::Interior, "over the pole of a cap");
  check::Near(
    std::abs(cap.ClosestPoint(Vec3(0, 0, 1.3)).Normal.z()), 1, 1e-6, "normal at the pole of a cap");
  check::That(cap.ClosestPoint(Vec3(0.3, 0.1, -1.3)).Kind == FootKind::Border, "under a cap");
  // Nothing left: no foot, no hit, no crash.
  NurbsSurface none = samples::Wavy();
  none.TrimLoops = { { Vec2(2, 2), Vec2(3, 2), Vec2(3, 3) } };
  const TrimmingSurface empty({ none }, 1e-9);
  check::That(
    empty.ClosestPoint(Vec3(0.5, 0.5, 1)).Kind == FootKind::None, "nothing inside the loops");
  check::That(
    empty.Intersect(Vec3(0.5, 0.5, -1), Vec3(0.5, 0.5, 1)).empty(), "no hit inside the loops");
  check::That(!empty.MayIntersect(Box3(Vec3(0, 0, -1), Vec3(1, 1, 1))), "no box meets nothing");
}

/// Which loops go round the whole surface.
void TestWholeRectangle()
{
  const NurbsSurface wavy = samples::Wavy();
  constexpr double Slack = 1e-6;
  const double low = 0.5 * Slack, high = 1 - low;
  const std::vector<Vec2> loop = { Vec2(low, 0), Vec2(high, low), Vec2(1, high), Vec2(0, 1) };
  check::That(IsWholeRectangle(loop, wavy, Slack), "a loop within the slack is the border");
  check::That(!IsWholeRectangle(loop, wavy, 1e-9), "it is not where the slack is less");
  const std::vector<Vec2> cut = { Vec2(0, 0), Vec2(0.999, 0), Vec2(1, 0.001), Vec2(1, 1),
    Vec2(0, 1) };
  check::That(!IsWholeRectangle(cut, wavy, Slack), "a loop that cuts a corner is not the border");
  const std::vector<Vec2> line = { Vec2(0, 0), Vec2(1, 0), Vec2(0.5, 0) };
  check::That(!IsWholeRectangle(line, wavy, Slack), "nor is one along a side that is empty");
}

/// A rectangle that begins in a loop and ends far away, by the loop's size.
void TestSmallLoop()
{
  for (const double radius : { 1e-3, 1e-6, 1e-9 })
  {
    NurbsSurface plane = samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    plane.TrimLoops = { Circle(Vec2(0.5, 0.5), radius, 9000, false) };
    const TrimLoops loops(plane);
    const double low = 0.5 - 0.5 * radius, high = 0.5 + 0.5 * radius;
    check::That(loops.Classify(Vec2(0.4, high), Vec2(0.6, 0.9)) == TrimState::Crossed &&
        loops.Classify(Vec2(0.4, 0.1), Vec2(0.6, low)) == TrimState::Crossed,
      "a loop of radius " + std::to_string(radius) + " crosses a large rectangle");
  }
}

/// Loops that touch: beside the place where they do nothing tells what is between them.
void TestTouchingLoops()
{
  for (int turn = 0; turn < 20; ++turn)
  {
    // The outer one has its longest edge there.
    std::vector<Vec2> outer = Circle(Vec2(0, 0), 2, 2048);
    outer[0] = Vec2(2, -1e-5 * (1 + turn));
    std::vector<Vec2> inner = Circle(Vec2(0.5, 0), 1.5, 2048);
    const bool turned = turn % 2 == 1, turnedInner = turn % 3 == 1;
    if (turned)
    {
      std::reverse(outer.begin(), outer.end());
    }
    if (turnedInner)
    {
      std::reverse(inner.begin(), inner.end());
    }
    NurbsSurface surface = samples::Plane(Vec3(-3, -3, 0), Vec3(6, 0, 0), Vec3(0, 6, 0));
    surface.KnotsU = surface.KnotsV = { -3, -3, 3, 3 };
    surface.TrimLoops = { outer, inner };
    const TrimLoops loops(surface);
    check::That(loops.InsideIsLeft(0) == !turned && loops.InsideIsLeft(1) == turnedInner,
      "the side of loops that touch");
  }
}

/// A face with a hole and the one that fills it, turned round, whose parameters may go to a million
/// one way and to a millionth the other way: how far that is says nothing of where a loop lies.
void TestParameterRanges()
{
  const auto stretched = [](NurbsSurface face, double u, double v)
  {
    for (double& knot : face.KnotsU)
    {
      knot *= u;
    }
    for (double& knot : face.KnotsV)
    {
      knot *= v;
    }
    for (auto& loop : face.TrimLoops)
    {
      for (Vec2& point : loop)
      {
        point = point.cwiseProduct(Vec2(u, v));
      }
    }
    return face;
  };
  NurbsSurface plate = samples::Plane(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  plate.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1) },
    Circle(Vec2(0.5, 0.5), 0.3, 60) };
  NurbsSurface lid = samples::Plane(Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0));
  lid.TrimLoops = { Circle(Vec2(0.5, 0.5), 0.3, 60) };
  for (const double u : { 1e-6, 1.0, 1e6 })
  {
    for (const double v : { 1e-6, 1.0, 1e6 })
    {
      const TrimmingSurface surface({ stretched(plate, u, v), stretched(lid, v, u) }, 1e-7);
      for (int k = 0; k < check::Trials(200); ++k)
      {
        const Vec3 p(Uniform(0.02, 0.98), Uniform(0.02, 0.98), Uniform(-0.01, 0.01));
        const Foot foot = surface.ClosestPoint(p);
        check::That(foot.Kind == FootKind::Interior && foot.SignedDistance * p.z() > 0,
          "parameters to " + std::to_string(u) + ", " + std::to_string(v) + Place(p, foot));
      }
    }
  }
}

}

int main()
{
  Random.seed(13);
  TestPlane();
  TestCurved("wavy", samples::Wavy());
  TestCurved("half cylinder", samples::Cylinder(1, 2, 2));
  TestCurved("creased", samples::Creased());
  TestCurved("unclamped", samples::Unclamped());
  TestCurved("high degree", samples::HighDegree(5, 4));
  TestTrimmedShell();
  TestPrism();
  TestWholeLoops();
  TestWholeRectangle();
  TestSmallLoop();
  TestTouchingLoops();
  TestParameterRanges();
  return check::Result();
}
