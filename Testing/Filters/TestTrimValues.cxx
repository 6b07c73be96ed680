/**
 * @file TestTrimValues.cxx
 * @brief MapValues: what nodes that moved and elements that changed their shape carry.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>

using namespace judge;

namespace
{

using Field = std::function<double(const Vec3&)>;

/// Mean of a field over an element, and its volume, by 4 Gauss points in each direction.
std::pair<double, double> MeanOf(const std::array<Vec3, 8>& corners, int size, const Field& field)
{
  constexpr std::array<double, 4> at = { 0.069431844202973712, 0.33000947820757187,
    0.66999052179242813, 0.93056815579702629 };
  constexpr std::array<double, 4> weight = { 0.17392742256872693, 0.32607257743127307,
    0.32607257743127307, 0.17392742256872693 };
  double sum = 0, volume = 0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      for (int k = 0; k < 4; ++k)
      {
        const double narrow = size == 8 ? 1 : 1 - at[i];
        const Vec3 natural(at[i], narrow * at[j], at[k]);
        const double part =
          narrow * weight[i] * weight[j] * weight[k] * JacobianAt(corners, size, natural);
        sum += part * field(PositionAt(corners, size, natural));
        volume += part;
      }
    }
  }
  return { sum / volume, std::abs(volume) };
}

/// Arrays "Field" on points and cells: the field at the nodes, and its mean in each element.
void AddField(vtkUnstructuredGrid* grid, const Field& field)
{
  const Model model(grid);
  vtkNew<vtkDoubleArray> nodes, cells;
  nodes->SetName("Field");
  cells->SetName("Field");
  for (const Vec3& p : model.Points)
  {
    nodes->InsertNextValue(field(p));
  }
  for (std::size_t e = 0; e < model.Elements.size(); ++e)
  {
    cells->InsertNextValue(MeanOf(model.Corners(e), model.Elements[e].Size, field).first);
  }
  grid->GetPointData()->AddArray(nodes);
  grid->GetCellData()->AddArray(cells);
}

vtkDataArray* CellField(vtkUnstructuredGrid* grid)
{
  return grid->GetCellData()->GetArray("Field");
}

/// The least and the largest value that an input cell and those that share a facet with it have.
std::vector<std::pair<double, double>> RangesRound(vtkUnstructuredGrid* grid)
{
  const Model model(grid);
  std::map<std::array<Id, 4>, std::vector<Id>> cellsOf;
  for (std::size_t e = 0; e < model.Elements.size(); ++e)
  {
    for (const Facet& facet : FacetsOf(model.Elements[e], e))
    {
      cellsOf[FacetKey(facet)].push_back(e);
    }
  }
  vtkDataArray* values = CellField(grid);
  std::vector<std::pair<double, double>> ranges;
  for (std::size_t e = 0; e < model.Elements.size(); ++e)
  {
    ranges.emplace_back(values->GetComponent(e, 0), values->GetComponent(e, 0));
  }
  for (const auto& facet : cellsOf)
  {
    for (const Id a : facet.second)
    {
      for (const Id b : facet.second)
      {
        const double value = values->GetComponent(b, 0);
        ranges[a] = { std::min(ranges[a].first, value), std::max(ranges[a].second, value) };
      }
    }
  }
  return ranges;
}

/// What is linear in space stays so: the values are those of the new places.
void TestLinear(const std::string& name, const std::string& kind, TrimOptions options)
{
  const std::string trial = "linear " + name + " " + kind + " " +
    std::to_string(options.CorrectionType) + std::to_string(options.Optimization);
  Mesh mesh = MakeMesh(name);
  const double size = Model(mesh.Grid).Diagonal();
  const Vec3 across = mesh.Box.Axes.col(2);
  Vec3 slope = Vec3(0.3, -0.8, 0.5) / size;
  if (name == "sheet1") // through a single layer there is no telling
  {
    slope -= across * across.dot(slope);
  }
  const Field field = [&](const Vec3& p) { return 2 + slope.dot(p - mesh.Box.Centre); };
  AddField(mesh.Grid, field);
  Placement at;
  at.Lean = kind == "cylinder" ? 0.2 : 0;
  const Surface surface = MakeSurface(kind, mesh.Box, at);
  options.MapValues = true;
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(mesh, surface, options);
  Expect(outcome.Clean(), trial + ": an error");
  const auto ranges = RangesRound(mesh.Grid);
  const double rounding = name == "float" ? 1e-6 : name == "far" ? 1e-8 : 1e-10;
  for (vtkUnstructuredGrid* part : { outcome.Case.Trimmed.Get(), outcome.Offcut.Get() })
  {
    const Model model(part);
    vtkDataArray* nodes = part->GetPointData()->GetArray("Field");
    vtkDataArray* displacement = part->GetPointData()->GetArray("Displacement");
    int moved = 0;
    for (std::size_t i = 0; i < model.Points.size(); ++i)
    {
      const double wrong = std::abs(nodes->GetComponent(i, 0) - field(model.Points[i]));
      moved += std::abs(displacement->GetComponent(i, 0)) > 0;
      Expect(wrong <= rounding, trial + ": a node is wrong by " + std::to_string(wrong));
    }
    Expect(moved > 10, trial + ": hardly a node has moved");
    vtkDataArray* cells = CellField(part);
    vtkDataArray* ids = part->GetCellData()->GetArray("vtkOriginalCellIds");
    int changed = 0, beyond = 0;
    for (std::size_t e = 0; e < model.Elements.size(); ++e)
    {
      const auto& range = ranges[static_cast<std::size_t>(ids->GetComponent(e, 0))];
      const double mean = MeanOf(model.Corners(e), model.Elements[e].Size, field).first;
      const double value = cells->GetComponent(e, 0);
      changed += value != CellField(mesh.Grid)->GetComponent(ids->GetComponent(e, 0), 0);
      if (mean > range.first && mean < range.second)
      {
        Expect(std::abs(value - mean) <= rounding,
          trial + ": an element is wrong by " + std::to_string(value - mean));
      }
      else
      {
        // At the border of the model nothing tells how the field goes on.
        ++beyond;
        Expect(std::abs(value - mean) <= slope.norm() * mesh.Box.ElementSize,
          trial + ": an element at the border is wrong by " + std::to_string(value - mean));
      }
    }
    Expect(changed > 10 && beyond <= 0.1 * changed + 4,
      trial + ": " + std::to_string(beyond) + " of " + std::to_string(changed) +
        " elements are beyond their neighbours");
  }
}

/// What is not mapped, and what need not be, is as without.
void TestTheRest(const std::string& name)
{
  Mesh mesh = MakeMesh(name);
  const Surface surface = MakeSurface("contour", mesh.Box, Placement());
  TrimOptions options;
  const Outcome carried = RunTrim(mesh, surface, options);
  options.MapValues = true;
  const Outcome mapped = RunTrim(mesh, surface, options);
  const auto compare = [&](vtkDataSetAttributes* with, vtkDataSetAttributes* without,
                         const std::function<bool(vtkIdType)>& mayDiffer)
  {
    Expect(with->GetNumberOfArrays() == without->GetNumberOfArrays(), name + ": arrays are lost");
    for (int i = 0; i < with->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* a = with->GetAbstractArray(i);
      vtkAbstractArray* b = without->GetAbstractArray(i);
      const std::string array = a->GetName();
      const bool real = a->GetDataType() == VTK_FLOAT || a->GetDataType() == VTK_DOUBLE;
      int differ = 0, misplaced = 0;
      for (vtkIdType t = 0; t < a->GetNumberOfTuples(); ++t)
      {
        for (int c = 0; c < a->GetNumberOfComponents(); ++c)
        {
          const vtkIdType at = t * a->GetNumberOfComponents() + c;
          const bool same = a->GetVariantValue(at).ToString() == b->GetVariantValue(at).ToString();
          differ += !same;
          misplaced += !same && !(real && mayDiffer(t));
        }
      }
      Expect(misplaced == 0, name + " " + array + ": values changed that must not");
      const bool own = array == "Temperature" || array == "Velocity" || array == "Stretch" ||
        array == "Stress" || array == "Fibre";
      Expect(!own || differ > 0, name + " " + array + ": nothing is mapped");
      Expect(with->IsArrayAnAttribute(i) == without->IsArrayAnAttribute(i),
        name + " " + array + ": is another attribute");
    }
  };
  vtkUnstructuredGrid* grid = mapped.Case.Trimmed;
  const Model model(grid);
  vtkDataArray* displacement = grid->GetPointData()->GetArray("Displacement");
  const auto moved = [&](vtkIdType p)
  {
    double way[3];
    displacement->GetTuple(p, way);
    return way[0] != 0 || way[1] != 0 || way[2] != 0;
  };
  vtkDataArray* status = grid->GetCellData()->GetArray("ScaledJacobian");
  const auto touched = [&](vtkIdType e) { return !std::isnan(status->GetComponent(e, 0)); };
  compare(grid->GetPointData(), carried.Case.Trimmed->GetPointData(), moved);
  compare(grid->GetCellData(), carried.Case.Trimmed->GetCellData(), touched);
}

/// A jump stays within its values; a smooth field is kept on the whole, better than carried along.
void TestRangeAndSum()
{
  Mesh mesh = MakeMesh("irregular");
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  TrimOptions options;
  options.ProduceOffcut = true;
  const auto run = [&](const Field& field, bool map)
  {
    AddField(mesh.Grid, field);
    options.MapValues = map;
    return RunTrim(mesh, surface, options);
  };
  const double middle = mesh.Box.Centre[1];
  const Outcome jump = run([middle](const Vec3& p) { return p[1] > middle ? 1.0 : 0.0; }, true);
  double low = 1, high = 0;
  int between = 0;
  for (vtkIdType e = 0; e < jump.Case.Trimmed->GetNumberOfCells(); ++e)
  {
    const double value = CellField(jump.Case.Trimmed)->GetComponent(e, 0);
    low = std::min(low, value);
    high = std::max(high, value);
    between += value > 0 && value < 1;
  }
  Expect(low == 0 && high == 1 && between > 0, "a jump: values beyond those of the input");

  const double size = mesh.Box.HalfX;
  const Field smooth = [&](const Vec3& p)
  { return std::exp(2 * (p[0] - mesh.Box.Centre[0]) / size) + p[1] * p[1] / (size * size); };
  const auto sum = [&](vtkUnstructuredGrid* grid)
  {
    const Model model(grid);
    double whole = 0;
    for (std::size_t e = 0; e < model.Elements.size(); ++e)
    {
      const auto [mean, volume] = MeanOf(model.Corners(e), model.Elements[e].Size, smooth);
      (void)mean;
      whole += volume * CellField(grid)->GetComponent(e, 0);
    }
    return whole;
  };
  double wrong[2];
  for (const bool map : { false, true })
  {
    const Outcome outcome = run(smooth, map);
    wrong[map] =
      std::abs(sum(outcome.Case.Trimmed) + sum(outcome.Offcut) - sum(mesh.Grid)) / sum(mesh.Grid);
  }
  std::printf("sum over both parts off by %.2e, carried along %.2e\n", wrong[1], wrong[0]);
  Expect(wrong[1] < 1e-5 && wrong[1] < 0.1 * wrong[0], "a smooth field is not kept on the whole");
}

/// Where a value is not a number the others take no harm.
void TestNotANumber()
{
  Mesh mesh = MakeMesh("sheet2");
  AddField(mesh.Grid, [](const Vec3& p) { return p[0]; });
  const Surface surface = MakeSurface("contour", mesh.Box, Placement());
  TrimOptions options;
  options.MapValues = true;
  const Outcome before = RunTrim(mesh, surface, options);
  vtkDataArray* scaled = before.Case.Trimmed->GetCellData()->GetArray("ScaledJacobian");
  vtkDataArray* ids = before.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  std::set<vtkIdType> holes;
  for (vtkIdType e = 0; e < ids->GetNumberOfTuples(); e += 3)
  {
    if (!std::isnan(scaled->GetComponent(e, 0)))
    {
      holes.insert(static_cast<vtkIdType>(ids->GetComponent(e, 0)));
    }
  }
  Expect(holes.size() > 3, "not a number: no element to put one in");
  for (const vtkIdType cell : holes)
  {
    CellField(mesh.Grid)->SetComponent(cell, 0, std::numeric_limits<double>::quiet_NaN());
  }
  const Outcome after = RunTrim(mesh, surface, options);
  for (vtkIdType e = 0; e < ids->GetNumberOfTuples(); ++e)
  {
    const bool own = holes.count(static_cast<vtkIdType>(ids->GetComponent(e, 0))) > 0;
    Expect(std::isnan(CellField(after.Case.Trimmed)->GetComponent(e, 0)) == own,
      "not a number: it has spread, or is lost");
  }
}

/// Ids are not mapped, of whatever type they are, nor is what has no name.
void TestNotMapped()
{
  Mesh mesh = MakeMesh("sheet2");
  const auto addArrays = [](vtkDataSetAttributes* data, vtkIdType count)
  {
    data->Initialize();
    for (const int role : { vtkDataSetAttributes::GLOBALIDS, vtkDataSetAttributes::PEDIGREEIDS,
           vtkDataSetAttributes::NUM_ATTRIBUTES })
    {
      vtkNew<vtkDoubleArray> array;
      for (vtkIdType i = 0; i < count; ++i)
      {
        array->InsertNextValue(static_cast<double>(7 * i % count));
      }
      const bool isId = role < vtkDataSetAttributes::NUM_ATTRIBUTES;
      array->SetName(isId ? ("Ids" + std::to_string(role)).c_str() : nullptr);
      const int index = data->AddArray(array);
      Expect(!isId || data->SetActiveAttribute(index, role) == index, "not mapped: no such ids");
    }
  };
  addArrays(mesh.Grid->GetPointData(), mesh.Grid->GetNumberOfPoints());
  addArrays(mesh.Grid->GetCellData(), mesh.Grid->GetNumberOfCells());
  TrimOptions options;
  options.MapValues = true;
  const Outcome outcome = RunTrim(mesh, MakeSurface("contour", mesh.Box, Placement()), options);
  const auto check = [](vtkDataSetAttributes* data, const char* originals, vtkIdType count)
  {
    vtkDataArray* original = data->GetArray(originals);
    for (int i = 0; i < 3; ++i)
    {
      vtkDataArray* array = data->GetArray(i);
      for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t)
      {
        const auto own = static_cast<vtkIdType>(original->GetComponent(t, 0));
        Expect(array->GetComponent(t, 0) == static_cast<double>(7 * own % count),
          "not mapped: array " + std::to_string(i) + " is");
      }
    }
  };
  Expect(outcome.Clean(), "not mapped: an error");
  check(
    outcome.Case.Trimmed->GetPointData(), "vtkOriginalPointIds", mesh.Grid->GetNumberOfPoints());
  check(outcome.Case.Trimmed->GetCellData(), "vtkOriginalCellIds", mesh.Grid->GetNumberOfCells());
}

/// Two sheets that lie on each other without common nodes keep what is theirs.
void TestContact()
{
  // They lie in one another, by one of two layers.
  const Mesh mesh = TwoSheets(14, 14, 2, 0.4, Vec3(0, 0, 0.4));
  const vtkIdType half = mesh.Grid->GetNumberOfCells() / 2;
  vtkNew<vtkFloatArray> cells, nodes;
  cells->SetName("Sheet");
  nodes->SetName("Sheet");
  for (vtkIdType e = 0; e < 2 * half; ++e)
  {
    cells->InsertNextValue(e < half ? 1 : 2);
  }
  for (vtkIdType p = 0; p < mesh.Grid->GetNumberOfPoints(); ++p)
  {
    nodes->InsertNextValue(2 * p < mesh.Grid->GetNumberOfPoints() ? 1 : 2);
  }
  mesh.Grid->GetCellData()->AddArray(cells);
  mesh.Grid->GetPointData()->AddArray(nodes);
  TrimOptions options;
  options.MapValues = true;
  const Outcome outcome = RunTrim(mesh, MakeSurface("scurve", mesh.Box, Placement()), options);
  const auto check = [&](vtkDataSetAttributes* data, const char* ids, vtkIdType first)
  {
    vtkDataArray* sheet = data->GetArray("Sheet");
    for (vtkIdType i = 0; i < sheet->GetNumberOfTuples(); ++i)
    {
      const double own = data->GetArray(ids)->GetComponent(i, 0) < first ? 1 : 2;
      Expect(std::abs(sheet->GetComponent(i, 0) - own) < 1e-6,
        "contact: a value comes from the other sheet");
    }
  };
  check(outcome.Case.Trimmed->GetCellData(), "vtkOriginalCellIds", half);
  check(outcome.Case.Trimmed->GetPointData(), "vtkOriginalPointIds",
    mesh.Grid->GetNumberOfPoints() / 2);
}

}

/// Beside a corner that points inwards: of a place that rounding puts outside of all elements the
/// walk from one element may end at the other wall.
void TestInnerCorner()
{
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, axis).toRotationMatrix();
  MeshOptions single;
  single.Float = true;
  single.Data = false;
  const Mesh mesh = LShape(6, 4, single);
  const Vec3 corner = turn * Vec3(3, 3, 0.8);
  MovePoints(
    mesh.Grid, [&turn](const Vec3& p) { return (turn * Vec3(p[0], p[1], 2.5 * p[2])).eval(); });
  const Vec3 slope(0.08, -0.04, 0.03);
  const Field field = [&slope](const Vec3& p) { return slope.dot(p); };
  AddField(mesh.Grid, field);
  TrimOptions options;
  options.MapValues = true;
  for (int i = 0; i < 60; ++i)
  {
    const double around = 2.4 * i, up = -0.9 + 0.03 * i, flat = std::sqrt(1 - up * up);
    const Vec3 normal(flat * std::cos(around), flat * std::sin(around), up);
    const Vec3 place = corner + turn * Vec3(0.3 * std::sin(i), 0.3 * std::cos(i), 0.02 * i);
    const Outcome outcome = RunTrim(mesh, PlaneThrough(place, normal, 60), options);
    const Model model(outcome.Case.Trimmed);
    vtkDataArray* values = outcome.Case.Trimmed->GetPointData()->GetArray("Field");
    for (std::size_t n = 0; n < model.Points.size(); ++n)
    {
      const double wrong = std::abs(values->GetComponent(n, 0) - field(model.Points[n]));
      Expect(wrong <= 1e-4,
        "inner corner, cut " + std::to_string(i) + ": a node is wrong by " + std::to_string(wrong));
    }
  }
}

int main()
{
  TrimOptions options;
  for (const char* name : { "sheet2", "sheet1", "irregular", "wedges", "block", "float", "far" })
  {
    TestLinear(name, "wavy", options);
  }
  for (const int treatment : { 0, 1 })
  {
    options.Optimization = treatment;
    TestLinear("sheet3", "contour", options);
  }
  options.Optimization = 2;
  options.CorrectionType = 3;
  TestLinear("sheet3", "cylinder", options);
  TestLinear("dome", "contour", options);
  options.CorrectionType = 2;
  options.Optimization = 0; // leaves elements folded at a corner, here at the points of a fine rule
  TestLinear("twist", "cylinder", options);
  TestTheRest("sheet2");
  TestTheRest("permuted");
  TestTheRest("wedges");
  TestRangeAndSum();
  TestNotANumber();
  TestNotMapped();
  TestContact();
  TestInnerCorner();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
