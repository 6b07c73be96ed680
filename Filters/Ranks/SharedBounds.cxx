#include "SharedBounds.h"

namespace trim
{

void ShareBounds(const Ranks& ranks, MeshBlocks& blocks)
{
  for (int k = 0; k < 3; ++k)
  {
    blocks.Bounds.min()[k] = -ranks.Largest(-blocks.Bounds.min()[k]);
    blocks.Bounds.max()[k] = ranks.Largest(blocks.Bounds.max()[k]);
    blocks.LargestCell[k] = ranks.Largest(blocks.LargestCell[k]);
  }
  blocks.LargestDiagonal = ranks.Largest(blocks.LargestDiagonal);
}

}
