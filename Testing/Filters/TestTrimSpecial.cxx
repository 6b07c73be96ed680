/**
 * @file TestTrimSpecial.cxx
 * @brief Surfaces that meet the mesh in special ways: exactly through nodes, edges and facets,
 * through an upright edge of the model, along a layer, touching only, or not at all; a keep point;
 * the whole elimination fraction; points without cells; a composite of one grid.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace judge;

namespace
{
void Both(const std::string& name, const Mesh& mesh, const Surface& surface)
{
  for (int correction = 1; correction <= 3; ++correction)
  {
    for (int optimization = 0; optimization <= (correction == 1 ? 0 : 2); ++optimization)
    {
      TrimOptions options;
      options.CorrectionType = correction;
      options.Optimization = optimization;
      Report report("special " + name + " " + mesh.Name + " " + std::to_string(correction) + " " +
        std::to_string(optimization));
      JudgeBothSides(mesh, surface, options, report);
      Wrong += report.Failures() > 0;
    }
  }
}

// Sheets run from 0 to nx, 0 to ny in elements of size 1.
void TestThroughNodes()
{
  for (const char* name : { "sheet1", "sheet2", "permuted" })
  {
    const Mesh mesh = MakeMesh(name);
    Both("through a row of facets", mesh, PlaneThrough(Vec3(10, 0, 0), Vec3::UnitX(), 200));
    Both("through diagonal edges", mesh, PlaneThrough(Vec3(10, 8, 0), Vec3(1, 1, 0), 200));
    Both("through one column of nodes", mesh, PlaneThrough(Vec3(10, 8, 0), Vec3(1, 0.3, 0), 200));
    Both("leaning through one node", mesh, PlaneThrough(Vec3(10, 8, 0), Vec3(1, 0.3, 0.4), 200));
    // Nodes at 5 and 4-3 from the centre lie on it exactly.
    Placement at;
    at.X = at.Y = 0;
    at.Angle = 0;
    at.Size = 5 / mesh.Box.HalfY;
    Both("cylinder through nodes", mesh, MakeSurface("cylinder", mesh.Box, at));
    Both("just beside the nodes", mesh, PlaneThrough(Vec3(10 + 1e-7, 0, 0), Vec3::UnitX(), 200));
  }
}

void TestAlongLayer()
{
  const Mesh sheet = MakeMesh("sheet2");
  const Mesh block = MakeMesh("block");
  Both("along the layers' common facets", sheet, PlaneThrough(Vec3(0, 0, 0), Vec3::UnitZ(), 200));
  Both("along a layer of a block", block, PlaneThrough(Vec3(0, 0, 0.7), Vec3::UnitZ(), 200));
  Both("along the nodes of a block", block, PlaneThrough(Vec3(5, 0, 0), Vec3::UnitX(), 200));
}

// All kept or all eliminated, no error; a warning where nothing is met.
void Whole(const std::string& name, const Mesh& mesh, const Surface& surface, bool warns)
{
  for (const bool invert : { false, true })
  {
    TrimOptions options;
    options.InvertSide = invert;
    const Outcome outcome = RunTrim(mesh, surface, options);
    Expect(outcome.Clean(), name + ": an error: " + (outcome.Clean() ? "" : outcome.Errors[0]));
    Expect(!warns || outcome.Warnings.size() == 1,
      name + ": " + std::to_string(outcome.Warnings.size()) + " warnings, not one");
    const bool stays = (surface.Signed(mesh.Box.Centre) < 0) != invert;
    const vtkIdType expected = stays ? mesh.Grid->GetNumberOfCells() : 0;
    Expect(outcome.Case.Trimmed->GetNumberOfCells() == expected,
      name + ": " + std::to_string(outcome.Case.Trimmed->GetNumberOfCells()) + " elements, not " +
        std::to_string(expected));
    Expect(outcome.Case.Whole->GetNumberOfCells() == mesh.Grid->GetNumberOfCells(),
      name + ": port 1 is not the whole grid");
    Report report("special " + name + (invert ? " inverted" : ""));
    if (outcome.Clean())
    {
      const Evidence evidence(outcome.Case, report);
      JudgeAll(evidence, report);
    }
    Wrong += report.Failures() > 0;
  }
}

void TestMisses()
{
  const Mesh mesh = MakeMesh("sheet2");
  Whole("far plane", mesh, PlaneThrough(Vec3(100, 0, 0), Vec3(1, 0.1, 0), 200), true);
  Whole("far small plane", mesh, PlaneThrough(Vec3(-50, 0, 0), Vec3(1, 0.1, 0), 200), true);
  Whole("plane along the border", mesh, PlaneThrough(Vec3(20, 0, 0), Vec3::UnitX(), 200), false);
  Whole("plane along the skin", mesh, PlaneThrough(Vec3(0, 0, 0.4), Vec3::UnitZ(), 200), false);
  Whole(
    "plane that touches a corner", mesh, PlaneThrough(Vec3(20, 16, 0), Vec3(1, 1, 0), 200), false);
  Placement at;
  at.X = 2;
  at.Y = 0;
  at.Angle = 0;
  at.Size = 10 / mesh.Box.HalfY;
  Whole("cylinder that touches the border", mesh, MakeSurface("cylinder", mesh.Box, at), false);
  // Round the whole sheet.
  at.X = 0;
  at.Size = 3;
  Whole("cylinder round the sheet", mesh, MakeSurface("cylinder", mesh.Box, at), true);
}

void TestSlot()
{
  // Crosses the sheet twice with about three and a half elements between, straight and slanted.
  for (const double angle : { 0.0, 0.4, 0.785 })
  {
    const Mesh mesh = MakeMesh("sheet2");
    Placement at;
    at.Angle = angle;
    Both("slot", mesh, MakeSurface("slot", mesh.Box, at));
  }
}

// A leaning cut takes away the side of a column on the border in one layer, not in the other.
void TestSideLostInOneLayer()
{
  const Mesh mesh = MakeMesh("sheet2");
  Placement at;
  at.X = -0.092;
  at.Y = -0.05;
  at.Angle = 1.893;
  at.Lean = 0.503;
  at.Size = 0.724;
  TrimOptions options;
  options.Optimization = 2;
  options.MinimumScaledJacobian = 0; // else the ladder finds a way round it
  Report report("special side lost in one layer");
  JudgeBothSides(mesh, MakeSurface("roundrect", mesh.Box, at), options, report);
  Wrong += report.Failures() > 0;
}

// The corner of a rounded rectangle draws a node from either side of it: they must not become one,
// though no element has both.
void TestNodesFromBothSides()
{
  const Mesh mesh = Sheet(8, 6, 1, Vec3(1, 1, 0.4));
  Placement at;
  at.X = 0.7912;
  at.Y = 0.5671;
  at.Angle = 1.399;
  at.Size = 0.2961;
  TrimOptions options;
  options.Optimization = 2;
  options.MinimumScaledJacobian = 0;
  Report report("special nodes from both sides");
  JudgeBothSides(mesh, MakeSurface("roundrect", mesh.Box, at), options, report);
  Wrong += report.Failures() > 0;
}

double FarthestLeft(vtkUnstructuredGrid* trimmed)
{
  double range[2] = { 0, 0 };
  trimmed->GetPointData()->GetArray("DistanceLeft")->GetRange(range);
  return range[1];
}

// A leaning cut through an upright edge of the model meets one side of the sheet below and the
// other above: what cannot come to it ends at the corner, and does not stay an element away.
void TestThroughUprightEdge()
{
  const Mesh mesh = MakeMesh("sheet2");
  for (const double lean : { 0.09, 0.26, -0.26, 0.52 })
  {
    for (const double angle : { 0.5, 0.79, 1.05 })
    {
      const Vec3 normal(
        -std::sin(angle) * std::cos(lean), std::cos(angle) * std::cos(lean), std::sin(lean));
      Report report("special through an upright edge");
      for (const bool invert : { false, true })
      {
        TrimOptions options;
        options.Optimization = 2;
        options.InvertSide = invert;
        const Outcome outcome =
          RunAndJudge(mesh, PlaneThrough(Vec3::Zero(), normal, 200), options, report);
        const double left = FarthestLeft(outcome.Case.Trimmed);
        if (!(left < 0.5 * mesh.Box.ElementSize))
        {
          report.Fail("at the corner", "farthest node", left, 0.5 * mesh.Box.ElementSize);
        }
      }
      Wrong += report.Failures() > 0;
    }
  }
}

// The two sides of a thin edge are no one face on which its nodes could slide away.
void TestThinEdge()
{
  const Mesh mesh = Segment(10, 20, 0.05);
  for (const double slope : { 0.3, 1.0 })
  {
    for (const double height : { 6.2, 6.5 })
    {
      Both("across a thin edge", mesh, PlaneThrough(Vec3(0, 0, height), Vec3(slope, 0.1, 1), 200));
    }
  }
}

// Beside the patch a column has a neighbour in the lower layers and none in the upper ones: a
// wedge in the ones alone would leave a gap to the others.
void TestPatch()
{
  const Mesh mesh = PatchedSheet(14, 10, 1);
  for (const double x : { 6.6, 7.0 })
  {
    for (const double turn : { 0.3, 1.0 })
    {
      Both("beside a patch", mesh, PlaneThrough(Vec3(x, 5.2, 0.4), Vec3(1, turn, 0.1), 200));
    }
  }
}

// A cylinder grazes the border near one of its knots, where a gap between faces of that width would
// count as closed. Nothing gapes at a knot: the nodes go to where the border meets the cylinder.
void TestCrossingAtKnot()
{
  const Mesh mesh = Sheet(10, 8, 1, Vec3(1, 1, 0.4));
  const double radius = 0.9 * mesh.Box.HalfY, graze = 0.2;
  for (const double beside : { -4e-4, 4e-4 })
  {
    const Vec2 knot(5.3, beside), out(std::sin(graze), -std::cos(graze));
    const Vec2 centre = knot - radius * out;
    Placement at;
    at.X = (centre[0] - mesh.Box.Centre[0]) / mesh.Box.HalfX;
    at.Y = (centre[1] - mesh.Box.Centre[1]) / mesh.Box.HalfY;
    at.Angle = std::atan2(out[1], out[0]);
    at.Size = 0.9;
    Both("crossing at a knot", mesh, MakeSurface("cylinder", mesh.Box, at));
  }
}

void TestKeepPoint()
{
  const Mesh mesh = MakeMesh("sheet2");
  const Surface cylinder = MakeSurface("cylinder", mesh.Box, Placement());
  const Surface sphere = MakeSurface("sphere", mesh.Box, Placement());
  // Above the sphere the nearest node lies within it.
  const std::pair<const Surface*, Vec3> points[] = { { &cylinder, Vec3(11.3, 7.4, 0) },
    { &cylinder, Vec3(0.1, 0.1, 0) }, { &sphere, mesh.Box.Centre },
    { &sphere, mesh.Box.Centre + 10 * mesh.Box.HalfX * Vec3::UnitZ() } };
  for (const auto& [surface, point] : points)
  {
    TrimOptions options;
    options.UseKeepPoint = true;
    options.KeepPoint = point;
    Report report("special keep point");
    const Outcome outcome = RunAndJudge(mesh, *surface, options, report);
    Wrong += report.Failures() > 0;
  }
  // On the surface: it says nothing, and the filter says so.
  const Surface plane = PlaneThrough(Vec3(7.2, 5, 0), Vec3::UnitX(), 100);
  for (const bool inverted : { false, true })
  {
    TrimOptions options;
    options.InvertSide = inverted;
    const Outcome expected = RunTrim(mesh, plane, options);
    options.UseKeepPoint = true;
    options.KeepPoint = Vec3(7.2, 3, 0.1);
    const Outcome outcome = RunTrim(mesh, plane, options);
    if (outcome.Warnings.size() != 1 ||
      outcome.Warnings[0].find("KeepPoint lies on the surface") == std::string::npos ||
      !FirstDifference(expected.Case.Trimmed, outcome.Case.Trimmed).empty())
    {
      std::printf("FAIL keep point on the surface\n");
      ++Wrong;
    }
  }
}

// Far from the surface the last crossing on the way there tells the side of a keep point, not the
// first: within a second sphere, above the one through the sheet, is where the first one's inside
// is.
// The side of a far keep point is that of the nearest node of an element, not of some point
// without.
void TestKeepPointBesideUnused()
{
  const Mesh mesh = Sheet(20, 16, 2, Vec3(1, 1, 0.4));
  const Surface plane = PlaneThrough(Vec3(10, 0, 0), Vec3(1, 0.3, 0), 40);
  TrimOptions options;
  options.UseKeepPoint = true;
  options.KeepPoint = Vec3(13, 8, 60);
  const Outcome without = RunTrim(mesh, plane, options);
  Mesh unused = mesh;
  unused.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  unused.Grid->DeepCopy(mesh.Grid);
  unused.Grid->GetPointData()->Initialize();
  unused.Grid->GetPoints()->InsertNextPoint(5, 8, 60);
  const Outcome with = RunTrim(unused, plane, options);
  Expect(without.Clean() && with.Clean() &&
      with.Case.Trimmed->GetNumberOfCells() == without.Case.Trimmed->GetNumberOfCells(),
    "a keep point beside a point without elements");
}

void TestKeepPointBehindSeveral()
{
  const Mesh mesh = MakeMesh("sheet2");
  const Surface sphere = MakeSurface("sphere", mesh.Box, Placement());
  const Vec3 shift = 20 * mesh.Box.HalfX * Vec3::UnitZ();
  vtkNew<vtkPolyData> above;
  above->DeepCopy(vtkPolyData::SafeDownCast(sphere.Data));
  vtkDataArray* const control = above->GetFieldData()->GetArray("NURBSControlPoints");
  for (vtkIdType i = 0; i < control->GetNumberOfTuples(); ++i)
  {
    control->SetComponent(i, 2, control->GetComponent(i, 2) + shift[2]);
  }
  above->SetPolys(nullptr);
  const Surface spheres = Together(sphere.Data, above);
  double box[6];
  vtkPolyData::SafeDownCast(sphere.Data)->GetBounds(box);
  const Vec3 middle(0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5]));
  TrimOptions options;
  options.UseKeepPoint = true;
  options.KeepPoint = middle;
  const Outcome within = RunTrim(mesh, spheres, options);
  options.KeepPoint = middle + shift;
  const Outcome withinSecond = RunTrim(mesh, spheres, options);
  options.KeepPoint = middle + 0.5 * shift;
  const Outcome between = RunTrim(mesh, spheres, options);
  const auto same = [](const Outcome& a, const Outcome& b)
  { return FirstDifference(a.Case.Trimmed, b.Case.Trimmed).empty(); };
  Expect(within.Clean() && same(within, withinSecond) && !same(within, between),
    "keep point behind several crossings");
}

// CAD programs write a body as a solid and its shells beside it: faces that are there more than
// once trim as one.
void TestRepeatedFaces()
{
  const Mesh mesh = MakeMesh("sheet2");
  for (const char* kind : { "plane", "roundrect" })
  {
    const Surface once = MakeSurface(kind, mesh.Box, Placement());
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (unsigned int i = 0; i < 3; ++i)
    {
      blocks->SetBlock(i, once.Data);
    }
    Surface often = once;
    often.Data = blocks;
    const Outcome a = RunTrim(mesh, once, TrimOptions()), b = RunTrim(mesh, often, TrimOptions());
    Expect(
      a.Clean() && b.Clean() && a.Warnings.size() == b.Warnings.size(), "repeated faces: messages");
    Expect(FirstDifference(a.Case.Trimmed, b.Case.Trimmed).empty(),
      std::string("repeated faces: ") + kind);
  }
}

/// Four walls round a rectangle, each so much shorter at either end; a tolerance that is told of.
Surface WallsApart(double gap, double tolerance)
{
  const Vec2 corners[] = { Vec2(3.3, 2.4), Vec2(9.6, 2.4), Vec2(9.6, 7.7), Vec2(3.3, 7.7) };
  vtkNew<vtkMultiBlockDataSet> walls;
  for (unsigned int i = 0; i < 4; ++i)
  {
    const Vec2 from = corners[i], to = corners[(i + 1) % 4], less = gap * (to - from).normalized();
    const vtkSmartPointer<vtkPolyData> wall = ToPolyData(Wall({ from + less, to - less }));
    vtkNew<vtkDoubleArray> told;
    told->SetName("NURBSTolerance");
    told->InsertNextValue(tolerance);
    wall->GetFieldData()->AddArray(told);
    walls->SetBlock(i, wall);
  }
  Surface surface;
  surface.Data = walls;
  return surface;
}

// CAD files may tell of faces that are joined more loosely than others ever are.
void TestToldGaps()
{
  const Mesh mesh = Sheet(14, 10, 1, Vec3(1, 1, 0.8));
  const double gap = 0.03; // 0.0015 of the surface's diagonal
  const Outcome closed = RunTrim(mesh, WallsApart(0.0, 0.0), TrimOptions());
  const Outcome unknown = RunTrim(mesh, WallsApart(gap, 0.0), TrimOptions());
  const Outcome told = RunTrim(mesh, WallsApart(gap, gap), TrimOptions());
  const Outcome wide = RunTrim(mesh, WallsApart(0.3, 0.3), TrimOptions());
  Expect(closed.Clean() && told.Clean(), "gaps that are told of: messages");
  Expect(!wide.Errors.empty(), "gaps too wide to be closed");
  const double volume = Number(closed.Case.Trimmed, "Volume");
  const auto lost = [volume](const Outcome& outcome)
  { return 1.0 - Number(outcome.Case.Trimmed, "Volume") / volume; };
  Expect(std::abs(lost(told)) < 2e-3, "gaps that are told of: the volume");
  Expect(lost(unknown) > 1e-2, "gaps that are not told of cut corners off");
}

// The whole fraction keeps what is cut, but nothing that lies beyond the surface.
void TestWholeFraction()
{
  const Mesh mesh = Sheet(20, 15, 2, Vec3(1, 1, 0.4));
  for (const char* kind : { "plane", "cylinder" })
  {
    for (const int type : { 1, 2 })
    {
      TrimOptions options;
      options.CorrectionType = type;
      options.EliminationFraction = 1;
      Report report(std::string("fraction 1 ") + kind);
      const auto outcome =
        RunAndJudge(mesh, MakeSurface(kind, mesh.Box, Placement()), options, report);
      Wrong += report.Failures();
      auto* status = outcome.Case.Trimmed->GetCellData()->GetArray("ElementStatus");
      int kept = 0;
      for (vtkIdType c = 0; c < status->GetNumberOfTuples(); ++c)
      {
        kept += status->GetComponent(c, 0) == 1;
      }
      Expect(kept == 0, "fraction 1: " + std::to_string(kept) + " elements beyond the surface");
    }
  }
}

// Points that no cell uses are no trouble, wherever they are and however many.
void TestUnusedPoints()
{
  const Mesh mesh = Sheet(20, 15, 2, Vec3(1, 1, 0.4));
  mesh.Grid->GetPointData()->Initialize();
  Mesh more = mesh;
  more.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  more.Grid->DeepCopy(mesh.Grid);
  const Vec3 c = mesh.Box.Centre;
  for (int i = 0; i < 1000; ++i)
  {
    more.Grid->GetPoints()->InsertNextPoint(
      c[0] + (i % 2 ? 9 : -9), c[1] + 0.001 * i, c[2] + 0.3 * (i % 7));
  }
  const Surface plane = PlaneThrough(c + Vec3(0.3, 0, 0), Vec3::UnitX(), 100);
  const Outcome with = RunTrim(more, plane, TrimOptions());
  const Outcome without = RunTrim(mesh, plane, TrimOptions());
  Expect(with.Clean() && FirstDifference(with.Case.Trimmed, without.Case.Trimmed).empty(),
    "unused points: another trim");
  auto* status = with.Case.Whole->GetPointData()->GetArray("NodeStatus");
  int wrong = 0;
  for (int i = 0; i < 1000; ++i)
  {
    wrong += status->GetComponent(mesh.Grid->GetNumberOfPoints() + i, 0) != (i % 2 ? 1 : 0);
  }
  Expect(wrong == 0, "unused points: " + std::to_string(wrong) + " on the wrong side");
}

// The polygons are for the eye alone: without them the surface is the same.
void TestNoPolygons()
{
  const Mesh mesh = MakeMesh("sheet2");
  Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  const Outcome expected = RunTrim(mesh, surface, TrimOptions());
  const auto bare = vtkSmartPointer<vtkPolyData>::New();
  bare->SetFieldData(surface.Data->GetFieldData());
  vtkNew<vtkMultiBlockDataSet> shell;
  shell->SetBlock(0, bare);
  for (vtkDataObject* data :
    { static_cast<vtkDataObject*>(bare), static_cast<vtkDataObject*>(shell) })
  {
    surface.Data = data;
    const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
    Expect(outcome.Clean() && FirstDifference(outcome.Case.Trimmed, expected.Case.Trimmed).empty(),
      "a surface without polygons");
  }
}

// A hole that touches the plane above it: nodes right over the line where they touch have a foot on
// both, with opposite normals.
void TestTouchingFaces()
{
  const Mesh mesh = Block(12, 10, 4);
  const auto plane = ToPolyData(Wall({ Vec2(20.0, 2.0), Vec2(-20.0, 2.0) }));
  for (const double radius :
    { 2.3, 2.7, 3.1, 3.3 }) // which face has the foot is a matter of rounding
  {
    const double middle = 2.0 - radius;
    const Surface both = Together(RoundHole(mesh, 0.0, middle, radius).Data, plane);
    const Outcome outcome = RunTrim(mesh, both, TrimOptions());
    Expect(outcome.Clean(), "touching faces: " + (outcome.Clean() ? "" : outcome.Errors[0]));
    vtkDataArray* status = outcome.Case.Whole->GetPointData()->GetArray("NodeStatus");
    int wrong = 0;
    for (vtkIdType i = 0; status && i < status->GetNumberOfTuples(); ++i)
    {
      const Vec3 p(mesh.Grid->GetPoint(i));
      const double beyond = std::max(p[1] - 2.0, radius - std::hypot(p[0], p[1] - middle));
      wrong += status->GetComponent(i, 0) != (std::abs(beyond) < 1e-9 ? 2 : beyond > 0.0 ? 1 : 0);
    }
    Expect(wrong == 0, "touching faces: " + std::to_string(wrong) + " nodes on the wrong side");
  }
}
}

int main()
{
  TestThroughNodes();
  TestAlongLayer();
  TestMisses();
  TestSlot();
  TestSideLostInOneLayer();
  TestNodesFromBothSides();
  TestThroughUprightEdge();
  TestThinEdge();
  TestPatch();
  TestCrossingAtKnot();
  TestKeepPoint();
  TestKeepPointBesideUnused();
  TestKeepPointBehindSeveral();
  TestRepeatedFaces();
  TestToldGaps();
  TestWholeFraction();
  TestUnusedPoints();
  TestTouchingFaces();
  TestNoPolygons();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
