/**
 * Files of other programs (Files/README.md), and STEP written by hand, compared with what they
 * are known to hold.
 */
#include "ReadTesting.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <sstream>

using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec3;
using nurbs::Vec4;

namespace
{
const double Pi = 3.14159265358979323846;

std::string TestFile(const std::string& name)
{
  return std::string(READ_TEST_FILES) + "/" + name;
}

/// Checks |distance(p)| < 1e-9 of the size and distance(p + normal) > 0 all over a surface.
void CheckDistance(const std::string& name, const NurbsSurface& surface,
  const std::function<double(const Vec3&)>& distance)
{
  double largest = 0.0;
  int inwards = 0;
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; j <= 10; ++j)
    {
      const double u = surface.FirstU() + (surface.LastU() - surface.FirstU()) * i / 10.0;
      const double v = surface.FirstV() + (surface.LastV() - surface.FirstV()) * j / 10.0;
      const Vec3 p = nurbs::Evaluate(surface, u, v);
      largest = std::max(largest, std::abs(distance(p)));
      const nurbs::SurfaceJet jet = nurbs::EvaluateJet(surface, u, v);
      const bool isPole = jet.Su.cross(jet.Sv).norm() < 1e-9;
      inwards += !isPole && distance(p + 0.01 * UnitNormal(surface, u, v)) < 0.0;
    }
  }
  CHECK(largest < 1e-9 * 50.0, name << " is off by " << largest);
  CHECK(inwards == 0, name << ": " << inwards << " normals point inwards");
}

/// Distance from a plate of 70 x 45 x 30 with a hole, positive outside; near its faces only.
double PlateDistance(const Vec3& p)
{
  const double box =
    std::max({ -30.0 - p.x(), p.x() - 40.0, -20.0 - p.y(), p.y() - 25.0, -p.z(), p.z() - 30.0 });
  return std::max(box, 12.0 - std::hypot(p.x() - 5.0, p.y() - 3.0));
}

void TestSolveSpace()
{
  const ReadResult result = ReadFaces(TestFile("solvespace-plate.step"), 10);
  double area = 0.0;
  size_t holed = 0;
  for (size_t i = 0; i < result.Surfaces.size(); ++i)
  {
    const NurbsSurface& surface = result.Surfaces[i];
    area += Area(surface, 200);
    holed += surface.TrimLoops.size() == 2;
    if (surface.TrimLoops.empty())
    {
      CheckDistance(result.Names[i], surface, PlateDistance);
    }
  }
  const double expected = 2.0 * (70 * 45 + 70 * 30 + 45 * 30 - 144 * Pi) + 24 * Pi * 30;
  CHECK(std::abs(area - expected) < 2e-3 * expected, "area " << area << ", not " << expected);
  CHECK(holed == 2, holed << " faces have a hole");
}

void TestGoToolsAnalytic()
{
  const ReadResult torus = ReadFaces(TestFile("gotools-torus.igs"), 1);
  for (const NurbsSurface& surface : torus.Surfaces)
  {
    CheckDistance("torus", surface,
      [](const Vec3& p)
      {
        const Vec3 arm = p - Vec3(10, 20, 30);
        const double height = arm.dot(Vec3(0, 0.6, 0.8));
        return std::hypot((arm - height * Vec3(0, 0.6, 0.8)).norm() - 40.0, height) - 12.0;
      });
    CHECK(std::abs(Area(surface, 200) - 4 * Pi * Pi * 40 * 12) < 1.0, Area(surface, 200));
  }
  const ReadResult both = ReadFaces(TestFile("gotools-cylinder-sphere.igs"), 2);
  if (both.Surfaces.size() == 2)
  {
    CheckDistance(
      "cylinder", both.Surfaces[0], [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 25.0; });
    CheckDistance(
      "sphere", both.Surfaces[1], [](const Vec3& p) { return (p - Vec3(0, 0, 30)).norm() - 25.0; });
    const double wall = 1.5 * Pi * 25 * 60;
    CHECK(std::abs(Area(both.Surfaces[0], 200) - wall) < 1e-3 * wall, "cylinder");
    const double zone = 1.5 * Pi * 25 * 25 * std::sin(1.2);
    CHECK(std::abs(Area(both.Surfaces[1], 200) - zone) < 1e-3 * zone, "sphere");
  }
}

/// The area in (u, v) that a closed uniform cubic with control points on an ellipse encloses.
double EnclosedArea(const Vec2& centre, const Vec2& axes)
{
  auto control = [&](int i)
  { return Vec2(centre + Vec2(axes.x() * std::cos(Pi * i / 6), axes.y() * std::sin(Pi * i / 6))); };
  auto point = [&](int i, double t)
  {
    const double s = 1.0 - t;
    return Vec2((s * s * s * control(i) + (3 * t * t * t - 6 * t * t + 4) * control(i + 1) +
                  (3 * s * s * s - 6 * s * s + 4) * control(i + 2) + t * t * t * control(i + 3)) /
      6.0);
  };
  double area = 0.0;
  for (int k = 0; k < 12 * 200; ++k)
  {
    const Vec2 a = point(k / 200, (k % 200) / 200.0);
    const Vec2 b = point(k / 200, (k % 200 + 1) / 200.0);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

void TestGoToolsTrimmed()
{
  NurbsSurface wave;
  wave.DegreeU = wave.DegreeV = 3;
  wave.CountU = 6;
  wave.CountV = 5;
  wave.KnotsU = { 0, 0, 0, 0, 1, 2, 3, 3, 3, 3 };
  wave.KnotsV = { 0, 0, 0, 0, 1, 2, 2, 2, 2 };
  for (int j = 0; j < 5; ++j)
  {
    for (int i = 0; i < 6; ++i)
    {
      wave.ControlPoints.emplace_back(
        20.0 * i, 25.0 * j, 6 * std::sin(1.2 * i) * std::cos(0.9 * j), 1.0);
    }
  }
  const ReadResult result = ReadFaces(TestFile("gotools-trimmed.igs"), 1);
  for (const NurbsSurface& read : result.Surfaces)
  {
    CHECK(read.TrimLoops.size() == 2, read.TrimLoops.size() << " loops");
    // Its edges in space are rounder than those in the parameters.
    CHECK(std::abs(read.Tolerance - 8.2e-4) < 1e-5, "a tolerance of " << read.Tolerance);
    double off = 0.0;
    double inside = 0.0;
    const int n = 400;
    const double du = (read.LastU() - read.FirstU()) / n;
    const double dv = (read.LastV() - read.FirstV()) / n;
    for (int k = 0; k < n * n; ++k)
    {
      const double u = read.FirstU() + (k % n + 0.5) * du;
      const double v = read.FirstV() + (k / n + 0.5) * dv;
      inside += IsInside(read, u, v) ? du * dv : 0.0;
      if (k % 17 == 0)
      {
        off = std::max(off, (nurbs::Evaluate(read, u, v) - nurbs::Evaluate(wave, u, v)).norm());
      }
    }
    // The file has about twelve digits.
    CHECK(off < 1e-9 * 100, "the wave is off by " << off);
    const double expected =
      EnclosedArea(Vec2(1.5, 1.0), Vec2(1.2, 0.8)) - EnclosedArea(Vec2(1.3, 0.9), Vec2(0.4, 0.3));
    CHECK(std::abs(inside - expected) < 2e-3 * expected, inside << ", not " << expected);
  }
  for (const NurbsSurface& read : ReadFaces(TestFile("gotools-trimmed.igs"), 1, 2).Surfaces)
  {
    CHECK(std::abs(read.Tolerance - 8.2e-7) < 1e-8, "in metres " << read.Tolerance);
  }
}

/// A STEP file with one B-spline surface and no topology, in metres.
std::string StepSurface()
{
  std::ostringstream text;
  text << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('by hand'),'2;1');\n"
          "FILE_NAME('x','2026-11-21T05:00:00',(''),(''),'','','');\n"
          "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
          "#1=APPLICATION_CONTEXT('automotive design');\n"
          "#2=PRODUCT_CONTEXT('',#1,'mechanical');\n#3=PRODUCT('Panel','Panel','',(#2));\n"
          "#4=PRODUCT_DEFINITION_FORMATION('','',#3);\n"
          "#5=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n"
          "#6=PRODUCT_DEFINITION('','',#4,#5);\n#7=PRODUCT_DEFINITION_SHAPE('','',#6);\n"
          "#8=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.));\n"
          "#9=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
          "#10=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n"
          "#11=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#8,'','');\n"
          "#12=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#11))"
          "GLOBAL_UNIT_ASSIGNED_CONTEXT((#8,#9,#10))REPRESENTATION_CONTEXT('',''));\n"
          "#13=SHAPE_DEFINITION_REPRESENTATION(#7,#14);\n"
          "#14=GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',(#15),#12);\n"
          "#15=GEOMETRIC_SET('set',(#16));\n"
          "#16=B_SPLINE_SURFACE_WITH_KNOTS('Bend',2,1,((#20,#21),(#22,#23),(#24,#25)),"
          ".UNSPECIFIED.,.F.,.F.,.U.,(3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);\n";
  for (int i = 0; i < 6; ++i)
  {
    text << "#" << 20 + i << "=CARTESIAN_POINT('',(" << 0.1 * (i / 2) << "," << 0.2 * (i % 2) << ","
         << (i / 2 == 1 ? "0.1" : "0.") << "));\n";
  }
  text << "ENDSEC;\nEND-ISO-10303-21;\n";
  return text.str();
}

/// Distance from a quarter of a ring without a hole, positive outside; near its faces only.
double ElbowDistance(const Vec3& p)
{
  const double ring = std::hypot(p.x(), std::hypot(p.y(), p.z()) - 1.0) - 1.0;
  return std::max({ ring, -p.y(), -p.z() });
}

/// Its wire passes the one point that is the ring's hole: of the two parts of the ring between the
/// ends OpenCASCADE takes the other one, three quarters.
void TestStepElbow(const std::string& path)
{
  const ReadResult result = ReadFaces(path, 3);
  double area = 0.0;
  for (const NurbsSurface& surface : result.Surfaces)
  {
    area += Area(surface);
    if (surface.TrimLoops.empty())
    {
      CheckDistance("elbow", surface, ElbowDistance);
    }
  }
  const double expected = Pi * Pi + 2.0 * Pi;
  CHECK(std::abs(area - expected) < 2e-3 * expected, "area " << area << ", not " << expected);
}

/// A part with its shape alone, as some programs write it: no product has it.
void TestStepWithoutProduct()
{
  const std::string text = ReadText(TestFile("elbow.step"));
  const std::size_t first = text.find("#90="), end = text.rfind("ENDSEC;");
  CHECK(first < end && text.find("PRODUCT") > first, "elbow.step does not end with its product");
  const std::string path = OutputPath("no-product.step");
  WriteText(path, text.substr(0, first) + text.substr(end));
  TestStepElbow(path);
}

void TestStepWithoutTopology()
{
  const std::string path = OutputPath("bend.step");
  WriteText(path, StepSurface());
  const ReadResult result = ReadFaces(path, 1);
  for (const NurbsSurface& surface : result.Surfaces)
  {
    const Vec3 middle = nurbs::Evaluate(surface, 0.5, 0.5);
    CHECK((middle - Vec3(100, 100, 50)).norm() < 1e-9, "middle at " << middle.transpose());
    CHECK(result.Names[0] == "Bend", "named " << result.Names[0]);
  }
}

/// The example's files: faces, names, and normals that point to what is cut away.
void TestExample()
{
  struct Part
  {
    const char* File;
    size_t Faces;
    const char* FirstName;
    Vec3 Place; ///< on the side that goes
  };
  for (const Part& part : { Part{ "SidePanelOuter.igs", 1, "OuterContour", Vec3(10, 1000, 0) },
         Part{ "FrontDoor.igs", 1, "FrontDoorOpening", Vec3(450, 400, 0) },
         Part{ "RearDoor.igs", 12, "RearDoorSide1", Vec3(900, 500, 0) },
         Part{ "WheelArch.igs", 1, "WheelArch", Vec3(1250, 250, 0) } })
  {
    const ReadResult result = ReadFaces(std::string(EXAMPLE_DATA) + "/" + part.File, part.Faces);
    CHECK(!result.Names.empty() && result.Names[0] == part.FirstName, part.File);
    // The closest of many points is enough to tell the side.
    double closest = 1e300;
    double side = 0.0;
    for (const NurbsSurface& surface : result.Surfaces)
    {
      for (int k = 0; k <= 4000; ++k)
      {
        const double u = surface.FirstU() + (surface.LastU() - surface.FirstU()) * k / 4000.0;
        const double v = 0.5 * (surface.FirstV() + surface.LastV());
        const Vec3 arm = part.Place - nurbs::Evaluate(surface, u, v);
        if (arm.norm() < closest)
        {
          closest = arm.norm();
          side = arm.dot(UnitNormal(surface, u, v));
        }
      }
    }
    CHECK(side > 0.9 * closest, part.File << ": the normal points to the side that stays");
  }
}
}

int main()
{
  TestSolveSpace();
  TestGoToolsAnalytic();
  TestGoToolsTrimmed();
  TestStepWithoutTopology();
  TestStepElbow(TestFile("elbow.step"));
  TestStepWithoutProduct();
  TestExample();
  return Failures != 0;
}
