#include "NameClashes.h"

#include "ArrayNames.h"
#include "GatherAttributes.h"
#include "Summary.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <string>
#include <vector>

namespace trim
{
namespace
{

/// An array that the trim writes. What has its name but another type is not the trim's.
struct OwnArray
{
  std::string Name;
  int Type;
  int Components = 1;

  bool Is(vtkAbstractArray* array) const
  {
    return array && array->GetDataType() == this->Type &&
      array->GetNumberOfComponents() == this->Components;
  }
};
using OwnArrays = std::vector<OwnArray>;

const OwnArrays OfPoints{ { names::NodeStatus, VTK_UNSIGNED_CHAR },
  { names::SignedDistance, VTK_FLOAT }, { names::Displacement, VTK_FLOAT, 3 },
  { names::CorrectionApplied, VTK_UNSIGNED_CHAR }, { names::DistanceLeft, VTK_FLOAT },
  { names::NewBoundary, VTK_UNSIGNED_CHAR }, { names::CornerLost, VTK_UNSIGNED_CHAR },
  { names::OriginalPoints, VTK_ID_TYPE }, { names::Inserted, VTK_UNSIGNED_CHAR } };
const OwnArrays OfCells{ { names::ElementStatus, VTK_UNSIGNED_CHAR },
  { names::EliminatedFraction, VTK_FLOAT }, { names::ScaledJacobian, VTK_FLOAT },
  { names::Rescue, VTK_UNSIGNED_CHAR }, { names::Feasibility, VTK_UNSIGNED_CHAR },
  { names::Shortfall, VTK_UNSIGNED_CHAR }, { names::OriginalCells, VTK_ID_TYPE },
  { names::Inserted, VTK_UNSIGNED_CHAR } };

OwnArrays EntriesOfSummary()
{
  vtkNew<vtkFieldData> entries;
  Summary().AddTo(entries);
  OwnArrays arrays;
  for (int i = 0; i < entries->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* entry = entries->GetAbstractArray(i);
    arrays.push_back({ entry->GetName(), entry->GetDataType(), entry->GetNumberOfComponents() });
  }
  return arrays;
}

/// Whether an earlier trim has made the grid, or what it was made from: filters between the two may
/// have dropped the field data.
bool IsTrimmed(vtkUnstructuredGrid* grid)
{
  return grid->GetFieldData()->HasArray(names::CertifiedElements) ||
    (grid->GetPointData()->HasArray(names::NodeStatus) &&
      grid->GetPointData()->HasArray(names::CorrectionApplied));
}

bool HasAny(vtkFieldData* data, const OwnArrays& arrays)
{
  return std::any_of(arrays.begin(), arrays.end(),
    [data](const OwnArray& own) { return data->HasArray(own.Name.c_str()) != 0; });
}

/// Another array with the same values.
vtkSmartPointer<vtkAbstractArray> Renamed(vtkAbstractArray* array, const std::string& name)
{
  auto renamed = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  auto* from = vtkDataArray::SafeDownCast(array);
  if (from)
  {
    auto* const to = vtkDataArray::SafeDownCast(renamed);
    to->ShallowCopy(from);
    to->CopyInformation(from->GetInformation());
    to->SetLookupTable(from->GetLookupTable());
  }
  else
  {
    renamed->DeepCopy(array);
  }
  renamed->SetName(name.c_str());
  return renamed;
}

/// @param[in,out] told what has been renamed, before this and after.
void Rename(vtkFieldData* data, const OwnArrays& arrays, const char* what, std::string& told)
{
  for (const OwnArray& own : arrays)
  {
    const std::string& name = own.Name;
    vtkSmartPointer<vtkAbstractArray> array = data->GetAbstractArray(name.c_str());
    if (!array)
    {
      continue;
    }
    auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
    const auto roles = attributes ? RolesOf(attributes, array) : std::vector<int>();
    std::string other = "Input" + name;
    while (data->HasArray(other.c_str()))
    {
      other = "Input" + other;
    }
    data->RemoveArray(name.c_str());
    const int index = data->AddArray(Renamed(array, other));
    for (const int role : roles)
    {
      attributes->SetActiveAttribute(index, role);
    }
    if (name != names::OriginalPoints && name != names::OriginalCells) // not worth a warning
    {
      told += (told.empty() ? "" : ", ") + name + " (" + what + ")";
    }
  }
}

/// Removes what an earlier trim has written.
void Remove(vtkFieldData* data, const OwnArrays& arrays)
{
  for (const OwnArray& own : arrays)
  {
    if (own.Is(data->GetAbstractArray(own.Name.c_str())))
    {
      data->RemoveArray(own.Name.c_str());
    }
  }
}

}

vtkSmartPointer<vtkUnstructuredGrid> ResolveNameClashes(
  vtkUnstructuredGrid* input, std::string& warning)
{
  warning.clear();
  const OwnArrays ofSummary = EntriesOfSummary();
  if (!HasAny(input->GetPointData(), OfPoints) && !HasAny(input->GetCellData(), OfCells) &&
    !HasAny(input->GetFieldData(), ofSummary))
  {
    return input;
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->ShallowCopy(input);
  if (IsTrimmed(input))
  {
    Remove(grid->GetPointData(), OfPoints);
    Remove(grid->GetCellData(), OfCells);
    Summary::RemoveFrom(grid->GetFieldData());
  }
  Rename(grid->GetPointData(), OfPoints, "points", warning);
  Rename(grid->GetCellData(), OfCells, "cells", warning);
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
