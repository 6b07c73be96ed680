/**
 * @file TestTrimBadInput.cxx
 * @brief Every kind of bad input of CONTRACT.md: one error that names the thing, an empty
 * output, no crash.
 */
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTrimHexahedralGrid.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>

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

// One line that ends in a full stop and says what to do.
void JudgeForm(const std::string& name, const std::string& message)
{
  const std::size_t start = message.find("): ");
  const std::string text = start == std::string::npos ? "" : message.substr(start + 3);
  const std::size_t end = text.find_last_not_of('\n');
  if (text.find('\n') <= end || end == std::string::npos || text[end] != '.')
  {
    std::printf("FAIL %s: not one sentence: %s\n", name.c_str(), message.c_str());
    ++Wrong;
  }
  const std::vector<const char*> remedies = { "connect", "repair", "remove", "rewrite", "write",
    "convert", "give", "make it", "need", "has to", "have to", "must", "extend", "correct",
    "scale" };
  const bool helps = std::any_of(remedies.begin(), remedies.end(),
    [&text](const char* remedy) { return text.find(remedy) != std::string::npos; });
  if (!helps)
  {
    std::printf("FAIL %s: nothing to do in: %s\n", name.c_str(), message.c_str());
    ++Wrong;
  }
}

// words: alternatives separated by "|"; one of each must be in the message.
void Judge(
  const std::string& name, vtkDataObject* grid, vtkDataObject* surface,
  const std::vector<std::string>& words,
  const std::function<void(vtkTrimHexahedralGrid*)>& set = [](vtkTrimHexahedralGrid*) {})
{
  const Listener listener;
  vtkNew<vtkTrimHexahedralGrid> filter;
  set(filter);
  if (grid)
  {
    filter->SetInputDataObject(0, grid);
  }
  if (surface)
  {
    filter->SetInputDataObject(1, surface);
  }
  filter->ProduceOffcutOn();
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
  JudgeForm(name, message);
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
  for (int port = 0; port < 3; ++port)
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
    { "no NURBS at all", { "trimming surface", "nurbs" },
      [](vtkPolyData* d) { d->GetFieldData()->Initialize(); } },
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
    { "zero weight", { "trimming surface", "(1, 0)", "weight", "above zero" },
      set("NURBSControlPoints", 1, 3, 0) },
    { "weights too far apart", { "trimming surface", "weight", "(1, 0)", "factor" },
      set("NURBSControlPoints", 1, 3, 1e10) },
    { "infinite weight", { "weight|control" },
      set("NURBSControlPoints", 2, 3, std::numeric_limits<double>::infinity()) },
    { "infinite coordinate of a control point", { "control|point", "(0, 1)" },
      set("NURBSControlPoints", 2, 0, -std::numeric_limits<double>::infinity()) },
    { "a control point far beyond the grid", { "control point", "length unit" },
      set("NURBSControlPoints", 2, 0, 1e30) },
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
  Judge("second face of a shell has a bad weight", mesh.Grid, shell,
    { "trimming surface", "block 1", "weight" });
}

vtkSmartPointer<vtkUnstructuredGrid> CopyOf(const Mesh& mesh)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->DeepCopy(mesh.Grid);
  return grid;
}

void TestGrids(const Mesh& mesh)
{
  const auto plane = GoodPlane(mesh);
  Judge("no surface", mesh.Grid, nullptr, { "surface" });
  Judge("no grid", nullptr, plane, { "grid|input" });
  vtkNew<vtkUnstructuredGrid> empty;
  Judge("a grid without cells", empty, plane, { "grid", "no cells" });

  auto grid = CopyOf(mesh);
  grid->GetPoints()->SetPoint(17, 1, NaN, 0);
  Judge("NaN coordinate", grid, plane, { "17", "finite|nan|coordinate" });
  grid = CopyOf(mesh);
  grid->GetPoints()->SetPoint(5, std::numeric_limits<double>::infinity(), 0, 0);
  Judge("infinite coordinate", grid, plane, { "5", "finite|coordinate" });

  grid = CopyOf(mesh);
  const vtkIdType tetra[4] = { 0, 1, 22, 400 };
  grid->InsertNextCell(VTK_TETRA, 4, tetra);
  Judge("a tetrahedron", grid, plane,
    { "hexahedr|wedge", std::to_string(mesh.Grid->GetNumberOfCells()) });
  grid = CopyOf(mesh);
  const vtkIdType quad[4] = { 0, 1, 22, 21 };
  grid->InsertNextCell(VTK_QUAD, 4, quad);
  Judge("a quadrilateral", grid, plane, { "hexahedr|wedge" });
  grid = CopyOf(mesh);
  const vtkIdType voxel[8] = { 0, 1, 21, 22, 357, 358, 378, 379 };
  grid->InsertNextCell(VTK_VOXEL, 8, voxel);
  Judge("a voxel", grid, plane, { "hexahedra of eight nodes" });
  grid = CopyOf(mesh);
  const vtkIdType edge[3] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_QUADRATIC_EDGE, 3, edge);
  Judge("a curved edge", grid, plane, { "vtkQuadraticEdge", "Extract Cells By Type" });
  std::array<vtkIdType, 20> quadratic;
  std::iota(quadratic.begin(), quadratic.end(), 0);
  grid->InsertNextCell(VTK_QUADRATIC_HEXAHEDRON, 20, quadratic.data());
  Judge("a curved edge before a hexahedron of twenty nodes", grid, plane,
    { "vtkQuadraticEdge", "hexahedra of eight nodes" });
  grid = CopyOf(mesh);
  vtkNew<vtkUnsignedCharArray> types;
  types->DeepCopy(grid->GetCellTypesArray());
  types->SetNumberOfValues(grid->GetNumberOfCells() - 3);
  grid->SetCells(types, grid->GetCells());
  Judge("cells without types", grid, plane, { "but the types of", "corrupt" });

  grid = CopyOf(mesh);
  const vtkIdType wild[8] = { 0, 1, 22, 21, 357, 358, 379, 99999999 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, wild);
  Judge("a node number out of range", grid, plane, { "99999999|point|node" });
  grid = CopyOf(mesh);
  const vtkIdType negative[8] = { 0, 1, 22, 21, 357, 358, 379, -4 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, negative);
  Judge("a negative node number", grid, plane, { "-4|point|node" });
  grid = CopyOf(mesh);
  const vtkIdType shortOne[7] = { 0, 1, 22, 21, 357, 358, 379 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 7, shortOne);
  Judge("a hexahedron of seven nodes", grid, plane, { "hexahedr|node|point" });
  grid = CopyOf(mesh);
  const vtkIdType repeated[8] = { 0, 1, 22, 21, 357, 357, 357, 357 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, repeated);
  Judge("a node twice in a hexahedron", grid, plane,
    { "wedge", std::to_string(mesh.Grid->GetNumberOfCells()) });
}

void TestPointsAndArrays(const Mesh& mesh)
{
  const auto plane = GoodPlane(mesh);
  auto grid = CopyOf(mesh);
  vtkNew<vtkPoints> whole;
  whole->SetDataType(VTK_INT);
  whole->DeepCopy(grid->GetPoints());
  whole->SetDataType(VTK_INT);
  whole->SetNumberOfPoints(grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    whole->SetPoint(i, grid->GetPoint(i));
  }
  grid->SetPoints(whole);
  Judge("points of whole numbers", grid, plane, { "float or double" });

  grid = CopyOf(mesh);
  vtkNew<vtkDoubleArray> tooShort;
  tooShort->SetName("thickness");
  tooShort->SetNumberOfValues(3);
  tooShort->Fill(1);
  grid->GetCellData()->AddArray(tooShort);
  Judge("an array of three values", grid, plane, { "thickness", "3", "corrupt" });

  grid = CopyOf(mesh);
  grid->GetPoints()->SetPoint(3, 1e200, 0, 0);
  Judge("a node beyond all bounds", grid, plane, { "1e+200", "repair" });
  grid = CopyOf(mesh);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    grid->GetPoints()->SetPoint(i, 1, 2, 3);
  }
  Judge("all nodes at one place", grid, plane, { "one place", "1 2 3" });
  grid = CopyOf(mesh);
  MovePoints(grid, [](const Vec3& p) { return Vec3(9e14 + 0.2 * p[0], 0.2 * p[1], p[2]); });
  Judge("so far away that places are one", grid, plane, { "one place", "nearer to the origin" });
}

// Options out of their ranges, and a mesh in several blocks.
void TestOptionsAndBlocks(const Mesh& mesh)
{
  const auto plane = GoodPlane(mesh);
  using Filter = vtkTrimHexahedralGrid;
  Judge("a fraction that is no number", mesh.Grid, plane, { "EliminationFraction", "0 to 1" },
    [](Filter* filter) { filter->SetEliminationFraction(NaN); });
  Judge("a floor that is no number", mesh.Grid, plane, { "MinimumScaledJacobian" },
    [](Filter* filter) { filter->SetMinimumScaledJacobian(NaN); });
  Judge("a tolerance that is no number", mesh.Grid, plane, { "Tolerance" },
    [](Filter* filter) { filter->SetTolerance(NaN); });
  // What was meant is another unit, or another option: not taken for the nearest that there is.
  Judge("a fraction in per cent", mesh.Grid, plane, { "EliminationFraction", "50", "0 to 1" },
    [](Filter* filter) { filter->SetEliminationFraction(50); });
  Judge("a floor below zero", mesh.Grid, plane, { "MinimumScaledJacobian", "-0.2" },
    [](Filter* filter) { filter->SetMinimumScaledJacobian(-0.2); });
  Judge("a tolerance above one", mesh.Grid, plane, { "Tolerance" },
    [](Filter* filter) { filter->SetTolerance(2); });
  Judge("a fourth type", mesh.Grid, plane, { "CorrectionType", "4", "1, 2 or 3" },
    [](Filter* filter) { filter->SetCorrectionType(4); });
  Judge("another treatment", mesh.Grid, plane, { "Optimization", "-1" },
    [](Filter* filter) { filter->SetOptimization(-1); });
  for (const double x : { NaN, std::numeric_limits<double>::infinity(), 1e200 })
  {
    Judge("a keep point nowhere", mesh.Grid, plane, { "KeepPoint" },
      [x](Filter* filter)
      {
        filter->UseKeepPointOn();
        filter->SetKeepPoint(0, x, 0);
      });
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(1, mesh.Grid);
  blocks->SetBlock(2, MakeMesh("sheet1").Grid);
  Judge("two blocks", blocks, plane, { "2 blocks", "Merge Blocks" });
  Judge("no block", vtkNew<vtkMultiBlockDataSet>(), plane, { "no cells" });
  vtkNew<vtkMultiBlockDataSet> poly;
  poly->SetBlock(0, plane);
  Judge("a block of poly data", poly, plane, { "vtkPolyData", "unstructured grid" });
}

// Two closed bodies, one of them inside out: nothing ends, but between them both sides meet.
void TestMixedSides(const Mesh& mesh)
{
  vtkNew<vtkMultiBlockDataSet> both;
  for (const bool reversed : { false, true })
  {
    Placement at;
    at.X = reversed ? 0.5 : -0.5;
    at.Y = 0;
    at.Size = 0.3;
    at.Reversed = reversed;
    both->SetBlock(reversed, MakeSurface("roundrect", mesh.Box, at).Data);
  }
  Judge("bodies of opposite sense", mesh.Grid, both,
    { "two sides mixed up near (", "a face is there twice", "inside out" });
  // One within the other, a few elements between them, and both face outwards.
  for (const bool inner : { false, true })
  {
    Placement at;
    at.X = at.Y = 0;
    at.Size = inner ? 0.3 : 0.5;
    both->SetBlock(inner, MakeSurface("roundrect", mesh.Box, at).Data);
  }
  Judge("bodies within each other", mesh.Grid, both,
    { "two sides mixed up near (", "closed lines within each other" });
}

// The place that a message gives; of NaN if it gives none.
Vec3 PlaceIn(const std::string& text)
{
  double x = NAN, y = NAN, z = NAN;
  const std::size_t place = std::min(text.find(", at (") + 6, text.size());
  std::sscanf(text.c_str() + place, "%lf, %lf, %lf", &x, &y, &z);
  return Vec3(x, y, z);
}

// The message gives a point where the surface ends: both surfaces are upright and end at a line
// whose distance from the middle of the sheet is known.
void TestEnds(const Mesh& mesh)
{
  Placement at;
  at.X = at.Y = 0;
  const std::pair<Surface, double> ends[] = { { EndingPlane(mesh.Box, at), 0.2 * mesh.Box.HalfY },
    { EndingTrimLoop(mesh.Box, at), 0 } };
  for (const auto& [surface, fromMiddle] : ends)
  {
    Judge(surface.Name, mesh.Grid, surface.Data, { "ends inside the grid, at (" });
    const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
    const std::string text = outcome.Errors.empty() ? "" : outcome.Errors[0];
    const Vec3 end = PlaceIn(text);
    const bool found = std::abs(surface.Signed(end)) < 1e-6 &&
      std::abs((end - mesh.Box.Centre).head<2>().norm() - fromMiddle) < 1e-6 &&
      std::abs(end.z()) < 1;
    if (!found)
    {
      std::printf("FAIL %s: not where it ends: %s\n", surface.Name.c_str(), text.c_str());
      ++Wrong;
    }
  }
}

// Where the border is nearest to a node it lies beside the grid: that is not where it ends inside.
void TestEndBesideTheGrid(const Mesh& mesh)
{
  const auto& box = mesh.Box;
  const Vec3 node = box.Centre + Vec3(2 * box.ElementSize - box.HalfX, -box.HalfY, 0);
  const Vec3 begin = node + box.ElementSize * Vec3(0.04, -0.01, 0);
  const Vec3 along(std::sin(0.5), std::cos(0.5), 0);
  const double half = 0.6 * box.HalfY;
  const Surface plane = PlaneThrough(begin + half * along, Vec3(along.y(), -along.x(), 0), half);
  Judge("ends beside the grid too", mesh.Grid, plane.Data, { "ends inside the grid, at (" });
  const Outcome outcome = RunTrim(mesh, plane, TrimOptions());
  const std::string text = outcome.Errors.empty() ? "" : outcome.Errors[0];
  if (!((PlaceIn(text) - begin - 2 * half * along).head<2>().norm() < 1e-6))
  {
    std::printf("FAIL ends beside the grid too: not where it ends inside: %s\n", text.c_str());
    ++Wrong;
  }
}

// A hole in a face, smaller than an element, that an edge of the mesh goes through.
void TestHoleInFace(const Mesh& mesh)
{
  const auto& box = mesh.Box;
  const Vec3 place = box.Centre + 0.3 * box.ElementSize * Vec3::UnitX();
  const double half = 4 * box.HalfX;
  for (const double width : { 0.02, 0.1, 0.6 })
  {
    Surface plane = PlaneThrough(place, Vec3(1, 0.1, 0.05), half);
    SplineSurface face = ReadSpline(vtkPolyData::SafeDownCast(plane.Data));
    const auto square = [](double r)
    {
      return std::vector<Vec2>{ Vec2(0.5 - r, 0.5 - r), Vec2(0.5 + r, 0.5 - r),
        Vec2(0.5 + r, 0.5 + r), Vec2(0.5 - r, 0.5 + r) };
    };
    face.Loops = { square(0.45), square(0.25 * width * box.ElementSize / half) };
    plane.Data = ToPolyData(face);
    Judge("hole in a face", mesh.Grid, plane.Data, { "ends inside the grid, at (" });
    const Outcome outcome = RunTrim(mesh, plane, TrimOptions());
    const double away =
      outcome.Clean() ? 0 : (PlaceIn(outcome.Errors[0]) - place).norm() / box.ElementSize;
    if (!(away > 0.49 * width && away < 0.71 * width))
    {
      std::printf("FAIL hole in a face: it ends %g of an element from the middle\n", away);
      ++Wrong;
    }
  }
}

// One that parts no two nodes ends inside as well: in an element, and where facets of elements
// meet. One that ends right above the skin does not.
void TestEndsInAnElement(const Mesh& mesh)
{
  const auto& box = mesh.Box;
  const Vec3 node = box.Centre - Vec3(box.HalfX, box.HalfY, box.HalfZ) +
    box.ElementSize * Vec3(3, 3, 0) + box.LayerThickness * Vec3::UnitZ();
  const std::pair<const char*, Vec3> ends[] = { { "in an element", Vec3(0.3, 0.45, 0.1) },
    { "between elements", Vec3(0, 0.45, 0.1) }, { "at an edge", Vec3(0, 0, 0.1) } };
  for (const auto& end : ends)
  {
    Judge(std::string("ends ") + end.first, mesh.Grid,
      PlaneThrough(node + end.second, Vec3::UnitX(), 0.05).Data, { "ends inside the grid, at (" });
  }
  const Outcome outcome = RunTrim(mesh,
    PlaneThrough(
      node + Vec3(0.3, 0, box.Centre[2] + box.HalfZ + 5.001 - node[2]), Vec3::UnitX(), 5),
    TrimOptions());
  if (!outcome.Errors.empty() || outcome.Warnings.size() != 1)
  {
    std::printf("FAIL ends above the skin: %s\n",
      outcome.Errors.empty() ? "not one warning" : outcome.Errors[0].c_str());
    ++Wrong;
  }
}

// Through the only layer, from right above the lower skin to right below the upper one: no edge of
// an element meets it, and it ends inside all the same. From skin to skin it parts the sheet.
void TestEndsBelowTheSkins()
{
  const Mesh sheet = Sheet(12, 8, 1, Vec3(1, 1, 1));
  for (const double x : { 4.0, 4.37 })
  {
    for (const double gap : { 1e-4, 1e-6, 0.0 })
    {
      const double z = sheet.Box.Centre[2], half = sheet.Box.HalfZ - gap;
      SplineSurface face =
        ReadSpline(vtkPolyData::SafeDownCast(PlaneThrough(Vec3(x, 4, z), Vec3::UnitX(), 100).Data));
      for (auto& point : face.Control)
      {
        point.z() = point.z() < z ? z - half : z + half;
      }
      const std::string name = "ends below the skins by " + std::to_string(gap);
      if (gap > 0.0)
      {
        Judge(name, sheet.Grid, ToPolyData(face), { "ends inside the grid, at (" });
        continue;
      }
      Surface plane;
      plane.Data = ToPolyData(face);
      const Outcome outcome = RunTrim(sheet, plane, TrimOptions());
      if (!outcome.Errors.empty() || outcome.Case.Trimmed->GetNumberOfCells() != 4 * 8)
      {
        std::printf("FAIL %s: not parted\n", name.c_str());
        ++Wrong;
      }
    }
  }
}

// No error: a surface beside the grid keeps or eliminates it whole, by the side it lies on.
void TestMissed(const Mesh& mesh)
{
  for (const double x : { -3.0, 23.0 })
  {
    for (const bool invert : { false, true })
    {
      TrimOptions options;
      options.InvertSide = invert;
      const Outcome outcome =
        RunTrim(mesh, PlaneThrough(Vec3(x, 8, 0), Vec3::UnitX(), 100), options);
      const std::string name = "missed at " + std::to_string(x) + (invert ? ", inverted" : "");
      // The side that the normal points to goes: all of the grid lies there if x is below it.
      const vtkIdType expected = (x < 0) == invert ? mesh.Grid->GetNumberOfCells() : 0;
      const vtkIdType cells = outcome.Case.Trimmed->GetNumberOfCells();
      if (!outcome.Errors.empty() || outcome.Warnings.size() != 1 ||
        outcome.Warnings[0].find("misses the grid") == std::string::npos)
      {
        std::printf("FAIL %s: not one warning alone\n", name.c_str());
        ++Wrong;
      }
      if (cells != expected || outcome.Case.Whole->GetNumberOfCells() == 0)
      {
        std::printf("FAIL %s: %lld cells\n", name.c_str(), static_cast<long long>(cells));
        ++Wrong;
      }
    }
  }
}

// One warning where all goes: beyond a plane that leaves a tenth of a row, and by one in the skin.
void TestNothingLeft(const Mesh& mesh)
{
  const auto& box = mesh.Box;
  const Vec3 corner = box.Centre - Vec3(box.HalfX, box.HalfY, 0);
  const std::pair<const char*, Vec3> cases[] = { { "No element is left",
                                                   corner + 0.1 * box.ElementSize * Vec3::UnitX() },
    { "touches the grid, but does not part it, so the grid is eliminated", corner } };
  for (const auto& item : cases)
  {
    const Outcome outcome =
      RunTrim(mesh, PlaneThrough(item.second, Vec3::UnitX(), 100), TrimOptions());
    if (!outcome.Errors.empty() || outcome.Case.Trimmed->GetNumberOfCells() != 0 ||
      outcome.Warnings.size() != 1 || outcome.Warnings[0].find(item.first) == std::string::npos)
    {
      std::printf("FAIL %s: %lld cells, %zu warnings, %s\n", item.first,
        static_cast<long long>(outcome.Case.Trimmed->GetNumberOfCells()), outcome.Warnings.size(),
        outcome.Warnings.empty() ? "" : outcome.Warnings[0].c_str());
      ++Wrong;
    }
  }
}
}

int main()
{
  const Mesh mesh = MakeMesh("sheet2");
  TestGrids(mesh);
  TestPointsAndArrays(mesh);
  TestSurfaces(mesh);
  TestLoopsAndShells(mesh);
  TestOptionsAndBlocks(mesh);
  TestMixedSides(mesh);
  TestEndBesideTheGrid(mesh);
  TestHoleInFace(mesh);
  TestEndsInAnElement(mesh);
  TestEndsBelowTheSkins();
  TestEnds(mesh);
  TestMissed(mesh);
  TestNothingLeft(mesh);
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
