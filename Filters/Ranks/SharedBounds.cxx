#include "SharedBounds.h"

namespace trim
{

void ShareBounds(const Ranks& ranks, MeshBlocks& blocks)
{
  const Vec3 low = -blocks.Bounds.min();
  const Vec3& high = blocks.Bounds.max();
  const Vec3& cell = blocks.LargestCell;
  const auto largest = ranks.Largest(std::array<double, 10>{ low[0], low[1], low[2], high[0],
    high[1], high[2], cell[0], cell[1], cell[2], blocks.LargestDiagonal });
  blocks.Bounds.min() = -Vec3(largest[0], largest[1], largest[2]);
  blocks.Bounds.max() = Vec3(largest[3], largest[4], largest[5]);
  blocks.LargestCell = Vec3(largest[6], largest[7], largest[8]);
  blocks.LargestDiagonal = largest[9];
}

}
