/**
 * @file TestTrimFindings.cxx
 * @brief No silence and no false alarms: the arrays Feasibility, Shortfall, DistanceLeft and
 * CornerLost, and the warnings that tell of them.
 */
#include "Expect.h"
#include "SplineData.h"
#include "WarnedFindings.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace judge;

namespace
{
Vec3 LeaningNormal(double angle, double lean)
{
  return Vec3(std::cos(angle) * std::cos(lean), std::sin(angle) * std::cos(lean), std::sin(lean));
}

constexpr double Degree = 0.017453292519943295;

void TestOrdinary()
{
  const Mesh sheet = Sheet(80, 80, 1, Vec3(1, 1, 0.5));
  const Mesh layers = Sheet(40, 30, 3, Vec3(1, 1, 0.4));
  const Mesh block = Block(12, 12, 12);
  TrimOptions options;
  for (int correction = 1; correction <= 3; ++correction)
  {
    options.CorrectionType = correction;
    for (const double angle : { 0.0, 0.21, 0.785398, 1.3 })
    {
      const std::string name = "plane at " + std::to_string(angle);
      ExpectNothing(name + " upright", layers,
        PlaneThrough(Vec3(20.3, 14.9, 0), LeaningNormal(angle, 0), 200), options);
      ExpectNothing(name + " leaning by 40 degrees", layers,
        PlaneThrough(Vec3(20.3, 14.9, 0), LeaningNormal(angle, 40 * Degree), 200), options);
    }
    ExpectNothing(
      "plane through nodes", layers, PlaneThrough(Vec3(20, 0, 0), Vec3::UnitX(), 200), options);
    ExpectNothing("plane through a block", block,
      PlaneThrough(block.Box.Centre + Vec3(0.2, 0.1, 0), Vec3::UnitX(), 200), options);
  }
  // Tangent to lines of the mesh, from just inside and outside; edges there are crossed twice.
  options.CorrectionType = 2;
  for (const double shift : { 0.0, 0.002, -0.002, 0.5 })
  {
    ExpectNothing("hole of radius 30", sheet, RoundHole(sheet, 40.5, 40 + shift, 30), options);
    ExpectNothing("hole of radius 10", sheet, RoundHole(sheet, 40.5, 40.01 + shift, 10), options);
  }
  ExpectNothing("leaning hole", sheet, RoundHole(sheet, 40.2, 39.9, 30, 15 * Degree), options);
}

// Two cuts that face the same way: where no edge lies between them nothing else contradicts it.
void TestDoubled()
{
  const Mesh sheet = Sheet(40, 30, 2, Vec3(1, 1, 0.4));
  const Vec3 at(20.3, 14.9, 0);
  for (const double angle : { 0.0, 0.2 })
  {
    const Vec3 normal = LeaningNormal(angle, 0);
    const auto plane = [&](double shift) { return PlaneThrough(at + shift * normal, normal, 40); };
    const std::string name = "planes at " + std::to_string(angle);
    ExpectOnly(name + " beside each other", sheet, Together(plane(0).Data, plane(0.2).Data),
      CrossedTwice, 60);
    // As faces of one surface that overlap.
    ExpectNothing(
      name + " nearly in one", sheet, Together(plane(0).Data, plane(0.01).Data), TrimOptions());
  }
}

// The same with nodes between the two that all are nearer to one of them: the other one is crossed
// once, and does not part the mesh.
void TestBesideEachOther()
{
  const Mesh sheet = Sheet(40, 30, 2, Vec3(1, 1, 0.4));
  const Mesh block = Block(10, 10, 10);
  struct Beside
  {
    double At, Distance;
  };
  for (const Beside& beside : { Beside{ 0.3, 0.9 }, Beside{ 0.3, 1.1 }, Beside{ 0.3, 1.6 },
         Beside{ 0.0, 1.0 }, Beside{ 0.0, 1.2 }, Beside{ 0.0, 2.0 }, Beside{ 0.8, 1.2 } })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const auto both = [&](const Vec3& corner)
      {
        const auto plane = [&](double shift) {
          return PlaneThrough(corner + Vec3(beside.At + shift, 0.3, 0.1), sign * Vec3::UnitX(), 60);
        };
        return Together(plane(0).Data, plane(beside.Distance).Data);
      };
      const std::string name = "planes at " + std::to_string(beside.At) + ", " +
        std::to_string(sign * beside.Distance) + " beside each other";
      ExpectOnly(name, sheet, both(Vec3(20, 15, 0)), CrossedTwice, 60);
      const Vec3 corner = block.Box.Centre - Vec3::Constant(1);
      ExpectOnly(name + ", block", block, both(corner), CrossedTwice, 100);
    }
  }
}

void TestInclined()
{
  const Mesh sheet = Sheet(40, 30, 2, Vec3(1, 1, 0.4));
  const auto plane = [](double lean)
  { return PlaneThrough(Vec3(20.3, 14.9, 0), LeaningNormal(0.3, lean), 200); };
  // Every element with nodes on both sides: two layers along 30 rows at least.
  ExpectOnly("leaning by 50 degrees", sheet, plane(50 * Degree), Inclined, 60);
  // So far that the sheet is treated as a block.
  const Outcome flat = RunTrim(sheet, plane(80 * Degree), TrimOptions());
  Expect(ExpectWarned("leaning by 80 degrees", flat)[Inclined] > 100, "leaning by 80 degrees");
}

void TestSmallHoles()
{
  const Mesh sheet = Sheet(30, 30, 2, Vec3(1, 1, 0.4));
  ExpectOnly("hole of radius 1.7", sheet, RoundHole(sheet, 15.2, 15.3, 1.7), Curved, 2 * 4);
  ExpectOnly("hole of radius 1.3", sheet, RoundHole(sheet, 15.2, 15.3, 1.3), Narrow, 2 * 4);
  ExpectNothing("hole of radius 2.2", sheet, RoundHole(sheet, 15.2, 15.3, 2.2), TrimOptions());
  // Round a node, with less than half of each element.
  ExpectOnly("hole round a node", sheet, RoundHole(sheet, 15, 15, 0.45), NotOpened, 2 * 4);
  // Nothing moves for a hole that is not there.
  const Outcome shut = RunTrim(sheet, RoundHole(sheet, 15, 15, 0.45), TrimOptions());
  Expect(Number(shut.Case.Trimmed, "MovedNodes") == 0, "hole round a node: nodes moved");
  TrimOptions stepped;
  stepped.CorrectionType = 1;
  ExpectOnly(
    "hole round a node, type I", sheet, RoundHole(sheet, 15, 15, 0.45), NotOpened, 8, stepped);
  // Within one element: no node sees it.
  ExpectOnly("hole within an element", sheet, RoundHole(sheet, 15.5, 15.45, 0.3), NotOpened, 2);
  // Across an edge, between its nodes.
  ExpectOnly("hole across an edge", sheet, RoundHole(sheet, 15.1, 15.5, 0.3), NotOpened, 4);
}

// Two sides of a window lie on lines of the mesh, and run along edges that end at its corners.
void TestAligned()
{
  const Mesh sheet = Sheet(40, 40, 2, Vec3(2.5, 2.5, 0.5));
  ExpectNothing("window along x", sheet,
    Polyline({ Vec2(20, 21), Vec2(80, 21), Vec2(80, 40.7), Vec2(20, 40.7) }), TrimOptions());
  ExpectNothing("window along y", sheet,
    Polyline({ Vec2(21, 20), Vec2(80, 20), Vec2(80, 40), Vec2(21, 40) }), TrimOptions());
  // Four planes round two by two elements, which are opened: those beside touch them, no more.
  const Mesh oblong = Sheet(30, 30, 2, Vec3(1.3, 1, 0.4));
  Placement at;
  at.X = at.Y = at.Angle = 0;
  at.Size = 1.0 / oblong.Box.HalfY;
  at.Reversed = true;
  ExpectOnly(
    "window of four elements", oblong, MakeSurface("rectangle", oblong.Box, at), Narrow, 2 * 4);
}

/// How far long edges of a grid of elements of 1 x 1 bridge a surface, at most.
double SagOfLongEdges(vtkUnstructuredGrid* grid, const Surface& surface)
{
  const auto distance = [&](const Vec3& p) { return std::abs(surface.Signed(p)); };
  double sag = 0.0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    vtkCell* const cell = grid->GetCell(c);
    for (int i = 0; i < cell->GetNumberOfEdges(); ++i)
    {
      vtkPoints* const ends = cell->GetEdge(i)->GetPoints();
      const Vec3 a(ends->GetPoint(0)), b(ends->GetPoint(1));
      if (distance(a) < 1e-6 && distance(b) < 1e-6 && (b - a).norm() > 1.5)
      {
        sag = std::max(sag, distance(0.5 * (a + b)));
      }
    }
  }
  return sag;
}

/// Whether edges that bridge a hole are told of.
/// @return whether there are some.
bool JudgeBridges(
  const std::string& name, const Mesh& mesh, const Surface& hole, const TrimOptions& options)
{
  const Outcome outcome = RunTrim(mesh, hole, options);
  const bool bridges = SagOfLongEdges(outcome.Case.Trimmed, hole) > 0.2;
  Expect((ExpectWarned(name, outcome).count(Curved) > 0) == bridges,
    name + (bridges ? ": nothing is told of a long edge" : ": a long edge is told of"));
  return bridges;
}

// Where a hole grazes the border nodes go far apart, and edges between them bridge it: told of
// where they are a fifth of an element off the surface. The height of a layer is no measure.
void TestLongChords()
{
  for (const Mesh& mesh : { Sheet(14, 10, 4, Vec3(1, 1, 1)), Sheet(30, 20, 1, Vec3(1, 1, 7)) })
  {
    int bridged = 0;
    for (int k = 0; k < 60; ++k)
    {
      const double radius = 3.3 + 0.05 * k, x = 5.0 + 0.17 * (k % 30), depth = 0.1 * (k % 7) - 0.2;
      TrimOptions options;
      options.CorrectionType = 2 + k % 2;
      bridged += JudgeBridges("hole " + std::to_string(k) + " that grazes the border", mesh,
        RoundHole(mesh, x, mesh.Ny - radius + depth, radius), options);
    }
    Expect(bridged > 5 && bridged < 40, "holes bridged: " + std::to_string(bridged));
  }
}

// From top to bottom of a tall layer a surface bends by more than a fifth of an edge within it, and
// by less.
void TestTallLayer()
{
  const Mesh sheet = Sheet(40, 30, 1, Vec3(1, 1, 7));
  const auto sphere = [](double radius) { return SphereAt(Vec3(20.3 - radius, 15, 0), radius); };
  ExpectOnly("a bend in a tall layer", sheet, sphere(22), Curved, 20);
  ExpectNothing("a slight bend in a tall layer", sheet, sphere(40), TrimOptions());
}

// A surface that ends in the gap between two sheets leaves open what becomes of the second one if
// that has parts on both sides of where it would go on; if it has not, all is clear.
void TestBesideEnd()
{
  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, 0, 0));
  const Vec3 first(sheets.Grid->GetPoint(0));
  const auto wall = [&first](double y, double xEnd)
  {
    Surface surface;
    surface.Data = ToPolyData(Wall({ { -9.0, y }, { xEnd, y } }, first));
    return surface;
  };
  const std::string phrase = "1 part of the grid lies beyond the end of the trimming surface";
  for (const bool invert : { false, true })
  {
    TrimOptions options;
    options.InvertSide = invert;
    Expect(IsTold(RunTrim(sheets, wall(4.3, 8.5), options), phrase), "a part beside an end");
    Expect(RunTrim(sheets, wall(4.3, 20), options).Warnings.empty(), "through both parts");
  }
  // The second one higher up, above the end of the surface.
  const Mesh apart = TwoSheets(8, 10, 2, 0.4, Vec3(9, 5, 0));
  Expect(RunTrim(apart, wall(4.3, 8.5), {}).Warnings.empty(), "a part beyond on one side");
}

// Of a part that sees more of the surface than its end the nodes that do decide: the wall bends
// down in the gap between the sheets, and the lower nodes of the second one see it from behind.
void TestBehindEnd()
{
  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, -3, 0));
  const Vec3 first(sheets.Grid->GetPoint(0));
  Surface surface;
  surface.Data = ToPolyData(Wall({ { -9, 4.3 }, { 8.5, 4.3 }, { 8.8, 1 } }, first));
  const vtkIdType half = sheets.Grid->GetNumberOfCells() / 2;
  for (const bool invert : { false, true })
  {
    TrimOptions options;
    options.InvertSide = invert;
    const Outcome outcome = RunTrim(sheets, surface, options);
    vtkDataArray* const ids = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
    vtkIdType ofSecond = 0;
    bool hasUpper = false;
    for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
    {
      ofSecond += ids->GetComponent(i, 0) >= half;
      hasUpper |= ids->GetComponent(i, 0) == half - 1;
    }
    Expect(outcome.Clean() && outcome.Warnings.empty() && ofSecond == (hasUpper ? half : 0),
      "behind an end: " + std::to_string(ofSecond) + " elements of the second sheet stay");
  }
}

/// Volume of what the plane, which is nearly along a sheet of one layer, has on its kept side, less
/// that of what is kept, in elements.
double MeasureLoss(
  const Mesh& sheet, const Surface& plane, double thickness, const Outcome& outcome)
{
  const Model whole(sheet.Grid), kept(outcome.Case.Trimmed);
  double elements = 0;
  for (Id c = 0; c < static_cast<Id>(whole.Elements.size()); ++c)
  {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : whole.Corners(c))
    {
      middle += corner / 8;
    }
    elements += std::clamp(0.5 - plane.Signed(middle) / thickness, 0.0, 1.0);
  }
  const double volume = judge::VolumeOf(whole.Corners(0), 8);
  for (Id c = 0; c < static_cast<Id>(kept.Elements.size()); ++c)
  {
    elements -= judge::VolumeOf(kept.Corners(c), kept.Elements[c].Size) / volume;
  }
  return elements;
}

// A cut that is nearly along a sheet of one layer takes far more than lies beyond it. Nodes are
// left off the surface, but that does not tell how much is lost.
void TestFlatLost()
{
  const double thickness = 0.8;
  const Mesh sheet = Sheet(16, 12, 1, Vec3(2.25, 2.25, thickness));
  for (const bool layer : { false, true })
  {
    const Vec3 normal = layer ? Vec3(0.03, 0.02, 1) : Vec3(0.044, 0.01, 1);
    const Surface plane = PlaneThrough(Vec3(18, 13.5, 0), normal.normalized(), 200);
    TrimOptions options;
    options.InsertLayer = layer;
    const Outcome outcome = RunTrim(sheet, plane, options);
    const double elements = MeasureLoss(sheet, plane, thickness, outcome);
    const int told = NumberAfter("The volume of ", outcome);
    Expect(CountWarned(outcome, LeftPhrase) > 0 && elements > 20,
      "flat: not the loss that is meant: " + std::to_string(elements));
    Expect(std::abs(told - elements) < 2,
      "flat: told of " + std::to_string(told) + " for " + std::to_string(elements));
  }
}

void TestStretched()
{
  // Radius 6 in elements of 1 x 4: a hole of three elements across in one direction.
  const Mesh sheet = Sheet(60, 20, 1, Vec3(1, 4, 0.4));
  auto found = ExpectWarned("stretched", RunTrim(sheet, RoundHole(sheet, 30.2, 41, 6.5), {}));
  Expect(found[Curved] > 0 && found[Curved] < 20, "stretched: where it bends along the long edges");
}

void TestShortfalls()
{
  const Mesh sheet = Sheet(30, 30, 2, Vec3(1, 1, 0.4));
  TrimOptions options;
  options.MinimumScaledJacobian = 0.99;
  const Outcome outcome = RunTrim(sheet, RoundHole(sheet, 15.2, 15.3, 5.3), options);
  ExpectWarned("floor of 0.99", outcome);
  vtkUnstructuredGrid* output = outcome.Case.Trimmed;
  vtkDataArray* shortfall = output->GetCellData()->GetArray("Shortfall");
  vtkDataArray* quality = output->GetCellData()->GetArray("ScaledJacobian");
  // No element of a staircase turned into a circle is that good: its nodes are left off.
  int leftOff = 0;
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    Expect(!(quality->GetComponent(i, 0) < 0.99), "an element below the floor of 0.99");
    leftOff += shortfall->GetComponent(i, 0) == 2;
  }
  Expect(leftOff > 20, "a floor of 0.99 leaves nothing off the surface");
}

// Behind a good scaled Jacobian an edge may vanish, which is told of where a quality was asked for.
void TestShortEdges()
{
  // A sheet that is askew.
  const Mesh mesh = Sheet(8, 8, 1, Vec3(1, 1, 0.5));
  const double shear = 0.43;
  MovePoints(mesh.Grid, [shear](const Vec3& p) { return Vec3(p[0] + shear * p[1], p[1], p[2]); });
  const Vec3 place = mesh.Box.Centre + Vec3(shear * mesh.Box.Centre[1] - 0.01, 0, 0);
  const Surface cut = PlaneThrough(place, Vec3(std::cos(0.04), std::sin(0.04), 0), 40);
  TrimOptions options;
  options.Optimization = 0;
  const auto countShort = [&](double floor)
  {
    options.MinimumScaledJacobian = floor;
    const Outcome outcome = RunTrim(mesh, cut, options);
    ExpectWarned("short edges", outcome);
    return CountValues(outcome.Case.Trimmed->GetCellData()->GetArray("Shortfall"))[5];
  };
  const int count = countShort(0.2);
  Expect(count > 0 && count < 5, "short edges: " + std::to_string(count));
  Expect(countShort(0) == 0, "short edges are told of though no quality was asked for");
}

// A hole that reaches both borders at a corner leaves that as a part of its own; a small disc is
// no more, but all there is.
void TestLooseParts()
{
  const Mesh sheet = Sheet(12, 12, 2, Vec3(1, 1, 0.4));
  const auto countLoose = [&](double at, double radius, bool invert)
  {
    TrimOptions options;
    options.InvertSide = invert;
    const Outcome outcome = RunTrim(sheet, RoundHole(sheet, at, at, radius), options);
    ExpectWarned("loose part", outcome);
    return CountValues(outcome.Case.Trimmed->GetCellData()->GetArray("Shortfall"))[6];
  };
  Expect(countLoose(2.9, 3.2, false) == 2, "the corner that a hole leaves is not loose");
  Expect(countLoose(6.1, 1.6, false) == 0, "what is round a hole is loose");
  Expect(countLoose(6.1, 1.6, true) == 0, "a disc that is all there is, is loose");

  // Of a corner that a sphere leaves of a block the element is not at the cut itself, but beneath
  // an inserted layer.
  TrimOptions options;
  options.InvertSide = true;
  options.InsertLayer = true;
  const Outcome outcome = RunTrim(Block(10, 10, 10), SphereAt(Vec3(3.5, 3.5, -1.5), 5.0), options);
  const auto count = [&](const char* name, int value)
  { return CountValues(outcome.Case.Trimmed->GetCellData()->GetArray(name))[value]; };
  Expect(outcome.Clean() && count("Inserted", 1) > 3 && count("Shortfall", 6) == 4 &&
      CountWarned(outcome, ShortfallPhrases[6]) == 4,
    "an element in a corner is not loose with its layer");
}

// Between two holes that nearly touch facets of the usual length go from the one to the other, on
// both sides.
void TestWallToWall()
{
  const Mesh sheet = Sheet(14, 12, 2, Vec3(1, 1, 0.4));
  const Surface holes =
    Together(RoundHole(sheet, 6.81, 5.37, 2.57).Data, RoundHole(sheet, 0.908, 4.906, 2.75).Data);
  const Outcome outcome = RunTrim(sheet, holes, TrimOptions());
  const auto told = ExpectWarned("from hole to hole", outcome);
  Expect(told.count(Curved) && told.at(Curved) == 4, "facets that go from hole to hole");
}

// Elements that are inside out are not mended by the trim, but told of, and hold what they held.
void TestFolded()
{
  Mesh mesh = MakeMesh("sheet2");
  FoldElements(mesh.Grid);
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, Placement()), options);
  ExpectWarned("folded", outcome);
  const auto number = [&](const char* name) { return Number(outcome.Case.Trimmed, name); };
  Expect(number("TouchedElements") > 20 && number("CertifiedElements") == 0 &&
      CountWarned(outcome, ShortfallPhrases[4]) == number("TouchedElements"),
    "folded: touched elements");
  Expect(CountWarned(outcome, "elements of the offcut were inside out") > 20, "folded: offcut");
  // What a folded element holds is a matter of how it is seen, but most of it is there.
  const std::string before = "The volume of ";
  int lost = 0;
  for (const std::string& warning : outcome.Warnings)
  {
    const std::size_t at = warning.find(before);
    lost += at == std::string::npos ? 0 : std::atoi(&warning[at + before.size()]);
  }
  Expect(lost < 20, "folded: volume told as lost that is there");
}

// Elements without a volume have no share beyond the surface, and nothing else that is no number.
void TestFlat()
{
  Mesh mesh = MakeMesh("sheet2");
  MovePoints(mesh.Grid, [](const Vec3& p) { return Vec3(p[0], p[1], 0); });
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, Placement()), TrimOptions());
  vtkCellData* const cells = outcome.Case.Whole->GetCellData();
  vtkIdType stay = 0;
  for (vtkIdType c = 0; c < mesh.Grid->GetNumberOfCells(); ++c)
  {
    stay += cells->GetArray("ElementStatus")->GetComponent(c, 0) != 1;
    Expect(!std::isnan(cells->GetArray("EliminatedFraction")->GetComponent(c, 0)), "flat: a share");
  }
  Expect(outcome.Clean() && outcome.Case.Trimmed->GetNumberOfCells() == stay,
    "flat: " + std::to_string(outcome.Case.Trimmed->GetNumberOfCells()) + " elements stay, not " +
      std::to_string(stay));
}

// A face that ends above the sheet is nearer to nodes behind the cut than that is, but they are
// not left off it.
void TestBesideOtherEnd()
{
  const Mesh sheet = Sheet(20, 20, 1, Vec3(1, 1, 0.5));
  const Surface hole = Polyline({ Vec2(13.2, 9.68), Vec2(7.62, 8.84), Vec2(10.41, 12.47) });
  const Outcome alone = RunTrim(sheet, hole, TrimOptions());
  Expect(CountLeft(alone.Case.Trimmed) == 0, "beside no end: a node is left");
  for (const double y : { 6.0, 7.0, 9.5, 11.0, 12.5 })
  {
    const auto above = ToPolyData(Wall({ Vec2(-2, y), Vec2(22, y) }, Vec3(0, 0, 9.8)));
    const Outcome outcome = RunTrim(sheet, Together(hole.Data, above), TrimOptions());
    const std::string name = "beside the end of a face at " + std::to_string(y);
    ExpectWarned(name, outcome);
    Expect(CountLeft(outcome.Case.Trimmed) == 0 && !IsTold(outcome, LeftPhrase),
      name + ": nodes behind the cut are said to be left off it");
  }
}

// A cone past the corners of a hole of the model: nodes with no place to go.
void TestLeft()
{
  const Mesh mesh = MakeMesh("hole");
  Placement at;
  at.Seed = 3;
  at.Size = 0.45;
  const Surface surface = MakeSurface("cone", mesh.Box, at);
  const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
  ExpectWarned("left", outcome);
  Expect(CountWarned(outcome, LeftPhrase) > 0, "left: no node is");
  // What to ask for less of is named if it was asked for.
  TrimOptions withoutFloor;
  withoutFloor.MinimumScaledJacobian = 0;
  const Mesh block = Block(6, 6, 6);
  const Outcome valid =
    RunTrim(block, PlaneThrough(block.Box.Centre, Vec3(1, 0.9, 0.8), 30), withoutFloor);
  const char* const floor = "MinimumScaledJacobian";
  Expect(CountWarned(valid, LeftPhrase) > 0 && IsTold(outcome, floor) && !IsTold(valid, floor),
    "left: a floor is named where there is none");
  // A node beneath one that is left sticks out with it: it is none of the border's.
  const Outcome beneath =
    RunTrim(block, PlaneThrough(block.Box.Centre, Vec3(1, 1.8, -0.9), 30), TrimOptions());
  ExpectWarned("left beneath", beneath);
  Expect(IsTold(beneath, "of them of the new boundary"), "left: all are of the border");
  vtkUnstructuredGrid* grid = outcome.Case.Trimmed;
  vtkDataArray* left = grid->GetPointData()->GetArray("DistanceLeft");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const double distance = left->GetComponent(i, 0);
    double p[3];
    grid->GetPoint(i, p);
    const double real = std::abs(surface.Signed(Vec3(p[0], p[1], p[2])));
    Expect(distance == 0 || std::abs(distance - real) < 1e-5, "left: a wrong distance");
  }
}

// A tolerance of a quarter of an element lets nodes stay that make steps in the new boundary.
void TestCoarseTolerance()
{
  const Mesh sheet = Sheet(30, 20, 2, Vec3(1, 1, 0.4));
  const Surface surface = PlaneThrough(Vec3(15.1, 10.2, 0), Vec3(1, 0.2, 0), 200);
  TrimOptions options;
  Expect(CountWarned(RunTrim(sheet, surface, options), TolerancePhrase) == 0,
    "tolerance: an alarm for the default");
  options.Tolerance = 0.25 / std::sqrt(30.0 * 30 + 20 * 20 + 0.8 * 0.8);
  const Outcome outcome = RunTrim(sheet, surface, options);
  vtkUnstructuredGrid* grid = outcome.Case.Trimmed;
  vtkDataArray* status = grid->GetPointData()->GetArray("NodeStatus");
  int beside = 0;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    const double away = std::abs(surface.Signed(Vec3(grid->GetPoint(i))));
    beside += status->GetComponent(i, 0) == 2 && away > 0.05;
  }
  Expect(beside > 5 && CountWarned(outcome, TolerancePhrase) == beside,
    "tolerance: " + std::to_string(beside) + " nodes beside the surface, warned of " +
      std::to_string(CountWarned(outcome, TolerancePhrase)));
}

// Nodes within the tolerance are on the surface, though it meets none of their cells; of a sheet
// thinner than the tolerance all are, and where its middle lies decides.
void TestToleranceBeside()
{
  struct Beside
  {
    double Height; ///< of the plane; the sheet's reaches from -0.4 to 0.4
    double Tolerance;
    bool Below; ///< what the plane keeps
    vtkIdType Kept;
    vtkIdType OnSurface;
  };
  const vtkIdType cells = 2 * 12 * 10;
  const vtkIdType layer = 13 * 11;
  for (const Beside& beside :
    { Beside{ 0.42, 1e-9, true, cells, 0 }, Beside{ 0.42, 0.03, true, cells, layer },
      Beside{ 0.42, 0.5, true, cells, 2 * layer }, Beside{ -0.42, 0.03, false, cells, layer },
      Beside{ 0.42, 1.0, true, cells, 3 * layer }, Beside{ 0.1, 1.0, true, cells / 2, 2 * layer } })
  {
    const Mesh sheet = Sheet(12, 10, 2, Vec3(1, 1, 0.4));
    const Surface plane =
      PlaneThrough(Vec3(6, 5, beside.Height), Vec3(0, 0, beside.Below ? 1 : -1), 200);
    TrimOptions options;
    options.Tolerance = beside.Tolerance / std::sqrt(12.0 * 12 + 10 * 10 + 0.8 * 0.8);
    const Outcome outcome = RunTrim(sheet, plane, options);
    vtkUnstructuredGrid* grid = outcome.Case.Trimmed;
    vtkDataArray* status = grid->GetPointData()->GetArray("NodeStatus");
    vtkIdType on = 0;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      on += status->GetComponent(i, 0) == 2;
    }
    Expect(grid->GetNumberOfCells() == beside.Kept && on == beside.OnSurface,
      "tolerance " + std::to_string(beside.Tolerance) + " of a plane at " +
        std::to_string(beside.Height) + ": " + std::to_string(grid->GetNumberOfCells()) +
        " elements, " + std::to_string(on) + " nodes on the surface");
  }
}

// Of a block all nodes are within the tolerance, those too that are farther off than any ring of a
// band reaches.
void TestToleranceOfBlock()
{
  const Mesh block = Sheet(40, 4, 4, Vec3(1, 1, 1));
  const Surface plane = PlaneThrough(Vec3(1.3, 2, 0), Vec3(1, 0, 0), 200);
  TrimOptions options;
  options.Tolerance = 1.0;
  const Outcome outcome = RunTrim(block, plane, options);
  Expect(outcome.Errors.empty() && outcome.Case.Trimmed->GetNumberOfCells() == 4 * 4,
    "tolerance: elements of a block");
}

// Less than an element is cut off a corner: the corner's nodes move, and no element is there to
// take what they leave behind.
void TestCornerLost()
{
  const Mesh sheet = Sheet(30, 20, 2, Vec3(1, 1, 0.4));
  const Surface plane = PlaneThrough(Vec3(29.8, 19.8, 0), Vec3(1, 1, 0), 200);
  TrimOptions options;
  const Outcome without = RunTrim(sheet, plane, options);
  ExpectWarned("corner without the offcut", without);
  Expect(CountWarned(without, CornerPhrase) == 0, "a corner lost of an offcut nobody asked for");
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(sheet, plane, options);
  ExpectWarned("corner", outcome);
  Expect(CountWarned(outcome, CornerPhrase) == 3, "corner: not the three nodes of its edge");
  vtkUnstructuredGrid* whole = outcome.Case.Whole;
  vtkDataArray* lost = whole->GetPointData()->GetArray("CornerLost");
  for (vtkIdType i = 0; i < whole->GetNumberOfPoints(); ++i)
  {
    const Vec3 p(whole->GetPoint(i));
    const bool corner = p.x() > 29.9 && p.y() > 19.9;
    Expect((lost->GetComponent(i, 0) != 0) == corner,
      "corner: CornerLost of point " + std::to_string(i));
  }
  bool placed = false;
  for (const std::string& warning : outcome.Warnings)
  {
    placed = placed || warning.find("The first is at (30, 20, -0.4)") != std::string::npos;
  }
  Expect(placed,
    "corner: no place in the warning: " +
      (outcome.Warnings.empty() ? "" : outcome.Warnings.back()));
}
}

int main()
{
  TestOrdinary();
  TestDoubled();
  TestBesideEachOther();
  TestInclined();
  TestSmallHoles();
  TestAligned();
  TestLongChords();
  TestTallLayer();
  TestBesideEnd();
  TestBehindEnd();
  TestFlatLost();
  TestStretched();
  TestShortfalls();
  TestShortEdges();
  TestLooseParts();
  TestWallToWall();
  TestFolded();
  TestFlat();
  TestBesideOtherEnd();
  TestLeft();
  TestCornerLost();
  TestCoarseTolerance();
  TestToleranceBeside();
  TestToleranceOfBlock();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
