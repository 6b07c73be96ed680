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
 * @param[in,out] missed where to begin: demands that may miss their targets after the step; empty:
 * those that do before it. The nearer they are to those that do in the end, which come out, the
 * fewer repetitions it takes.
 */
Eigen::VectorXd FindLeastSquaresStep(const std::vector<StepDemand>& demands, std::size_t variables,
  double damping, std::vector<int>& missed);

}

#endif
