/**
 * @file GridState.h
 * @brief Whether a grid, or the blocks of a composite, are still what they were.
 */
#ifndef GridState_h
#define GridState_h

#include "NURBSTrimReadModule.h"

#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataObject;
class vtkUnstructuredGrid;

namespace nurbs
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

  NURBSTRIMREAD_EXPORT bool operator==(const GridState& other) const;
};

NURBSTRIMREAD_EXPORT GridState StateOf(vtkUnstructuredGrid* grid);

/// Of the object or, if it is a composite, of its blocks, too. Of what is no unstructured grid the
/// time alone, which tells.
NURBSTRIMREAD_EXPORT std::vector<GridState> StatesOf(vtkDataObject* data);

}

#endif
