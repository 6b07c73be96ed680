/**
 * @file ReturnedNodes.h
 * @brief Nodes that the ladder left off the surface go to it after all, one by one, as far as the
 * elements round them stand it.
 *
 * The ladder leaves nodes by columns and all nodes of an invalid element at once, and what it
 * leaves may spoil the next element. In the end most of them need not have been left.
 */
#ifndef ReturnedNodes_h
#define ReturnedNodes_h

#include "GuardedMesh.h"

#include <vector>

namespace trim
{

enum class ReturnEffort
{
  Alone,   ///< nodes go to the surface, and nothing else moves
  Relaxed, ///< the nodes round them make room
  Nearer   ///< nodes come as near to the surface as the elements stand, and stay left
};

/**
 * Takes nodes to the surface, or nearer to it, where no element becomes invalid by it.
 *
 * @param given returned nodes are left no more: they are free, and on the cut.
 * @param left the nodes, ascending.
 * @return false if none returned or came nearer.
 */
bool ReturnNodes(const GuardedCase& given, const std::vector<int>& left, ReturnEffort effort);

}

#endif
