#include "Checks.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkLookupTable.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkVariant.h>

#include <cstring>
#include <numeric>
#include <set>

namespace judge
{
namespace
{
// Names that the filter writes itself: an input that was trimmed before has them too.
const std::set<std::string>& OwnNames()
{
  static const std::set<std::string> names{ "NodeStatus", "SignedDistance", "Displacement",
    "CorrectionApplied", "ElementStatus", "EliminatedFraction", "ScaledJacobian",
    "vtkOriginalPointIds", "vtkOriginalCellIds", "Kept", "Eliminated", "Treated", "MovedNodes",
    "Pentahedra", "Wedges", "CertifiedElements", "TouchedElements", "MinimumScaledJacobian",
    "MinimumIntegrationPointJacobian", "MaximumDistanceToSurface", "Volume", "NodeBandwidth",
    "Rescue", "Inserted", "InsertedElements", "Feasibility", "Shortfall", "DistanceLeft",
    "CornerLost", "NewBoundary" };
  return names;
}

bool IsOwn(const char* name)
{
  return name && (OwnNames().count(name) > 0 || std::strncmp(name, "Rescued", 7) == 0);
}

bool SameTuple(vtkAbstractArray* a, vtkIdType i, vtkAbstractArray* b, vtkIdType j)
{
  const int n = a->GetNumberOfComponents();
  if (auto* text = vtkStringArray::SafeDownCast(a))
  {
    auto* other = vtkStringArray::SafeDownCast(b);
    for (int k = 0; k < n; ++k)
    {
      if (!other || text->GetValue(i * n + k) != other->GetValue(j * n + k))
      {
        return false;
      }
    }
    return true;
  }
  if (a->GetDataType() == VTK_BIT)
  {
    for (int k = 0; k < n; ++k)
    {
      if (a->GetVariantValue(i * n + k) != b->GetVariantValue(j * n + k))
      {
        return false;
      }
    }
    return true;
  }
  const std::size_t bytes = static_cast<std::size_t>(n) * a->GetDataTypeSize();
  return std::memcmp(a->GetVoidPointer(i * n), b->GetVoidPointer(j * n), bytes) == 0;
}

std::string UnitOf(vtkAbstractArray* array)
{
  const auto key = vtkDataArray::UNITS_LABEL();
  const bool has = array->HasInformation() && array->GetInformation()->Has(key);
  return has ? array->GetInformation()->Get(key) : "";
}

// The array `name` of the output is that of the input, tuple ids[i] at i (ids null: i).
void Compare(vtkAbstractArray* in, vtkAbstractArray* out, const std::vector<Id>* ids,
  const std::string& what, Report& report)
{
  if (!out)
  {
    report.Fail("carried arrays", what + " is missing");
    return;
  }
  const vtkIdType expected = ids ? static_cast<vtkIdType>(ids->size()) : in->GetNumberOfTuples();
  if (in->GetDataType() != out->GetDataType() ||
    in->GetNumberOfComponents() != out->GetNumberOfComponents() ||
    out->GetNumberOfTuples() != expected)
  {
    report.Fail("carried arrays", what + " changed type, components or length");
    return;
  }
  for (int k = 0; k < in->GetNumberOfComponents(); ++k)
  {
    const char* a = in->GetComponentName(k);
    const char* b = out->GetComponentName(k);
    if ((a == nullptr) != (b == nullptr) || (a && std::strcmp(a, b) != 0))
    {
      report.Fail("carried arrays", what + " lost a component's name");
    }
  }
  if (UnitOf(in) != UnitOf(out))
  {
    report.Fail("carried arrays", what + " lost its unit");
  }
  auto* const numbers = vtkDataArray::SafeDownCast(in);
  if (numbers && numbers->GetLookupTable() != vtkDataArray::SafeDownCast(out)->GetLookupTable())
  {
    report.Fail("carried arrays", what + " lost its colours");
  }
  for (vtkIdType i = 0; i < expected; ++i)
  {
    if (!SameTuple(in, ids ? (*ids)[i] : i, out, i))
    {
      report.Fail("carried arrays", what + " has another value at", i, 0);
      return;
    }
  }
}

bool IsFlags(const std::string& name)
{
  return name == vtkDataSetAttributes::GhostArrayName();
}

/// True if points or cells of the output have one origin: inserted ones, parts of an element.
bool SharesOrigins(vtkDataSetAttributes* data)
{
  for (const char* name : { "vtkOriginalPointIds", "vtkOriginalCellIds" })
  {
    if (vtkDataArray* origins = data->GetArray(name))
    {
      std::set<double> different;
      for (vtkIdType i = 0; i < origins->GetNumberOfTuples(); ++i)
      {
        different.insert(origins->GetComponent(i, 0));
      }
      return static_cast<vtkIdType>(different.size()) < origins->GetNumberOfTuples();
    }
  }
  return false;
}

void CompareAttributes(vtkDataSetAttributes* in, vtkDataSetAttributes* out,
  const std::vector<Id>* ids, const std::string& where, Report& report)
{
  for (int i = 0; i < in->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = in->GetAbstractArray(i);
    if (array->GetName() && IsFlags(array->GetName()))
    {
      if (out->HasArray(array->GetName()))
      {
        report.Fail("carried arrays", where + " has flags of ghosts");
      }
    }
    else if (array->GetName() && !IsOwn(array->GetName()))
    {
      Compare(array, out->GetAbstractArray(array->GetName()), ids, where + " " + array->GetName(),
        report);
    }
  }
  for (int k = 0; k < vtkDataSetAttributes::NUM_ATTRIBUTES; ++k)
  {
    vtkAbstractArray* a = in->GetAbstractAttribute(k);
    vtkAbstractArray* b = out->GetAbstractAttribute(k);
    if (k == vtkDataSetAttributes::GLOBALIDS && SharesOrigins(out))
    {
      if (b)
      {
        report.Fail("carried arrays", where + " several have one global id");
      }
      continue;
    }
    if (a && !IsOwn(a->GetName()) && (!b || std::strcmp(a->GetName(), b->GetName()) != 0))
    {
      report.Fail("carried arrays",
        where + " " + a->GetName() + " is no longer the active " +
          vtkDataSetAttributes::GetAttributeTypeAsString(k));
    }
  }
}

std::string DifferentData(vtkFieldData* a, vtkFieldData* b)
{
  if (a->GetNumberOfArrays() != b->GetNumberOfArrays())
  {
    return "number of arrays";
  }
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* x = a->GetAbstractArray(i);
    vtkAbstractArray* y = b->GetAbstractArray(i);
    const std::string name = x->GetName() ? x->GetName() : "";
    if (!y || name != (y->GetName() ? y->GetName() : "") || x->GetDataType() != y->GetDataType() ||
      x->GetNumberOfTuples() != y->GetNumberOfTuples() ||
      x->GetNumberOfComponents() != y->GetNumberOfComponents())
    {
      return "array " + name;
    }
    for (vtkIdType t = 0; t < x->GetNumberOfTuples(); ++t)
    {
      if (!SameTuple(x, t, y, t))
      {
        return "array " + name + " at " + std::to_string(t);
      }
    }
  }
  return "";
}

std::vector<Id> FirstIds(Id count)
{
  std::vector<Id> ids(count);
  std::iota(ids.begin(), ids.end(), Id(0));
  return ids;
}
}

void CheckCarriedArrays(const Evidence& e, Report& report)
{
  vtkUnstructuredGrid* in = e.Case.Input->Grid;
  vtkUnstructuredGrid* out = e.Case.Trimmed;
  vtkUnstructuredGrid* whole = e.Case.Whole;
  CompareAttributes(
    in->GetPointData(), out->GetPointData(), &e.PointOf, "port 0 point data", report);
  CompareAttributes(in->GetCellData(), out->GetCellData(), &e.CellOf, "port 0 cell data", report);
  // Not by the arrays' own lengths, which may be more than the grid has.
  const auto points = FirstIds(in->GetNumberOfPoints()), cells = FirstIds(in->GetNumberOfCells());
  CompareAttributes(
    in->GetPointData(), whole->GetPointData(), &points, "port 1 point data", report);
  CompareAttributes(in->GetCellData(), whole->GetCellData(), &cells, "port 1 cell data", report);
  for (int i = 0; i < in->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = in->GetFieldData()->GetAbstractArray(i);
    if (!IsOwn(array->GetName()))
    {
      Compare(array, out->GetFieldData()->GetAbstractArray(array->GetName()), nullptr,
        std::string("port 0 field data ") + array->GetName(), report);
      Compare(array, whole->GetFieldData()->GetAbstractArray(array->GetName()), nullptr,
        std::string("port 1 field data ") + array->GetName(), report);
    }
  }
}

std::string FirstDifference(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints() ||
    a->GetNumberOfCells() != b->GetNumberOfCells())
  {
    return "number of points or cells";
  }
  if (a->GetNumberOfPoints() > 0)
  {
    vtkDataArray* x = a->GetPoints()->GetData();
    vtkDataArray* y = b->GetPoints()->GetData();
    if (x->GetDataType() != y->GetDataType())
    {
      return "type of the points";
    }
    for (vtkIdType i = 0; i < x->GetNumberOfTuples(); ++i)
    {
      if (!SameTuple(x, i, y, i))
      {
        return "point " + std::to_string(i);
      }
    }
  }
  vtkNew<vtkIdList> p, q;
  for (vtkIdType c = 0; c < a->GetNumberOfCells(); ++c)
  {
    a->GetCellPoints(c, p);
    b->GetCellPoints(c, q);
    bool same =
      a->GetCellType(c) == b->GetCellType(c) && p->GetNumberOfIds() == q->GetNumberOfIds();
    for (vtkIdType i = 0; same && i < p->GetNumberOfIds(); ++i)
    {
      same = p->GetId(i) == q->GetId(i);
    }
    if (!same)
    {
      return "cell " + std::to_string(c);
    }
  }
  std::string where = DifferentData(a->GetPointData(), b->GetPointData());
  if (!where.empty())
  {
    return "point data: " + where;
  }
  where = DifferentData(a->GetCellData(), b->GetCellData());
  if (!where.empty())
  {
    return "cell data: " + where;
  }
  where = DifferentData(a->GetFieldData(), b->GetFieldData());
  return where.empty() ? "" : "field data: " + where;
}

}
