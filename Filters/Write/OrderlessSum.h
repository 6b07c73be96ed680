/**
 * @file OrderlessSum.h
 * @brief A sum that does not depend on the order of its terms, nor on how they are spread over
 * ranks.
 */
#ifndef OrderlessSum_h
#define OrderlessSum_h

#include "HexMesh.h"
#include "Ranks.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace trim
{

/**
 * Sum of terms >= 0 over all ranks, the same bits whatever their order; collective. The terms
 * are added as integers, each rounded to 2^-62 of the largest.
 *
 * @param term of an index below count; asked for twice, by several threads.
 */
template <typename Term>
double OrderlessSum(Id count, const Term& term, const Ranks& ranks)
{
  constexpr Id grain = 30000;
  const Id runs = NumberOfRuns(count, grain);
  const auto forRuns = [&](const auto& action)
  {
    vtkSMPTools::For(0, runs, 1,
      [&](Id begin, Id end)
      {
        for (Id run = begin; run < end; ++run)
        {
          action(run, run * grain, std::min(count, (run + 1) * grain));
        }
      });
  };
  std::vector<double> largestOfRun(runs, 0.0);
  forRuns(
    [&](Id run, Id begin, Id end)
    {
      double most = 0.0;
      for (Id i = begin; i < end; ++i)
      {
        most = std::max(most, term(i));
      }
      largestOfRun[run] = most;
    });
  double largest = 0.0;
  for (const double most : largestOfRun)
  {
    largest = std::max(largest, most);
  }
  largest = ranks.Largest(largest);
  if (!(largest > 0.0) || !std::isfinite(largest))
  {
    return largest;
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  exponent = std::max(exponent, -900); // the scale has to be finite
  const double scale = std::ldexp(1.0, 62 - exponent);
  // In two halves of 31 bits, so that no sum of fewer than 2^33 terms overflows.
  constexpr std::uint64_t lowHalf = (std::uint64_t(1) << 31) - 1;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> sumOfRun(runs);
  forRuns(
    [&](Id run, Id begin, Id end)
    {
      std::uint64_t high = 0, low = 0;
      for (Id i = begin; i < end; ++i)
      {
        const auto bits = static_cast<std::uint64_t>(scale * term(i));
        high += bits >> 31;
        low += bits & lowHalf;
      }
      sumOfRun[run] = { high, low };
    });
  std::uint64_t high = 0, low = 0;
  for (const auto& sum : sumOfRun)
  {
    high += sum.first;
    low += sum.second;
  }
  high = ranks.Sum(high);
  low = ranks.Sum(low);
  high += low >> 31;
  low &= lowHalf;
  return std::ldexp(static_cast<double>(high), exponent - 31) +
    std::ldexp(static_cast<double>(low), exponent - 62);
}

}

#endif
