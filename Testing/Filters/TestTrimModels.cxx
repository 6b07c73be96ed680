/**
 * @file TestTrimModels.cxx
 * @brief Models of special shapes: long elements, islands, blocks joined at edges, zigzags, ridges,
 * steps and corners at the border, wedges, joints of sheets, a large body.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
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

// Rescue tells of the element that goes as it would hang on another by an edge alone.
void TestPinchIsTold()
{
  // The second one hangs on the first by an edge, once the third is gone.
  const Mesh cubes = Cubes({ { 1, 0, 1 }, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 0, 1 } });
  TrimOptions options;
  options.CorrectionType = 1;
  options.EliminationFraction = 0.8;
  const Outcome outcome =
    RunTrim(cubes, PlaneThrough(Vec3(1.6, 0.7, 1.4), Vec3(0, 3, 2), 100), options);
  Expect(outcome.Clean(), "three cubes round an edge: the judge");
  Expect(outcome.Case.Trimmed->GetFieldData()->GetArray("RescuedByFate")->GetComponent(0, 0) == 1.0,
    "one column goes against its share");
  vtkDataArray* rescue = outcome.Case.Whole->GetCellData()->GetArray("Rescue");
  for (vtkIdType i = 0; i < rescue->GetNumberOfTuples(); ++i)
  {
    Expect(rescue->GetComponent(i, 0) == (i == 1 ? 4.0 : 0.0),
      "three cubes round an edge: Rescue of the one numbered " + std::to_string(i));
  }
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
  TestLongElements();
  TestIslands();
  TestBlocksJoinedAtEdges();
  TestNoNewPinch();
  TestPinchIsTold();
  TestKeptCorners();
  TestFootOfStep();
  TestCornersAtBorder();
  TestLargeBody();
  TestWedgeOrder();
  TestWedgesAtBorder();
  TestJoints();
  TestLeaningCore();
  TestBesideCorner();
  TestBlockAlone();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
