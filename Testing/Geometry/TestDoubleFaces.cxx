// Faces and whole shells that a file has twice, written alike or but for rounding: they are one
// surface, no body without an inside.
#include "Check.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace nurbs;
using samples::RandomVector;

namespace
{

constexpr double Gap = 1e-5;

NurbsSurface Moved(const NurbsSurface& face, double by)
{
  return samples::Transformed(face, Eigen::Matrix3d::Identity(), Vec3(0.3, 0.2, 1) * by);
}

/// The sides of places are those of the first faces, of which those after them are there twice; if
/// `eitherSide`, or all the other ones.
void TestSides(const std::string& name, const std::vector<NurbsSurface>& faces, double by,
  std::size_t first, bool eitherSide = false)
{
  const TrimmingSurface once({ faces.begin(), faces.begin() + first }, Gap);
  const TrimmingSurface twice(faces, Gap);
  const Vec3 outside = Vec3::Constant(3);
  const bool turned = eitherSide &&
    once.ClosestPoint(outside).SignedDistance * twice.ClosestPoint(outside).SignedDistance < 0;
  const int places = check::Trials(2000);
  int told = 0, wrong = 0;
  for (int k = 0; k < places; ++k)
  {
    const Vec3 p = 0.5 * Vec3::Ones() + 0.6 * RandomVector();
    const Foot foot = once.ClosestPoint(p);
    if (foot.Kind == FootKind::Interior && foot.Distance > 10 * by)
    {
      ++told;
      const double distance = (turned ? -1 : 1) * twice.ClosestPoint(p).SignedDistance;
      wrong += !(std::abs(distance - foot.SignedDistance) <= 2 * by + 1e-11);
    }
  }
  check::That(told > places / 4, name + ": only " + std::to_string(told) + " places have a side");
  check::That(
    wrong == 0, name + ": " + std::to_string(wrong) + " of " + std::to_string(told) + " wrong");
}

/// The same place, cut out of a plane twice as large.
NurbsSurface Trimmed(NurbsSurface face)
{
  nurbs::Vec4 middle = nurbs::Vec4::Zero();
  for (const nurbs::Vec4& point : face.ControlPoints)
  {
    middle += point / static_cast<double>(face.ControlPoints.size());
  }
  for (nurbs::Vec4& point : face.ControlPoints)
  {
    point.head<3>() += point.head<3>() - middle.head<3>();
  }
  face.TrimLoops = { { Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.75, 0.75), Vec2(0.25, 0.75) } };
  return face;
}

/// Shells of which all faces are there twice.
void TestShells(const std::string& name, double by, bool reversed)
{
  const auto add = [&](std::vector<NurbsSurface> faces, std::size_t count)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      faces.push_back(Moved(reversed ? samples::ReversedU(faces[k]) : faces[k], by));
    }
    return faces;
  };
  std::vector<NurbsSurface> rounded = samples::RoundedShell(0.8, 0.6, 0.15, 1.4);
  for (NurbsSurface& face : rounded)
  {
    face = samples::Transformed(face, Eigen::Matrix3d::Identity(), Vec3(0.5, 0.5, -0.2));
  }
  const std::vector<NurbsSurface> box = samples::BoxShell(Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.7, 0.6));
  TestSides("a box " + name, add(box, 6), by, 6, reversed);
  std::vector<NurbsSurface> trimmed = box;
  std::transform(box.begin(), box.end(), trimmed.begin(), Trimmed);
  TestSides("a box of trimmed planes " + name, add(trimmed, 6), by, 6, reversed);
  TestSides("a rounded shell " + name, add(rounded, rounded.size()), by, rounded.size(), reversed);
}

/// A wall that two bodies share is there for each of them.
void TestSharedWalls()
{
  const auto count = [](std::vector<NurbsSurface> faces, const std::vector<NurbsSurface>& others)
  {
    faces.insert(faces.end(), others.begin(), others.end());
    return TrimmingSurface(faces, Gap).NumberOfFaces();
  };
  const std::vector<NurbsSurface> box = samples::BoxShell(Vec3(0, 0, 0), Vec3(1, 1, 1));
  check::That(count(box, samples::BoxShell(Vec3(1, 0, 0), Vec3(2, 1, 1))) == 12, "a shared wall");
  check::That(count(box, { box.begin(), box.end() - 1 }) == 11, "a box twice but for a wall");
  check::That(count(box, box) == 6, "a box twice");
}

}

int main()
{
  for (const double by : { 0.0, 1e-12, 1e-10, 1e-8, 1e-6 })
  {
    for (const bool reversed : { false, true })
    {
      const auto add = [&](std::vector<NurbsSurface> faces, std::size_t face)
      {
        const NurbsSurface other = reversed ? samples::ReversedU(faces[face]) : faces[face];
        faces.push_back(Moved(other, by));
        return faces;
      };
      const std::string name =
        "by " + std::to_string(1e6 * by) + "e-6" + (reversed ? ", turned" : "");
      TestSides("a wavy face " + name, add({ samples::Wavy() }, 0), by, 1);
      TestSides("a creased face " + name, add({ samples::Creased() }, 0), by, 1);
      TestSides("a face of a box " + name,
        add(samples::BoxShell(Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.7, 0.6)), 3), by, 6);
      TestShells(name, by, reversed);
    }
  }
  TestSharedWalls();
  return check::Result();
}
