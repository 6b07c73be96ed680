/**
 * @file CreaseNodes.h
 * @brief Nodes of the new boundary go to the sharp edges of the surface that it passes, so that it
 * does not cut across the corners of the trimming contour.
 */
#ifndef CreaseNodes_h
#define CreaseNodes_h

#include "GuardedMesh.h"

#include <vector>

namespace trim
{

/**
 * Of two pillars beside each other on the new boundary, on either side of a sharp edge, takes that
 * to the edge which has less far to go, or the other one, and relaxes the nodes round it, if no
 * element becomes invalid by it or falls below the least; else nothing changes there.
 *
 * @param given nodes that are moved get Correction::Relax, those on sharp edges are fixed.
 * @param among by node: only pillars beside each other one of which has such a node; empty: all.
 * @param[in,out] there by node: on a sharp edge; those that are stay, and more come. Empty: none.
 * @return by node: next to a sharp edge that none could go to, or beside such a node.
 */
std::vector<char> PutOnCreases(const GuardedCase& given, const nurbs::TrimmingSurface& surface,
  const std::vector<char>& among, std::vector<char>& there);

/// Whether a surface may have sharp edges at all.
bool MayHaveCreases(const nurbs::TrimmingSurface& surface);

}

#endif
