/**
 * @file TestTrimMistakes.cxx
 * @brief What a user may take for granted and is not so is told of: surfaces that were moved by
 * filters, other units, pieces of a mesh that were not merged; and what the arrays say there.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <utility>

using namespace judge;

namespace
{
const char* const MovedPhrase = "The polygons of the trimming surface do not lie on it";
const char* const SeamPhrase = "without common nodes";
constexpr double OpenSeam = 6;

bool Says(const std::vector<std::string>& texts, const std::string& phrase)
{
  for (const std::string& text : texts)
  {
    if (text.find(phrase) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

vtkSmartPointer<vtkPolyData> Shifted(vtkDataObject* surface, double x)
{
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->DeepCopy(vtkPolyData::SafeDownCast(surface));
  MovePoints(moved, [x](const Vec3& p) { return Vec3(p[0] + x, p[1], p[2]); });
  return moved;
}

// Transform and its like move the polygons, and the surface stays.
void TestMovedSurface()
{
  const Mesh mesh = MakeMesh("sheet2");
  // The polygons of a face with trim loops may show the whole of it.
  Surface face = MakeSurface("trimmedface", mesh.Box, Placement());
  Expect(!Says(RunTrim(mesh, face, TrimOptions()).Warnings, MovedPhrase),
    "moved: an alarm for a trimmed face as it was made");
  face.Data = Shifted(face.Data, 1000);
  Expect(Says(RunTrim(mesh, face, TrimOptions()).Warnings, MovedPhrase),
    "moved: a trimmed face: no word of it");
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  const Outcome expected = RunTrim(mesh, surface, TrimOptions());
  Expect(!Says(expected.Warnings, MovedPhrase), "moved: an alarm for a surface as it was made");
  const auto expectAlarm = [&](const std::string& what, vtkDataObject* data, bool alarm)
  {
    Surface given = surface;
    given.Data = data;
    const Outcome outcome = RunTrim(mesh, given, TrimOptions());
    Expect(outcome.Clean() && Says(outcome.Warnings, MovedPhrase) == alarm,
      "moved: " + what + (alarm ? ": no word of it" : ": an alarm"));
    Expect(FirstDifference(expected.Case.Trimmed, outcome.Case.Trimmed).empty(),
      "moved: " + what + ": another result");
  };
  expectAlarm("by an element", Shifted(surface.Data, mesh.Box.ElementSize), true);
  expectAlarm("by a hundredth of one", Shifted(surface.Data, 1e-2 * mesh.Box.ElementSize), true);
  expectAlarm("by rounding", Shifted(surface.Data, 1e-6 * mesh.Box.ElementSize), false);
  const auto bare = Shifted(surface.Data, mesh.Box.ElementSize);
  bare->SetPolys(nullptr);
  expectAlarm("no polygons", bare, false);
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, 2 });
  bare->SetStrips(strips);
  expectAlarm("strips of triangles", bare, true);
  vtkNew<vtkMultiBlockDataSet> group;
  group->SetBlock(0, Shifted(surface.Data, 100));
  expectAlarm("in a group", group, true);
  // One small face among others that are where they were.
  const Surface shell = MakeSurface("roundrect", mesh.Box, Placement());
  vtkNew<vtkMultiBlockDataSet> faces;
  faces->ShallowCopy(shell.Data);
  Surface given = shell;
  given.Data = faces;
  Expect(!Says(RunTrim(mesh, given, TrimOptions()).Warnings, MovedPhrase),
    "moved: an alarm for a shell as it was made");
  faces->SetBlock(3, Shifted(faces->GetBlock(3), 1.0));
  Expect(Says(RunTrim(mesh, given, TrimOptions()).Warnings, MovedPhrase),
    "moved: one face of a shell: no word of it");
  // As Append Geometry leaves two surfaces: the polygons of both, and the definition of one.
  const auto both = Shifted(surface.Data, 0);
  const vtkIdType count = both->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    both->GetPoint(i, p);
    both->GetPoints()->InsertNextPoint(p[0] + 5 * mesh.Box.ElementSize, p[1], p[2]);
  }
  expectAlarm("appended", both, true);
}

// A mesh in metres and a surface in millimetres.
void TestUnits()
{
  const char* const units = "set LengthUnit";
  MeshOptions inMetres;
  inMetres.Scale = 1e-3;
  const Mesh small = Sheet(20, 16, 2, Vec3(1, 1, 0.4), inMetres);
  const Outcome missed = RunTrim(small, PlaneThrough(Vec3(7, 5, 0), Vec3::UnitX(), 30), {});
  Expect(missed.Clean() && Says(missed.Warnings, "misses the grid") && Says(missed.Warnings, units),
    "units: a surface in millimetres misses a mesh in metres, and nothing is said of units");
  const Mesh large = Sheet(20, 16, 2, Vec3(1, 1, 0.4));
  const Outcome ends = RunTrim(large, PlaneThrough(Vec3(7.2, 5, 0), Vec3::UnitX(), 0.05), {});
  Expect(Says(ends.Errors, "ends inside the grid") && Says(ends.Errors, units),
    "units: a surface in metres ends in a mesh in millimetres, and nothing is said of units");
  const Outcome same = RunTrim(large, PlaneThrough(Vec3(-3, 8, 0), Vec3::UnitX(), 100), {});
  Expect(Says(same.Warnings, "misses the grid") && !Says(same.Warnings, units),
    "units: an alarm where they are the same");
}

// Cells that are open along a seam where a plane goes through, each with a face at the seam.
int CountAtSeam(const std::string& name, const Mesh& mesh, const Vec3& origin, const Vec3& normal,
  int axis, double place)
{
  const Outcome outcome = RunTrim(mesh, PlaneThrough(origin, normal, 60), TrimOptions());
  vtkUnstructuredGrid* grid = outcome.Case.Whole;
  vtkDataArray* feasibility = grid->GetCellData()->GetArray("Feasibility");
  int found = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    double box[6];
    grid->GetCellBounds(c, box);
    const bool atSeam = box[2 * axis] == place || box[2 * axis + 1] == place;
    Expect(feasibility->GetComponent(c, 0) != OpenSeam || atSeam, name + ": a cell elsewhere");
    found += feasibility->GetComponent(c, 0) == OpenSeam;
  }
  Expect(outcome.Clean() && CountWarned(outcome, SeamPhrase) == found,
    name + ": " + std::to_string(found) + " cells, warned of " +
      std::to_string(CountWarned(outcome, SeamPhrase)));
  return found;
}

// Pieces beside each other whose nodes were not merged; on each other they are two sheets.
void TestSeam()
{
  const auto count = [](const Vec3& shift)
  {
    return CountAtSeam(
      "seam", TwoSheets(15, 20, 2, 0.5, shift), Vec3(15, 10.3, 0.5), Vec3(0.1, 1, 0), 0, 15);
  };
  const int found = count(Vec3(15, 0, 0));
  Expect(found >= 4, "seam: " + std::to_string(found) + " cells");
  Expect(count(Vec3(0, 0, 1)) == 0 && count(Vec3(15.5, 0, 0)) == 0,
    "seam: an alarm where there is none");
}

// Bricks of a mesh: nodes at the same place are the same unless they are of another part.
class Bricks
{
public:
  void Add(const Vec3& low, const Vec3& high, const Vec3& size)
  {
    for (double z = low[2]; z < high[2]; z += size[2])
    {
      for (double y = low[1]; y < high[1]; y += size[1])
      {
        for (double x = low[0]; x < high[0]; x += size[0])
        {
          this->AddOne(Vec3(x, y, z), Vec3(x, y, z) + size);
        }
      }
    }
  }

  // Bricks from here on have nodes of their own, but for those at places that are glued.
  void BeginPart(std::function<bool(const Vec3&)> isGlued)
  {
    ++this->Part;
    this->IsGlued = std::move(isGlued);
  }

  // In a frame of a sheet for PlaneThrough.
  Mesh ToMesh() const
  {
    Mesh mesh = Sheet(16, 16, 1, Vec3(1, 1, 0.5));
    mesh.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    mesh.Grid->DeepCopy(this->Grid);
    mesh.Grid->SetPoints(this->Points);
    return mesh;
  }

private:
  void AddOne(const Vec3& low, const Vec3& high)
  {
    const Vec3 ends[] = { low, high };
    vtkIdType nodes[8];
    for (int i = 0; i < 8; ++i)
    {
      const bool right = i % 4 == 1 || i % 4 == 2, back = i % 4 > 1;
      nodes[i] = this->Number(Vec3(ends[right][0], ends[back][1], ends[i / 4][2]));
    }
    this->Grid->InsertNextCell(VTK_HEXAHEDRON, 8, nodes);
  }

  vtkIdType Number(const Vec3& at)
  {
    const int part = this->Part > 0 && this->IsGlued(at) ? 0 : this->Part;
    const auto found =
      this->Numbers.try_emplace({ at[0], at[1], at[2] + 100 * part }, this->Numbers.size());
    return found.second ? this->Points->InsertNextPoint(at.data()) : found.first->second;
  }

  vtkNew<vtkUnstructuredGrid> Grid;
  vtkNew<vtkPoints> Points;
  std::map<std::array<double, 3>, vtkIdType> Numbers;
  int Part = 0;
  std::function<bool(const Vec3&)> IsGlued;
};

// One layer of squares, of size 1 up to x = 8 and of half the size beyond: every other node of the
// small ones hangs on a side of the large ones.
void TestHangingNodes()
{
  Bricks bricks;
  bricks.Add(Vec3(0, 0, 0), Vec3(8, 16, 0.5), Vec3(1, 1, 0.5));
  bricks.Add(Vec3(8, 0, 0), Vec3(16, 16, 0.5), Vec3(0.5, 0.5, 0.5));
  const Mesh mesh = bricks.ToMesh();
  const auto count = [&mesh](const Vec3& origin, const Vec3& normal)
  { return CountAtSeam("hanging nodes", mesh, origin, normal, 0, 8); };
  Expect(count(Vec3(8.3, 8.1, 0), Vec3(0.3, 1, 0)) >= 2, "hanging nodes: no word of them");
  Expect(count(Vec3(4.3, 8, 0), Vec3::UnitX()) == 0, "hanging nodes: an alarm elsewhere");

  // Three small ones beside each large one: the middle of the outer ones lies on that, and not the
  // other way round.
  Bricks thirds;
  thirds.Add(Vec3(0, 0, 0), Vec3(9, 15, 0.5), Vec3(1.5, 1.5, 0.5));
  thirds.Add(Vec3(9, 0, 0), Vec3(15, 15, 0.5), Vec3(0.5, 0.5, 0.5));
  const int found =
    CountAtSeam("hanging nodes", thirds.ToMesh(), Vec3(9, 7.25, 0), Vec3::UnitY(), 0, 9);
  Expect(found == 2, "hanging nodes: " + std::to_string(found) + " elements of two sizes, not 2");
}

// A sheet on another one, at z = 1, of elements of its own size, glued to it where it is said.
int CountOnSheet(
  const std::string& name, const Vec3& size, const std::function<bool(const Vec3&)>& isGlued)
{
  Bricks bricks;
  bricks.Add(Vec3(0, 0, 0), Vec3(16, 16, 1), Vec3(1, 1, 1));
  bricks.BeginPart(isGlued);
  bricks.Add(Vec3(0, 0, 1), Vec3(16, 16, 2), size);
  return CountAtSeam(name, bricks.ToMesh(), Vec3(8.3, 8.1, 1), Vec3(0.3, 1, 0), 2, 1);
}

// Skins of sheets may lie on each other, glued at some nodes as by welds too, but for nodes that
// hang between those that are the same.
void TestHangingOnSkin()
{
  const Vec3 fine(0.5, 0.5, 0.5);
  const auto nowhere = [](const Vec3&) { return false; };
  const auto atInterface = [](const Vec3& at) { return at[2] == 1; };
  const auto atWelds = [](const Vec3& at)
  { return at[2] == 1 && std::fmod(at[0], 4) == 0 && std::fmod(at[1], 2) == 0; };
  const int hanging = CountOnSheet("two fine layers on a coarse one", fine, atInterface);
  // Each row of 16 large elements is cut once or more, and two rows of small ones are.
  Expect(hanging >= 16 + 32, "two fine layers on a coarse one: " + std::to_string(hanging));
  Expect(CountOnSheet("fine layers that touch a coarse one", fine, nowhere) == 0 &&
      CountOnSheet("sheets that touch", Vec3(1, 1, 0.5), nowhere) == 0 &&
      CountOnSheet("sheets that are welded", Vec3(1, 1, 0.5), atWelds) == 0 &&
      CountOnSheet("sheets that are one", Vec3(1, 1, 0.5), atInterface) == 0,
    "on a skin: an alarm where nothing hangs");
}

// A wall of two fine layers that stands on a sheet, or beside the side of a block of large
// elements.
void TestHangingBesideSkin()
{
  for (const double size : { 1.0, 0.5 })
  {
    Bricks tee;
    tee.Add(Vec3(0, 0, 0), Vec3(16, 16, 1), Vec3(1, 1, 1));
    tee.Add(Vec3(7, 0, 1), Vec3(8, 16, 9), Vec3(size, size, 1));
    const int found =
      CountAtSeam("a wall on a sheet", tee.ToMesh(), Vec3(8, 8.1, 1), Vec3(0.05, 1, 0), 2, 1);
    Expect((found > 0) == (size < 1), "a wall on a sheet: " + std::to_string(found));
    Bricks beside;
    beside.Add(Vec3(0, 0, 0), Vec3(8, 16, 8), Vec3(1, 1, 1));
    beside.Add(Vec3(8, 0, 0), Vec3(8 + 2 * size, 16, 8), Vec3(size, size, 1));
    const int along =
      CountAtSeam("a wall at a block", beside.ToMesh(), Vec3(8, 8.1, 1), Vec3(0.05, 1, 0), 0, 8);
    Expect((along > 0) == (size < 1), "a wall at a block: " + std::to_string(along));
  }
}

// An element that is in the mesh twice.
void TestRepeated()
{
  Mesh mesh = Sheet(20, 16, 2, Vec3(1, 1, 0.4));
  const Surface plane = PlaneThrough(Vec3(7.2, 5, 0), Vec3::UnitX(), 800);
  const vtkIdType cell = 7; // at the cut
  vtkNew<vtkIdList> nodes;
  mesh.Grid->GetCellPoints(cell, nodes);
  vtkNew<vtkUnstructuredGrid> twice;
  twice->DeepCopy(mesh.Grid);
  twice->GetCellData()->Initialize();
  twice->InsertNextCell(VTK_HEXAHEDRON, nodes);
  mesh.Grid = twice;
  const Outcome outcome = RunTrim(mesh, plane, TrimOptions());
  Expect(outcome.Errors.size() == 1 && Says(outcome.Errors, "have the same nodes") &&
      !Says(outcome.Errors, "LengthUnit") && outcome.Case.Trimmed->GetNumberOfCells() == 0,
    "repeated: not one error: " + (outcome.Errors.empty() ? "none" : outcome.Errors[0]));

  // Numbers in messages are those of the input, where ghost cells before them are left out too.
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(twice->GetNumberOfCells());
  ghosts->FillComponent(0, 0);
  for (const vtkIdType ghost : { 0, 1, 2 })
  {
    ghosts->SetValue(ghost, vtkDataSetAttributes::DUPLICATECELL);
  }
  twice->GetCellData()->AddArray(ghosts);
  const std::string text =
    "Cells 7 and " + std::to_string(twice->GetNumberOfCells() - 1) + " of the grid";
  Expect(Says(RunTrim(mesh, plane, TrimOptions()).Errors, text), "repeated: other cells are named");
}

/// The cell that a warning names; -1: none.
vtkIdType NamedCell(const Outcome& outcome, const std::string& phrase)
{
  const std::string before = "The first (cell ";
  for (const std::string& warning : outcome.Warnings)
  {
    const std::size_t start = warning.find(before);
    if (warning.find(phrase) != std::string::npos && start != std::string::npos)
    {
      return std::atoi(&warning[start + before.size()]);
    }
  }
  return -1;
}

// Cells that are left out by their flags are told of, and count where others are named.
void TestHidden()
{
  Mesh mesh = MakeMesh("sheet2");
  const Surface plane = MakeSurface("plane", mesh.Box, Placement());
  vtkNew<vtkUnstructuredGrid> flagged;
  flagged->DeepCopy(mesh.Grid);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(flagged->GetNumberOfCells());
  ghosts->FillComponent(0, 0);
  ghosts->SetValue(3, vtkDataSetAttributes::HIDDENCELL);
  ghosts->SetValue(4, vtkDataSetAttributes::REFINEDCELL);
  ghosts->SetValue(9, vtkDataSetAttributes::DUPLICATECELL);
  flagged->GetCellData()->AddArray(ghosts);
  mesh.Grid = flagged;
  const Outcome outcome = RunTrim(mesh, plane, TrimOptions());
  Expect(CountWarned(outcome, "cells of the grid are flagged as hidden") == 3,
    "hidden cells: left out without a word");

  constexpr vtkIdType leftOut = 3;
  const auto expectNamed =
    [&](const std::string& phrase, const Outcome& trimmed, const char* array, int value)
  {
    const vtkIdType named = NamedCell(trimmed, phrase);
    vtkDataArray* const found = trimmed.Case.Whole->GetCellData()->GetArray(array);
    Expect(named > 9 && found->GetComponent(named - leftOut, 0) == value,
      "hidden cells: another cell is named that is " + phrase);
  };
  // Flags of points alone leave out nothing, and are in no output either.
  vtkNew<vtkUnsignedCharArray> ofPoints;
  ofPoints->SetName(vtkDataSetAttributes::GhostArrayName());
  ofPoints->SetNumberOfTuples(flagged->GetNumberOfPoints());
  ofPoints->FillComponent(0, vtkDataSetAttributes::DUPLICATEPOINT);
  Mesh shared = MakeMesh("sheet2");
  shared.Grid->GetPointData()->AddArray(ofPoints);
  const Outcome whole = RunTrim(shared, plane, TrimOptions());
  Expect(whole.Clean() && whole.Warnings.empty() &&
      whole.Case.Whole->GetNumberOfCells() == shared.Grid->GetNumberOfCells() &&
      !whole.Case.Trimmed->GetPointData()->HasArray(vtkDataSetAttributes::GhostArrayName()) &&
      !whole.Case.Whole->GetPointData()->HasArray(vtkDataSetAttributes::GhostArrayName()),
    "hidden cells: flags of points");

  const Surface hole = RoundHole(mesh, 15.2, 10.3, 1.3);
  expectNamed("narrower than three", RunTrim(mesh, hole, TrimOptions()), "Feasibility", 3);
  FoldElements(flagged);
  expectNamed("inside out", RunTrim(mesh, plane, TrimOptions()), "Shortfall", 4);
}

// Inserted elements have the arrays of those on which they stand, but no two cells one global id.
void TestInserted()
{
  const Mesh mesh = MakeMesh("block");
  Placement at;
  at.Angle = 0.7;
  at.Lean = 0.6;
  const Surface plane = MakeSurface("plane", mesh.Box, at);
  for (const bool layer : { false, true })
  {
    TrimOptions options;
    options.InsertLayer = layer;
    const Outcome outcome = RunTrim(mesh, plane, options);
    vtkUnstructuredGrid* grid = outcome.Case.Trimmed;
    const std::string name = layer ? "inserted: " : "nothing inserted: ";
    Expect((grid->GetCellData()->GetGlobalIds() == nullptr) == layer, name + "global cell ids");
    Expect((grid->GetPointData()->GetGlobalIds() == nullptr) == layer, name + "global point ids");
    const char* const ids = mesh.Grid->GetCellData()->GetGlobalIds()->GetName();
    Expect(grid->GetCellData()->GetArray(ids) != nullptr, name + "the array of ids is lost");
    vtkDataArray* own = grid->GetCellData()->GetArray("Rescue");
    vtkDataArray* whole = outcome.Case.Whole->GetCellData()->GetArray("Rescue");
    vtkDataArray* origin = grid->GetCellData()->GetArray("vtkOriginalCellIds");
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      Expect(own->GetComponent(c, 0) ==
          whole->GetComponent(static_cast<vtkIdType>(origin->GetComponent(c, 0)), 0),
        name + "another Rescue on port 0");
    }
    vtkDataArray* distance = grid->GetPointData()->GetArray("SignedDistance");
    vtkDataArray* before = outcome.Case.Whole->GetPointData()->GetArray("SignedDistance");
    origin = grid->GetPointData()->GetArray("vtkOriginalPointIds");
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      const double mine = distance->GetComponent(p, 0);
      const double input =
        before->GetComponent(static_cast<vtkIdType>(origin->GetComponent(p, 0)), 0);
      Expect(mine == input || (std::isnan(mine) && std::isnan(input)), name + "another distance");
    }
  }
  // Where none is needed none is inserted, and ids stay ids.
  TrimOptions options;
  options.InsertLayer = true;
  const Outcome straight =
    RunTrim(mesh, PlaneThrough(mesh.Box.Centre + Vec3(0.3, 0, 0), Vec3::UnitX(), 60), options);
  Expect(straight.Case.Trimmed->GetCellData()->GetGlobalIds() &&
      straight.Case.Trimmed->GetPointData()->GetGlobalIds(),
    "nothing to insert: global ids are none");
}

// What is below the floor is told of, also where a node was left off the surface.
void TestShortfallOfOffcut()
{
  const Mesh mesh = Block(12, 12, 12);
  Placement at;
  at.Angle = 0.7;
  at.Lean = 0.6;
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, at), options);
  vtkDataArray* quality = outcome.Offcut->GetCellData()->GetArray("ScaledJacobian");
  vtkDataArray* shortfall = outcome.Offcut->GetCellData()->GetArray("Shortfall");
  int below = 0;
  for (vtkIdType c = 0; c < quality->GetNumberOfTuples(); ++c)
  {
    const bool isBelow = quality->GetComponent(c, 0) < options.MinimumScaledJacobian;
    below += isBelow;
    const double told = shortfall->GetComponent(c, 0);
    Expect(!isBelow || (told != 0 && told != 2), "offcut: an element below the floor");
  }
  std::printf("elements of the offcut below the floor: %d\n", below);
  Expect(below > 0, "offcut: no element is below the floor");
}
}

int main()
{
  TestMovedSurface();
  TestUnits();
  TestSeam();
  TestHangingNodes();
  TestHangingOnSkin();
  TestHangingBesideSkin();
  TestRepeated();
  TestHidden();
  TestInserted();
  TestShortfallOfOffcut();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
