/**
 * @file Timing.h
 * @brief Times that can be compared: contestants take turns, the best of several rounds counts.
 */
#ifndef Timing_h
#define Timing_h

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace benchmark
{
struct Contestant
{
  std::string Name;
  std::function<void()> Run;
  int Items = 1;       ///< queries in one run
  double Best = 1e300; ///< seconds an item

  double Microseconds() const { return 1e6 * this->Best; }
};

/// Other programs on the machine disturb all contestants alike, and the best round least.
inline void TakeTurns(std::vector<Contestant>& contestants, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    for (Contestant& contestant : contestants)
    {
      const auto start = std::chrono::steady_clock::now();
      contestant.Run();
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      contestant.Best = std::min(contestant.Best, time.count() / contestant.Items);
    }
  }
}
}

#endif
