#include "NameClashes.h"

#include "Summary.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <string>
#include <vector>

namespace trim
{
namespace
{

using Names = std::vector<std::string>;

/// VTK's own names, which many filters leave behind: not worth a warning.
constexpr const char* OriginalPoints = "vtkOriginalPointIds";
constexpr const char* OriginalCells = "vtkOriginalCellIds";
const Names OfPoints{ "NodeStatus", "SignedDistance", "Displacement", "CorrectionApplied",
  "DistanceLeft", "CornerLost", OriginalPoints };
const Names OfCells{ "ElementStatus", "EliminatedFraction", "ScaledJacobian", "Rescue",
  "Feasibility", "Shortfall", OriginalCells };
constexpr const char* Inserted = "Inserted";

Names EntriesOfSummary()
{
  vtkNew<vtkFieldData> entries;
  Summary().AddTo(entries);
  Names names;
  for (int i = 0; i < entries->GetNumberOfArrays(); ++i)
  {
    names.emplace_back(entries->GetArrayName(i));
  }
  return names;
}

/// Whether an earlier trim has made the grid, or what it was made from: filters between the two may
/// have dropped the field data.
bool IsTrimmed(vtkUnstructuredGrid* grid)
{
  return grid->GetFieldData()->HasArray("CertifiedElements") ||
    (grid->GetPointData()->HasArray("NodeStatus") &&
      grid->GetPointData()->HasArray("CorrectionApplied"));
}

bool HasAny(vtkFieldData* data, const Names& names)
{
  for (const std::string& name : names)
  {
    if (data->HasArray(name.c_str()))
    {
      return true;
    }
  }
  return false;
}

/// Another array with the same values.
vtkSmartPointer<vtkAbstractArray> Renamed(vtkAbstractArray* array, const std::string& name)
{
  auto renamed = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  auto* from = vtkDataArray::SafeDownCast(array);
  if (from)
  {
    vtkDataArray::SafeDownCast(renamed)->ShallowCopy(from);
  }
  else
  {
    renamed->DeepCopy(array);
  }
  renamed->SetName(name.c_str());
  return renamed;
}

/// Adds an array; of points and cells it has the role that another one had.
void AddInRole(vtkFieldData* data, vtkAbstractArray* array, int role)
{
  const int index = data->AddArray(array);
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  if (attributes && role >= 0)
  {
    attributes->SetActiveAttribute(index, role);
  }
}

/// @param[in,out] told what has been renamed, before this and after.
void Rename(vtkFieldData* data, const Names& names, const char* what, std::string& told)
{
  for (const std::string& name : names)
  {
    int index = -1;
    vtkSmartPointer<vtkAbstractArray> array = data->GetAbstractArray(name.c_str(), index);
    if (!array)
    {
      continue;
    }
    auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
    const int role = attributes ? attributes->IsArrayAnAttribute(index) : -1;
    std::string other = "Input" + name;
    while (data->HasArray(other.c_str()))
    {
      other = "Input" + other;
    }
    data->RemoveArray(name.c_str());
    AddInRole(data, Renamed(array, other), role);
    if (name != OriginalPoints && name != OriginalCells)
    {
      told += (told.empty() ? "" : ", ") + name + " (" + what + ")";
    }
  }
}

void Remove(vtkFieldData* data, const Names& names)
{
  for (const std::string& name : names)
  {
    data->RemoveArray(name.c_str());
  }
}

}

vtkSmartPointer<vtkUnstructuredGrid> ResolveNameClashes(
  vtkUnstructuredGrid* input, bool insertsLayer, std::string& warning)
{
  warning.clear();
  const bool isTrimmed = IsTrimmed(input);
  Names ofPoints = OfPoints, ofCells = OfCells;
  if (insertsLayer || isTrimmed)
  {
    ofPoints.emplace_back(Inserted);
    ofCells.emplace_back(Inserted);
  }
  const Names ofSummary = EntriesOfSummary();
  if (!HasAny(input->GetPointData(), ofPoints) && !HasAny(input->GetCellData(), ofCells) &&
    !HasAny(input->GetFieldData(), ofSummary))
  {
    return input;
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(input);
  if (isTrimmed)
  {
    Remove(grid->GetPointData(), ofPoints);
    Remove(grid->GetCellData(), ofCells);
    Summary::RemoveFrom(grid->GetFieldData());
    return grid;
  }
  Rename(grid->GetPointData(), ofPoints, "points", warning);
  Rename(grid->GetCellData(), ofCells, "cells", warning);
  Rename(grid->GetFieldData(), ofSummary, "field data", warning);
  if (!warning.empty())
  {
    warning = "Arrays of the input have names of the trim's own, and \"Input\" before them in the "
              "outputs: " +
      warning + ".";
  }
  return grid;
}

}
