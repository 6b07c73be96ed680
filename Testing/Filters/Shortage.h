/**
 * @file Shortage.h
 * @brief Memory that operator new refuses, in the program that this is linked into.
 */
#ifndef Shortage_h
#define Shortage_h

#include <cstddef>

namespace judge
{
/// For as long as one lives, what is asked for is counted, and refused as planned.
class Shortage
{
public:
  struct Refusal
  {
    long First = -1;          ///< the first one that is refused; -1: none is
    bool Lasts = false;       ///< all from there on, else this one alone
    std::size_t Smallest = 0; ///< bytes; what is smaller does not count
  };

  Shortage();
  ~Shortage();
  Shortage(const Shortage&) = delete;
  void operator=(const Shortage&) = delete;

  /// Counts anew.
  static void Plan(const Refusal& refusal);
  /// How many there were that could have been refused.
  static long Seen();
};
}

#endif
