/**
 * @file GridState.h
 * @brief Whether a grid is still what it was.
 */
#ifndef GridState_h
#define GridState_h

#include <vtkType.h>

#include <array>

class vtkUnstructuredGrid;

namespace trim
{

/// VTK does not count it as a change of a grid when it gets other cells, or more points or cells in
/// arrays that grow, which frees what was there.
struct GridState
{
  struct Array
  {
    vtkMTimeType Time = 0; ///< no two arrays have the same
    const void* Memory = nullptr;
    vtkIdType Values = 0;

    bool operator==(const Array& other) const;
  };

  vtkMTimeType Time = 0;
  std::array<Array, 4> Arrays; ///< of points, cells and types

  bool operator==(const GridState& other) const;
};

GridState StateOf(vtkUnstructuredGrid* grid);

}

#endif
