#include "BezierPatch.h"

#include <algorithm>

namespace nurbs
{

bool NormaliseWeights(Vec4* net, int size)
{
  double low = net[0].w(), high = low;
  for (int i = 1; i < size; ++i)
  {
    low = std::min(low, net[i].w());
    high = std::max(high, net[i].w());
  }
  if (high - low > 1e-15 * high)
  {
    return true;
  }
  for (int i = 0; i < size && !(low == 1.0 && high == 1.0); ++i)
  {
    net[i].head<3>() /= net[i].w();
    net[i].w() = 1.0;
  }
  return false;
}

}
