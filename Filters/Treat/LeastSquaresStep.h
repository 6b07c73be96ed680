/**
 * @file LeastSquaresStep.h
 * @brief The step of many variables that brings values to what they should reach at least.
 */
#ifndef LeastSquaresStep_h
#define LeastSquaresStep_h

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace trim
{

/// How a value changes with one variable.
struct Slope
{
  int Variable;
  double By;
};

/// A value that is to reach a target at least.
struct StepDemand
{
  double Value, Target;
  const Slope *Begin, *End; ///< its gradient, each variable once
};

/**
 * The step that misses the targets least, in the sum of squares, with its own length. Which values
 * miss them is found by repetition.
 *
 * @param damping weight of the square of the step's length, positive.
 */
Eigen::VectorXd FindLeastSquaresStep(
  const std::vector<StepDemand>& demands, std::size_t variables, double damping);

}

#endif
