/**
 * @file TestChecks.cxx
 * @brief The judge must pass a trim that is right on paper, and its offcut, and report every way of
 * breaking them.
 *
 * The right one is a sheet of 6 x 4 x 2 elements cut by the plane x = 3.4: the elements of the
 * fourth column lose 60 % and go, those of the first three stay, and their last nodes are pulled
 * out from x = 3 to 3.4. The offcut is the other half, with the side inverted.
 */
#include "Checks.h"

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
  const std::vector<vtkIdType>& points, const std::vector<vtkIdType>& cells, bool isOffcut)
{
  const double side = isOffcut ? -1 : 1;
  const auto x = [&](vtkIdType i) { return input->GetPoint(points[i])[0]; };
  const auto cellX = [&](vtkIdType c) { return double(cells[c] % 6); };
  const auto n = static_cast<vtkIdType>(points.size()), m = static_cast<vtkIdType>(cells.size());
  vtkPointData* pd = grid->GetPointData();
  vtkCellData* cd = grid->GetCellData();
  Fill<vtkUnsignedCharArray>(
    pd, "NodeStatus", 1, n, [&](vtkIdType i, int) { return side * (x(i) - CutAt) > 0; });
  Fill<vtkFloatArray>(pd, "SignedDistance", 1, n,
    [&](vtkIdType i, int)
    { return std::abs(x(i) - CutAt) < 1.5 ? side * (x(i) - CutAt) : std::nan(""); });
  Fill<vtkFloatArray>(pd, "Displacement", 3, n,
    [&](vtkIdType i, int k) { return x(i) == LastColumn && k == 0 ? CutAt - LastColumn : 0; });
  Fill<vtkUnsignedCharArray>(
    pd, "CorrectionApplied", 1, n, [&](vtkIdType i, int) { return x(i) == LastColumn ? 2 : 0; });
  const auto byColumn = [&](vtkIdType c, double kept, double cut, double eliminated) {
    return cellX(c) == LastColumn ? cut : side * (cellX(c) - LastColumn) < 0 ? kept : eliminated;
  };
  Fill<vtkUnsignedCharArray>(
    cd, "ElementStatus", 1, m, [&](vtkIdType c, int) { return byColumn(c, 0, 2, 1); });
  Fill<vtkFloatArray>(cd, "EliminatedFraction", 1, m,
    [&](vtkIdType c, int) { return byColumn(c, 0, isOffcut ? 0.4 : 0.6, 1); });
  Fill<vtkUnsignedCharArray>(
    cd, "Rescue", 1, m, [&](vtkIdType c, int) { return cells[c] == 2 || cells[c] == 3; });
}

vtkSmartPointer<vtkUnstructuredGrid> RightTrim(vtkUnstructuredGrid* input, bool isOffcut)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::vector<vtkIdType> points, cells, number(input->GetNumberOfPoints(), -1);
  vtkNew<vtkPoints> positions;
  positions->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    double p[3];
    input->GetPoint(i, p);
    if (isOffcut ? p[0] < LastColumn : p[0] > LastColumn)
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
    if ((c % 6 >= LastColumn) != isOffcut)
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
  AddStatuses(grid, input, points, cells, isOffcut);
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
    [&](vtkIdType c, int)
    {
      return cells[c] % 6 == (isOffcut ? 3 : 2)
        ? vtkMeshQuality::HexScaledJacobian(grid->GetCell(c))
        : std::nan("");
    });
  const std::map<std::string, double> summary = { { "Kept", 24 }, { "Eliminated", 24 },
    { "InsertedElements", 0 }, { "Treated", 8 }, { "MovedNodes", 15 }, { "Pentahedra", 0 },
    { "Wedges", 0 }, { "CertifiedElements", 8 }, { "TouchedElements", 8 },
    { "MinimumScaledJacobian", 1 }, { "MinimumIntegrationPointJacobian", 1 },
    { "MaximumDistanceToSurface", 0 }, { "Volume", (isOffcut ? 6 - CutAt : CutAt) * 4 * 0.8 },
    { "NodeBandwidth", 20 + 4 + 1 }, { "RescuedByRelaxation", 2 }, { "RescuedByTreatment", 0 },
    { "RescuedByCorrection", 0 }, { "RescuedByFate", 0 }, { "RescuedByLeaving", 0 } };
  for (const auto& entry : summary)
  {
    Fill<vtkDoubleArray>(grid->GetFieldData(), entry.first.c_str(), 1, 1,
      [&](vtkIdType, int) { return entry.second; });
  }
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> RightWhole(vtkUnstructuredGrid* input, bool isOffcut)
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
  AddStatuses(grid, input, points, cells, isOffcut);
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
  std::function<void(TrimOptions&)> Ask = [](TrimOptions&) {}; ///< for other things
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

/// Makes the cells anew, with their data and all points.
/// @param change change(cell, type, ids) says what becomes of each; false: it goes.
void ChangeCells(
  Grid* t, const std::function<bool(vtkIdType cell, int& type, vtkIdList* ids)>& change)
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
    old->GetCellPoints(c, ids);
    int type = old->GetCellType(c);
    if (change(c, type, ids))
    {
      t->GetCellData()->CopyData(old->GetCellData(), c, t->InsertNextCell(type, ids));
    }
  }
}

void DropCell(Grid* t, vtkIdType cell)
{
  ChangeCells(t, [cell](vtkIdType c, int&, vtkIdList*) { return c != cell; });
}

/// Gives a cell these of its own points, by number, as a hexahedron or a wedge.
void RenewCell(Grid* t, vtkIdType cell, const std::vector<int>& points)
{
  ChangeCells(t,
    [&](vtkIdType c, int& type, vtkIdList* ids)
    {
      vtkNew<vtkIdList> before;
      before->DeepCopy(ids);
      for (std::size_t i = 0; c == cell && i < points.size(); ++i)
      {
        ids->SetId(static_cast<vtkIdType>(i), before->GetId(points[i]));
      }
      if (c == cell)
      {
        ids->Resize(static_cast<vtkIdType>(points.size()));
        type = points.size() == 8 ? VTK_HEXAHEDRON : VTK_WEDGE;
      }
      return true;
    });
}

/// Numbers two points the other way round.
void SwapPoints(Grid* t, vtkIdType a, vtkIdType b)
{
  vtkPointData* data = t->GetPointData();
  std::vector<vtkAbstractArray*> arrays{ t->GetPoints()->GetData() };
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    arrays.push_back(data->GetAbstractArray(i));
  }
  for (vtkAbstractArray* array : arrays)
  {
    const auto before = vtk::TakeSmartPointer(array->NewInstance());
    before->DeepCopy(array);
    array->SetTuple(a, b, before);
    array->SetTuple(b, a, before);
  }
  ChangeCells(t,
    [=](vtkIdType, int&, vtkIdList* ids)
    {
      for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      {
        const vtkIdType id = ids->GetId(i);
        ids->SetId(i, id == a ? b : id == b ? a : id);
      }
      return true;
    });
}

std::vector<Fault> ElementFaults()
{
  return {
    { "cell types", "a cell of another type",
      [](Grid* t, Grid*)
      {
        ChangeCells(t,
          [](vtkIdType c, int& type, vtkIdList*)
          {
            type = c == 3 ? VTK_VOXEL : type;
            return true;
          });
      } },
    { "port 1", "a cell less on it",
      [](Grid*, Grid* w)
      { ChangeCells(w, [](vtkIdType c, int&, vtkIdList*) { return c != 3; }); } },
    { "distinct nodes", "a node twice in an element",
      [](Grid* t, Grid*) {
        RenewCell(t, 0, { 0, 0, 2, 3, 4, 5, 6, 7 });
      } },
    { "nodes of an element are those it had", "a node of another element",
      [](Grid* t, Grid*)
      {
        ChangeCells(t,
          [t](vtkIdType c, int&, vtkIdList* ids)
          {
            ids->SetId(0, c == 0 ? t->GetNumberOfPoints() - 1 : ids->GetId(0));
            return true;
          });
      } },
    { "nodes of an untouched element", "in another order",
      [](Grid* t, Grid*) {
        RenewCell(t, 0, { 1, 2, 3, 0, 5, 6, 7, 4 });
      } },
    { "no wedge without treatment", "a wedge",
      [](Grid* t, Grid*) {
        RenewCell(t, 2, { 0, 1, 3, 4, 5, 7 });
      },
      [](TrimOptions& options) { options.Optimization = 0; } },
    { "nothing kept", "no element left",
      [](Grid* t, Grid*) { ChangeCells(t, [](vtkIdType, int&, vtkIdList*) { return false; }); } },
    { "unused points", "those of an element that is missing",
      [](Grid* t, Grid*) { DropCell(t, 0); } },
    { "no element collapses", "pressed to nothing",
      [](Grid* t, Grid*)
      {
        for (vtkIdType i = 0; i < t->GetNumberOfPoints(); ++i)
        {
          Shift(t, i, t->GetPoint(i)[0] == CutAt ? LastColumn - 1 + 1e-7 - CutAt : 0, 0, 0);
        }
      } },
    { "quality floor", "a corner that is nearly straight",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, CutAt, 2, 0), -0.9, -0.9, 0); } },
    { "in the mesh's box", "a corner outside",
      [](Grid* t, Grid*) { Shift(t, PointAt(t, 0, 0, 0.4), 0, 0, 0.1); } },
    { "DistanceLeft", "of a node that is on the surface",
      [](Grid* t, Grid*)
      { SetValue(t->GetPointData(), "DistanceLeft", PointAt(t, CutAt, 2, 0), 0.1); } },
    { "volume cut by a plane", "the border before the surface",
      [](Grid* t, Grid*)
      {
        for (vtkIdType i = 0; i < t->GetNumberOfPoints(); ++i)
        {
          Shift(t, i, t->GetPoint(i)[0] == CutAt ? -1e-6 : 0, 0, 0);
        }
      } },
    { "type I moves nothing", "it does", [](Grid*, Grid*) {},
      [](TrimOptions& options) { options.CorrectionType = 1; } },
    { "type III stays on a mesh edge", "a node beside it",
      [](Grid* t, Grid*)
      {
        const vtkIdType node = PointAt(t, CutAt, 2, 0);
        Shift(t, node, 0, 1e-6, 0);
        SetValue(t->GetPointData(), "CorrectionApplied", node, 3);
      },
      [](TrimOptions& options)
      {
        options.CorrectionType = 3;
        options.Optimization = 0;
      } },
    { "numbering", "numbers far apart", [](Grid* t, Grid*) { SwapPoints(t, 0, 50); },
      [](TrimOptions& options) { options.RenumberNodes = true; } },
  };
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

/// Of the kept part, and of the offcut in place of the whole input.
std::vector<Fault> PairFaults()
{
  return {
    { "kept part or offcut", "an element in both",
      [](Grid*, Grid* offcut) { SetValue(offcut->GetCellData(), "vtkOriginalCellIds", 1, 2); } },
    { "kept part and offcut add up", "a gap between them",
      [](Grid* kept, Grid*)
      {
        for (vtkIdType i = 0; i < kept->GetNumberOfPoints(); ++i)
        {
          Shift(kept, i, kept->GetPoint(i)[0] == CutAt ? -1e-6 : 0, 0, 0);
        }
      } },
    { "parts fit node by node", "a node elsewhere in one of them",
      [](Grid* kept, Grid*) { Shift(kept, PointAt(kept, CutAt, 2, 0), 0, 1e-6, 0); } },
  };
}

Trial RightTrial(const Mesh& mesh, const Surface& cut, bool isOffcut)
{
  Trial trial;
  trial.Input = &mesh;
  trial.Cut = &cut;
  trial.Options.RenumberNodes = false;
  trial.Options.InvertSide = isOffcut;
  trial.Trimmed = RightTrim(mesh.Grid, isOffcut);
  trial.Whole = RightWhole(mesh.Grid, isOffcut);
  return trial;
}

/// @return how often the report is not what it should be.
int CountWrong(const Report& report, const Fault* fault)
{
  if (!fault)
  {
    return report.Failures();
  }
  if (report.Failures(fault->Check) > 0)
  {
    return 0;
  }
  std::printf("FAIL not reported by '%s': %s\n", fault->Check, fault->What);
  for (const auto& other : report.ByCheck())
  {
    std::printf("     but by '%s'\n", other.first.c_str());
  }
  return 1;
}

int Run(const Mesh& mesh, const Surface& cut, bool isOffcut, const Fault* fault)
{
  Trial trial = RightTrial(mesh, cut, isOffcut);
  if (fault)
  {
    fault->Break(trial.Trimmed, trial.Whole);
    fault->Ask(trial.Options);
  }
  Report report(isOffcut ? "right offcut" : "right trim", fault != nullptr);
  const Evidence evidence(trial, report);
  JudgeAll(evidence, report);
  if (evidence.Usable)
  {
    CheckPlaneVolume(evidence, Vec3(CutAt, 0, 0), (isOffcut ? -1 : 1) * Vec3::UnitX(), report);
    CheckKeptVolume(evidence, 0.15, report);
    CheckNothingKept(evidence, report);
  }
  return CountWrong(report, fault);
}

int RunPair(const Mesh& mesh, const Surface& cut, const Fault* fault)
{
  const Trial kept = RightTrial(mesh, cut, false), offcut = RightTrial(mesh, cut, true);
  for (const Trial* trial : { &kept, &offcut })
  {
    // Nothing is asked of parts that a rescue made.
    SetValue(trial->Trimmed->GetFieldData(), "RescuedByRelaxation", 0, 0);
  }
  if (fault)
  {
    fault->Break(kept.Trimmed, offcut.Trimmed);
  }
  Report report("right pair", fault != nullptr);
  CheckPair(Evidence(kept, report), Evidence(offcut, report), report);
  return CountWrong(report, fault);
}
}

int main()
{
  const Mesh mesh = Sheet(6, 4, 2, Vec3(1, 1, 0.4));
  const Surface cut = PlaneThrough(Vec3(CutAt, 2, 0), Vec3::UnitX(), 100);
  int wrong = Run(mesh, cut, false, nullptr) + Run(mesh, cut, true, nullptr);
  wrong += RunPair(mesh, cut, nullptr);
  int faults = 0;
  for (const auto& list : { StatusFaults(), GeometryFaults(), ElementFaults(), OtherFaults() })
  {
    for (const Fault& fault : list)
    {
      wrong += Run(mesh, cut, false, &fault);
      ++faults;
    }
  }
  for (const Fault& fault : PairFaults())
  {
    wrong += RunPair(mesh, cut, &fault);
    ++faults;
  }
  // The same bits, and not.
  const auto a = RightTrim(mesh.Grid, false), b = RightTrim(mesh.Grid, false);
  wrong += !FirstDifference(a, b).empty();
  Shift(b, 7, 0, 0, 1e-15);
  wrong += FirstDifference(a, b).empty();
  std::printf("%d faults tried, %d wrong\n", faults, wrong);
  return wrong > 0;
}
