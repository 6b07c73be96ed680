/**
 * @file JointRelaxation.h
 * @brief Better elements at the cut by moving all nodes round them at once.
 *
 * Where several elements pull at each other, no step of a single node raises the lowest of them.
 * Here the determinants whose smallest is the scaled Jacobian are linearised over all free
 * directions of all nodes of a part, and the shortest step is taken that would raise what is
 * lowest. What cannot be raised any more is held, and the rest goes on.
 */
#ifndef JointRelaxation_h
#define JointRelaxation_h

#include "Relaxation.h"

namespace trim
{

/// Relaxes the nodes round those active elements that are below the goal; see Relax.
void RelaxJointly(const RelaxationCase& given, const std::vector<int>& active,
  const RelaxationGoal& goal, Moves& moves);

}

#endif
