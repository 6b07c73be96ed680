/**
 * @file TrimmedGrid.h
 * @brief Writes the trimmed grid (paper, section 2.4) and the input grid with its statuses.
 */
#ifndef TrimmedGrid_h
#define TrimmedGrid_h

#include "TrimmingSurface.h"
#include "WritePart.h"

namespace trim
{

/**
 * Fills `output` with the kept elements at their new positions, renumbered, with the arrays that
 * vtkTrimHexahedralGrid.h lists, the input's own arrays and the summary of all ranks' pieces.
 * Collective.
 */
void WriteTrimmedGrid(
  const WriteInput& from, const nurbs::TrimmingSurface& surface, vtkUnstructuredGrid* output);

/// Fills `output` with the whole input grid and the status arrays.
void WriteStatusGrid(
  vtkUnstructuredGrid* input, const TrimResult& result, vtkUnstructuredGrid* output);

}

#endif
