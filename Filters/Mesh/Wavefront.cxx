#include "Wavefront.h"

#include <chrono>
#include <numeric>
#include <thread>
#include <utility>

namespace trim
{
namespace
{

/// Runs until threads are tried again: a tenth of a second, about.
constexpr int MostRunsAlone = 100;
std::atomic<int> RunsAlone{ 0 };
/// A thread that yields and does not come back at once has others on its processor.
constexpr std::chrono::microseconds LongYield{ 500 };
/// Hardly any task takes so long but for others on the processor of its thread.
constexpr std::chrono::milliseconds LongTask{ 20 };

}

Wavefront::Wavefront(Band::Lists met)
  : Met(std::move(met))
  , Order(this->Met.Offset.size() - 1)
{
  std::vector<int> level(this->Order.size(), 0);
  for (std::size_t task = 0; task < level.size(); ++task)
  {
    for (const int* other = this->Met.begin(task); other != this->Met.end(task); ++other)
    {
      level[task] = std::max(level[task], level[*other] + 1);
    }
  }
  std::iota(this->Order.begin(), this->Order.end(), 0);
  std::stable_sort(
    this->Order.begin(), this->Order.end(), [&level](int a, int b) { return level[a] < level[b]; });
}

bool Wavefront::TakesTurnAlone()
{
  int left = RunsAlone;
  while (left > 0 && !RunsAlone.compare_exchange_weak(left, left - 1))
  {
  }
  return left > 0;
}

void Wavefront::Await(const std::atomic<char>& done, const std::atomic<bool>& failed)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (auto before = start; !done.load(std::memory_order_acquire) && !failed.load();)
  {
    std::this_thread::yield();
    const auto now = Clock::now();
    if (now - before > LongYield || now - start > LongTask)
    {
      RunsAlone = MostRunsAlone;
    }
    before = now;
  }
}

}
