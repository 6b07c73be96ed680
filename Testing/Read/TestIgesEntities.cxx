/**
 * Each kind of IGES surface, written by hand and so unlike any program writes it: the faces read
 * are compared with the definition in the file.
 */
#include "IgesText.h"
#include "ReadTesting.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>

using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec3;
using nurbs::Vec4;

namespace
{
const double Pi = 3.14159265358979323846;

/// A wavy net with the given knots; weights between 0.4 and 2 if rational.
NurbsSurface WavySurface(int degreeU, int degreeV, const std::vector<double>& knotsU,
  const std::vector<double>& knotsV, bool rational)
{
  NurbsSurface surface;
  surface.DegreeU = degreeU;
  surface.DegreeV = degreeV;
  surface.KnotsU = knotsU;
  surface.KnotsV = knotsV;
  surface.CountU = static_cast<int>(knotsU.size()) - degreeU - 1;
  surface.CountV = static_cast<int>(knotsV.size()) - degreeV - 1;
  for (int j = 0; j < surface.CountV; ++j)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      const double weight = rational ? 0.4 + 1.6 * std::abs(std::sin(2.0 * i + 3.0 * j)) : 1.0;
      surface.ControlPoints.emplace_back(
        10.0 * i, 8.0 * j, 3.0 * std::sin(1.1 * i) + 2.0 * std::cos(0.7 * j), weight);
    }
  }
  return surface;
}

/// Calls with places spread over a surface, inside its trim loops.
void ForPlaces(const NurbsSurface& surface, const std::function<void(double, double)>& check)
{
  for (int i = 0; i <= 12; ++i)
  {
    for (int j = 0; j <= 12; ++j)
    {
      const double u = surface.FirstU() + (surface.LastU() - surface.FirstU()) * i / 12.0;
      const double v = surface.FirstV() + (surface.LastV() - surface.FirstV()) * j / 12.0;
      if (IsInside(surface, u, v))
      {
        check(u, v);
      }
    }
  }
}

/// Largest |f| over a surface, f of its points.
double Largest(const NurbsSurface& surface, const std::function<double(const Vec3&)>& f)
{
  double largest = 0.0;
  ForPlaces(surface,
    [&](double u, double v)
    { largest = std::max(largest, std::abs(f(nurbs::Evaluate(surface, u, v)))); });
  return largest;
}

NurbsSurface ReadOne(const IgesText& iges, const std::string& name, int unit = 0)
{
  const std::string path = OutputPath(name + ".igs");
  iges.Write(path);
  const ReadResult result = ReadFaces(path, 1, unit);
  return result.Surfaces.empty() ? WavySurface(1, 1, { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, false)
                                 : result.Surfaces[0];
}

/// A surface of type 128 comes back with the same point at the same parameters.
void TestSpline(const std::string& name, const NurbsSurface& given, int unitFlag,
  const std::string& unitName, double millimetres)
{
  IgesText iges(unitFlag, unitName);
  iges.Add(128, SurfaceParameters(given));
  const NurbsSurface read = ReadOne(iges, name);
  double off = std::abs(read.FirstU() - given.FirstU()) + std::abs(read.LastU() - given.LastU()) +
    std::abs(read.FirstV() - given.FirstV()) + std::abs(read.LastV() - given.LastV());
  ForPlaces(given,
    [&](double u, double v)
    {
      const Vec3 difference =
        nurbs::Evaluate(read, u, v) - millimetres * nurbs::Evaluate(given, u, v);
      off = std::max(off, difference.norm() / (50.0 * millimetres));
    });
  CHECK(off < 1e-12, name << " differs by " << off);
  CHECK(read.TrimLoops.empty(), name);
}

void TestSplines()
{
  const std::vector<double> clamped{ 0, 0, 0, 0, 0.3, 0.5, 1, 1, 1, 1 };
  const std::vector<double> loose{ -2, -1.5, -1, 0, 1, 1.25, 2.5, 3, 4 };
  const std::vector<double> kinked{ 0, 0, 0, 1, 1, 2, 2, 2 };
  TestSpline("spline", WavySurface(3, 2, clamped, kinked, false), 2, "MM", 1.0);
  TestSpline("rational", WavySurface(3, 3, clamped, clamped, true), 2, "MM", 1.0);
  TestSpline("unclamped", WavySurface(3, 2, loose, kinked, true), 2, "MM", 1.0);
  TestSpline("unclamped-both", WavySurface(2, 3, loose, loose, false), 2, "MM", 1.0);
  TestSpline("inch", WavySurface(3, 2, clamped, kinked, true), 1, "INCH", 25.4);
  TestSpline("foot", WavySurface(2, 2, kinked, kinked, false), 4, "FT", 304.8);
  TestSpline("metre", WavySurface(1, 1, { 0, 0, 1, 1 }, { 0, 0, 5, 5 }, false), 6, "M", 1000.0);
  TestSpline("micron", WavySurface(3, 2, clamped, kinked, false), 9, "UM", 1e-3);
}

/// The parameters of type 128 with another range at their end.
std::string WithRange(std::string parameters, const std::vector<double>& range)
{
  for (int i = 0; i < 4; ++i)
  {
    parameters.erase(parameters.rfind(','));
  }
  return parameters + "," + Join(range);
}

/// The parameter range at the end of type 128 may be less than the knots'.
void TestPartOfSpline()
{
  const NurbsSurface given =
    WavySurface(3, 2, { 0, 0, 0, 0, 0.3, 0.5, 1, 1, 1, 1 }, { 0, 0, 0, 1, 1, 2, 2, 2 }, true);
  IgesText iges;
  iges.Add(128, WithRange(SurfaceParameters(given), { 0.2, 0.7, 0.5, 1.75 }));
  const NurbsSurface read = ReadOne(iges, "part");
  CHECK(std::abs(read.FirstU() - 0.2) + std::abs(read.LastU() - 0.7) < 1e-12, "range of u");
  CHECK(std::abs(read.FirstV() - 0.5) + std::abs(read.LastV() - 1.75) < 1e-12, "range of v");
  double off = 0.0;
  ForPlaces(read,
    [&](double u, double v)
    { off = std::max(off, (nurbs::Evaluate(read, u, v) - nurbs::Evaluate(given, u, v)).norm()); });
  CHECK(off < 1e-12 * 50, "part of a spline differs by " << off);
}

/// Six planes round a box; of the first the file takes a part.
void AddBox(
  IgesText& iges, const Vec3& low, const Vec3& size, const std::vector<double>& firstRange)
{
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
    NurbsSurface plane = WavySurface(1, 1, { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, false);
    for (int i = 0; i < 4; ++i)
    {
      Vec3 corner = low;
      corner[axis] += face % 2 * size[axis];
      corner[next] += i % 2 * size[next];
      corner[last] += i / 2 * size[last];
      plane.ControlPoints[i] << corner, 1.0;
    }
    const std::string parameters = SurfaceParameters(plane);
    iges.Add(128, face == 0 ? WithRange(parameters, firstRange) : parameters);
  }
}

/// Bodies of untrimmed splines are joined where they touch, but for one that has a face of which
/// the file takes a part: it is open.
void TestBoxesOfSplines()
{
  for (const bool isPart : { false, true })
  {
    IgesText iges;
    AddBox(iges, Vec3(0, 0, 0), Vec3(10, 10, 4), { 0, 1, 0, 1 });
    AddBox(iges, Vec3(10, 2, 0), Vec3(5, 6, 3), { 0, 1, 0, isPart ? 0.5 : 1 });
    const std::string path = OutputPath("boxes.igs");
    iges.Write(path);
    const ReadResult read = ReadFile(path);
    CHECK(read.Errors.empty() && read.Warnings.empty(), "boxes of splines");
    const size_t faces = isPart ? 12 : 11;
    CHECK(read.Surfaces.size() == faces, "boxes of splines: " << read.Surfaces.size());
  }
}

/// Type 114: two cubic patches, z a polynomial of x and y.
void TestParametricSpline()
{
  auto height = [](double x, double y) { return 1.0 + 0.5 * x * x - 0.2 * x * x * x * y + y * y; };
  std::vector<double> values;
  std::string parameters = "3,1,2,1,";
  parameters += Join({ 0, 1, 3, 0, 1.5 });
  for (double start : { 0.0, 1.0 })
  {
    // Coefficients of s^i t^j, s from the patch's start; i running fastest.
    double x[16] = { start, 1 };
    double y[16] = { 0, 0, 0, 0, 1 };
    double z[16] = { 1 + 0.5 * start * start, start, 0.5, 0, -0.2 * start * start * start,
      -0.6 * start * start, -0.6 * start, -0.2, 1 };
    for (const double* c : { x, y, z })
    {
      parameters += "," + Join(std::vector<double>(c, c + 16));
    }
    // The patch beyond the last in v, as the format wants it.
    parameters += "," + Join(std::vector<double>(48, 0.0));
  }
  parameters += "," + Join(std::vector<double>(96, 0.0));
  IgesText iges;
  iges.Add(114, parameters);
  const NurbsSurface read = ReadOne(iges, "parametric-spline");
  const double off = Largest(read, [&](const Vec3& p) { return p.z() - height(p.x(), p.y()); });
  CHECK(off < 1e-10, "type 114 is off by " << off);
  CHECK(Largest(read, [](const Vec3& p) { return p.x(); }) > 2.999, "type 114 is cut short");
}

/// Type 118: between a small arc and a large one above it, a piece of a cone.
void TestRuled()
{
  IgesText iges;
  const int low = iges.AddOwned(100, "0.,0.,0.,10.,0.,0.,10.");
  const int high = iges.AddOwned(100, "5.,0.,0.,20.,0.,0.,20.");
  IgesText::Entry form;
  form.Form = 1;
  iges.Add(118, std::to_string(low) + "," + std::to_string(high) + ",0,0", form);
  const NurbsSurface read = ReadOne(iges, "ruled");
  const double off =
    Largest(read, [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 10.0 - 2.0 * p.z(); });
  CHECK(off < 1e-10 * 50, "type 118 is off by " << off);
  const double area = 0.25 * Pi * (10 + 20) * std::hypot(10, 5);
  CHECK(std::abs(Area(read) - area) < 1e-4 * area, "type 118 has area " << Area(read));
}

/// Type 120: a line turned by 100 degrees from 30 degrees on.
void TestRevolution()
{
  IgesText iges;
  const int axis = iges.AddOwned(110, "0.,0.,0.,0.,0.,1.");
  const int line = iges.AddOwned(110, "10.,0.,0.,16.,0.,9.");
  iges.Add(120,
    std::to_string(axis) + "," + std::to_string(line) + "," + Join({ Pi / 6, Pi / 6 + Pi / 1.8 }));
  const NurbsSurface read = ReadOne(iges, "revolution");
  const double off = Largest(
    read, [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 10.0 - p.z() * 6.0 / 9.0; });
  CHECK(off < 1e-10 * 50, "type 120 is off by " << off);
  double first = 10.0;
  double last = -10.0;
  ForPlaces(read,
    [&](double u, double v)
    {
      const Vec3 p = nurbs::Evaluate(read, u, v);
      first = std::min(first, std::atan2(p.y(), p.x()));
      last = std::max(last, std::atan2(p.y(), p.x()));
    });
  CHECK(std::abs(first - Pi / 6) < 1e-9 && std::abs(last - Pi / 6 - Pi / 1.8) < 1e-9,
    "type 120 turns from " << first << " to " << last);
}

/// Type 122: an arc swept sideways; its normal is T x L.
void TestTabulatedCylinder()
{
  IgesText iges;
  const int arc = iges.AddOwned(100, "2.,1.,1.,11.,1.,1.,11.");
  iges.Add(122, std::to_string(arc) + ",14.,5.,22.");
  const NurbsSurface read = ReadOne(iges, "tabulated");
  const double off = Largest(read,
    [](const Vec3& p)
    {
      const double v = (p.z() - 2.0) / 20.0;
      return std::hypot(p.x() - 1.0 - 3.0 * v, p.y() - 1.0 - 4.0 * v) - 10.0;
    });
  CHECK(off < 1e-10 * 50, "type 122 is off by " << off);
  const Vec3 normal = UnitNormal(read, 0.5 * (read.FirstU() + read.LastU()), read.FirstV());
  const Vec3 expected = Vec3(-1, 1, 0).cross(Vec3(3, 4, 20)).normalized();
  CHECK((normal - expected).norm() < 1e-9, "type 122: normal " << normal.transpose());
}

/// A square plane with a round hole or a triangle cut out of it, by pairs of curves.
int AddSquare(IgesText& iges, const std::vector<double>& range = { 0, 1, 0, 1 })
{
  NurbsSurface square = WavySurface(1, 1, { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, false);
  for (int i = 0; i < 4; ++i)
  {
    square.ControlPoints[i] = Vec4(20.0 * (i % 2), 20.0 * (i / 2), 3.0, 1.0);
  }
  return iges.AddOwned(128, WithRange(SurfaceParameters(square), range));
}

/// The lines of a closed polygon, as one composite curve.
int AddPolygon(IgesText& iges, const std::vector<Vec2>& corners, double scale, double z)
{
  std::string parts = std::to_string(corners.size());
  for (size_t i = 0; i < corners.size(); ++i)
  {
    const Vec2 a = scale * corners[i];
    const Vec2 b = scale * corners[(i + 1) % corners.size()];
    parts += "," + std::to_string(iges.AddOwned(110, Join({ a.x(), a.y(), z, b.x(), b.y(), z })));
  }
  return iges.AddOwned(102, parts);
}

/// Type 144: an outer triangle and a round hole in it, trimmed by 142.
void TestTrimmed()
{
  const std::vector<Vec2> triangle{ Vec2(0.1, 0.1), Vec2(0.9, 0.1), Vec2(0.1, 0.9) };
  IgesText iges;
  const int base = AddSquare(iges);
  const int flat = AddPolygon(iges, triangle, 1.0, 0.0);
  const int model = AddPolygon(iges, triangle, 20.0, 3.0);
  auto boundary = [&](int b, int c)
  {
    return iges.AddOwned(
      142, "1," + std::to_string(base) + "," + std::to_string(b) + "," + std::to_string(c) + ",1");
  };
  const int outer = boundary(flat, model);
  const int hole = boundary(
    iges.AddOwned(100, "0.,0.3,0.3,0.4,0.3,0.4,0.3"), iges.AddOwned(100, "3.,6.,6.,8.,6.,8.,6."));
  IgesText::Entry named;
  named.Label = "TRIANGLE";
  named.Subscript = 7;
  iges.Add(144, std::to_string(base) + ",1,1," + std::to_string(outer) + "," + std::to_string(hole),
    named);
  const NurbsSurface read = ReadOne(iges, "trimmed");
  CHECK(read.TrimLoops.size() == 2, read.TrimLoops.size() << " loops");
  const double area = 0.5 * 16 * 16 - 4 * Pi;
  CHECK(std::abs(Area(read, 300) - area) < 5e-3 * area, "type 144 has area " << Area(read, 300));
  CHECK(std::abs(UnitNormal(read, read.FirstU(), read.FirstV()).z() - 1.0) < 1e-12, "normal");
}

/// An outer contour that bulges beyond the surface's range is not cut off there.
void TestTrimmedBeyondRange()
{
  IgesText iges;
  const int base = AddSquare(iges, { 0.1, 0.9, 0.1, 0.9 });
  const int flat = iges.AddOwned(100, "0.,0.5,0.5,0.95,0.5,0.95,0.5");
  const int model = iges.AddOwned(100, "3.,10.,10.,19.,10.,19.,10.");
  const int outer = iges.AddOwned(142,
    "1," + std::to_string(base) + "," + std::to_string(flat) + "," + std::to_string(model) + ",1");
  iges.Add(144, std::to_string(base) + ",1,0," + std::to_string(outer));
  const NurbsSurface read = ReadOne(iges, "trimmed-beyond-range");
  const double area = 81 * Pi;
  CHECK(std::abs(Area(read, 300) - area) < 5e-3 * area, "the disc has area " << Area(read, 300));
}

/// Type 143, bounded by curves of type 141 that are given in space only.
void TestBounded()
{
  IgesText iges;
  const int base = AddSquare(iges);
  const int square = AddPolygon(
    iges, { Vec2(2, 2), Vec2(12, 2), Vec2(12, 7), Vec2(7, 7), Vec2(7, 12), Vec2(2, 12) }, 1.0, 3.0);
  const int boundary =
    iges.AddOwned(141, "0,1," + std::to_string(base) + ",1," + std::to_string(square) + ",1,0");
  iges.Add(143, "0," + std::to_string(base) + ",1," + std::to_string(boundary));
  const NurbsSurface read = ReadOne(iges, "bounded");
  CHECK(read.TrimLoops.size() == 1 && read.TrimLoops[0].size() == 6, "the L has six corners");
  CHECK(std::abs(Area(read, 300) - 75.0) < 0.5, "type 143 has area " << Area(read, 300));
}

/// Type 108, a plane bounded by a circle, moved by a matrix of type 124.
void TestPlane()
{
  IgesText iges;
  const int matrix = iges.AddOwned(124, "1.,0.,0.,100.,0.,0.,-1.,0.,0.,1.,0.,7.");
  IgesText::Entry owned;
  owned.Subordinate = 1;
  const int circle = iges.Add(100, "0.,0.,0.,5.,0.,5.,0.", owned);
  IgesText::Entry entry;
  entry.Form = 1;
  entry.Transform = matrix;
  iges.Add(108, "0.,0.,1.,0.," + std::to_string(circle) + ",0.,0.,0.,0.", entry);
  const NurbsSurface read = ReadOne(iges, "plane");
  CHECK(std::abs(Area(read, 300) - 25 * Pi) < 0.4, "type 108 has area " << Area(read, 300));
  const double off = Largest(read, [](const Vec3& p) { return p.y(); });
  CHECK(off < 1e-10, "type 108 is off its plane by " << off);
}

/// Type 140: a plane-like and a cylindrical surface, offset.
void TestOffset()
{
  IgesText iges;
  const int arc = iges.AddOwned(100, "0.,0.,0.,10.,0.,0.,10.");
  const int cylinder = iges.AddOwned(122, std::to_string(arc) + ",10.,0.,30.");
  iges.Add(140, "1.,0.,0.,2.5," + std::to_string(cylinder));
  const NurbsSurface read = ReadOne(iges, "offset");
  const double off = Largest(read, [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 12.5; });
  CHECK(off < 1e-9 * 50, "type 140 is off by " << off);
}

/// Names, in order: a property, a label with subscript, a label, none; and a group.
void TestNames()
{
  IgesText iges;
  const int line = iges.AddOwned(110, "0.,0.,0.,10.,0.,0.");
  auto sweep = [line](int y) { return std::to_string(line) + ",0.," + std::to_string(y) + ".,5."; };
  IgesText::Entry property;
  property.Form = 15;
  property.Subordinate = 1;
  const int name = iges.Add(406, "1,12HOuterContour", property);
  IgesText::Entry labelled;
  labelled.Label = "WHEEL";
  IgesText::Entry numbered = labelled;
  numbered.Subscript = 12;
  const int first = iges.Add(122, sweep(0) + ",0,1," + std::to_string(name));
  iges.Add(122, sweep(10), numbered);
  iges.Add(122, sweep(20), labelled);
  iges.Add(122, sweep(30));
  CHECK(first > 0, "");
  const std::string path = OutputPath("names.igs");
  iges.Write(path);
  const ReadResult result = ReadFaces(path, 4);
  const std::vector<std::string> expected{ "OuterContour", "WHEEL(12)", "WHEEL", "Face 4" };
  for (size_t i = 0; i < expected.size() && i < result.Names.size(); ++i)
  {
    CHECK(result.Names[i] == expected[i], "\"" << result.Names[i] << "\", not " << expected[i]);
  }
}

/// A start section that the last line counts wrongly is no loss.
void TestMiscounted()
{
  IgesText iges;
  const int line = iges.AddOwned(110, "0.,0.,0.,10.,0.,0.");
  iges.Add(122, std::to_string(line) + ",0.,0.,5.");
  std::string text = iges.Text();
  text.replace(text.rfind("S      1G"), 8, "S      4");
  const std::string path = OutputPath("miscounted.igs");
  WriteText(path, text);
  ReadFaces(path, 1);
}

/// Faces that hang together in a group are read once each.
void TestGroup()
{
  IgesText iges;
  const int line = iges.AddOwned(110, "0.,0.,0.,10.,0.,0.");
  IgesText::Entry member;
  member.Subordinate = 2;
  const int a = iges.Add(122, std::to_string(line) + ",0.,0.,5.", member);
  const int b = iges.Add(122, std::to_string(line) + ",0.,5.,0.", member);
  IgesText::Entry group;
  group.Form = 7;
  iges.Add(402, "2," + std::to_string(a) + "," + std::to_string(b), group);
  const std::string path = OutputPath("group.igs");
  iges.Write(path);
  ReadFaces(path, 2);
}
}

/// A scale of the model is nowhere applied, and that is said.
void TestScale()
{
  const std::string path = OutputPath("scale.igs");
  IgesText iges(2, "MM", "0.5");
  iges.Add(128, SurfaceParameters(WavySurface(1, 1, { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, false)));
  iges.Write(path);
  const ReadResult read = ReadFile(path);
  CHECK(read.Errors.empty() && !read.Surfaces.empty(), "a file with a scale");
  CHECK(read.Warnings.size() == 1 && read.Warnings[0].find("a scale of 0.5") != std::string::npos,
    "a scale that nothing is said of");
}

int main()
{
  TestSplines();
  TestPartOfSpline();
  TestBoxesOfSplines();
  TestParametricSpline();
  TestRuled();
  TestRevolution();
  TestTabulatedCylinder();
  TestTrimmed();
  TestTrimmedBeyondRange();
  TestBounded();
  TestPlane();
  TestOffset();
  TestNames();
  TestGroup();
  TestMiscounted();
  TestScale();
  return Failures != 0;
}
