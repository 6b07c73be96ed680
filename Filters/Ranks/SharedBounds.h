/**
 * @file SharedBounds.h
 * @brief The bounds of the whole mesh, which each rank has a piece of.
 */
#ifndef SharedBounds_h
#define SharedBounds_h

#include "MeshBlocks.h"
#include "Ranks.h"

namespace trim
{

/// Widens Bounds, LargestDiagonal and LargestCell to those of all ranks' pieces; collective.
void ShareBounds(const Ranks& ranks, MeshBlocks& blocks);

}

#endif
