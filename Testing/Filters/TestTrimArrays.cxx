/**
 * @file TestTrimArrays.cxx
 * @brief What the filter does with the input's arrays and with the input itself.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkBoundingBox.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSOADataArrayTemplate.h>
#include <vtkStringArray.h>
#include <vtkTrimHexahedralGrid.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

using namespace judge;

namespace
{
void TestInputUntouched(const Mesh& mesh, const Surface& surface)
{
  vtkNew<vtkUnstructuredGrid> before;
  before->DeepCopy(mesh.Grid);
  const vtkMTimeType time = mesh.Grid->GetMTime();
  for (int correction = 1; correction <= 3; ++correction)
  {
    TrimOptions options;
    options.CorrectionType = correction;
    RunTrim(mesh, surface, options);
    const std::string difference = FirstDifference(before, mesh.Grid);
    Expect(difference.empty(), mesh.Name + ": the input has changed: " + difference);
    Expect(mesh.Grid->GetMTime() == time, mesh.Name + ": the input says it has changed");
  }
}

// Arrays without attributes, names of the filter's own, ghosts, no arrays at all.
void TestUnusual(Mesh mesh, const Surface& surface)
{
  Report report("arrays unusual");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkFloatArray> own;
  own->SetName("NodeStatus");
  own->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < mesh.Grid->GetNumberOfPoints(); ++i)
  {
    ghosts->InsertNextValue(0);
    own->InsertNextTuple2(7, 8);
  }
  mesh.Grid->GetPointData()->AddArray(ghosts);
  mesh.Grid->GetPointData()->AddArray(own);
  RunAndJudge(mesh, surface, TrimOptions(), report);

  mesh.Grid->GetPointData()->Initialize();
  mesh.Grid->GetCellData()->Initialize();
  mesh.Grid->GetFieldData()->Initialize();
  const Outcome bare = RunAndJudge(mesh, surface, TrimOptions(), report);
  Expect(bare.Case.Trimmed->GetPointData()->GetNumberOfArrays() >= 5, "arrays: some are missing");
  Wrong += report.Failures();
}

template <typename Array>
void AddFilled(
  vtkFieldData* data, const char* name, vtkIdType count, double value, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  array->Fill(value);
  data->AddArray(array);
}

bool IsFilled(vtkFieldData* data, const char* name, double value)
{
  vtkDataArray* array = data->GetArray(name);
  bool filled = array != nullptr && array->GetNumberOfTuples() > 0;
  for (vtkIdType i = 0; filled && i < array->GetNumberOfTuples(); ++i)
  {
    filled = array->GetComponent(i, 0) == value;
  }
  return filled;
}

// What a solver calls as the trim calls its own is told of and taken along under another name.
void TestNameClashes(Mesh mesh, const Surface& surface)
{
  vtkUnstructuredGrid* grid = mesh.Grid;
  AddFilled<vtkFloatArray>(grid->GetPointData(), "Displacement", grid->GetNumberOfPoints(), 3.5);
  AddFilled<vtkFloatArray>(grid->GetCellData(), "ScaledJacobian", grid->GetNumberOfCells(), 0.77);
  AddFilled<vtkFloatArray>(grid->GetFieldData(), "Volume", 1, 12);
  AddFilled<vtkIdTypeArray>(
    grid->GetCellData(), "vtkOriginalCellIds", grid->GetNumberOfCells(), 630);
  grid->GetPointData()->SetActiveScalars("Displacement");
  const auto unit = vtkDataArray::UNITS_LABEL();
  grid->GetPointData()->GetScalars()->GetInformation()->Set(unit, "mm");
  TrimOptions options;
  options.MapValues = true;
  options.ProduceOffcut = true;
  // Two roles of one array.
  vtkDataArray* const ids = grid->GetCellData()->GetGlobalIds();
  grid->GetCellData()->SetActiveScalars(ids->GetName());
  const Outcome outcome = RunTrim(mesh, surface, options);
  Expect(outcome.Case.Trimmed->GetCellData()->GetGlobalIds() &&
      outcome.Case.Trimmed->GetCellData()->GetGlobalIds() ==
        outcome.Case.Trimmed->GetCellData()->GetScalars(),
    "names: an array has lost a role");
  Expect(IsFilled(outcome.Offcut->GetFieldData(), "InputVolume", 12), "names: of the offcut");
  Expect(outcome.Warnings.size() == 1 &&
      outcome.Warnings.front().find("Displacement (points), ScaledJacobian (cells), Volume") !=
        std::string::npos,
    "names: not one warning of all arrays");
  for (vtkUnstructuredGrid* output : { outcome.Case.Trimmed, outcome.Case.Whole })
  {
    Expect(IsFilled(output->GetPointData(), "InputDisplacement", 3.5), "names: of points");
    Expect(IsFilled(output->GetCellData(), "InputScaledJacobian", 0.77f), "names: of cells");
    Expect(IsFilled(output->GetFieldData(), "InputVolume", 12), "names: of the field data");
    Expect(IsFilled(output->GetCellData(), "InputvtkOriginalCellIds", 630), "names: ids");
    vtkDataArray* scalars = output->GetPointData()->GetScalars();
    Expect(scalars && std::string(scalars->GetName()) == "InputDisplacement",
      "names: other scalars are active");
    Expect(scalars && scalars->GetInformation()->Has(unit), "names: the unit is lost");
    Expect(output->GetPointData()->GetArray("Displacement")->GetNumberOfComponents() == 3,
      "names: no displacement of the trim's own");
  }
  Expect(IsFilled(grid->GetPointData(), "Displacement", 3.5), "names: the input has changed");
}

// A new name that is taken too is made longer; field data may be all that clashes.
void TestOtherClashes(Mesh mesh, const Surface& surface)
{
  vtkUnstructuredGrid* grid = mesh.Grid;
  AddFilled<vtkFloatArray>(grid->GetFieldData(), "Volume", 1, 12);
  const Outcome alone = RunTrim(mesh, surface, TrimOptions());
  Expect(IsFilled(alone.Case.Trimmed->GetFieldData(), "InputVolume", 12) &&
      IsFilled(alone.Case.Whole->GetFieldData(), "InputVolume", 12) && alone.Warnings.size() == 1,
    "names: of the field data alone");
  // One of an earlier trim does not make it one.
  AddFilled<vtkUnsignedCharArray>(grid->GetPointData(), "NodeStatus", grid->GetNumberOfPoints(), 2);
  AddFilled<vtkFloatArray>(grid->GetPointData(), "Displacement", grid->GetNumberOfPoints(), 3.5);
  AddFilled<vtkFloatArray>(
    grid->GetPointData(), "InputDisplacement", grid->GetNumberOfPoints(), 4.5);
  const Outcome both = RunTrim(mesh, surface, TrimOptions());
  Expect(IsFilled(both.Case.Trimmed->GetPointData(), "InputInputDisplacement", 3.5) &&
      IsFilled(both.Case.Trimmed->GetPointData(), "InputDisplacement", 4.5),
    "names: of two arrays one is lost");
  Expect(IsFilled(both.Case.Trimmed->GetPointData(), "InputNodeStatus", 2),
    "names: a status of the user's own is lost");
}

// What the input is coloured by it stays coloured by; else it is by the statuses of the elements.
void TestActiveScalars(const Mesh& mesh, const Surface& surface)
{
  for (const char* asked : { "Thickness", "ElementStatus" })
  {
    Mesh coloured = mesh;
    coloured.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    coloured.Grid->ShallowCopy(mesh.Grid);
    vtkCellData* const data = coloured.Grid->GetCellData();
    AddFilled<vtkFloatArray>(data, "Thickness", coloured.Grid->GetNumberOfCells(), 0.8);
    coloured.Grid->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::SCALARS);
    data->SetActiveAttribute(-1, vtkDataSetAttributes::SCALARS);
    data->SetActiveScalars(asked);
    TrimOptions options;
    options.ProduceOffcut = true;
    const Outcome outcome = RunTrim(coloured, surface, options);
    for (vtkUnstructuredGrid* output :
      { outcome.Case.Trimmed.Get(), outcome.Case.Whole.Get(), outcome.Offcut.Get() })
    {
      vtkDataArray* const scalars = output->GetCellData()->GetScalars();
      Expect(
        scalars && std::string(scalars->GetName()) == asked, std::string("scalars: not ") + asked);
    }
  }
}

// The quality is that of all elements if that is asked for, and else that of those at the cut.
void TestQualityOfAll(const Mesh& mesh, const Surface& surface)
{
  std::array<vtkSmartPointer<vtkDataArray>, 2> qualities;
  for (const bool all : { false, true })
  {
    vtkNew<vtkTrimHexahedralGrid> filter;
    filter->SetInputDataObject(0, mesh.Grid);
    filter->SetInputDataObject(1, surface.Data);
    filter->SetQualityOfAllElements(all);
    filter->Update();
    auto* const trimmed = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
    qualities[all] = trimmed->GetCellData()->GetArray("ScaledJacobian");
  }
  vtkIdType without = 0, missing = 0, differ = 0;
  for (vtkIdType c = 0; c < qualities[0]->GetNumberOfTuples(); ++c)
  {
    const double some = qualities[0]->GetComponent(c, 0), every = qualities[1]->GetComponent(c, 0);
    without += std::isnan(some);
    missing += std::isnan(every);
    differ += !std::isnan(some) && some != every;
  }
  Expect(without > 0 && missing == 0 && differ == 0,
    "quality of all: " + std::to_string(missing) + " elements without");
}

// The outputs are of the later of the inputs' times.
void TestTime(const Mesh& mesh, const Surface& surface)
{
  const auto key = vtkDataObject::DATA_TIME_STEP();
  for (const auto& [ofGrid, ofSurface] : { std::pair(1.5, 4.0), { 4.0, 1.5 } })
  {
    mesh.Grid->GetInformation()->Set(key, ofGrid);
    surface.Data->GetInformation()->Set(key, ofSurface);
    const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
    for (vtkUnstructuredGrid* output : { outcome.Case.Trimmed.Get(), outcome.Case.Whole.Get() })
    {
      vtkInformation* const information = output->GetInformation();
      Expect(information->Has(key) && information->Get(key) == 4.0, "time: not the later one");
    }
  }
}

// What an earlier trim has written is no clash, and nothing of it stays that the next one does not
// write.
void TestNamesOfEarlierTrim(const Mesh& mesh, const Surface& surface)
{
  TrimOptions options;
  options.InsertLayer = true;
  Mesh next = mesh;
  next.Grid = RunTrim(mesh, surface, options).Case.Trimmed;
  AddFilled<vtkUnsignedCharArray>(
    next.Grid->GetCellData(), "Inserted", next.Grid->GetNumberOfCells(), 1);
  options.InsertLayer = false;
  Placement at;
  at.X = 0.31;
  const Outcome outcome = RunTrim(next, MakeSurface("plane", mesh.Box, at), options);
  Expect(outcome.Warnings.empty(), "names: a warning of an earlier trim's arrays");
  Expect(!outcome.Case.Trimmed->GetCellData()->HasArray("Inserted"), "names: Inserted is stale");
  Expect(!outcome.Case.Trimmed->GetPointData()->HasArray("InputDisplacement"),
    "names: an earlier trim's displacement stays");

  // Filters between the two may have dropped the field data.
  vtkNew<vtkUnstructuredGrid> filtered;
  filtered->ShallowCopy(next.Grid);
  filtered->GetFieldData()->Initialize();
  Mesh bare = next;
  bare.Grid = filtered;
  const Outcome ofBare = RunTrim(bare, MakeSurface("plane", mesh.Box, at), options);
  Expect(
    ofBare.Warnings.empty() && !ofBare.Case.Trimmed->GetPointData()->HasArray("InputDisplacement"),
    "names: an earlier trim without field data is none");

  // A solver has written its own in between, of another type or of other components.
  for (const auto& [isDouble, components] : { std::pair(true, 3), { true, 1 }, { false, 1 } })
  {
    vtkPointData* data = next.Grid->GetPointData();
    const vtkIdType count = next.Grid->GetNumberOfPoints();
    data->RemoveArray("Displacement");
    const auto add = isDouble ? AddFilled<vtkDoubleArray> : AddFilled<vtkFloatArray>;
    add(data, "Displacement", count, 7, components);
    const Outcome solved = RunTrim(next, MakeSurface("plane", mesh.Box, at), options);
    Expect(IsFilled(solved.Case.Trimmed->GetPointData(), "InputDisplacement", 7) &&
        solved.Warnings.size() == 1,
      "names: a solver's displacement is lost after an earlier trim");
  }
}

// An array of the input is not taken for an earlier trim's, though that had none to write.
void TestInsertedOfInput(const Mesh& mesh, const Surface& surface)
{
  Mesh next = mesh;
  next.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  next.Grid->ShallowCopy(mesh.Grid);
  AddFilled<vtkUnsignedCharArray>(
    next.Grid->GetCellData(), "Inserted", next.Grid->GetNumberOfCells(), 5);
  Placement at;
  at.X = 0.31;
  for (const Surface& by : { surface, MakeSurface("plane", mesh.Box, at) })
  {
    next.Grid = RunTrim(next, by, TrimOptions()).Case.Trimmed;
    Expect(IsFilled(next.Grid->GetCellData(), "InputInserted", 5), "names: Inserted is lost");
  }
}

// Points and data that come as an array for each component are taken as they are.
template <typename Value>
void TestOtherLayout(const std::string& name)
{
  const Mesh mesh = MakeMesh(name);
  const Surface surface = MakeSurface("contour", mesh.Box, Placement());
  const Outcome expected = RunTrim(mesh, surface, TrimOptions());
  const auto layOut = [](vtkDataArray* given)
  {
    vtkNew<vtkSOADataArrayTemplate<Value>> array;
    array->SetNumberOfComponents(given->GetNumberOfComponents());
    array->DeepCopy(given);
    return vtkSmartPointer<vtkDataArray>(array);
  };
  Mesh other = mesh;
  other.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  other.Grid->ShallowCopy(mesh.Grid);
  vtkNew<vtkPoints> points;
  points->SetData(layOut(mesh.Grid->GetPoints()->GetData()));
  other.Grid->SetPoints(points);
  const auto tuples = layOut(mesh.Grid->GetPoints()->GetData());
  tuples->SetName("ByComponent");
  other.Grid->GetPointData()->AddArray(tuples);
  Outcome outcome = RunTrim(other, surface, TrimOptions());
  Expect(outcome.Clean(), name + ": points by component are refused");
  auto* taken = outcome.Case.Trimmed->GetPointData()->GetArray("ByComponent");
  Expect(taken && taken->GetNumberOfTuples() == outcome.Case.Trimmed->GetNumberOfPoints(),
    name + ": data by component are lost");
  for (vtkUnstructuredGrid* grid : { outcome.Case.Trimmed.Get(), outcome.Case.Whole.Get() })
  {
    grid->GetPointData()->RemoveArray("ByComponent");
  }
  const std::string difference = FirstDifference(expected.Case.Trimmed, outcome.Case.Trimmed);
  Expect(difference.empty(), name + ": points by component: " + difference);
}

// Gives a grid its cells in the reverse order, in arrays of their own.
void ReverseCells(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = grid->GetNumberOfCells(); c-- > 0;)
  {
    grid->GetCellPoints(c, nodes);
    cells->InsertNextCell(nodes);
    types->InsertNextValue(static_cast<unsigned char>(grid->GetCellType(c)));
  }
  grid->SetCells(types, cells);
}

// Adds a copy of one tuple to all arrays.
void RepeatTuple(vtkDataSetAttributes* data, vtkIdType tuple)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    data->GetAbstractArray(i)->InsertNextTuple(tuple, data->GetAbstractArray(i));
  }
}

// Adds a copy of the first cell, with nodes of its own beyond the last ones, in the arrays that
// there are: they grow.
void GrowByOneCell(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(0, nodes);
  vtkPoints* const points = grid->GetPoints();
  const vtkBoundingBox box(grid->GetBounds());
  for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
  {
    Vec3 place;
    points->GetPoint(nodes->GetId(i), place.data());
    place[1] += 2 * box.GetLength(1);
    RepeatTuple(grid->GetPointData(), nodes->GetId(i));
    nodes->SetId(i, points->InsertNextPoint(place.data()));
  }
  grid->InsertNextCell(grid->GetCellType(0), nodes);
  RepeatTuple(grid->GetCellData(), 0);
}

// What a filter remembers of its inputs it forgets when they change, though they are the same
// objects, and what it said of them.
void TestChangedInPlace(Mesh mesh)
{
  const Surface surface = MakeSurface("plane", mesh.Box, Placement());
  vtkUnstructuredGrid* const grid = mesh.Grid;
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, grid);
  filter->SetInputDataObject(1, surface.Data);
  const auto check = [&](const std::string& what)
  {
    const Listener listener;
    filter->Update();
    const std::vector<std::string> warnings = listener.Warnings();
    const Outcome expected = RunTrim(mesh, surface, TrimOptions());
    auto* const trimmed = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
    const std::string difference = FirstDifference(expected.Case.Trimmed, trimmed);
    Expect(expected.Clean() && trimmed->GetNumberOfCells() > 0 && difference.empty(),
      "changed in place: " + what + ": " + difference);
    Expect(warnings.size() == expected.Warnings.size(),
      "changed in place: " + what + ": " + std::to_string(warnings.size()) + " warnings, not " +
        std::to_string(expected.Warnings.size()));
  };
  check("as it was made");
  MovePoints(grid, [](const Vec3& p) { return Vec3(p[0] + 2.3, p[1], p[2]); });
  check("points moved");
  AddFilled<vtkFloatArray>(grid->GetCellData(), "More", grid->GetNumberOfCells() + 3, 1);
  check("a longer array");
  grid->GetCellData()->RemoveArray("More");
  check("the longer array is gone");
  ReverseCells(grid);
  filter->Modified(); // as by an option: VTK does not take it for a change of the grid
  check("other cells");
  GrowByOneCell(grid);
  filter->Modified();
  check("one more cell");
  vtkDataArray* const control = surface.Data->GetFieldData()->GetArray("NURBSControlPoints");
  for (vtkIdType i = 0; i < control->GetNumberOfTuples(); ++i)
  {
    control->SetComponent(i, 0, control->GetComponent(i, 0) + 1.7);
  }
  control->Modified();
  check("surface moved");
  // As a source leaves it that failed: not trimmed along what it was before.
  surface.Data->Initialize();
  const Listener listener;
  filter->Update();
  Expect(listener.Errors().size() == 1 &&
      filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL) == 0,
    "changed in place: a surface that is empty now");
}

// Tuples follow their elements whatever the numbering: with and without renumbering.
void TestNumberings(const Mesh& mesh, const Surface& surface)
{
  for (const bool renumber : { false, true })
  {
    TrimOptions options;
    options.RenumberNodes = renumber;
    Report report("arrays " + mesh.Name + (renumber ? " renumbered" : ""));
    RunAndJudge(mesh, surface, options, report);
    Wrong += report.Failures();
  }
}

// Point ids and names of cells with some more at the end.
Mesh WithSurplus(Mesh mesh)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->DeepCopy(mesh.Grid);
  mesh.Grid = grid;
  grid->GetPointData()->GetGlobalIds()->InsertVariantValue(grid->GetNumberOfPoints(), -1);
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells() + 5; ++c)
  {
    names->InsertNextValue(std::to_string(c));
  }
  grid->GetCellData()->AddArray(names);
  return mesh;
}

void ExpectNoSurplus(vtkDataSetAttributes* data, vtkIdType count)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    Expect(data->GetAbstractArray(i)->GetNumberOfTuples() == count,
      "surplus: in an output, array " + std::to_string(i));
  }
}

// Tuples that no point or cell has are told of, and in no output: else it would be as corrupt.
void TestSurplus(const Mesh& mesh, const Surface& surface)
{
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(WithSurplus(mesh), surface, options);
  const std::string count = std::to_string(mesh.Grid->GetNumberOfCells());
  const std::string text = outcome.Warnings.empty() ? "" : outcome.Warnings.front();
  Expect(outcome.Clean() && outcome.Warnings.size() == 1 &&
      text.find("more tuples than it has points or cells") != std::string::npos &&
      text.find(" for " + count + " cells)") != std::string::npos,
    "surplus: not one warning: " + text);
  vtkUnstructuredGrid* const outputs[] = { outcome.Case.Trimmed, outcome.Case.Whole,
    outcome.Offcut };
  for (vtkUnstructuredGrid* output : outputs)
  {
    ExpectNoSurplus(output->GetPointData(), output->GetNumberOfPoints());
    ExpectNoSurplus(output->GetCellData(), output->GetNumberOfCells());
    Expect(output->GetPointData()->GetGlobalIds() && output->GetCellData()->HasArray("Names"),
      "surplus: an array is lost");
    output->GetCellData()->RemoveArray("Names");
  }
  const Outcome expected = RunTrim(mesh, surface, options);
  const std::string difference = FirstDifference(expected.Case.Whole, outcome.Case.Whole) +
    FirstDifference(expected.Case.Trimmed, outcome.Case.Trimmed);
  Expect(difference.empty(), "surplus: another result: " + difference);
}
}

int main()
{
  for (const char* name : { "sheet2", "permuted", "float", "short", "wedges" })
  {
    const Mesh mesh = MakeMesh(name);
    const Surface surface = MakeSurface("contour", mesh.Box, Placement());
    TestInputUntouched(mesh, surface);
    TestNumberings(mesh, surface);
  }
  const Mesh mesh = MakeMesh("sheet2");
  TestOtherLayout<double>("sheet2");
  TestOtherLayout<float>("float");
  TestUnusual(mesh, MakeSurface("scurve", mesh.Box, Placement()));
  TestSurplus(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  TestNameClashes(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  TestOtherClashes(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  TestChangedInPlace(MakeMesh("sheet2"));
  TestActiveScalars(mesh, MakeSurface("scurve", mesh.Box, Placement()));
  TestQualityOfAll(mesh, MakeSurface("scurve", mesh.Box, Placement()));
  TestTime(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  TestNamesOfEarlierTrim(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  TestInsertedOfInput(MakeMesh("sheet2"), MakeSurface("scurve", mesh.Box, Placement()));
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
