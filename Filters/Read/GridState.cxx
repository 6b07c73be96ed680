#include "GridState.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <tuple>

namespace nurbs
{
namespace
{

GridState::Array StateOf(vtkDataArray* array)
{
  GridState::Array state;
  if (array)
  {
    state.Time = array->GetMTime();
    // Of one in another layout a copy would be made.
    state.Memory = array->HasStandardMemoryLayout() ? array->GetVoidPointer(0) : nullptr;
    state.Values = array->GetNumberOfValues();
  }
  return state;
}

}

bool GridState::Array::operator==(const Array& other) const
{
  return std::tie(this->Time, this->Memory, this->Values) ==
    std::tie(other.Time, other.Memory, other.Values);
}

bool GridState::operator==(const GridState& other) const
{
  return this->Time == other.Time && this->Arrays == other.Arrays;
}

GridState StateOf(vtkUnstructuredGrid* grid)
{
  vtkCellArray* const cells = grid->GetCells();
  vtkPoints* const points = grid->GetPoints();
  GridState state;
  state.Time = grid->GetMTime();
  state.Arrays = { StateOf(points ? points->GetData() : nullptr),
    StateOf(cells ? cells->GetOffsetsArray() : nullptr),
    StateOf(cells ? cells->GetConnectivityArray() : nullptr), StateOf(grid->GetCellTypesArray()) };
  return state;
}

std::vector<GridState> StatesOf(vtkDataObject* data)
{
  std::vector<GridState> states;
  const auto add = [&states](vtkDataObject* own)
  {
    auto* grid = vtkUnstructuredGrid::SafeDownCast(own);
    states.push_back(grid ? StateOf(grid) : GridState{ own->GetMTime(), {} });
  };
  add(data);
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    for (vtkDataObject* leaf : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      add(leaf);
    }
  }
  return states;
}

}
