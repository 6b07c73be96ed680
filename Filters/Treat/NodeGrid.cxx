#include "NodeGrid.h"

namespace trim
{

NodeGrid::NodeGrid(int numberOfNodes, double cell)
  : Side(cell)
  , First(numberOfNodes + 1, -1)
  , Next(numberOfNodes, -1)
  , In(numberOfNodes, -1)
{
}

void NodeGrid::Put(int node, const Vec3& at)
{
  const int bucket = static_cast<int>(this->BucketOf(this->CellOf(at)));
  if (bucket == this->In[node])
  {
    return;
  }
  if (this->In[node] >= 0)
  {
    int* link = &this->First[this->In[node]];
    while (*link != node)
    {
      link = &this->Next[*link];
    }
    *link = this->Next[node];
  }
  this->Next[node] = this->First[bucket];
  this->First[bucket] = node;
  this->In[node] = bucket;
}

std::size_t NodeGrid::BucketOf(const Cell& cell) const
{
  const auto mixed = static_cast<std::uint64_t>(cell[0]) * 73856093u ^
    static_cast<std::uint64_t>(cell[1]) * 19349663u ^
    static_cast<std::uint64_t>(cell[2]) * 83492791u;
  return mixed % this->First.size();
}

}
