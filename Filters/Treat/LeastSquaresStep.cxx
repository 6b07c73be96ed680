#include "LeastSquaresStep.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace trim
{
namespace
{

/// How often a step is corrected for values that it makes miss.
constexpr int MostRounds = 12;
/// Values that are summed up side by side, as one alone would wait for each of its terms.
constexpr std::size_t Abreast = 4;

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

/// Solves equations of which the lower half is given.
Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& lower, const Eigen::VectorXd& right)
{
  // In blocks, a third of the time of what can do with equations that rounding has made indefinite.
  const Eigen::LLT<Eigen::MatrixXd> factors(lower);
  if (factors.info() == Eigen::Success)
  {
    return factors.solve(right);
  }
  return lower.ldlt().solve(right);
}

/// Least squares of values that miss, by the normal equations of the variables.
Eigen::VectorXd SolveByVariables(const std::vector<StepDemand>& demands,
  const std::vector<int>& missed, std::size_t variables, double damping)
{
  const auto count = static_cast<Eigen::Index>(variables);
  Eigen::MatrixXd products = damping * Eigen::MatrixXd::Identity(count, count);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(count);
  for (const int i : missed)
  {
    const StepDemand& demand = demands[i];
    for (const Slope* a = demand.Begin; a != demand.End; ++a)
    {
      pull[a->Variable] += a->By * (demand.Target - demand.Value);
      for (const Slope* b = a; b != demand.End; ++b)
      {
        const auto [column, row] = std::minmax(a->Variable, b->Variable);
        products(row, column) += b->By * a->By;
      }
    }
  }
  return SolveSymmetric(products, pull);
}

/// The same by those of the values.
Eigen::VectorXd SolveByValues(const std::vector<StepDemand>& demands,
  const std::vector<int>& missed, std::size_t variables, double damping)
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
  const Eigen::VectorXd weights = SolveSymmetric(products, misses);
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

/// Demands that have less than their targets.
std::vector<int> FindMissed(const std::vector<StepDemand>& demands)
{
  std::vector<int> missed;
  for (std::size_t i = 0; i < demands.size(); ++i)
  {
    if (demands[i].Value < demands[i].Target)
    {
      missed.push_back(static_cast<int>(i));
    }
  }
  return missed;
}

/// What demands have after a step.
class SteppedValues
{
public:
  SteppedValues(const std::vector<StepDemand>& demands, const Eigen::VectorXd& way)
    : Demands(demands)
    , Way(way)
  {
  }

  /// Calls take(i, value) for each, in order.
  template <typename Take>
  void ForAll(const Take& take) const
  {
    for (std::size_t i = 0; i < this->Demands.size(); i += Abreast)
    {
      const std::size_t count = std::min(Abreast, this->Demands.size() - i);
      const std::array<double, Abreast> values = this->From(i, count);
      for (std::size_t k = 0; k < count; ++k)
      {
        take(i + k, values[k]);
      }
    }
  }

private:
  std::array<double, Abreast> From(std::size_t first, std::size_t count) const
  {
    std::array<double, Abreast> value{};
    std::array<const Slope*, Abreast> slope{};
    std::ptrdiff_t common = count == Abreast ? std::numeric_limits<std::ptrdiff_t>::max() : 0;
    for (std::size_t k = 0; k < count; ++k)
    {
      const StepDemand& demand = this->Demands[first + k];
      value[k] = demand.Value;
      slope[k] = demand.Begin;
      common = std::min(common, demand.End - demand.Begin);
    }
    for (std::ptrdiff_t i = 0; i < common; ++i)
    {
      for (std::size_t k = 0; k < Abreast; ++k)
      {
        value[k] += slope[k]->By * this->Way[slope[k]->Variable];
        ++slope[k];
      }
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      for (; slope[k] != this->Demands[first + k].End; ++slope[k])
      {
        value[k] += slope[k]->By * this->Way[slope[k]->Variable];
      }
    }
    return value;
  }

  const std::vector<StepDemand>& Demands;
  const Eigen::VectorXd& Way;
};

/// One repetition: the values that it was to help, and the step that it found.
struct Round
{
  std::vector<int> Missed;
  Eigen::VectorXd Way;
};

}

Eigen::VectorXd FindLeastSquaresStep(const std::vector<StepDemand>& demands, std::size_t variables,
  double damping, SolvingBudget& budget, std::vector<int>& missed)
{
  if (missed.empty())
  {
    missed = FindMissed(demands);
  }
  std::vector<Round> rounds;
  for (int round = 0; round == 0 || (round < MostRounds && !budget.IsSpent()); ++round)
  {
    const auto before = std::find_if(
      rounds.begin(), rounds.end(), [&missed](const Round& r) { return r.Missed == missed; });
    if (before != rounds.end())
    {
      // From here on it goes round in a circle, mostly one of a single step.
      const int first = static_cast<int>(before - rounds.begin());
      const auto later = [&](int steps) { return first + (steps - first) % (round - first); };
      missed = rounds[later(MostRounds)].Missed;
      return rounds[later(MostRounds - 1)].Way;
    }
    budget.Spend(static_cast<double>(std::min(missed.size(), variables)));
    // The fewer equations.
    Eigen::VectorXd way = missed.size() > variables
      ? SolveByVariables(demands, missed, variables, damping)
      : SolveByValues(demands, missed, variables, damping);
    rounds.push_back({ std::move(missed), std::move(way) });
    missed.clear();
    SteppedValues(demands, rounds.back().Way)
      .ForAll(
        [&](std::size_t i, double value)
        {
          if (value < demands[i].Target)
          {
            missed.push_back(static_cast<int>(i));
          }
        });
  }
  return rounds.back().Way;
}

}
