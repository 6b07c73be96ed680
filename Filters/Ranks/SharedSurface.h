/**
 * @file SharedSurface.h
 * @brief The whole trimming surface on every rank, wherever its faces are and how often.
 */
#ifndef SharedSurface_h
#define SharedSurface_h

#include "NurbsSurface.h"
#include "Ranks.h"

#include <vector>

namespace trim
{

/**
 * The faces of all ranks, rank by rank, each once; collective. A source gives the whole surface to
 * each rank or to the first alone, a file of many blocks is spread over the ranks, and CAD programs
 * write a body as a solid and once more as its shells.
 */
std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, const std::vector<nurbs::NurbsSurface>& own);

}

#endif
