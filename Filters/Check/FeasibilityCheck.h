/**
 * @file FeasibilityCheck.h
 * @brief Finds the elements where the surface breaks the assumptions of the method.
 *
 * All lengths are measured in elements: by the inverse of the Jacobian at the element's centre,
 * so that stretched elements count along the direction in question. In a sheet they are measured
 * within the skin, as that is where the nodes move.
 */
#ifndef FeasibilityCheck_h
#define FeasibilityCheck_h

#include "Ranks.h"
#include "TrimResult.h"
#include "TrimmingSurface.h"

namespace trim
{

/**
 * Collective.
 *
 * @param result classified and, unless the surface touches nothing, decided; its surface turned
 * as it was for that.
 * @return by ascending cell.
 */
std::vector<std::pair<Id, Feasibility>> CheckFeasibility(const HexMesh& mesh, const Ranks& ranks,
  const nurbs::TrimmingSurface& surface, const TrimResult& result);

}

#endif
