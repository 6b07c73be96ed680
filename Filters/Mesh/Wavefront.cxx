#include "Wavefront.h"

#include <numeric>

namespace trim
{
namespace
{

/// Runs until threads are tried again: a tenth of a second, about.
constexpr int MostRunsAlone = 100;
std::atomic<int> RunsAlone{ 0 };

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

void Wavefront::TellHeldUp()
{
  RunsAlone = MostRunsAlone;
}

}
