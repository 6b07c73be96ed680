/**
 * @file CoincidentNodes.h
 * @brief Nodes of the trimmed band that came to lie on each other.
 */
#ifndef CoincidentNodes_h
#define CoincidentNodes_h

#include "NodeGrid.h"
#include "TrimmedBand.h"

#include <vector>

namespace trim
{

/// Two nodes nearer than this share of the element's shortest edge have become one.
constexpr double SmallestDistanceShare = 1e-3;

/**
 * By node: those that came to lie where another one is, and have to give way. No kept element need
 * have both: from either side of an eliminated one they would make the new boundary touch itself.
 * Nodes of parts that touched before are none, nor are those far from each other in the mesh: along
 * a slit each side has its own.
 */
std::vector<char> FindCoincidentNodes(const Band& band, const TrimmedBand& trimmed);

/// A grid to find coincident nodes by; as yet there are none in it.
NodeGrid MakeNodeGrid(const Band& band);

/// Whether one node, which has moved, coincides with another.
/// @param others where they are; this one may be among them, anywhere.
bool IsCoincident(const Band& band, const Moves& moves, const NodeGrid& others, int node);

}

#endif
