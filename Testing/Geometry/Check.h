/**
 * @file Check.h
 * @brief Assertions of the kernel's tests: count failures, say where, go on.
 */
#ifndef Check_h
#define Check_h

#include <iostream>
#include <string>
#include <type_traits>

namespace check
{
inline int& Failures()
{
  static int failures = 0;
  return failures;
}

/// @param what a text, or what makes one where it is needed: of thousands of places that are right
/// none has to be written out.
template <typename What>
std::string TextOf(const What& what)
{
  if constexpr (std::is_invocable_v<What>)
  {
    return what();
  }
  else
  {
    return what;
  }
}

/// Prints the first failures of a test only: a thousand alike say no more.
/// @param what see TextOf.
template <typename What>
bool That(bool holds, const What& what)
{
  if (!holds && ++Failures() <= 40)
  {
    std::cerr << "FAILED: " << TextOf(what) << "\n";
  }
  return holds;
}

/// |a - b| <= tolerance, with the numbers in the message.
template <typename What>
bool Near(double a, double b, double tolerance, const What& what)
{
  const double difference = a > b ? a - b : b - a;
  return That(difference <= tolerance,
    [&]
    {
      return TextOf(what) + ": " + std::to_string(a) + " and " + std::to_string(b) + " differ by " +
        std::to_string(difference / tolerance) + " tolerances";
    });
}

/// Of so many random trials a twentieth under a sanitizer, which makes each that much slower.
constexpr int Trials(int count)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return count / 20;
#else
  return count;
#endif
}

/// Exit status of a test program.
inline int Result()
{
  if (Failures() > 0)
  {
    std::cerr << Failures() << " checks failed\n";
    return 1;
  }
  std::cout << "all checks passed\n";
  return 0;
}
}

#endif
