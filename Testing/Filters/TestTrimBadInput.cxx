/**
 * @file TestTrimBadInput.cxx
 * @brief Every kind of bad input of CONTRACT.md: one error that names the thing, an empty
 * output, no crash.
 */
#include "RunTrim.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTrimHexahedralGrid.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

using namespace judge;

namespace
{
int Wrong = 0;
const double NaN = std::numeric_limits<double>::quiet_NaN();

std::string Lower(std::string text)
{
  for (char& c : text)
  {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

// words: alternatives separated by "|"; one of each must be in the message.
void Judge(const std::string& name, vtkDataObject* grid, vtkDataObject* surface,
  const std::vector<std::string>& words)
{
  const Listener listener;
  vtkNew<vtkTrimHexahedralGrid> filter;
  if (grid)
  {
    filter->SetInputDataObject(0, grid);
  }
  if (surface)
  {
    filter->SetInputDataObject(1, surface);
  }
  filter->Update();
  const auto errors = listener.Errors();
  if (errors.size() != 1)
  {
    std::printf("FAIL %s: %zu errors, not one\n", name.c_str(), errors.size());
    for (const auto& error : errors)
    {
      std::printf("     %s\n", error.c_str());
    }
    ++Wrong;
  }
  const std::string message = errors.empty() ? "" : Lower(errors[0]);
  for (const std::string& word : words)
  {
    bool named = false;
    for (std::size_t from = 0; from <= word.size();)
    {
      const std::size_t to = std::min(word.find('|', from), word.size());
      named = named || message.find(Lower(word.substr(from, to - from))) != std::string::npos;
      from = to + 1;
    }
    if (!named)
    {
      std::printf("FAIL %s: '%s' is not in: %s\n", name.c_str(), word.c_str(), message.c_str());
      ++Wrong;
    }
  }
  for (int port = 0; port < 2; ++port)
  {
    auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(port));
    if (output && (output->GetNumberOfPoints() > 0 || output->GetNumberOfCells() > 0))
    {
      std::printf("FAIL %s: port %d is not empty\n", name.c_str(), port);
      ++Wrong;
    }
  }
}

vtkSmartPointer<vtkPolyData> GoodPlane(const Mesh& mesh)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->DeepCopy(MakeSurface("plane", mesh.Box, Placement()).Data);
  return data;
}

void SetField(vtkPolyData* data, const char* name, vtkIdType tuple, int component, double value)
{
  data->GetFieldData()->GetArray(name)->SetComponent(tuple, component, value);
}

void TestSurfaces(const Mesh& mesh)
{
  struct Case
  {
    const char* Name;
    std::vector<std::string> Words;
    std::function<void(vtkPolyData*)> Break;
  };
  const auto set = [](const char* name, vtkIdType t, int c, double v)
  { return [=](vtkPolyData* d) { SetField(d, name, t, c, v); }; };
  const auto drop = [](const char* name)
  { return [=](vtkPolyData* d) { d->GetFieldData()->RemoveArray(name); }; };
  const auto resize = [](const char* name, vtkIdType n)
  {
    return [=](vtkPolyData* d)
    {
      vtkDataArray* array = d->GetFieldData()->GetArray(name);
      array->Resize(n);
      array->SetNumberOfTuples(n);
    };
  };
  const std::vector<Case> cases = {
    { "no NURBS at all", { "nurbs" }, [](vtkPolyData* d) { d->GetFieldData()->Initialize(); } },
    { "no degrees", { "degree" }, drop("NURBSDegrees") },
    { "no control points", { "control" }, drop("NURBSControlPoints") },
    { "no knots", { "knot" }, drop("NURBSKnotsV") },
    { "NaN knot", { "knot" }, set("NURBSKnotsU", 1, 0, NaN) },
    { "infinite knot", { "knot" },
      set("NURBSKnotsV", 3, 0, std::numeric_limits<double>::infinity()) },
    { "decreasing knots", { "knot", "decreas|non-decreasing|smaller" },
      set("NURBSKnotsU", 2, 0, -1) },
    { "all knots equal", { "knot|domain|empty" },
      [](vtkPolyData* d) { d->GetFieldData()->GetArray("NURBSKnotsU")->Fill(1); } },
    { "too few knots", { "knot" }, resize("NURBSKnotsU", 3) },
    { "too many knots", { "knot" }, resize("NURBSKnotsV", 9) },
    { "net size and points differ", { "control" }, set("NURBSControlNetSize", 0, 0, 3) },
    { "negative net size", { "control|net|size" }, set("NURBSControlNetSize", 0, 1, -2) },
    { "huge net size", { "control|net|size" }, set("NURBSControlNetSize", 0, 1, 2000000000) },
    { "degree 0", { "degree" }, set("NURBSDegrees", 0, 0, 0) },
    { "degree -1", { "degree" }, set("NURBSDegrees", 0, 1, -1) },
    { "degree 99", { "degree" }, set("NURBSDegrees", 0, 1, 99) },
    { "NaN coordinate of a control point", { "control|point" },
      set("NURBSControlPoints", 2, 1, NaN) },
    { "NaN weight", { "weight|control" }, set("NURBSControlPoints", 2, 3, NaN) },
    { "zero weight", { "weight", "positive|above zero" }, set("NURBSControlPoints", 1, 3, 0) },
    { "negative weight", { "weight", "positive|above zero" }, set("NURBSControlPoints", 1, 3, -1) },
  };
  for (const Case& test : cases)
  {
    const auto data = GoodPlane(mesh);
    test.Break(data);
    Judge(test.Name, mesh.Grid, data, test.Words);
  }
}

void TestLoopsAndShells(const Mesh& mesh)
{
  const auto loops = [&mesh]()
  {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->DeepCopy(MakeSurface("trimmedface", mesh.Box, Placement()).Data);
    return data;
  };
  auto data = loops();
  SetField(data, "NURBSTrimLoopOffsets", 1, 0, 9999);
  Judge("loop offsets beyond the points", mesh.Grid, data, { "loop" });
  data = loops();
  SetField(data, "NURBSTrimLoops", 1, 0, NaN);
  Judge("NaN in a loop", mesh.Grid, data, { "loop" });
  data = loops();
  data->GetFieldData()->RemoveArray("NURBSTrimLoopOffsets");
  Judge("loops without offsets", mesh.Grid, data, { "loop" });

  vtkNew<vtkMultiBlockDataSet> shell;
  Judge("empty composite", mesh.Grid, shell, { "surface|nurbs" });
  const auto bad = GoodPlane(mesh);
  SetField(bad, "NURBSControlPoints", 0, 3, -2);
  shell->SetBlock(0, GoodPlane(mesh));
  shell->SetBlock(1, bad);
  Judge("second face of a shell has a bad weight", mesh.Grid, shell, { "weight" });
}

void TestGrids(const Mesh& mesh)
{
  const auto plane = GoodPlane(mesh);
  const auto copy = [&mesh]()
  {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->DeepCopy(mesh.Grid);
    return grid;
  };
  Judge("no surface", mesh.Grid, nullptr, { "surface" });
  Judge("no grid", nullptr, plane, { "grid|input" });

  auto grid = copy();
  grid->GetPoints()->SetPoint(17, 1, NaN, 0);
  Judge("NaN coordinate", grid, plane, { "17", "finite|nan|coordinate" });
  grid = copy();
  grid->GetPoints()->SetPoint(5, std::numeric_limits<double>::infinity(), 0, 0);
  Judge("infinite coordinate", grid, plane, { "5", "finite|coordinate" });

  grid = copy();
  const vtkIdType tetra[4] = { 0, 1, 22, 400 };
  grid->InsertNextCell(VTK_TETRA, 4, tetra);
  Judge("a tetrahedron", grid, plane,
    { "hexahedr|wedge", std::to_string(mesh.Grid->GetNumberOfCells()) });
  grid = copy();
  const vtkIdType quad[4] = { 0, 1, 22, 21 };
  grid->InsertNextCell(VTK_QUAD, 4, quad);
  Judge("a quadrilateral", grid, plane, { "hexahedr|wedge" });

  grid = copy();
  const vtkIdType wild[8] = { 0, 1, 22, 21, 357, 358, 379, 99999999 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, wild);
  Judge("a node number out of range", grid, plane, { "99999999|point|node" });
  grid = copy();
  const vtkIdType negative[8] = { 0, 1, 22, 21, 357, 358, 379, -4 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, negative);
  Judge("a negative node number", grid, plane, { "-4|point|node" });
  grid = copy();
  const vtkIdType shortOne[7] = { 0, 1, 22, 21, 357, 358, 379 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 7, shortOne);
  Judge("a hexahedron of seven nodes", grid, plane, { "hexahedr|node|point" });
}

// The message gives a point where the surface ends: on the surface, within the grid.
void TestEnds(const Mesh& mesh)
{
  Placement at;
  at.X = at.Y = 0;
  for (const Surface& surface : { EndingPlane(mesh.Box, at), EndingTrimLoop(mesh.Box, at) })
  {
    Judge(surface.Name, mesh.Grid, surface.Data, { "end" });
    const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
    const std::string text = outcome.Errors.empty() ? "" : outcome.Errors[0];
    // Three numbers in a row that are a point near the surface, within the grid.
    bool found = false;
    for (std::size_t i = 0; i < text.size() && !found; ++i)
    {
      double x, y, z;
      const char* from = text.c_str() + i;
      found = (std::sscanf(from, "%lf %lf %lf", &x, &y, &z) == 3 ||
                std::sscanf(from, "%lf , %lf , %lf", &x, &y, &z) == 3) &&
        x >= -1 && x <= 21 && y >= -1 && y <= 17 && std::abs(z) < 1 &&
        std::abs(surface.Signed(Vec3(x, y, z))) < 1.5;
    }
    if (!found)
    {
      std::printf("FAIL %s: no point of the surface in: %s\n", surface.Name.c_str(), text.c_str());
      ++Wrong;
    }
  }
}

// No error: an empty grid has an empty result.
void TestEmpty(const Mesh& mesh)
{
  Mesh empty = mesh;
  empty.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const Outcome outcome =
    RunTrim(empty, MakeSurface("plane", mesh.Box, Placement()), TrimOptions());
  if (outcome.Case.Trimmed->GetNumberOfCells() != 0 || outcome.Errors.size() > 1)
  {
    std::printf("FAIL empty grid\n");
    ++Wrong;
  }
}
}

int main()
{
  const Mesh mesh = MakeMesh("sheet2");
  TestGrids(mesh);
  TestSurfaces(mesh);
  TestLoopsAndShells(mesh);
  TestEnds(mesh);
  TestEmpty(mesh);
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
