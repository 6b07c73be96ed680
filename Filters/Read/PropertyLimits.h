/**
 * @file PropertyLimits.h
 * @brief What the sources take as properties: how many points or knots, which numbers for a choice.
 */
#ifndef PropertyLimits_h
#define PropertyLimits_h

#include <string>

namespace nurbs
{
/// More than any line or surface has: an index or a number beyond is a mistake, and would take all
/// the memory.
constexpr int MostValues = 10000000;

/// What is wrong with the number of a choice; empty: nothing.
inline std::string FindChoiceDefect(const std::string& name, int number, int most)
{
  return number < 0 || number > most
    ? name + " is " + std::to_string(number) + ": give a number from 0 to " + std::to_string(most)
    : "";
}
}

#endif
