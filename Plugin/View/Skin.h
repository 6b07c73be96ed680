/**
 * @file Skin.h
 * @brief The facets of a mesh that belong to one element only.
 */
#ifndef Skin_h
#define Skin_h

#include "HexMesh.h"

#include <vector>

namespace trim
{

/// A facet: an element, and the face's number in its ElementTopology.
struct SkinFacet
{
  Id Cell;
  int Face;
};

/// In the order of the elements and of their faces. At most 2^31 - 1 points.
std::vector<SkinFacet> FindSkin(const HexMesh& mesh);

}

#endif
