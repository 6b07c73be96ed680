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

#include "BandQuality.h"
#include "Relaxation.h"

#include <functional>
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
 * @param least scaled Jacobian that no element falls below.
 * @param left the nodes, ascending.
 * @param aborted true ends the work; the result is then of no use.
 * @param[in,out] fixed, onCut what `given` refers to: returned nodes are free, and on the cut.
 * @param[in,out] moves returned nodes are left no more.
 * @return false if none returned or came nearer.
 */
bool ReturnNodes(const RelaxationCase& given, const BandQuality& quality, double least,
  const std::vector<int>& left, ReturnEffort effort, const std::function<bool()>& aborted,
  std::vector<char>& fixed, std::vector<char>& onCut, Moves& moves);

}

#endif
