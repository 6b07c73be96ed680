/**
 * @file SharedSurface.h
 * @brief The whole trimming surface on every rank, wherever its faces are.
 */
#ifndef SharedSurface_h
#define SharedSurface_h

#include "NurbsSurface.h"
#include "Ranks.h"

#include <vector>

namespace trim
{

/**
 * The faces of all ranks, rank by rank; collective. A source gives the whole surface to each rank
 * or to the first alone, and a file of many blocks is spread over the ranks: a face that an
 * earlier rank has too is taken once.
 */
std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, std::vector<nurbs::NurbsSurface> own);

}

#endif
