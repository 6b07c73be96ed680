/**
 * @file Relaxation.h
 * @brief Better elements at the cut by moving nodes where they may: boundary nodes along the
 * cut, and the nodes of the rings behind it within their layer.
 *
 * The nodes of a pillar together, then each alone, try steps in their own directions and the way
 * their neighbours went, and keep what raises the lowest worth (ElementWorth.h) of the elements
 * round them. Skin nodes stay on the skin, boundary nodes on the surface, border nodes on their
 * border where it is straight; others and corners stay where they are.
 */
#ifndef Relaxation_h
#define Relaxation_h

#include "RelaxedMesh.h"

#include <vector>

namespace trim
{

/// How long the relaxation goes on.
struct RelaxationEffort
{
  int Sweeps;             ///< at most
  double Gain;            ///< of quality, below which a step is none
  bool Joint;             ///< followed by RelaxJointly, where that applies
  bool EndsEarly = false; ///< where one element cannot reach the goal, the others need not either
  double Solving = 1e9;   ///< see SolvingBudget; ten times what it takes as a rule is enough
};
constexpr RelaxationEffort Thorough{ 40, 1e-4, true };
constexpr RelaxationEffort Brief{ 10, 1e-3, true };
/// To see whether more is worthwhile.
constexpr RelaxationEffort Probing{ 10, 1e-3, false };
/// All or nothing.
constexpr RelaxationEffort Decisive{ 10, 1e-3, true, true, 3e7 };

/// What elements are relaxed to where no floor is asked for.
constexpr double SmallestGoal = 0.05;

/// What the relaxation is after, by worth; see ElementWorth.h.
struct RelaxationGoal
{
  double Quality; ///< to be reached by the active elements, if possible
  double Floor;   ///< no element falls below it
  RelaxationEffort Effort;
};

/**
 * Relaxes the nodes round the elements that are worth less than the goal.
 *
 * @param active elements that should reach the goal, ascending.
 * @param[in,out] moves positions; nodes that are moved get Correction::Relax.
 */
void Relax(const RelaxationCase& given, const std::vector<int>& active, const RelaxationGoal& goal,
  Moves& moves);

}

#endif
