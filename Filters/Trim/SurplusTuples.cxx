#include "SurplusTuples.h"

#include "GatherAttributes.h"

#include <vtkAbstractArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

namespace trim
{
namespace
{

bool HasSurplus(vtkDataSetAttributes* data, vtkIdType count)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    if (data->GetAbstractArray(i)->GetNumberOfTuples() > count)
    {
      return true;
    }
  }
  return false;
}

/// Cuts arrays off, if any is too long.
/// @param[in,out] told which arrays are cut off, before this and after.
void CutOff(vtkDataSetAttributes* data, vtkIdType count, const char* what, std::string& told)
{
  if (!HasSurplus(data, count))
  {
    return;
  }
  // All of them anew, in their order: an array without a name cannot be replaced.
  const auto given = vtkSmartPointer<vtkDataSetAttributes>::Take(data->NewInstance());
  given->ShallowCopy(data);
  data->Initialize();
  for (int i = 0; i < given->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = given->GetAbstractArray(i);
    vtkSmartPointer<vtkAbstractArray> own = array;
    if (array->GetNumberOfTuples() > count)
    {
      own = FirstTuples(array, count);
      told += (told.empty() ? "\"" : ", \"") +
        std::string(array->GetName() ? array->GetName() : "") + "\" (" +
        std::to_string(array->GetNumberOfTuples()) + " for " + std::to_string(count) + " " + what +
        ")";
    }
    AddInRolesOf(array, given, own, data);
  }
}

}

vtkSmartPointer<vtkUnstructuredGrid> WithoutSurplus(vtkUnstructuredGrid* grid, std::string& told)
{
  told.clear();
  const vtkIdType points = grid->GetNumberOfPoints(), cells = grid->GetNumberOfCells();
  // Pieces without cells give nothing to any output.
  if (cells == 0 ||
    (!HasSurplus(grid->GetPointData(), points) && !HasSurplus(grid->GetCellData(), cells)))
  {
    return grid;
  }
  auto cut = vtkSmartPointer<vtkUnstructuredGrid>::New();
  cut->ShallowCopy(grid);
  CutOff(cut->GetPointData(), points, "points", told);
  CutOff(cut->GetCellData(), cells, "cells", told);
  return cut;
}

}
