/**
 * @file TestChecks.cxx
 * @brief The judge must pass a trim that is right on paper and report every way of breaking it.
 *
 * The right one is a sheet of 6 x 4 x 2 elements cut by the plane x = 3.4: the elements of the
 * fourth column lose 60 % and go, those of the first three stay, and their last nodes are pulled
 * out from x = 3 to 3.4.
 */
#include "Checks.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdio>
#include <functional>

using namespace judge;

namespace
{
constexpr double CutAt = 3.4;
constexpr int LastColumn = 3;

template <typename ArrayT, typename ValueF>
void Fill(vtkFieldData* data, const char* name, int components, vtkIdType tuples, ValueF value)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int k = 0; k < components; ++k)
    {
      array->InsertNextValue(static_cast<typename ArrayT::ValueType>(value(i, k)));
    }
  }
  data->AddArray(array);
}

// Statuses as both ports carry them; ids map to the input.
void AddStatuses(vtkUnstructuredGrid* grid, vtkUnstructuredGrid* input,
  const std::vector<vtkIdType>& points, const std::vector<vtkIdType>& cells)
{
  const auto x = [&](vtkIdType i) { return input->GetPoint(points[i])[0]; };
  const auto cellX = [&](vtkIdType c) { return double(cells[c] % 6); };
  const auto n = static_cast<vtkIdType>(points.size()), m = static_cast<vtkIdType>(cells.size());
  vtkPointData* pd = grid->GetPointData();
  vtkCellData* cd = grid->GetCellData();
  Fill<vtkUnsignedCharArray>(
    pd, "NodeStatus", 1, n, [&](vtkIdType i, int) { return x(i) > CutAt; });
  Fill<vtkFloatArray>(pd, "SignedDistance", 1, n,
    [&](vtkIdType i, int) { return std::abs(x(i) - CutAt) < 1.5 ? x(i) - CutAt : std::nan(""); });
  Fill<vtkFloatArray>(pd, "Displacement", 3, n,
    [&](vtkIdType i, int k) { return x(i) == LastColumn && k == 0 ? CutAt - LastColumn : 0; });
  Fill<vtkUnsignedCharArray>(
    pd, "CorrectionApplied", 1, n, [&](vtkIdType i, int) { return x(i) == LastColumn ? 2 : 0; });
  Fill<vtkUnsignedCharArray>(cd, "ElementStatus", 1, m,
    [&](vtkIdType c, int) { return cellX(c) < 3 ? 0
                              : cellX(c) > 3    ? 1
                                                : 2; });
  Fill<vtkFloatArray>(cd, "EliminatedFraction", 1, m,
    [&](vtkIdType c, int) { return cellX(c) < 3 ? 0
                              : cellX(c) > 3    ? 1
                                                : 0.6; });
  Fill<vtkUnsignedCharArray>(
    cd, "Rescue", 1, m, [&](vtkIdType c, int) { return cells[c] == 2 || cells[c] == 3; });
}

vtkSmartPointer<vtkUnstructuredGrid> RightTrim(vtkUnstructuredGrid* input)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::vector<vtkIdType> points, cells, number(input->GetNumberOfPoints(), -1);
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    double p[3];
    input->GetPoint(i, p);
    if (p[0] > LastColumn)
    {
      continue;
    }
    p[0] = p[0] == LastColumn ? CutAt : p[0];
    number[i] = positions->InsertNextPoint(p);
    points.push_back(i);
  }
  grid->SetPoints(positions);
  grid->Allocate(input->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    if (c % 6 >= LastColumn)
    {
      continue;
    }
    input->GetCellPoints(c, ids);
    for (int i = 0; i < 8; ++i)
    {
      ids->SetId(i, number[ids->GetId(i)]);
    }
    grid->InsertNextCell(VTK_HEXAHEDRON, ids);
    cells.push_back(c);
  }
  const auto n = static_cast<vtkIdType>(points.size()), m = static_cast<vtkIdType>(cells.size());
  grid->GetPointData()->CopyAllOn();
  grid->GetPointData()->CopyAllocate(input->GetPointData());
  grid->GetCellData()->CopyAllOn();
  grid->GetCellData()->CopyAllocate(input->GetCellData());
  for (vtkIdType i = 0; i < n; ++i)
  {
    grid->GetPointData()->CopyData(input->GetPointData(), points[i], i);
  }
  for (vtkIdType c = 0; c < m; ++c)
  {
    grid->GetCellData()->CopyData(input->GetCellData(), cells[c], c);
  }
  grid->GetFieldData()->ShallowCopy(input->GetFieldData());
  AddStatuses(grid, input, points, cells);
  Fill<vtkIdTypeArray>(
    grid->GetPointData(), "vtkOriginalPointIds", 1, n, [&](vtkIdType i, int) { return points[i]; });
  Fill<vtkIdTypeArray>(
    grid->GetCellData(), "vtkOriginalCellIds", 1, m, [&](vtkIdType c, int) { return cells[c]; });
  const auto zero = [](vtkIdType, int) { return 0; };
  Fill<vtkFloatArray>(grid->GetPointData(), "DistanceLeft", 1, n, zero);
  Fill<vtkUnsignedCharArray>(grid->GetPointData(), "NewBoundary", 1, n,
    [&](vtkIdType i, int) { return positions->GetPoint(i)[0] == CutAt; });
  Fill<vtkUnsignedCharArray>(grid->GetCellData(), "Shortfall", 1, m, zero);
  Fill<vtkFloatArray>(grid->GetCellData(), "ScaledJacobian", 1, m,
    [&](vtkIdType c, int) {
      return cells[c] % 6 == 2 ? vtkMeshQuality::HexScaledJacobian(grid->GetCell(c)) : std::nan("");
    });
  const std::map<std::string, double> summary = { { "Kept", 24 }, { "Eliminated", 24 },
    { "InsertedElements", 0 }, { "Treated", 8 }, { "MovedNodes", 15 }, { "Pentahedra", 0 },
    { "Wedges", 0 }, { "CertifiedElements", 8 }, { "TouchedElements", 8 },
    { "MinimumScaledJacobian", 1 }, { "MinimumIntegrationPointJacobian", 1 },
    { "MaximumDistanceToSurface", 0 }, { "Volume", CutAt * 4 * 0.8 },
    { "NodeBandwidth", 20 + 4 + 1 }, { "RescuedByRelaxation", 2 }, { "RescuedByTreatment", 0 },
    { "RescuedByCorrection", 0 }, { "RescuedByFate", 0 }, { "RescuedByLeaving", 0 } };
  for (const auto& entry : summary)
  {
    Fill<vtkDoubleArray>(grid->GetFieldData(), entry.first.c_str(), 1, 1,
      [&](vtkIdType, int) { return entry.second; });
  }
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> RightWhole(vtkUnstructuredGrid* input)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(input);
  std::vector<vtkIdType> points, cells;
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    points.push_back(i);
  }
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    cells.push_back(c);
  }
  AddStatuses(grid, input, points, cells);
  return grid;
}

vtkIdType PointAt(vtkUnstructuredGrid* grid, double x, double y, double z)
{
  const double p[3] = { x, y, z };
  return grid->FindPoint(p[0], p[1], p[2]);
}

void Shift(vtkUnstructuredGrid* grid, vtkIdType point, double x, double y, double z)
{
  double p[3];
  grid->GetPoint(point, p);
  grid->GetPoints()->SetPoint(point, p[0] + x, p[1] + y, p[2] + z);
}

void SetValue(vtkFieldData* data, const char* name, vtkIdType i, double value)
{
  data->GetArray(name)->SetComponent(i, 0, value);
}

struct Fault
{
  const char* Check; ///< that must report it
  const char* What;
  std::function<void(vtkUnstructuredGrid* trimmed, vtkUnstructuredGrid* whole)> Break;
};

using Grid = vtkUnstructuredGrid;

std::vector<Fault> StatusFaults()
{
  return {
    { "arrays", "an array less",
      [](Grid* t, Grid*) { t->GetCellData()->RemoveArray("ElementStatus"); } },
    { "arrays", "summary value missing",
      [](Grid* t, Grid*) { t->GetFieldData()->RemoveArray("Kept"); } },
    { "arrays", "type changed",
      [](Grid* t, Grid*)
      {
        t->GetPointData()->RemoveArray("CorrectionApplied");
        Fill<vtkFloatArray>(t->GetPointData(), "CorrectionApplied", 1, t->GetNumberOfPoints(),
          [](vtkIdType, int) { return 0; });
      } },
    { "NodeStatus", "a node on the wrong side",
      [](Grid*, Grid* w) { SetValue(w->GetPointData(), "NodeStatus", 0, 1); } },
    { "NodeStatus", "a node on the surface that is not",
      [](Grid*, Grid* w) { SetValue(w->GetPointData(), "NodeStatus", 4, 2); } },
    { "NodeStatus", "ports differ",
      [](Grid* t, Grid*) { SetValue(t->GetPointData(), "NodeStatus", 0, 2); } },
    { "Rescue", "ports differ",
      [](Grid* t, Grid*) { SetValue(t->GetCellData(), "Rescue", 1, 2); } },
    { "Rescue", "one more than the summary counts",
      [](Grid*, Grid* w) { SetValue(w->GetCellData(), "Rescue", 4, 1); } },
    { "Rescue", "a rung that the summary does not have",
      [](Grid*, Grid* w) { SetValue(w->GetCellData(), "Rescue", 5, 4); } },
    { "NewBoundary", "a node that is not on it",
      [](Grid* t, Grid*) { SetValue(t->GetPointData(), "NewBoundary", 0, 1); } },
    { "NewBoundary", "a node of it left out",
      [](Grid* t, Grid*)
      { SetValue(t->GetPointData(), "NewBoundary", PointAt(t, CutAt, 0, 0), 0); } },
    { "Shortfall", "a node left off that is not",
      [](Grid* t, Grid*) { SetValue(t->GetCellData(), "Shortfall", 2, 2); } },
    { "Shortfall", "nothing told of a node left off",
      [](Grid* t, Grid*) { SetValue(t->GetPointData(), "DistanceLeft", 0, 0.1); } },
    { "Shortfall, loose part", "told of where all hangs together",
      [](Grid* t, Grid*) { SetValue(t->GetCellData(), "Shortfall", 2, 6); } },
    { "Shortfall, short edge", "told of where no edge is short",
      [](Grid* t, Grid*) { SetValue(t->GetCellData(), "Shortfall", 2, 5); } },
    { "SignedDistance", "wrong by a hundredth",
      [](Grid*, Grid* w) { SetValue(w->GetPointData(), "SignedDistance", 3, -0.41); } },
    { "SignedDistance", "missing at a cut element",
      [](Grid*, Grid* w) { SetValue(w->GetPointData(), "SignedDistance", 3, std::nan("")); } },
    { "ElementStatus", "a cut element kept",
      [](Grid*, Grid* w) { SetValue(w->GetCellData(), "ElementStatus", 3, 0); } },
    { "EliminatedFraction", "off by a tenth",
      [](Grid*, Grid* w) { SetValue(w->GetCellData(), "EliminatedFraction", 3, 0.5); } },
    { "EliminatedFraction", "kept element not 0",
      [](Grid*, Grid* w) { SetValue(w->GetCellData(), "EliminatedFraction", 0, 0.01); } },
    { "original ids", "twice the same",
      [](Grid* t, Grid*) { SetValue(t->GetPointData(), "vtkOriginalPointIds", 0, 1); } },
  };
}

std::vector<Fault> GeometryFaults()
{
  return {
    { "Displacement", "coordinate changed by a bit",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, 1, 1, 0), 1e-6, 0, 0); } },
    { "CorrectionApplied", "moved silently",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, 1, 1, 0), 1e-6, 0, 0); } },
    { "port 1 has the input's coordinates", "moved in port 1",
      [](Grid*, Grid* w)
      {
        vtkNew<vtkPoints> points;
        points->DeepCopy(w->GetPoints());
        w->SetPoints(points);
        Shift(w, 0, 1e-9, 0, 0);
      } },
    { "new boundary on the surface", "node beside the surface",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0), -1e-6, 0, 0); } },
    { "stays on the exterior", "node lifted off the skin",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0.4), 0, 0, 1e-6); } },
    { "stays on the exterior", "node sunk into the sheet",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0.4), 0, 0, -1e-6); } },
    { "stays on the exterior", "node of a lateral side put on the skin",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 0, 0), 0, 1, 0.4); } },
    { "stays on the ridge", "ridge node pulled into the skin",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 0, 0.4), 0, 1e-6, 0); } },
    { "corner stays", "corner moved along its ridge",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, 0, 0, 0.4), 1e-6, 0, 0); } },
    { "Jacobian at integration points", "element turned inside out",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0), 0, 0, 1.5); } },
    { "Bezier certificate", "corner beyond a straight angle",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0.4), -0.8, -0.5, 0); } },
    { "coincident nodes", "two nodes at one place",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0), 0, 1, 0); } },
    { "volume kept", "the border far before the surface",
      [](Grid* t, Grid*)
      {
        for (vtkIdType i = 0; i < t->GetNumberOfPoints(); ++i)
        {
          Shift(t, i, t->GetPoint(i)[0] == CutAt ? -0.8 : 0, 0, 0);
        }
      } },
    { "summary", "volume off",
      [](Grid* t, Grid*) { SetValue(t->GetFieldData(), "Volume", 0, 10.87); } },
    { "summary", "bandwidth off",
      [](Grid* t, Grid*) { SetValue(t->GetFieldData(), "NodeBandwidth", 0, 24); } },
    { "summary", "certified too many",
      [](Grid* t, Grid*) { SetValue(t->GetFieldData(), "CertifiedElements", 0, 9); } },
    { "ScaledJacobian", "off",
      [](Grid* t, Grid*) { SetValue(t->GetCellData(), "ScaledJacobian", 2, 0.99); } },
  };
}

// Removes cells of the trimmed grid (and the points they alone used stay: also a fault).
void DropCell(Grid* t, vtkIdType cell)
{
  vtkNew<vtkUnstructuredGrid> old;
  old->DeepCopy(t);
  t->Allocate(old->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  t->GetCellData()->Initialize();
  t->GetCellData()->CopyAllOn();
  t->GetCellData()->CopyAllocate(old->GetCellData());
  for (vtkIdType c = 0; c < old->GetNumberOfCells(); ++c)
  {
    if (c == cell)
    {
      continue;
    }
    old->GetCellPoints(c, ids);
    const vtkIdType n = t->InsertNextCell(old->GetCellType(c), ids);
    t->GetCellData()->CopyData(old->GetCellData(), c, n);
  }
}

std::vector<Fault> OtherFaults()
{
  return {
    { "manifold", "two elements that hang together by an edge",
      [](Grid* t, Grid*)
      {
        DropCell(t, 7 - 3); // the middle of three columns leaves neighbours across an edge
        DropCell(t, 0);
      } },
    { "carried arrays", "an input array lost",
      [](Grid* t, Grid*) { t->GetPointData()->RemoveArray("Zone"); } },
    { "carried arrays", "a value of another node",
      [](Grid* t, Grid*)
      {
        SetValue(t->GetPointData(), "Temperature", 5,
          t->GetPointData()->GetArray("Temperature")->GetComponent(6, 0));
      } },
    { "carried arrays", "active scalars lost",
      [](Grid* t, Grid*) { t->GetPointData()->SetActiveScalars("Zone"); } },
    { "carried arrays", "component name lost",
      [](Grid* t, Grid*) { t->GetCellData()->GetArray("Stress")->SetComponentName(5, "ZX"); } },
    { "carried arrays", "field data lost on port 1",
      [](Grid*, Grid* w)
      {
        vtkNew<vtkFieldData> none;
        w->SetFieldData(none);
      } },
    { "numbering", "order changed though not asked for",
      [](Grid* t, Grid*)
      {
        SetValue(t->GetPointData(), "vtkOriginalPointIds", 0, 1);
        SetValue(t->GetPointData(), "vtkOriginalPointIds", 1, 0);
      } },
  };
}

int Run(const Mesh& mesh, const Surface& cut, const Fault* fault)
{
  Trial trial;
  trial.Input = &mesh;
  trial.Cut = &cut;
  trial.Options.RenumberNodes = false;
  trial.Trimmed = RightTrim(mesh.Grid);
  trial.Whole = RightWhole(mesh.Grid);
  if (fault)
  {
    fault->Break(trial.Trimmed, trial.Whole);
  }
  Report report("right trim", fault != nullptr);
  const Evidence evidence(trial, report);
  JudgeAll(evidence, report);
  if (evidence.Usable)
  {
    CheckPlaneVolume(evidence, Vec3(CutAt, 0, 0), Vec3::UnitX(), report);
    CheckKeptVolume(evidence, 0.15, report);
  }
  if (!fault)
  {
    return report.Failures();
  }
  if (report.Failures(fault->Check) == 0)
  {
    std::printf("FAIL not reported by '%s': %s\n", fault->Check, fault->What);
    for (const auto& other : report.ByCheck())
    {
      std::printf("     but by '%s'\n", other.first.c_str());
    }
    return 1;
  }
  return 0;
}
}

int main()
{
  const Mesh mesh = Sheet(6, 4, 2, Vec3(1, 1, 0.4));
  const Surface cut = PlaneThrough(Vec3(CutAt, 2, 0), Vec3::UnitX(), 100);
  int wrong = Run(mesh, cut, nullptr);
  int faults = 0;
  for (const auto& list : { StatusFaults(), GeometryFaults(), OtherFaults() })
  {
    for (const Fault& fault : list)
    {
      wrong += Run(mesh, cut, &fault);
      ++faults;
    }
  }
  // The same bits, and not.
  const auto a = RightTrim(mesh.Grid), b = RightTrim(mesh.Grid);
  wrong += !FirstDifference(a, b).empty();
  Shift(b, 7, 0, 0, 1e-15);
  wrong += FirstDifference(a, b).empty();
  std::printf("%d faults tried, %d wrong\n", faults, wrong);
  return wrong > 0;
}
