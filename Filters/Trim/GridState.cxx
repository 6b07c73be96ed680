#include "GridState.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <tuple>

namespace trim
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

}
