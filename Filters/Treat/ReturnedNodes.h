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

/**
 * Takes nodes to the surface where no element becomes invalid by it.
 *
 * @param least scaled Jacobian that no element falls below.
 * @param left the nodes, ascending.
 * @param relax whether the nodes round them make room.
 * @param aborted true ends the work; the result is then of no use.
 * @param[in,out] fixed, onCut what `given` refers to: returned nodes are free, and on the cut.
 * @param[in,out] moves returned nodes are left no more.
 * @return false if none returned.
 */
bool ReturnNodes(const RelaxationCase& given, const BandQuality& quality, double least,
  const std::vector<int>& left, bool relax, const std::function<bool()>& aborted,
  std::vector<char>& fixed, std::vector<char>& onCut, Moves& moves);

/// Takes nodes that have to be left as near to the surface as they come with no element below
/// `least`; parameters as above. False if none came nearer.
bool ApproachSurface(const RelaxationCase& given, const BandQuality& quality, double least,
  const std::vector<int>& left, const std::function<bool()>& aborted, std::vector<char>& fixed,
  std::vector<char>& onCut, Moves& moves);

}

#endif
