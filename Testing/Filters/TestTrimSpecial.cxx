/**
 * @file TestTrimSpecial.cxx
 * @brief Surfaces that meet the mesh in special ways: exactly through nodes, edges and facets,
 * through an upright edge of the model, along a layer, touching only, or not at all; a keep point;
 * the whole elimination fraction; points without cells; a composite of one grid.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTrimHexahedralGrid.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
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

// Columns along which the surface shifts by several elements are none for what stays inside.
void TestLeaningCore()
{
  for (const char* name : { "bar", "block" })
  {
    const Mesh mesh = MakeMesh(name);
    for (const double lean : { 0.35, 0.6 })
    {
      Placement at;
      at.Angle = 0.7;
      at.Lean = lean;
      at.Size = 0.55;
      const Surface cylinder = MakeSurface("cylinder", mesh.Box, at);
      TrimOptions options;
      options.CorrectionType = 1;
      const Outcome inside = RunTrim(mesh, cylinder, options);
      options.InvertSide = true;
      const Outcome outside = RunTrim(mesh, cylinder, options);
      const auto volume = [](const Outcome& outcome)
      { return Number(outcome.Case.Trimmed, "Volume"); };
      const double lost = VolumeOf(Model(mesh.Grid)) - volume(inside) - volume(outside);
      Expect(std::abs(lost) < 0.1 * volume(inside),
        std::string(name) + ": the two sides of a leaning cylinder lack " + std::to_string(lost));
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

// A hole along the long sides of a block's elements is one hole whatever their length: columns of
// another direction, in which the hole is no cut from skin to skin, lost it all, and it was warned
// of what only is so across a skin.
void TestLongElements()
{
  struct Bar
  {
    int Layers;
    double Length; ///< of an element
  };
  for (const bool inside : { false, true })
  {
    vtkIdType columns = 0;
    for (const Bar& bar : std::initializer_list<Bar>{
           { 1, 2 }, { 2, 10 }, { 1, 40 }, { 4, 20 }, { 2, 100 }, { 12, 2 }, { 20, 2 } })
    {
      const std::string name = "block of elements 2 x 2 x " + std::to_string(bar.Length) +
        (inside ? ", inside" : ", outside");
      const Mesh mesh = Sheet(16, 12, bar.Layers, Vec3(2, 2, bar.Length));
      Placement at;
      at.X = -0.0625;
      at.Y = -0.083;
      at.Size = 0.525;
      TrimOptions options;
      options.InvertSide = inside;
      Report report(name);
      const Outcome outcome =
        RunAndJudge(mesh, MakeSurface("cylinder", mesh.Box, at), options, report);
      Wrong += report.Failures();
      const vtkIdType cells = outcome.Case.Trimmed->GetNumberOfCells();
      columns = columns > 0 ? columns : cells;
      Expect(cells == columns * bar.Layers && CountLeft(outcome.Case.Trimmed) == 0,
        name + ": " + std::to_string(cells) + " elements");
      Expect(outcome.Warnings.empty(),
        name + ": " + (outcome.Warnings.empty() ? "" : outcome.Warnings.front()));
    }
  }
}

struct Cut
{
  const char* Kind;
  double X, Y, Angle, Lean, Size;
  int Type, Optimization = 2;
  bool Reversed = false, Invert = false;
};

Outcome JudgeCut(const Mesh& mesh, const Cut& cut)
{
  Placement at;
  at.X = cut.X;
  at.Y = cut.Y;
  at.Angle = cut.Angle;
  at.Lean = cut.Lean;
  at.Size = cut.Size;
  at.Reversed = cut.Reversed;
  TrimOptions options;
  options.CorrectionType = cut.Type;
  options.Optimization = cut.Optimization;
  options.InvertSide = cut.Invert;
  Report report("special cut of " + mesh.Name + " by " + cut.Kind);
  Outcome outcome = RunAndJudge(mesh, MakeSurface(cut.Kind, mesh.Box, at), options, report);
  Wrong += report.Failures();
  return outcome;
}

void JudgeCuts(const Mesh& mesh, const std::vector<Cut>& cuts)
{
  for (const Cut& cut : cuts)
  {
    JudgeCut(mesh, cut);
  }
}

// What whole columns cannot follow, a hole or an island within a block, is not lost with them: all
// of it was, or most, without a node off the surface.
void TestIslands()
{
  struct Island
  {
    const char* Mesh;
    Cut By;
    vtkIdType Least; ///< elements
  };
  for (const Island& island : std::initializer_list<Island>{
         { "bar", { "trimmedface", 0.598, -0.681, 5.799, 0.25, 0.627, 2, 2, true }, 20 },
         { "bar", { "rectangle", -0.496, 0.608, 0.154, 0.488, 0.395, 2, 2, true, true }, 70 },
         { "bar", { "contour", -0.106, 0.171, 1.814, 0.297, 0.408, 2 }, 110 },
         { "bar", { "cone", -0.077, 0.586, 1.466, 0.241, 0.557, 2, 2, true }, 400 },
         { "twist", { "sphere", 0.464, -0.677, 1.447, 0.42, 0.609, 2, 2, false, true }, 10 },
         { "twist", { "contour", -0.224, 0.185, 0.026, 0, 0.364, 2 }, 60 },
         { "ball", { "cylinder", 0.28, 0.24, 1.333, 0.364, 0.398, 2 }, 130 } })
  {
    const Mesh mesh = MakePart(island.Mesh);
    const Outcome outcome = JudgeCut(mesh, island.By);
    const vtkIdType cells = outcome.Case.Trimmed->GetNumberOfCells();
    Expect(cells >= island.Least,
      std::string("an island in ") + island.Mesh + " by " + island.By.Kind + ": " +
        std::to_string(cells) + " elements of " + std::to_string(island.Least) + " or more");
  }
}

// Parts that are one another's neighbours at a line only may have columns along different axes, and
// no node of one goes on to the skin of another.
void TestBlocksJoinedAtEdges()
{
  JudgeCuts(BlocksJoinedAtEdges(4),
    { { "torus", -0.354, -0.215, 6.073, 0.261, 0.586, 2 },
      { "contour", 0.084, 0.08, 5.149, 0.641, 0.452, 3 } });
}

// Unit cubes at some places of a grid; nodes that no cube has are there, too.
Mesh Cubes(const std::vector<std::array<Id, 3>>& places)
{
  constexpr Id n = 4; // nodes along each axis
  RawMesh raw;
  for (Id i = 0; i < n * n * n; ++i)
  {
    raw.Points.emplace_back(i % n, i / n % n, i / (n * n));
  }
  for (const auto& place : places)
  {
    const Id a = place[0] + n * (place[1] + n * place[2]);
    const Id b = a + n * n;
    raw.Add(8, { a, a + 1, a + 1 + n, a + n, b, b + 1, b + 1 + n, b + n });
  }
  MeshOptions plain;
  plain.Data = false;
  return Finish("cubes", raw, BoxOf(raw, 1), plain);
}

// Cubes that hang together by edges here and there: what is kept does by no other ones.
void TestNoNewPinch()
{
  // The first three have an edge in common, and the third one loses most.
  const Mesh cubes = Cubes(
    { { 1, 0, 1 }, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 }, { 2, 1, 0 } });
  const Outcome outcome =
    RunTrim(cubes, PlaneThrough(Vec3(1.6, 0.7, 1.4), Vec3(0, 3, 2), 100), TrimOptions());
  vtkDataArray* ids = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  bool kept[7] = {};
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    kept[static_cast<int>(ids->GetComponent(i, 0))] = true;
  }
  Expect(outcome.Clean() && !(kept[0] && kept[1] && !kept[2]),
    "two cubes hang together by an edge that was not the only one");
}

// Where the border of what is kept turns or a ridge of it ends, its node does not slide along the
// border of an element that goes, to where that has a corner.
void TestKeptCorners()
{
  JudgeCuts(MakeMesh("zigzag"),
    { { "sphere", -0.036, 0.404, 0.67, 0, 0.391, 2, 2, true },
      { "torus", 0.593, -0.535, 0.545, 0, 0.401, 3, 1, true, true },
      { "torus", 0.202, -0.147, 1.352, 0.586, 0.708, 3 } });
  JudgeCuts(MakeMesh("fading-ridge"),
    { { "trimmedface", -0.006, 0.132, 2.858, 0.349, 0.675, 2, 0 },
      { "roundrect", -0.581, -0.326, 2.389, 0.548, 0.425, 2 } });
}

// Where the side of a step of the thickness goes with what is cut off, a node at its foot keeps to
// the skin that stays, and does not go on between the layers.
void TestFootOfStep()
{
  JudgeCuts(
    MakeMesh("patched"), { { "torus", 0.207, -0.055, 1.716, 0.384, 0.407, 2, 2, false, true } });
}

// A hole that reaches over the border: where the next node leaves the border for the surface, one
// beyond it may not slide along the border behind the cut, which would cut that corner off.
void TestCornersAtBorder()
{
  const Mesh mesh = Sheet(16, 10, 2, Vec3(2, 4, 1));
  const double border = 40;
  for (int step = 0; step < 14; ++step)
  {
    Placement at;
    at.X = 0.0125 * step;
    at.Y = 1.325;
    at.Angle = 0.46;
    at.Lean = 0.111;
    at.Size = 0.8125;
    const Surface hole = MakeSurface("cylinder", mesh.Box, at);
    TrimOptions options;
    options.InvertSide = true;
    Report report("corners at the border, hole at " + std::to_string(at.X));
    const Outcome outcome = RunAndJudge(mesh, hole, options, report);
    Wrong += report.Failures();
    vtkUnstructuredGrid* out = outcome.Case.Trimmed;
    vtkPointData* data = out->GetPointData();
    Expect(out->GetNumberOfCells() > 100, "corners at the border: the wrong side is kept");
    for (vtkIdType i = 0; i < out->GetNumberOfPoints(); ++i)
    {
      const Vec3 p(out->GetPoint(i));
      const bool cutOff = data->GetArray("NodeStatus")->GetComponent(i, 0) == 1 &&
        std::abs(p[1] - border) < 1e-9 && std::abs(hole.Signed(p)) > 0.5 &&
        data->GetArray("DistanceLeft")->GetComponent(i, 0) == 0;
      Expect(!cutOff,
        "corners at the border, hole at " + std::to_string(at.X) + ": the node at " +
          std::to_string(p[0]) + " is off by " + std::to_string(hole.Signed(p)));
    }
  }
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

/// Three faces that meet at a corner, of this side length, turned; what lies before all goes.
Surface CornerOfBody(const Vec3& corner, const Eigen::Matrix3d& turn, double side)
{
  vtkNew<vtkMultiBlockDataSet> faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 u = side * turn.col((axis + 1) % 3), v = side * turn.col((axis + 2) % 3);
    SplineSurface face;
    face.CountU = face.CountV = 2;
    face.KnotsU = face.KnotsV = UniformKnots(2, 1);
    for (const Vec3& p : { corner, Vec3(corner + u), Vec3(corner + v), Vec3(corner + u + v) })
    {
      face.Control.emplace_back(p[0], p[1], p[2], 1);
    }
    faces->SetBlock(axis, ToPolyData(face));
  }
  Surface surface;
  surface.Data = faces;
  return surface;
}

/// Nodes that slid, but not along an edge of a mesh whose edges are along the axes.
int CountAstray(vtkUnstructuredGrid* trimmed)
{
  auto* by = trimmed->GetPointData()->GetArray("CorrectionApplied");
  auto* displacement = trimmed->GetPointData()->GetArray("Displacement");
  int astray = 0;
  for (vtkIdType i = 0; i < trimmed->GetNumberOfPoints(); ++i)
  {
    const Vec3 moved(displacement->GetTuple(i));
    astray += by->GetComponent(i, 0) == 3 &&
      moved.squaredNorm() - moved.cwiseAbs2().maxCoeff() > 1e-8 * moved.squaredNorm();
  }
  return astray;
}

// Which gaps between faces count as closed goes by the size of the surface, but not where they
// would be as wide as elements: at the corner of a large body nodes slid to places beside their
// edges. The gaps are those of the grid, whatever was trimmed before.
void TestLargeBody()
{
  const Mesh block = Block(6, 6, 6), larger = Block(12, 12, 12);
  TrimOptions options;
  options.CorrectionType = 3;
  options.MinimumScaledJacobian = 0;
  for (int k = 0; k < 8; ++k)
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3 + 0.4 * k, Vec3(1, 2 - k, 0.5 * k).normalized()).toRotationMatrix();
    const Vec3 corner = Vec3(3, 3, 3) + 0.3 * Vec3(std::cos(k), std::sin(2 * k), std::sin(k));
    const Surface body = CornerOfBody(corner, turn, 1e5);
    const Outcome outcome = RunTrim(block, body, options);
    const std::string name = "a large body, " + std::to_string(k) + ": ";
    const int astray = outcome.Clean() ? CountAstray(outcome.Case.Trimmed) : -1;
    Expect(astray == 0, name + std::to_string(astray) + " nodes astray");
    vtkNew<vtkTrimHexahedralGrid> filter;
    SetOptions(filter, options);
    filter->SetInputDataObject(1, body.Data);
    for (const Mesh* mesh : { &larger, &block })
    {
      filter->SetInputDataObject(0, mesh->Grid);
      filter->Update();
    }
    auto* later = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
    Expect(FirstDifference(outcome.Case.Trimmed, later).empty(), name + "after another grid");
  }
}

// Wedges of the input may have the node order of vtkWedge's documentation; those of the outputs
// have the other one, as if the input had it.
void TestWedgeOrder()
{
  const Mesh mesh = MakeMesh("wedges");
  Mesh turned = mesh;
  turned.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  turned.Grid->DeepCopy(mesh.Grid);
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < mesh.Grid->GetNumberOfCells(); ++c)
  {
    mesh.Grid->GetCellPoints(c, nodes);
    if (nodes->GetNumberOfIds() == 6 && c % 3 != 0)
    {
      const vtkIdType* n = nodes->GetPointer(0);
      const vtkIdType other[] = { n[3], n[4], n[5], n[0], n[1], n[2] };
      turned.Grid->GetCells()->ReplaceCellAtId(c, 6, other);
    }
  }
  const Surface surface = MakeSurface("contour", mesh.Box, Placement());
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome as = RunTrim(mesh, surface, options);
  Report report("wedges in the other order");
  const Outcome other = RunAndJudge(turned, surface, options, report);
  Wrong += report.Failures();
  Expect(FirstDifference(turned.Grid, mesh.Grid) != "", "no wedge was turned");
  Expect(FirstDifference(other.Case.Trimmed, as.Case.Trimmed).empty(), "turned wedges: port 0");
  Expect(FirstDifference(other.Offcut, as.Offcut).empty(), "turned wedges: port 2");
}

// A column of wedges at the border goes too when it loses its whole side there, as a wedge has
// others beside it though none opposite to that side: a quarter of an element lies beyond the
// plane, less than half of each column.
void TestWedgesAtBorder()
{
  const Mesh mesh = MakeMesh("wedges");
  const Surface plane =
    PlaneThrough(mesh.Box.Centre + (mesh.Box.HalfX - 0.25) * Vec3::UnitX(), Vec3::UnitX(), 200);
  Report report("wedges at the border");
  const Outcome outcome = RunAndJudge(mesh, plane, TrimOptions(), report);
  Wrong += report.Failures();
  std::set<vtkIdType> stay;
  vtkDataArray* ids = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    stay.insert(static_cast<vtkIdType>(ids->GetComponent(i, 0)));
  }
  int sides = 0, left = 0;
  for (vtkIdType c = 0; c < mesh.Grid->GetNumberOfCells(); ++c)
  {
    vtkCell* const cell = mesh.Grid->GetCell(c);
    int atBorder = 0;
    for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i)
    {
      atBorder += cell->GetPoints()->GetPoint(i)[0] > mesh.Box.Centre[0] + mesh.Box.HalfX - 0.01;
    }
    const bool hasSide = cell->GetNumberOfPoints() == 6 && atBorder == 4;
    sides += hasSide;
    left += hasSide && stay.count(c) > 0;
  }
  Expect(sides > 0 && left == 0,
    "wedges at the border: " + std::to_string(left) + " of " + std::to_string(sides) + " stay");
}

/// The farthest whole element that went though it lies on the kept side, or stayed beyond.
double FarthestAstray(const Outcome& outcome, const Surface& surface)
{
  auto* whole = outcome.Case.Whole.Get();
  auto* ids = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  std::vector<char> kept(whole->GetNumberOfCells(), 0);
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    kept[static_cast<vtkIdType>(ids->GetComponent(i, 0))] = 1;
  }
  auto* status = whole->GetCellData()->GetArray("ElementStatus");
  double farthest = 0;
  for (vtkIdType e = 0; e < whole->GetNumberOfCells(); ++e)
  {
    if (status->GetComponent(e, 0) == (kept[e] ? 1 : 0))
    {
      double b[6];
      whole->GetCellBounds(e, b);
      const Vec3 centre(0.5 * (b[0] + b[1]), 0.5 * (b[2] + b[3]), 0.5 * (b[4] + b[5]));
      farthest = std::max(farthest, std::abs(surface.Signed(centre)));
    }
  }
  return farthest;
}

// Sheets that meet at a joint: the thickness of one goes on along the width of another, and columns
// along it would take elements far from a leaning plane with them.
void TestJoints()
{
  const Mesh mesh = MakeMesh("angle");
  int left = 0;
  for (const int type : { 1, 2 })
  {
    for (int k = 0; k < 8; ++k)
    {
      const Vec3 normal(0.35 * std::sin(0.8 * k), 1, 0.35 * std::cos(0.8 * k));
      const Surface plane =
        PlaneThrough(mesh.Box.Centre + 0.13 * k * Vec3::UnitY(), normal.normalized(), 200);
      TrimOptions options;
      options.CorrectionType = type;
      Report report("joint");
      const Outcome outcome = RunAndJudge(mesh, plane, options, report);
      const double farthest = FarthestAstray(outcome, plane) / mesh.Box.ElementSize;
      Wrong += report.Failures() > 0;
      // Unless its nodes have come to the surface all the same.
      const bool exact = type == 2 && CountLeft(outcome.Case.Trimmed) == 0;
      Expect(farthest < 1.0 || exact,
        "joint: an element on the wrong side, " + std::to_string(farthest) + " from the surface");
      left += CountLeft(outcome.Case.Trimmed);
    }
  }
  Expect(left <= 21, "joint: " + std::to_string(left) + " nodes are left off");
}

// Where the surface leaves the model right beside a corner, nodes whose side ends there come to it.
void TestBesideCorner()
{
  // In thin layers the nodes of a pillar have to go together.
  for (const double thickness : { 0.5, 0.1 })
  {
    const Mesh mesh = Sheet(20, 20, 2, Vec3(1, 1, thickness));
    const Surface plane =
      PlaneThrough(mesh.Box.Centre + Vec3(1e-5, 0, 0), Vec3(1, 1, 0).normalized(), 200);
    Report report("beside a corner");
    const Outcome outcome = RunAndJudge(mesh, plane, TrimOptions(), report);
    Wrong += report.Failures() > 0;
    auto* left = outcome.Case.Trimmed->GetPointData()->GetArray("DistanceLeft");
    Expect(left->GetRange()[1] > 0 && left->GetRange()[1] < 2e-5,
      "beside a corner: " + std::to_string(left->GetRange()[1]) + " left");
  }
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

// A composite of one grid is that grid, whatever blocks without cells are beside it.
void TestBlockAlone()
{
  const Mesh mesh = MakeMesh("sheet2");
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(1, mesh.Grid);
  blocks->SetBlock(2, vtkNew<vtkUnstructuredGrid>());
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, blocks);
  filter->SetInputDataObject(1, surface.Data);
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  const Outcome expected = RunTrim(mesh, surface, TrimOptions());
  Expect(output && FirstDifference(output, expected.Case.Trimmed).empty(), "a block alone");
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
  TestKeepPointBehindSeveral();
  TestLongElements();
  TestIslands();
  TestBlocksJoinedAtEdges();
  TestNoNewPinch();
  TestKeptCorners();
  TestFootOfStep();
  TestCornersAtBorder();
  TestRepeatedFaces();
  TestToldGaps();
  TestLargeBody();
  TestWedgeOrder();
  TestWedgesAtBorder();
  TestJoints();
  TestLeaningCore();
  TestBesideCorner();
  TestWholeFraction();
  TestUnusedPoints();
  TestTouchingFaces();
  TestBlockAlone();
  TestNoPolygons();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
