/**
 * @file NodeGrid.h
 * @brief Nodes by the cells of a regular grid in which they lie, for those that keep moving.
 *
 * Spatial hashing: M. Teschner et al., Optimized Spatial Hashing for Collision Detection of
 * Deformable Objects (2003).
 */
#ifndef NodeGrid_h
#define NodeGrid_h

#include "Place.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trim
{

class NodeGrid
{
public:
  /// @param cell side of a cell, positive; searches of a smaller reach look at few cells.
  NodeGrid(int numberOfNodes, double cell);

  /// Puts a node where it is now.
  void Put(int node, const Vec3& at);

  /// The same, if it is in the grid.
  void Move(int node, const Vec3& at)
  {
    if (this->In[node] >= 0)
    {
      this->Put(node, at);
    }
  }

  /// Whether a node passes a test of those that may be as near to a place as this; others may be
  /// tested, too.
  template <typename Test>
  bool AnyNear(const Vec3& at, double reach, const Test& test) const
  {
    const Cell first = this->CellOf(at - Vec3::Constant(reach));
    const Cell last = this->CellOf(at + Vec3::Constant(reach));
    for (std::int64_t i = first[0]; i <= last[0]; ++i)
    {
      for (std::int64_t j = first[1]; j <= last[1]; ++j)
      {
        for (std::int64_t k = first[2]; k <= last[2]; ++k)
        {
          for (int n = this->First[this->BucketOf({ i, j, k })]; n >= 0; n = this->Next[n])
          {
            if (test(n))
            {
              return true;
            }
          }
        }
      }
    }
    return false;
  }

private:
  using Cell = std::array<std::int64_t, 3>;

  Cell CellOf(const Vec3& at) const
  {
    return { static_cast<std::int64_t>(std::floor(at[0] / this->Side)),
      static_cast<std::int64_t>(std::floor(at[1] / this->Side)),
      static_cast<std::int64_t>(std::floor(at[2] / this->Side)) };
  }
  std::size_t BucketOf(const Cell& cell) const;

  double Side;
  std::vector<int> First; ///< by bucket: its first node, -1 if there is none
  std::vector<int> Next;  ///< by node: the next one in its bucket, -1 if it is the last
  std::vector<int> In;    ///< by node: its bucket, -1 before it was put anywhere
};

}

#endif
