/**
 * @file Runs.h
 * @brief Loops over long lists in runs of a fixed length, the same whatever threads there are.
 */
#ifndef Runs_h
#define Runs_h

#include "Team.h"
#include "Types.h"

#include <algorithm>
#include <vector>

namespace trim
{

/// The last may be shorter.
inline Id NumberOfRuns(Id count, Id length)
{
  return (count + length - 1) / length;
}

/// Calls action(run, begin, end) for all runs of so many of the items, by all threads.
template <typename Action>
void ForRuns(Id count, Id length, const Action& action)
{
  ParallelFor(0, NumberOfRuns(count, length), 1,
    [&](Id begin, Id end)
    {
      for (Id run = begin; run < end; ++run)
      {
        action(run, run * length, std::min(count, (run + 1) * length));
      }
    });
}

/// One list of what was found in the runs.
template <typename Item>
std::vector<Item> Joined(const std::vector<std::vector<Item>>& lists)
{
  std::size_t size = 0;
  for (const auto& list : lists)
  {
    size += list.size();
  }
  std::vector<Item> all;
  all.reserve(size);
  for (const auto& list : lists)
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  return all;
}

/// So many items are worth a thread where each takes a few nanoseconds: to begin one takes as long
/// as all items of most bands.
constexpr int LightGrain = 5000;

/// Calls action(i) for all of so many items, a few hundred of which are worth a thread.
template <typename Action>
void ForAll(int count, const Action& action, int grain = 256)
{
  ParallelFor(0, count, grain,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        action(static_cast<int>(i));
      }
    });
}

}

#endif
