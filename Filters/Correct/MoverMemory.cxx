#include "MoverMemory.h"

#include "Status.h"

namespace trim
{

bool SlidingMatters(const Band& band, const Columns& columns, const MoverMemory& memory)
{
  const std::vector<unsigned char> allKept(band.NumberOfNodes(), NodeKeep);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (memory.AskedOffCut[n].load(std::memory_order_relaxed) &&
      !(ConstrainNode(band, columns, band.NodeStatus, n) ==
        ConstrainNode(band, columns, allKept, n)))
    {
      return true;
    }
  }
  return false;
}

}
