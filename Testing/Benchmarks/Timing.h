/**
 * @file Timing.h
 * @brief Times that can be compared: contestants take turns, the best of several rounds counts.
 */
#ifndef Timing_h
#define Timing_h

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <time.h>
#include <vector>

namespace benchmark
{
struct Contestant
{
  std::string Name;
  int Items = 1; ///< queries in one run
  std::function<void()> Run;
  bool Threaded = false; ///< wall time, not that of the calling thread
  double Best = std::numeric_limits<double>::infinity(); ///< microseconds an item
};

/// Seconds of the calling thread: other programs on the machine disturb it least.
inline double ThreadSeconds()
{
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double WallSeconds()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline void TakeTurns(std::vector<Contestant>& contestants, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    for (Contestant& contestant : contestants)
    {
      const auto now = contestant.Threaded ? WallSeconds : ThreadSeconds;
      const double start = now();
      contestant.Run();
      contestant.Best = std::min(contestant.Best, 1e6 * (now() - start) / contestant.Items);
    }
  }
}
}

#endif
