#include "OrderlessSum.h"

#include <cmath>
#include <cstdint>

namespace trim
{

double OrderlessSum(const std::vector<double>& terms, const Ranks& ranks)
{
  double largest = 0.0;
  for (const double term : terms)
  {
    largest = std::max(largest, term);
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
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  for (const double term : terms)
  {
    const auto bits = static_cast<std::uint64_t>(scale * term);
    high += bits >> 31;
    low += bits & lowHalf;
  }
  high = ranks.Sum(high);
  low = ranks.Sum(low);
  high += low >> 31;
  low &= lowHalf;
  return std::ldexp(static_cast<double>(high), exponent - 31) +
    std::ldexp(static_cast<double>(low), exponent - 62);
}

}
