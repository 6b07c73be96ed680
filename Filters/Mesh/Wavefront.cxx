#include "Wavefront.h"

#include <numeric>

namespace trim
{

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

}
