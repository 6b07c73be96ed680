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

bool operator==(const GridState::Array& a, const GridState::Array& b)
{
  return std::tie(a.Time, a.Memory, a.Values) == std::tie(b.Time, b.Memory, b.Values);
}

}

bool GridState::operator==(const GridState& other) const
{
  bool same = this->Time == other.Time;
  for (std::size_t i = 0; i < this->Arrays.size(); ++i)
  {
    same = same && this->Arrays[i] == other.Arrays[i];
  }
  return same;
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
