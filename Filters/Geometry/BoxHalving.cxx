#include "BoxHalving.h"

#include <algorithm>

namespace nurbs
{

void HalveBox(const PartDomain& box, bool acrossS, bool highFirst, PartDomain* halves)
{
  PartDomain low = box, high = box;
  if (acrossS)
  {
    low.S1 = high.S0 = 0.5 * (box.S0 + box.S1);
  }
  else
  {
    low.T1 = high.T0 = 0.5 * (box.T0 + box.T1);
  }
  halves[0] = highFirst ? high : low;
  halves[1] = highFirst ? low : high;
}

Vec2 MeasureSides(int p, int q, const Vec4* net)
{
  const auto corner = [&](int i, int j) -> Vec3 { return CartesianPoint(net[i + j * (p + 1)]); };
  const Vec3 low = corner(0, 0), lowS = corner(p, 0), lowT = corner(0, q), high = corner(p, q);
  return Vec2(std::max((lowS - low).norm(), (high - lowT).norm()),
    std::max((lowT - low).norm(), (high - lowS).norm()));
}

}
