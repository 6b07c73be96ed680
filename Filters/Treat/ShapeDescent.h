/**
 * @file ShapeDescent.h
 * @brief Many poor elements at once, inverted ones among them: all nodes round them move to where
 * the energy of the elements' corners (CornerShape.h) is least, in turn, by Newton's method.
 *
 * It raises most for the sake of all, and leaves few below a goal: for Relax and RelaxJointly,
 * which raise the lowest, but only what is near to the goal, and few.
 */
#ifndef ShapeDescent_h
#define ShapeDescent_h

#include "RelaxedMesh.h"

#include <vector>

namespace trim
{

/// Moves the nodes round those active elements that are worth less than the goal; see Relax.
/// @return of the elements round them those that are worth less then, and than they have to be,
/// ascending. Where these would not be fewer no node has moved.
std::vector<int> DescendToShape(
  const RelaxationCase& given, const std::vector<int>& active, double goal, Moves& moves);

}

#endif
