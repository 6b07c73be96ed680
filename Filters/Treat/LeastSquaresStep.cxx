#include "LeastSquaresStep.h"

#include <Eigen/Cholesky>

#include <numeric>

namespace trim
{
namespace
{

/// How often a step is corrected for values that it makes miss.
constexpr int MostRounds = 12;

/// The slopes of some demands, sorted by variables.
class SlopesByVariable
{
public:
  struct Entry
  {
    int Demand;
    double By;
  };

  SlopesByVariable(
    const std::vector<StepDemand>& demands, const std::vector<int>& some, std::size_t variables)
    : First(variables + 2, 0)
  {
    const auto forAll = [&](const auto& action)
    {
      for (std::size_t i = 0; i < some.size(); ++i)
      {
        const StepDemand& demand = demands[some[i]];
        for (const Slope* slope = demand.Begin; slope != demand.End; ++slope)
        {
          action(static_cast<int>(i), *slope);
        }
      }
    };
    // Counted one place farther on: filling them shifts the starts back.
    forAll([this](int, const Slope& slope) { ++this->First[slope.Variable + 2]; });
    std::partial_sum(this->First.begin(), this->First.end(), this->First.begin());
    this->Entries.resize(this->First.back());
    forAll(
      [this](int i, const Slope& slope) {
        this->Entries[this->First[slope.Variable + 1]++] = { i, slope.By };
      });
  }

  const Entry* begin(std::size_t variable) const
  {
    return this->Entries.data() + this->First[variable];
  }
  const Entry* end(std::size_t variable) const { return this->begin(variable + 1); }

private:
  std::vector<std::size_t> First;
  std::vector<Entry> Entries;
};

/// Least squares of the values that miss, by their normal equations: there are fewer of them than
/// variables.
Eigen::VectorXd SolveFor(const std::vector<StepDemand>& demands, const std::vector<int>& missed,
  std::size_t variables, double damping)
{
  const auto count = static_cast<Eigen::Index>(missed.size());
  const SlopesByVariable slopes(demands, missed, variables);
  Eigen::VectorXd misses(count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    misses[i] = demands[missed[i]].Target - demands[missed[i]].Value;
  }
  Eigen::MatrixXd products = damping * Eigen::MatrixXd::Identity(count, count);
  for (std::size_t v = 0; v < variables; ++v)
  {
    // Half of them: the matrix is symmetric.
    for (auto a = slopes.begin(v); a != slopes.end(v); ++a)
    {
      for (auto b = a; b != slopes.end(v); ++b)
      {
        products(b->Demand, a->Demand) += b->By * a->By;
      }
    }
  }
  const Eigen::VectorXd weights = products.ldlt().solve(misses);
  Eigen::VectorXd way = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(variables));
  for (std::size_t v = 0; v < variables; ++v)
  {
    for (auto a = slopes.begin(v); a != slopes.end(v); ++a)
    {
      way[v] += weights[a->Demand] * a->By;
    }
  }
  return way;
}

}

Eigen::VectorXd FindLeastSquaresStep(
  const std::vector<StepDemand>& demands, std::size_t variables, double damping)
{
  Eigen::VectorXd way = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(variables));
  std::vector<int> missed, last;
  for (int round = 0; round < MostRounds; ++round)
  {
    missed.clear();
    for (std::size_t i = 0; i < demands.size(); ++i)
    {
      double value = demands[i].Value;
      for (const Slope* slope = demands[i].Begin; slope != demands[i].End; ++slope)
      {
        value += slope->By * way[slope->Variable];
      }
      if (value < demands[i].Target)
      {
        missed.push_back(static_cast<int>(i));
      }
    }
    if (missed == last)
    {
      break;
    }
    way = SolveFor(demands, missed, variables, damping);
    last.swap(missed);
  }
  return way;
}

}
