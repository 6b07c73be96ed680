/**
 * @file TrimmedGrid.h
 * @brief Writes the trimmed grid (paper, section 2.4) and the input grid with its statuses.
 */
#ifndef TrimmedGrid_h
#define TrimmedGrid_h

#include "HexMesh.h"
#include "MeshBlocks.h"
#include "Progress.h"
#include "Ranks.h"
#include "Summary.h"
#include "TrimResult.h"
#include "TrimmingSurface.h"

class vtkUnstructuredGrid;

namespace trim
{

struct WriteOptions
{
  bool RenumberNodes = true;
  bool QualityOfAllElements = false;
  bool MapValues = false;
  bool InsertLayer = false;
};

/**
 * Fills `output` with the kept elements at their new positions, renumbered, with the arrays that
 * vtkTrimHexahedralGrid.h lists, the input's own arrays and the summary of all ranks' pieces.
 * Collective.
 */
void WriteTrimmedGrid(vtkUnstructuredGrid* input, const HexMesh& mesh, const MeshBlocks& blocks,
  const Ranks& ranks, const TrimResult& result, const nurbs::TrimmingSurface& surface,
  const WriteOptions& options, const Progress& progress, vtkUnstructuredGrid* output);

/// Fills `output` with the whole input grid and the status arrays.
void WriteStatusGrid(
  vtkUnstructuredGrid* input, const TrimResult& result, vtkUnstructuredGrid* output);

}

#endif
