/**
 * @file OrderlessSum.h
 * @brief A sum that does not depend on the order of its terms, nor on how they are spread over
 * ranks.
 */
#ifndef OrderlessSum_h
#define OrderlessSum_h

#include "Ranks.h"
#include "Runs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trim
{

/// Terms for a thread at a time.
constexpr Id SumGrain = 30000;

/// An integer sum in two halves of 31 bits, so that no sum of fewer than 2^33 terms overflows.
struct SplitSum
{
  static constexpr std::uint64_t LowHalf = (std::uint64_t(1) << 31) - 1;

  std::uint64_t High = 0, Low = 0;

  void Add(std::uint64_t term)
  {
    this->High += term >> 31;
    this->Low += term & LowHalf;
  }
  /// In units of 2^(exponent - 62).
  double Value(int exponent) const
  {
    return std::ldexp(static_cast<double>(this->High + (this->Low >> 31)), exponent - 31) +
      std::ldexp(static_cast<double>(this->Low & LowHalf), exponent - 62);
  }
};

/// The sum of terms, each of them times the scale as an integer.
template <typename Term>
SplitSum SumTerms(Id count, const Term& term, double scale)
{
  std::vector<SplitSum> ofRun(NumberOfRuns(count, SumGrain));
  ForRuns(count, SumGrain,
    [&](Id run, Id begin, Id end)
    {
      SplitSum sum;
      for (Id i = begin; i < end; ++i)
      {
        // Of at most 2^62: from a signed number of that length it is one instruction.
        sum.Add(static_cast<std::uint64_t>(static_cast<std::int64_t>(scale * term(i))));
      }
      ofRun[run] = sum;
    });
  SplitSum sum;
  for (const SplitSum& own : ofRun)
  {
    sum.High += own.High;
    sum.Low += own.Low;
  }
  return sum;
}

/**
 * Sum of terms >= 0 over all ranks, the same bits whatever their order; collective. The terms
 * are added as integers, each rounded to 2^-62 of the bound.
 *
 * @param term of an index below count; asked for by several threads.
 * @param bound no term of this rank is larger.
 */
template <typename Term>
double OrderlessSum(Id count, const Term& term, double bound, const Ranks& ranks)
{
  const double largest = ranks.Largest(bound);
  if (!(largest > 0.0) || !std::isfinite(largest))
  {
    return largest;
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  exponent = std::max(exponent, -900); // the scale has to be finite
  const SplitSum own = SumTerms(count, term, std::ldexp(1.0, 62 - exponent));
  const SplitSum all{ ranks.Sum(own.High), ranks.Sum(own.Low) };
  return all.Value(exponent);
}

}

#endif
