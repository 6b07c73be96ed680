/**
 * @file MixedSides.h
 * @brief Where a surface contradicts itself.
 */
#ifndef MixedSides_h
#define MixedSides_h

#include "HexMesh.h"
#include "Place.h"

#include <array>
#include <vector>

namespace trim
{
class Ranks;

/// A node of a set whose nodes lie on both sides.
struct MixedNode
{
  std::array<Id, 2> Set; ///< the same for all nodes of a set on all ranks
  Place At;
  unsigned char Side;
};

/// One of those that lie on the side of the fewer in their set, the same however the mesh is
/// divided and numbered. Collective.
/// @param own not empty on all ranks.
Vec3 FindMixedPlace(const Ranks& ranks, const std::vector<MixedNode>& own);

}

#endif
