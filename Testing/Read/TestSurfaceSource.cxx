/**
 * vtkNURBSSurfaceSource: its default, a surface given as properties, and bad input, each piece
 * of which is one error with an empty output.
 */
#include "NURBSFieldData.h"
#include "ReadTesting.h"
#include "Shortage.h"
#include "vtkNURBSSurfaceSource.h"

#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>

using nurbs::NurbsSurface;
using nurbs::Vec3;

namespace
{
NurbsSurface SurfaceOf(vtkNURBSSurfaceSource* source)
{
  NurbsSurface surface;
  std::string error;
  source->Update();
  CHECK(nurbs::ReadNURBSFieldData(source->GetOutput()->GetFieldData(), surface, error), error);
  return surface;
}

void TestDefault()
{
  vtkNew<vtkNURBSSurfaceSource> source;
  const NurbsSurface surface = SurfaceOf(source);
  double bounds[6];
  source->GetOutput()->GetBounds(bounds);
  const double expected[6] = { -0.2, 0.2, -1, 1, -0.5, 0.5 };
  for (int i = 2; i < 6; ++i)
  {
    CHECK(std::abs(bounds[i] - expected[i]) < 1e-12, "bound " << i << " is " << bounds[i]);
  }
  CHECK(bounds[0] > -0.25 && bounds[1] < 0.25 && bounds[1] - bounds[0] > 0.2, "it waves");
  CHECK(source->GetOutput()->GetNumberOfPolys() >= 32 * 32, "resolution");
  for (double u : { 0.0, 1.1, 2.0, 3.9 })
  {
    CHECK(UnitNormal(surface, u, 0.3).x() > 0.7, "the normal points to positive x");
  }
}

/// A biquadratic patch of a sphere, by hand.
void Fill(vtkNURBSSurfaceSource* source)
{
  const double w = std::sqrt(0.5);
  const double points[9][4] = { { 1, 0, 0, 1 }, { 1, 1, 0, w }, { 0, 1, 0, 1 }, { 1, 0, 1, w },
    { 1, 1, 1, w * w }, { 0, 1, 1, w }, { 0, 0, 1, 1 }, { 0, 0, 1, w }, { 0, 0, 1, 1 } };
  source->SetDegrees(2, 2);
  source->SetControlNetSize(3, 3);
  source->SetNumberOfControlPoints(9);
  source->SetNumberOfKnotsU(6);
  source->SetNumberOfKnotsV(6);
  for (int i = 0; i < 9; ++i)
  {
    source->SetControlPoint(i, points[i][0], points[i][1], points[i][2], points[i][3]);
  }
  for (int i = 0; i < 6; ++i)
  {
    source->SetKnotU(i, i / 3);
    source->SetKnotV(i, i / 3);
  }
}

void TestSphere()
{
  vtkNew<vtkNURBSSurfaceSource> source;
  Fill(source);
  const NurbsSurface surface = SurfaceOf(source);
  for (double u : { 0.0, 0.2, 0.5, 1.0 })
  {
    for (double v : { 0.0, 0.3, 0.7 })
    {
      const Vec3 p = nurbs::Evaluate(surface, u, v);
      CHECK(std::abs(p.norm() - 1.0) < 1e-14, "radius " << p.norm());
      CHECK((UnitNormal(surface, u, v) - p).norm() < 1e-12, "normal");
    }
  }
  for (vtkIdType i = 0; i < source->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const double radius = Vec3(source->GetOutput()->GetPoint(i)).norm();
    CHECK(std::abs(radius - 1.0) < 1e-14, "a drawn point at radius " << radius);
  }
  const vtkIdType before = source->GetOutput()->GetNumberOfPolys();
  source->SetResolution(64);
  source->Update();
  CHECK(source->GetOutput()->GetNumberOfPolys() == 4 * before, "resolution");
}

/// Nothing runs again when nothing has changed.
void TestModified()
{
  vtkNew<vtkNURBSSurfaceSource> source;
  Fill(source);
  const vtkMTimeType before = source->GetMTime();
  Fill(source);
  CHECK(source->GetMTime() == before, "the same values modify the source");
  source->SetKnotU(3, 0.5);
  CHECK(source->GetMTime() > before, "a new knot does not");
}

void CheckError(const std::string& part, const std::function<void(vtkNURBSSurfaceSource*)>& spoil)
{
  vtkNew<vtkNURBSSurfaceSource> source;
  Fill(source);
  CheckRefusal(source, part, [&] { spoil(source); });
}

void TestBadInput()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Source = vtkNURBSSurfaceSource;
  CheckError("degree", [](Source* s) { s->SetDegrees(0, 2); });
  CheckError("degree", [](Source* s) { s->SetDegrees(2, 26); });
  CheckError("knot", [](Source* s) { s->SetDegrees(1, 2); });
  CheckError("control point", [](Source* s) { s->SetControlNetSize(2, 3); });
  CheckError("control point", [](Source* s) { s->SetControlNetSize(4, 3); });
  CheckError("control point", [](Source* s) { s->SetControlNetSize(-3, 3); });
  CheckError("control point", [](Source* s) { s->SetControlNetSize(2147483647, 2147483647); });
  CheckError("3 x 3 = 9", [](Source* s) { s->SetNumberOfControlPoints(8); });
  CheckError("knot", [](Source* s) { s->SetNumberOfKnotsU(5); });
  CheckError("knot", [](Source* s) { s->SetNumberOfKnotsV(7); });
  CheckError("knot", [](Source* s) { s->SetNumberOfKnotsV(0); });
  CheckError("knot", [](Source* s) { s->SetKnotU(1, 2.0); });
  CheckError("knot", [nan](Source* s) { s->SetKnotV(5, nan); });
  CheckError("finite", [nan](Source* s) { s->SetControlPoint(4, 0, nan, 0, 1); });
  CheckError("weight", [](Source* s) { s->SetControlPoint(4, 0, 0, 0, 0); });
  CheckError("weight", [](Source* s) { s->SetControlPoint(4, 0, 0, 0, -1); });
  CheckError("domain",
    [](Source* s)
    {
      for (int i = 0; i < 6; ++i)
      {
        s->SetKnotU(i, 1.0);
      }
    });
}

/// Numbers that would take all memory: an error each, and the source stays as it was.
void TestAbsurdNumbers()
{
  vtkNew<vtkNURBSSurfaceSource> source;
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  const vtkMTimeType before = source->GetMTime();
  source->SetControlPoint(2147483647, 1, 2, 3, 1);
  source->SetKnotU(2147483647, 1);
  source->SetNumberOfControlPoints(2147483647);
  source->SetNumberOfKnotsV(2147483647);
  CHECK(capture->Errors.size() == 4, capture->Errors.size() << " errors");
  CHECK(source->GetMTime() == before, "an absurd number modifies the source");
}

// Whichever piece of memory is refused: one error, and nothing comes out.
void TestShortage()
{
  vtkNew<vtkNURBSSurfaceSource> source;
  source->SetResolution(30);
  const judge::Shortage shortage;
  constexpr std::size_t smallest = 2000;
  judge::Shortage::Plan({ -1, false, smallest });
  source->Update();
  const long pieces = judge::Shortage::Seen();
  CHECK(pieces > 2, pieces << " pieces of memory");
  for (long piece = 0; piece < pieces; ++piece)
  {
    vtkNew<ErrorCapture> messages;
    messages->Watch(source);
    source->Modified();
    judge::Shortage::Plan({ piece, true, smallest });
    source->Update();
    judge::Shortage::Plan({});
    const bool one = messages->Errors.size() == 1 &&
      messages->Errors[0].find("more memory than there is") != std::string::npos;
    CHECK(one, messages->Errors.size() << " errors without piece " << piece);
    CHECK(source->GetOutput()->GetNumberOfPoints() == 0, "something comes out");
  }
  source->Modified();
  source->Update();
  CHECK(source->GetOutput()->GetNumberOfPoints() > 0, "nothing comes out afterwards");
}
}

int main()
{
  TestShortage();
  TestDefault();
  TestSphere();
  TestModified();
  TestAbsurdNumbers();
  TestBadInput();
  return Failures != 0;
}
