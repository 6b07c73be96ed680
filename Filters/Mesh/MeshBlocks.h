/**
 * @file MeshBlocks.h
 * @brief Boxes round runs of consecutive cells, so that most of a mesh is answered by the run.
 *
 * Depends on the mesh alone, so it is kept while only the surface changes.
 */
#ifndef MeshBlocks_h
#define MeshBlocks_h

#include "HexMesh.h"
#include "Ranks.h"
#include "TrimmingSurface.h"

#include <vector>

namespace trim
{
using nurbs::Box3;

struct MeshBlocks
{
  static constexpr Id CellsPerBlock = 64;

  std::vector<Box3> Boxes;
  Box3 Bounds;                ///< of all points used by cells
  double LargestDiagonal = 0; ///< of the boxes of single cells

  Id NumberOfBlocks() const { return static_cast<Id>(this->Boxes.size()); }
  static Id FirstCell(Id block) { return block * CellsPerBlock; }
  static Id EndCell(Id block, Id numberOfCells)
  {
    return std::min(numberOfCells, (block + 1) * CellsPerBlock);
  }
};

MeshBlocks BuildMeshBlocks(const HexMesh& mesh);

/// Widens Bounds and LargestDiagonal to those of all ranks' pieces; collective.
void ShareBounds(const Ranks& ranks, MeshBlocks& blocks);

/// The box of one cell.
Box3 CellBox(const HexMesh& mesh, Id cell);

}

#endif
