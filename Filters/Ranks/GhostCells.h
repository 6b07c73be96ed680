/**
 * @file GhostCells.h
 * @brief A rank's own cells: ghost cells are copies of other ranks' cells, and are not trimmed
 * twice.
 */
#ifndef GhostCells_h
#define GhostCells_h

#include "HexMesh.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <vector>

namespace trim
{

struct OwnCells
{
  vtkSmartPointer<vtkUnstructuredGrid> Grid; ///< the input itself if it has no ghost arrays
  bool Selected = false;                     ///< some cells or ghost arrays were left out
  std::vector<Id> Points, Cells;             ///< ids in the input, where Selected
  Id Copies = 0;                             ///< cells left out as copies of other ranks' cells
  Id Hidden = 0;                             ///< others left out: hidden or refined ones
};

/// Whether a cell with these flags is no cell of the rank's own.
bool IsLeftOut(unsigned char flags);

/// Whether some cells or points are flagged as ghosts, so that not all cells are a rank's own.
bool HasGhosts(vtkUnstructuredGrid* grid);

/**
 * The cells of `input` that are no ghosts (copies of other ranks' cells, hidden or refined ones),
 * with their points and arrays; the ghost arrays are left out, as a trim would make them wrong, and
 * where they flag nothing other ranks may have none.
 *
 * @param mesh the view of the input; it was found free of defects.
 */
OwnCells TakeOwnCells(vtkUnstructuredGrid* input, const HexMesh& mesh);

/// Turns vtkOriginalPointIds and vtkOriginalCellIds of a grid that was made from own cells into
/// ids of the input.
void RestoreOriginalIds(const OwnCells& own, vtkUnstructuredGrid* grid);

}

#endif
