/**
 * @file PatchTiles.h
 * @brief Groups of patches that are neighbours, known from the knots without a search.
 */
#ifndef PatchTiles_h
#define PatchTiles_h

#include "PatchShape.h"

#include <vector>

namespace nurbs
{
struct SurfaceModel;

/// All patches of a model, tile by tile.
struct PatchTiles
{
  std::vector<int> Patches;
  std::vector<int> Ends; ///< of the tiles in Patches, ascending
};

/// Rectangles of patches of a face, about as long as wide; pieces of loops along the loops.
/// @param shapes of all patches.
PatchTiles TilePatches(const SurfaceModel& model, const std::vector<PatchShape>& shapes);

}

#endif
