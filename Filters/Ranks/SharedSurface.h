/**
 * @file SharedSurface.h
 * @brief The whole trimming surface on every rank, wherever its faces are and how often.
 */
#ifndef SharedSurface_h
#define SharedSurface_h

#include "HexMesh.h"
#include "NurbsSurface.h"
#include "Ranks.h"

#include <vector>

namespace trim
{

/**
 * The faces of all ranks, each once; collective. A source gives the whole surface to each rank or
 * to the first alone, a file of many blocks is spread over the ranks, and CAD programs write a body
 * as a solid and once more as its shells.
 *
 * @param blocks of each face its place among the blocks of the composite that it is from: the order
 * of the faces, which decides ties, is that of these, then rank by rank.
 */
std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, const std::vector<nurbs::NurbsSurface>& own, const std::vector<Id>& blocks);

}

#endif
