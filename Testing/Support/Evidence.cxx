#include "Evidence.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace judge
{
namespace
{
// Values of a one-component array; empty and reported where the array does not fit.
template <typename T>
std::vector<T> Values(
  vtkDataSetAttributes* data, const char* name, vtkIdType tuples, Report& report)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array || array->GetNumberOfTuples() != tuples)
  {
    report.Fail("arrays", std::string(name) + " is missing or has a wrong number of tuples");
    return {};
  }
  std::vector<T> values(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    values[i] = static_cast<T>(array->GetComponent(i, 0));
  }
  return values;
}

/// Wedges of an input may have the order of their nodes that those of an output must not have.
Model WithWedgesTurned(Model model)
{
  for (Id e = 0; e < static_cast<Id>(model.Elements.size()); ++e)
  {
    Element& element = model.Elements[e];
    if (element.Size == 6 && VolumeOf(model.Corners(e), 6) < 0)
    {
      std::swap_ranges(element.Node.begin(), element.Node.begin() + 3, element.Node.begin() + 3);
    }
  }
  return model;
}
}

Evidence::Evidence(const Trial& trial, Report& report)
  : Case(trial)
  , In(WithWedgesTurned(Model(trial.Input->Grid)))
  , Out(trial.Trimmed)
  , Border(In)
  , Diagonal(In.Diagonal())
{
  double largest = 0;
  for (const Vec3& p : this->In.Points)
  {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  // Coordinates cannot be better than their type.
  vtkPoints* points = trial.Trimmed->GetPoints();
  const bool single = points && points->GetDataType() == VTK_FLOAT;
  this->Rounding = (single ? 1.2e-7 : 4.5e-16) * largest;
  this->Exact = 1e-9 * this->Diagonal + this->Rounding;

  const TrimOptions& options = trial.Options;
  this->SideSign = options.InvertSide ? -1 : 1;
  if (options.UseKeepPoint && trial.Cut->Signed(options.KeepPoint) > 0)
  {
    this->SideSign = -this->SideSign;
  }
  this->CellsAt.resize(this->In.Points.size());
  for (Id e = 0; e < static_cast<Id>(this->In.Elements.size()); ++e)
  {
    for (int i = 0; i < this->In.Elements[e].Size; ++i)
    {
      this->CellsAt[this->In.Elements[e].Node[i]].push_back(e);
    }
  }
  if (this->Out.BadCell >= 0)
  {
    report.Fail(
      "cell types", Cell(this->Out.BadCell) + " of port 0 is neither hexahedron nor wedge");
    return;
  }
  this->Usable = this->ReadOrigins(report) && this->ReadStatuses(report);
  if (this->Usable)
  {
    this->FindNewBoundary();
  }
}

namespace
{
/// Without a layer nothing is.
std::vector<char> ReadInserted(vtkDataSetAttributes* data, vtkIdType count)
{
  std::vector<char> inserted(count, 0);
  vtkDataArray* array = data->GetArray("Inserted");
  for (vtkIdType i = 0; array && i < count; ++i)
  {
    inserted[i] = array->GetComponent(i, 0) != 0;
  }
  return inserted;
}
}

bool Evidence::ReadOrigins(Report& report)
{
  const auto points = static_cast<vtkIdType>(this->Out.Points.size());
  const auto cells = static_cast<vtkIdType>(this->Out.Elements.size());
  this->PointOf =
    Values<Id>(this->Case.Trimmed->GetPointData(), "vtkOriginalPointIds", points, report);
  this->CellOf = Values<Id>(this->Case.Trimmed->GetCellData(), "vtkOriginalCellIds", cells, report);
  this->InsertedPoint = ReadInserted(this->Case.Trimmed->GetPointData(), points);
  this->InsertedCell = ReadInserted(this->Case.Trimmed->GetCellData(), cells);
  const auto good = [](const std::vector<Id>& ids, const std::vector<char>& inserted,
                      std::size_t count, bool mayRepeat = false)
  {
    std::set<Id> all, own;
    std::size_t owned = 0;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      all.insert(ids[i]);
      if (!inserted[i])
      {
        own.insert(ids[i]);
        ++owned;
      }
    }
    return (mayRepeat || own.size() == owned) &&
      (all.empty() || (*all.begin() >= 0 && *all.rbegin() < static_cast<Id>(count)));
  };
  if (!good(this->PointOf, this->InsertedPoint, this->In.Points.size()) ||
    !good(this->CellOf, this->InsertedCell, this->In.Elements.size(), this->Case.MayDivide))
  {
    report.Fail("original ids", "an id is out of range or appears twice");
    return false;
  }
  this->KeptCell.assign(this->In.Elements.size(), 0);
  for (Id c : this->CellOf)
  {
    this->KeptCell[c] = 1;
  }
  return static_cast<vtkIdType>(this->PointOf.size()) == points &&
    static_cast<vtkIdType>(this->CellOf.size()) == cells;
}

bool Evidence::ReadStatuses(Report& report)
{
  vtkUnstructuredGrid* whole = this->Case.Whole;
  const auto points = static_cast<vtkIdType>(this->In.Points.size());
  const auto cells = static_cast<vtkIdType>(this->In.Elements.size());
  if (whole->GetNumberOfPoints() != points || whole->GetNumberOfCells() != cells)
  {
    report.Fail("port 1", "is not the whole input");
    return false;
  }
  const int before = report.Failures();
  this->NodeStatus = Values<unsigned char>(whole->GetPointData(), "NodeStatus", points, report);
  this->SignedDistance = Values<float>(whole->GetPointData(), "SignedDistance", points, report);
  this->ElementStatus = Values<unsigned char>(whole->GetCellData(), "ElementStatus", cells, report);
  this->Fraction = Values<float>(whole->GetCellData(), "EliminatedFraction", cells, report);
  return report.Failures() == before;
}

bool Evidence::HasOnBorder(Id cell, const std::set<Id>& points) const
{
  const auto facets = FacetsOf(this->In.Elements[cell], cell);
  return std::any_of(facets.begin(), facets.end(),
    [&](const Facet& facet)
    {
      const std::set<Id> nodes(facet.Node.begin(), facet.Node.begin() + facet.Size());
      return std::includes(nodes.begin(), nodes.end(), points.begin(), points.end()) &&
        this->Border.Facets().Uses.at(FacetKey(facet)) == 1;
    });
}

void Evidence::FindNewBoundary()
{
  this->OnNewBoundary.assign(this->Out.Points.size(), 0);
  for (const Facet& facet : FacetTable(this->Out).Exterior)
  {
    std::set<Id> original;
    for (int i = 0; i < facet.Size(); ++i)
    {
      original.insert(this->PointOf[facet.Node[i]]);
    }
    // Old if it lies in an exterior facet of the element it came from (a wedge's triangle is
    // part of a quadrilateral), or, where a layer ends at the border, of one at the same edge.
    const Id cell = this->CellOf[facet.Owner];
    const bool endsLayer = this->InsertedCell[facet.Owner] && original.size() == 2;
    const std::vector<Id>& cells = this->CellsAt[*original.begin()];
    if (endsLayer ? std::any_of(cells.begin(), cells.end(),
                      [&](Id c) { return this->HasOnBorder(c, original); })
                  : this->HasOnBorder(cell, original))
    {
      continue;
    }
    this->NewBoundary.push_back(facet);
    for (int i = 0; i < facet.Size(); ++i)
    {
      this->OnNewBoundary[facet.Node[i]] = 1;
    }
  }
}

double Evidence::Signed(const Vec3& p) const
{
  return this->SideSign * this->Case.Cut->Signed(p);
}

double Evidence::Roughly(const Vec3& p) const
{
  return this->SideSign * this->Case.Cut->Roughly(p);
}

bool Evidence::Moved(Id p) const
{
  return this->Out.Points[p] != this->In.Points[this->PointOf[p]];
}

bool Evidence::Touched(Id c) const
{
  const Element& element = this->Out.Elements[c];
  for (int i = 0; i < element.Size; ++i)
  {
    if (this->Moved(element.Node[i]))
    {
      return true;
    }
  }
  return false;
}

bool Evidence::HasOrphans() const
{
  for (std::size_t p = 0; p < this->In.Points.size(); ++p)
  {
    const auto& cells = this->CellsAt[p];
    const auto kept =
      std::count_if(cells.begin(), cells.end(), [this](Id c) { return this->KeptCell[c]; });
    if (!cells.empty() &&
      ((this->NodeStatus[p] == 1 && kept == static_cast<std::ptrdiff_t>(cells.size())) ||
        (this->NodeStatus[p] == 0 && kept == 0)))
    {
      return true;
    }
  }
  return false;
}

double Evidence::Number(const char* name) const
{
  vtkDataArray* array = this->Case.Trimmed->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() == 1 ? array->GetComponent(0, 0) : std::nan("");
}

bool Evidence::Rescued() const
{
  vtkFieldData* data = this->Case.Trimmed->GetFieldData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array->GetName() && std::strncmp(array->GetName(), "Rescued", 7) == 0 &&
      array->GetNumberOfValues() == 1 && array->GetComponent(0, 0) > 0)
    {
      return true;
    }
  }
  return false;
}

}
