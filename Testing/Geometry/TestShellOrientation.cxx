// To which side the normals of a shell point whose faces are turned round and come in any order.
#include "Check.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "ShellTesting.h"
#include "TrimmingSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

using namespace nurbs;
using samples::Place;
using samples::Random;
using samples::RandomVector;
using samples::Shuffled;
using samples::Uniform;
using samples::UprightFace;

namespace
{
void TestOrientation()
{
  // The largest face decides: the four big planes look outwards, so do all.
  std::vector<NurbsSurface> faces = samples::RoundedShell(1, 0.8, 0.3, 1);
  const double outwards = [&]()
  {
    const SurfaceJet jet = EvaluateJet(faces[0], 0.5, 0.5);
    return jet.Su.cross(jet.Sv).y() < 0 ? 1.0 : -1.0;
  }();
  for (std::size_t k = 1; k < faces.size(); k += 2)
  {
    faces[k] = samples::ReversedU(faces[k]);
  }
  faces[2] = samples::ReversedU(faces[2]);
  faces[0] = samples::Plane(
    Vec3(-0.7, -0.8, 0), Vec3(1.4, 0, 0), Vec3(0, 0, 1)); // the first of the two largest
  TrimmingSurface surface(faces, 1e-7);
  for (const Vec3& p : { Vec3(0, -1, 0.5), Vec3(1.2, 0, 0.5), Vec3(0, 1, 0.5), Vec3(-1.2, 0, 0.5),
         Vec3(1, 0.8, 0.5), Vec3(-1, -0.8, 0.5) })
  {
    check::That(surface.ClosestPoint(p).SignedDistance * outwards > 0,
      "oriented by the largest face" + Place(p, surface.ClosestPoint(p)));
  }
  surface.Flip();
  check::That(surface.ClosestPoint(Vec3(0, -1, 0.5)).SignedDistance * outwards < 0, "turned round");
  const auto hits = surface.Intersect(Vec3(0, -1, 0.5), Vec3(0, 0, 0.5));
  check::That(hits.size() == 1 && hits[0].Normal.y() * outwards > 0, "hits have the same normals");
  // Two shells, each by its own largest face.
  std::vector<NurbsSurface> two = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1.1));
  for (NurbsSurface& face : samples::BoxShell(Vec3(3, 0, 0), Vec3(4, 1, 1)))
  {
    two.push_back(samples::ReversedU(face));
  }
  const TrimmingSurface both(two, 1e-7);
  check::That(both.ClosestPoint(Vec3(0.5, 0.5, 0.9)).SignedDistance < 0, "first shell");
  check::That(both.ClosestPoint(Vec3(3.5, 0.5, 0.9)).SignedDistance > 0, "second shell");
}

/// Six faces of one size, two of them turned round: most decide, in whatever order they come and
/// however their areas are rounded.
void TestOrientationOfEqualFaces()
{
  std::vector<NurbsSurface> box = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1));
  box[2] = samples::ReversedU(box[2]);
  box[4] = samples::ReversedU(box[4]);
  for (int order = 0; order < 24; ++order)
  {
    std::rotate(box.begin(), box.begin() + 1, box.end());
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(Uniform(0, 6), RandomVector().normalized()).toRotationMatrix();
    const Vec3 shift = RandomVector(), inside = turn * Vec3(0.5, 0.5, 0.1) + shift;
    std::vector<NurbsSurface> turned;
    for (const NurbsSurface& face : box)
    {
      turned.push_back(samples::Transformed(face, turn, shift));
    }
    const Foot found = TrimmingSurface(turned, 1e-7).ClosestPoint(inside);
    check::That(found.SignedDistance < 0, "most of the largest faces" + Place(inside, found));
  }
}

/// A strip of an upright cylinder between two angles.
NurbsSurface Strip(double radius, double from, double to, double half)
{
  return samples::FromNet(2, 1, 3, 2,
    [&](double u, double v)
    {
      const double angle = from + u * (to - from);
      const double weight = u == 0.5 ? std::cos(0.5 * (to - from)) : 1.0;
      const double away = radius / weight;
      return Vec4(away * std::cos(angle), away * std::sin(angle), (2 * v - 1) * half, weight);
    });
}

/// Long strips side by side, some hardly wider than the gap that counts as closed.
void TestOrientationOfStrips()
{
  const double quarters[] = { 0, 0.4, 1, 2, 2.68, 2.7, 3, 3.03, 3.46, 3.48, 3.58, 3.66, 4 };
  for (const double half : { 50.0, 55.0, 58.0, 60.0, 65.0, 200.0, 300.0, 400.0 })
  {
    std::vector<NurbsSurface> strips;
    for (std::size_t i = 0; i + 1 < std::size(quarters); ++i)
    {
      strips.push_back(Strip(2.2, 0.5 * M_PI * quarters[i], 0.5 * M_PI * quarters[i + 1], half));
    }
    const TrimmingSurface surface(strips, 1e-5 * 2 * half, 4e-4 * 2 * half);
    for (std::size_t i = 0; i < strips.size(); ++i)
    {
      const double angle = 0.25 * M_PI * (quarters[i] + quarters[i + 1]);
      const Foot foot =
        surface.ClosestPoint(Vec3(2.21 * std::cos(angle), 2.21 * std::sin(angle), 0.1));
      check::That(foot.SignedDistance > 0,
        "strips of " + std::to_string(2 * half) + ": turned, " + std::to_string(i));
    }
  }
}

/// Two long walls with a tiny fillet of several faces at the edge between them: these are narrower
/// than the gaps that count as closed, and the wall behind them is within such a gap as well.
void TestOrientationOfTinyFillets()
{
  constexpr double Half = 10.0;
  for (int k = 0; k < check::Trials(400); ++k)
  {
    const double length = std::pow(10.0, Uniform(1.5, 3)), opening = Uniform(0.2, 2.5);
    const double radius = length * std::pow(10.0, Uniform(-6, -3));
    const int count = 1 + static_cast<int>(Random() % 4);
    // The walls lean by half the opening from x, round a fillet at the origin.
    const double turn = 0.5 * (M_PI - opening);
    const auto onFillet = [&](double angle)
    { return Vec2(-radius * std::cos(angle), radius * std::sin(angle)); };
    const Vec2 wall(length * std::cos(0.5 * opening), length * std::sin(0.5 * opening));
    std::vector<Vec2> line = { onFillet(-turn) + Vec2(wall.x(), -wall.y()) };
    for (int i = 0; i <= count; ++i)
    {
      line.push_back(onFillet(turn * (2.0 * i / count - 1.0)));
    }
    line.push_back(onFillet(turn) + wall);
    std::vector<NurbsSurface> faces;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
      // Every other time with gaps of a fifth of the narrowest face between them.
      const double gap = k % 2 == 0 ? 0.0 : 0.1 * (line[2] - line[1]).norm();
      const Vec2 less = gap * (line[i + 1] - line[i]).normalized();
      faces.push_back(UprightFace(line[i] + less, line[i + 1] - less, Half, k % 3 == 0));
    }
    const double size = 2 * length;
    const TrimmingSurface surface(Shuffled(faces), 1e-5 * size, 4e-4 * size);
    const Vec2 inwards(0.1 * wall.y(), -0.1 * wall.x());
    const Vec2 place = 0.3 * wall + inwards, mirrored(place.x(), -place.y());
    const Foot one = surface.ClosestPoint(Vec3(place.x(), place.y(), 0.1));
    const Foot two = surface.ClosestPoint(Vec3(mirrored.x(), mirrored.y(), 0.1));
    check::That((one.SignedDistance > 0) == (two.SignedDistance > 0),
      "one side between two walls of length " + std::to_string(length) + " under " +
        std::to_string(opening) + " with " + std::to_string(count) + " faces of a fillet of " +
        std::to_string(radius) + (k % 3 == 0 ? " by loops" : ""));
  }
}

/// An upright wall from the edge at the origin, 1 long, with a notch in that edge.
NurbsSurface NotchedWall(const Vec2& along, double half, double depth, double height)
{
  NurbsSurface wall =
    samples::Plane(Vec3(0, 0, -half), Vec3(along.x(), along.y(), 0), Vec3(0, 0, 2 * half));
  const double bottom = 0.5, top = 0.5 + 0.5 * height / half;
  wall.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1), Vec2(0, top),
    Vec2(depth, top), Vec2(depth, bottom), Vec2(0, bottom) } };
  return wall;
}

/// Two walls with a long straight edge, and in a notch of it a bevel narrower than the gap that
/// counts as closed, off one of them. The many places of its curved side see the other wall as
/// well, and must not outvote the long edge (a part of Fusion 360 was refused for it).
void TestOrientationBesideSliver()
{
  constexpr double Half = 10.0, Gap = 4e-4 * 2 * Half;
  for (int k = 0; k < check::Trials(200); ++k)
  {
    const double height = Uniform(0.1, 0.5), width = Uniform(0.2, 0.6) * Gap;
    const double away = Uniform(0.35, 0.45); // of the width, from the first wall
    const double top = 0.5 + 0.5 * height / Half;
    NurbsSurface bevel =
      samples::Plane(Vec3(0, -width, -Half), Vec3(width, width, 0), Vec3(0, 0, 2 * Half));
    bevel.TrimLoops = { { Vec2(1, 0.5), Vec2(1, top) } };
    for (int i = 0; i <= 100; ++i)
    {
      const double share = 0.01 * i;
      bevel.TrimLoops[0].push_back(
        Vec2(away * (1 - 0.1 * std::sin(M_PI * share)), top + share * (0.5 - top)));
    }
    const TrimmingSurface surface(Shuffled({ NotchedWall(Vec2(0, -1), Half, width, height),
                                    NotchedWall(Vec2(1, 0), Half, width, height), bevel }),
      1e-5 * 2 * Half, Gap);
    const Foot one = surface.ClosestPoint(Vec3(0.1, -0.5, 3));
    const Foot two = surface.ClosestPoint(Vec3(0.5, -0.1, 3));
    check::That((one.SignedDistance > 0) == (two.SignedDistance > 0),
      "one side beside a sliver of " + std::to_string(height) + " by " + std::to_string(width));
  }
}

/// The same faces in another order give the same feet, to the last digit.
void TestFaceOrder()
{
  std::vector<NurbsSurface> faces;
  for (int k = 0; k < 4; ++k)
  {
    for (const NurbsSurface& face : samples::RoundedShell(0.3, 0.3, 0.2, 1))
    {
      faces.push_back(
        samples::Transformed(face, Eigen::Matrix3d::Identity(), Vec3(k % 2, k / 2, 0.1)));
    }
  }
  const TrimmingSurface surface(faces, 1e-9);
  std::shuffle(faces.begin(), faces.end(), Random);
  const TrimmingSurface shuffled(faces, 1e-9);
  for (int k = 0; k < check::Trials(20000); ++k)
  {
    const Vec3 p = Vec3(0.5, 0.5, 0.5) + RandomVector();
    const Foot foot = surface.ClosestPoint(p), other = shuffled.ClosestPoint(p);
    check::That(foot.Point == other.Point && foot.Normal == other.Normal &&
        foot.SignedDistance == other.SignedDistance,
      [&] { return "one foot whatever the order of faces" + Place(p, foot); });
  }
}
}

int main()
{
  Random.seed(3);
  TestOrientation();
  TestOrientationOfStrips();
  TestOrientationOfTinyFillets();
  TestOrientationBesideSliver();
  TestOrientationOfEqualFaces();
  TestFaceOrder();
  return check::Result();
}
