/**
 * @file TestTrimQuality.cxx
 * @brief The quality floor: poor elements are relaxed, on the surface and in their layer.
 */
#include "Expect.h"
#include "RunTrim.h"

#include "vtkTrimHexahedralGrid.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>
#include <cstdio>

using namespace judge;

namespace
{
/// The worst touched element with every option as it comes, all boundary nodes on the surface.
double LowestOf(const Mesh& mesh, const Surface& surface, bool invert, const char* what)
{
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInvertSide(invert);
  filter->SetRenumberNodes(false);
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  const auto number = [output](const char* name) { return Number(output, name); };
  Expect(number("TouchedElements") > 0 && number("MaximumDistanceToSurface") < 1e-7,
    "a node is off the surface");
  Expect(number("CertifiedElements") == number("TouchedElements"), "an element is not certified");
  std::printf("%-28s %.3f\n", what, number("MinimumScaledJacobian"));
  return number("MinimumScaledJacobian");
}

/// Straight cuts at any angle, and the round hole of the project's target.
void CheckTargets()
{
  MeshOptions plain;
  plain.Data = false;
  const Mesh sheet = Sheet(60, 60, 2, Vec3(1, 1, 0.5), plain);
  for (int degrees = 0; degrees <= 90; degrees += 5)
  {
    Placement at;
    at.Angle = degrees * M_PI / 180;
    const Surface cut = MakeSurface("plane", sheet.Box, at);
    const std::string what = "straight cut, " + std::to_string(degrees) + " degrees";
    Expect(LowestOf(sheet, cut, degrees % 2, what.c_str()) >= 0.5, "straight cuts: 0.5");
  }
  // Leaning ones, which leave the sheet where one layer of a column has lost its side to them.
  const Mesh slab = Sheet(24, 20, 2, Vec3(1, 1, 0.4), plain);
  for (const int degrees : { 48, 54, 60, 66 })
  {
    for (const int lean : { -30, 30 })
    {
      const double angle = degrees * M_PI / 180, tilt = lean * M_PI / 180;
      const Vec3 normal(
        -std::sin(angle) * std::cos(tilt), std::cos(angle) * std::cos(tilt), std::sin(tilt));
      const Surface cut =
        PlaneThrough(slab.Box.Centre + Vec3(-1.494, -1.345, 0), normal, 10 * slab.Box.HalfX);
      const std::string what =
        "straight cut, " + std::to_string(degrees) + ", leaning by " + std::to_string(lean);
      Expect(LowestOf(slab, cut, false, what.c_str()) >= 0.5, "leaning straight cuts: 0.5");
    }
  }
  for (const double thickness : { 1.0, 2.0 })
  {
    const double h = 100.0 / 224;
    const Mesh wide = Sheet(224, 224, 2, Vec3(h, h, thickness / 2), plain);
    for (const double lean : { 0.0, M_PI / 12 })
    {
      Placement at;
      at.X = at.Y = at.Angle = 0;
      at.Size = 0.6;
      at.Lean = lean;
      const Surface hole = MakeSurface("cylinder", wide.Box, at);
      const std::string what = std::string("hole, ") + (lean > 0 ? "leaning" : "upright") +
        ", thickness " + std::to_string(thickness);
      for (const bool invert : { false, true })
      {
        Expect(LowestOf(wide, hole, invert, what.c_str()) >= 0.55, "round hole: 0.55");
      }
    }
  }
}

/// A cut that leans by more than an element from skin to skin: nodes in the second row lie beyond
/// it, and have to come behind the first.
void CheckThickSheets()
{
  const double h = 100.0 / 350;
  const Mesh thick = Sheet(80, 80, 2, Vec3(h, h, 0.4));
  for (const double degrees : { 30.0, 38.7, 45.0 })
  {
    Placement at;
    at.X = at.Y = at.Angle = 0;
    at.Size = 0.6;
    at.Lean = degrees * M_PI / 180;
    for (const char* kind : { "cylinder", "plane", "slanting plane" })
    {
      const std::string what = std::string(kind) + ", leaning by " + std::to_string(degrees);
      // Meets the border of the sheet elsewhere on one skin than on the other.
      const bool slants = std::string(kind) == "slanting plane";
      at.Angle = slants ? 0.3 : 0;
      const Surface cut = MakeSurface(slants ? "plane" : kind, thick.Box, at);
      Expect(LowestOf(thick, cut, false, what.c_str()) >= 0.5, "thick sheet: 0.5");
      Report report(what);
      JudgeBothSides(thick, cut, TrimOptions(), report);
      Expect(report.Failures() == 0, "thick sheet: judged");
      Expect(report.Notes().empty(), "thick sheet: nodes left off");
    }
  }
}

/// Cuts that run along the wall of a formed part under a few degrees, and elements twenty times as
/// long as wide: there no single node gets an element up, all round it have to move at once.
void CheckHardCuts()
{
  for (const char* name : { "channel", "stretched" })
  {
    const Mesh mesh = MakeMesh(name);
    Placement at;
    at.Seed = 3;
    at.Size = mesh.Flat ? 0.9 : 0.45;
    const Surface cone = MakeSurface("cone", mesh.Box, at);
    for (const bool invert : { false, true })
    {
      const std::string what = std::string(name) + ", cone, side " + std::to_string(invert);
      Expect(LowestOf(mesh, cone, invert, what.c_str()) >= 0.3, "hard cuts: 0.3");
    }
  }
}

/// What one trim by a leaning cylinder says of itself and of its nodes.
struct Trimmed
{
  double MinimumScaledJacobian, MaximumDistance, Relaxations;
  int RelaxedNodes = 0, RelaxedOffLayer = 0, RescuedElements = 0, NotExact = 0;
};

Trimmed TrimAt(double floor)
{
  const Mesh mesh = MakeMesh("sheet2");
  Placement at;
  at.Lean = 0.6;
  at.Seed = 3;
  at.Size = 0.45;
  const Surface surface = MakeSurface("cylinder", mesh.Box, at);
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetMinimumScaledJacobian(floor);
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  const auto number = [output](const char* name) { return Number(output, name); };
  Trimmed result{ number("MinimumScaledJacobian"), number("MaximumDistanceToSurface"),
    number("RescuedByRelaxation") };
  auto* applied = output->GetPointData()->GetArray("CorrectionApplied");
  auto* moved = output->GetPointData()->GetArray("Displacement");
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    const double* d = moved->GetTuple3(i);
    const bool relaxed = applied->GetComponent(i, 0) == 4;
    result.RelaxedNodes += relaxed;
    // The layers of this sheet are level.
    result.RelaxedOffLayer += relaxed && std::abs(d[2]) > 1e-9;
    result.NotExact += (d[0] != 0 || d[1] != 0 || d[2] != 0) != (applied->GetComponent(i, 0) != 0);
  }
  auto* rescue = output->GetCellData()->GetArray("Rescue");
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    result.RescuedElements += rescue->GetComponent(i, 0) == 1;
  }
  return result;
}

/// What an edge has kept of its length, at least; also of edges at nodes left off the surface
/// alone.
struct LeastEdges
{
  double Any = 1, AtLeft = 1;
};

LeastEdges MeasureEdges(vtkUnstructuredGrid* output, const Mesh& mesh)
{
  auto* distance = output->GetPointData()->GetArray("DistanceLeft");
  auto* original = output->GetPointData()->GetArray("vtkOriginalPointIds");
  const auto isLeft = [distance](vtkIdType i) { return distance->GetComponent(i, 0) > 0; };
  const auto length = [](vtkUnstructuredGrid* grid, vtkIdType a, vtkIdType b)
  {
    Vec3 p, q;
    grid->GetPoint(a, p.data());
    grid->GetPoint(b, q.data());
    return (p - q).norm();
  };
  LeastEdges least;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    vtkCell* cell = output->GetCell(c);
    for (int i = 0; i < cell->GetNumberOfEdges(); ++i)
    {
      const vtkIdType a = cell->GetEdge(i)->GetPointId(0), b = cell->GetEdge(i)->GetPointId(1);
      const double before = length(mesh.Grid, static_cast<vtkIdType>(original->GetComponent(a, 0)),
        static_cast<vtkIdType>(original->GetComponent(b, 0)));
      const double share = length(output, a, b) / before;
      least.Any = std::min(least.Any, share);
      if (isLeft(a) || isLeft(b))
      {
        least.AtLeft = std::min(least.AtLeft, share);
      }
    }
  }
  return least;
}

/// Cuts that nodes have to be left off at: no more than need be, and no farther.
void CheckFewLeft()
{
  struct Case
  {
    const char *Mesh, *Kind;
    double Angle, Lean;
    bool Invert, Offcut;
    int Most;        ///< nodes left
    double Farthest; ///< of them
  };
  for (const Case& c : { Case{ "block", "plane", 1.1, 0.75, false, false, 88, 1.2 },
         Case{ "cup", "roundrect", 0, 0, true, false, 12, 0.4 },
         Case{ "channel", "cylinder", 0, 0.26, true, false, 13, 0.7 },
         Case{ "block", "plane", 1.1, 0.75, false, true, 135, 1.0 } })
  {
    const Mesh mesh = MakeMesh(c.Mesh);
    Placement at;
    at.Angle = c.Angle > 0 ? c.Angle : at.Angle;
    at.Lean = c.Lean;
    at.Seed = 3;
    at.Size = 0.45;
    const Surface surface = MakeSurface(c.Kind, mesh.Box, at);
    vtkNew<vtkTrimHexahedralGrid> filter;
    filter->SetInvertSide(c.Invert);
    filter->SetProduceOffcut(c.Offcut);
    filter->SetInputDataObject(0, mesh.Grid);
    filter->SetInputDataObject(1, surface.Data);
    filter->Update();
    auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
    auto* distance = output->GetPointData()->GetArray("DistanceLeft");
    int left = 0;
    double farthest = 0;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      left += distance->GetComponent(i, 0) > 0;
      farthest = std::max(farthest, distance->GetComponent(i, 0));
    }
    const double lowest = Number(output, "MinimumScaledJacobian");
    const double edge = MeasureEdges(output, mesh).AtLeft;
    std::printf("%s, %s%s: %d nodes left, by %.3f at most, lowest %.3f, edges %.4f\n", c.Mesh,
      c.Kind, c.Offcut ? ", with offcut" : "", left, farthest, lowest, edge);
    Expect(left <= c.Most, "too many nodes are left off the surface");
    Expect(farthest <= c.Farthest, "nodes are left too far off the surface");
    Expect(lowest >= 0.2, "an element is below the floor for a node that was left");
    Expect(edge >= 0.0499, "an edge was given up for a node that was left");
  }
}

/// Surfaces that pass by nodes so near that the corrections make edges of next to no length, in
/// elements of a good shape: they are lengthened, with every node on the surface.
void CheckShortEdges()
{
  struct Case
  {
    const char *Mesh, *Kind;
    int Correction, Number;
  };
  for (const Case& c : { Case{ "sheet2", "scurve", 3, 5 }, Case{ "perturbed", "contour", 3, 7 },
         Case{ "channel", "scurve", 3, 8 }, Case{ "angle", "scurve", 3, 6 },
         Case{ "lshape", "plane", 2, 4 } })
  {
    const Mesh mesh = MakeMesh(c.Mesh);
    Placement at;
    at.X = 0.05 * c.Number;
    at.Y = -0.03 * c.Number;
    at.Angle = 0.13 * c.Number;
    at.Size = 0.3 + 0.03 * c.Number;
    at.Seed = 3 + c.Number;
    TrimOptions options;
    options.CorrectionType = c.Correction;
    options.InvertSide = c.Number % 2 != 0;
    const Surface surface = MakeSurface(c.Kind, mesh.Box, at);
    double edges[2];
    for (const double floor : { 0.0, 0.2 })
    {
      options.MinimumScaledJacobian = floor;
      Report report(std::string("short edges, ") + c.Mesh + ", " + c.Kind);
      const Outcome outcome = RunAndJudge(mesh, surface, options, report);
      Expect(report.Failures() == 0, "short edges: the trim is not as it should be");
      Expect(
        floor == 0.0 || report.Notes().count(NodesLeftOff) == 0, "a node was left for an edge");
      edges[floor > 0.0] = MeasureEdges(outcome.Case.Trimmed, mesh).Any;
    }
    std::printf("%s, %s: edges keep %.4f of their lengths without a floor, %.4f with one\n", c.Mesh,
      c.Kind, edges[0], edges[1]);
    Expect(edges[0] < 0.04, "the trial makes no short edge: choose another");
    Expect(edges[1] >= 0.0499, "an edge is next to nothing");
  }
}

/// A floor above what the mesh has: elements that came below it are still held to the default one.
/// The judge looks at each element.
void CheckHighFloor()
{
  const Mesh mesh = MakeMesh("irregular");
  for (const char* kind : { "plane", "wavy", "cylinder", "arc" })
  {
    const Surface surface = MakeSurface(kind, mesh.Box, Placement());
    TrimOptions options;
    options.CorrectionType = 3;
    options.MinimumScaledJacobian = 0.8;
    for (const bool invert : { false, true })
    {
      options.InvertSide = invert;
      Report report(std::string("a floor of 0.8, ") + kind + (invert ? ", inverted" : ""));
      RunAndJudge(mesh, surface, options, report);
      Expect(report.Failures() == 0, "an element is worse than the default floor allows");
    }
  }
}
}

/// Blocks whose columns follow the cut, beside a corner of the model that it cuts off: nodes there
/// slide along an edge that lies beyond the surface, or the whole cut would do without columns.
void CheckCutCorners()
{
  struct Case
  {
    std::array<int, 3> Elements;
    Vec3 Normal, Offset; ///< of the plane, from the middle
    int Most;            ///< nodes that slid behind a corner between border and surface
  };
  const Case cases[] = { { { 12, 12, 12 }, { 0.3, 1, 0.4 }, { 0.13, -0.21, 0.07 }, 0 },
    { { 10, 10, 11 }, { -2, -1, -4 }, { -0.929, 0.093, 0.592 }, 0 },
    { { 8, 6, 10 }, { -1, 2, 3 }, { -0.232, 0.34, 0.245 }, 1 } };
  for (const Case& c : cases)
  {
    const auto [nx, ny, nz] = c.Elements;
    const Mesh mesh = Block(nx, ny, nz);
    const Surface plane = PlaneThrough(mesh.Box.Centre + c.Offset, c.Normal.normalized(), 100.0);
    Report report("corner of a block of " + std::to_string(nx));
    const Outcome outcome = RunAndJudge(mesh, plane, TrimOptions(), report);
    Wrong += report.Failures();
    const int left = CountLeft(outcome.Case.Trimmed);
    std::printf("block of %d x %d x %d: %d nodes left\n", nx, ny, nz, left);
    Expect(left <= c.Most, "nodes are left beside the corner of a block");
  }
}

/// Surfaces that pass through the skin of a sheet or a block beside elements that are kept: a node
/// that no face holds went along them, by nine tenths of a layer and a quarter of an element.
void CheckInside()
{
  struct Case
  {
    const char *Mesh, *Kind;
    Placement At;
    int Correction, Optimization;
    bool Inverted;
  };
  const Case cases[] = { { "wedges", "torus",
                           { -0.31891208598968551, -0.13670414893735228, 5.8845751215193483,
                             0.50588239638678345, 0.25104010568473478, 786254, true },
                           3, 2, false },
    { "block", "contour", { -0.568, -0.105, 4.556, 0.257, 0.711, 738419, false }, 2, 0, true } };
  for (const Case& c : cases)
  {
    const Mesh mesh = MakeMesh(c.Mesh);
    TrimOptions options;
    options.CorrectionType = c.Correction;
    options.Optimization = c.Optimization;
    options.InvertSide = c.Inverted;
    Report report(std::string("out of the ") + c.Mesh);
    RunAndJudge(mesh, MakeSurface(c.Kind, mesh.Box, c.At), options, report);
    Expect(report.Failures() == 0, "a node sticks out of the mesh");
  }
}

/// Elements that are askew: their outer nodes came to lie past the next ones along the cut, so that
/// the border turned back on itself and the element was folded, with nothing said.
void CheckNotFolded()
{
  struct Case
  {
    double Shear, Angle, Shift;
    int Correction;
  };
  // Shear of the sheet; the cut's normal to x, and its shift from the middle in elements.
  for (const Case& c : { Case{ 0.67, 3.03, -0.096, 2 }, Case{ 0.44, 1.21, 0.112, 2 },
         Case{ -0.73, 0.29, -0.28, 2 }, Case{ -0.56, 2.01, -0.432, 2 } })
  {
    const Mesh mesh = Sheet(8, 8, 1, Vec3(1, 1, 0.5));
    MovePoints(mesh.Grid, [&c](const Vec3& p) { return Vec3(p[0] + c.Shear * p[1], p[1], p[2]); });
    const Vec3& middle = mesh.Box.Centre;
    const Vec3 place(middle[0] + c.Shear * middle[1] + c.Shift, middle[1], middle[2]);
    const Surface cut = PlaneThrough(place, Vec3(std::cos(c.Angle), std::sin(c.Angle), 0), 40);
    TrimOptions options;
    options.CorrectionType = c.Correction;
    options.Optimization = 0;
    const Outcome outcome = RunTrim(mesh, cut, options);
    const double lowest = Number(outcome.Case.Trimmed, "MinimumScaledJacobian");
    std::printf("sheet askew by %g: %.3f\n", c.Shear, lowest);
    Expect(lowest > -1e-6, "an element is folded along a straight cut");
  }
}

/// Wedges without any optimization, nor a quality asked for: at a corner of theirs they were folded
/// by up to three times their volume, with nothing said. The judge looks at their certificates.
void CheckWholeWedges()
{
  for (const Placement& at :
    { Placement{ 0, -0.2, 4.5, 0.1, 0.35 }, Placement{ 0.2, -0.2, 0.5, 0.1, 0.45 } })
  {
    TrimOptions options;
    options.CorrectionType = 3;
    options.Optimization = 0;
    options.MinimumScaledJacobian = 0;
    const Mesh mesh = MakeMesh("cup");
    Report report("wedges of a cup");
    RunAndJudge(mesh, MakeSurface("roundrect", mesh.Box, at), options, report);
    Expect(report.Failures() == 0, "a wedge is folded");
  }
}

int main()
{
  CheckTargets();
  CheckHighFloor();
  CheckCutCorners();
  CheckThickSheets();
  CheckHardCuts();
  CheckFewLeft();
  CheckShortEdges();
  CheckInside();
  CheckNotFolded();
  CheckWholeWedges();
  const Trimmed plain = TrimAt(0);
  const Trimmed raised = TrimAt(0.7);
  std::printf("without a floor %g, with a floor of 0.7 %g (%d nodes relaxed)\n",
    plain.MinimumScaledJacobian, raised.MinimumScaledJacobian, raised.RelaxedNodes);
  Expect(plain.MinimumScaledJacobian < 0.7, "the trial needs no relaxation: choose another");
  Expect(plain.RelaxedNodes == 0 && plain.RescuedElements == 0, "relaxed without being asked");
  Expect(raised.MinimumScaledJacobian >= 0.7, "the floor is not reached");
  Expect(raised.RelaxedNodes > 0 && raised.RescuedElements > 0, "nothing says what was relaxed");
  Expect(raised.RescuedElements == static_cast<int>(raised.Relaxations),
    "Rescue and RescuedByRelaxation do not agree");
  Expect(raised.RelaxedOffLayer == 0, "a relaxed node left its layer");
  Expect(raised.MaximumDistance < 1e-8, "a relaxed node left the surface");
  Expect(
    plain.NotExact == 0 && raised.NotExact == 0, "CorrectionApplied and Displacement do not agree");
  return Wrong != 0;
}
