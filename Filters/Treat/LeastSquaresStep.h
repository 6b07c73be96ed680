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

/// How long equations may be solved yet. Their number to the third: of hundreds it takes seconds,
/// and where that many hold each other up it hardly ever ends well.
struct SolvingBudget
{
  double Multiplications;

  bool IsSpent() const { return this->Multiplications <= 0.0; }
  void Spend(double equations) { this->Multiplications -= equations * equations * equations / 3.0; }
};

/**
 * The step that misses the targets least, in the sum of squares, with its own length. Which values
 * miss them is found by repetition, as long as the budget is not spent.
 *
 * @param damping weight of the square of the step's length, positive.
 * @param[in,out] missed where to begin: demands that may miss their targets after the step; empty:
 * those that do before it. The nearer they are to those that do in the end, which come out, the
 * fewer repetitions it takes.
 */
Eigen::VectorXd FindLeastSquaresStep(const std::vector<StepDemand>& demands, std::size_t variables,
  double damping, SolvingBudget& budget, std::vector<int>& missed);

}

#endif
