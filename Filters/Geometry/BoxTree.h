/**
 * @file BoxTree.h
 * @brief A four-way tree over aligned boxes, of leaves or of blocks of a surface.
 *
 * Boxes are kept in single precision, rounded outwards, four to a node, so that one node is tested
 * with one set of vector instructions.
 */
#ifndef BoxTree_h
#define BoxTree_h

#include "PageVector.h"

#include <Eigen/Geometry>

#include <utility>
#include <vector>

namespace nurbs
{

struct alignas(CacheLine) TreeNode
{
  Eigen::Array4f Low[3], High[3];
  int Child[4]; ///< a node, or ~ of a leaf box, or Empty
  static constexpr int Empty = 0x7fffffff;
};

/// Four-way tree over aligned boxes; order is permuted into that of the tree.
std::vector<TreeNode> BuildTree(
  std::vector<int>& order, const std::vector<Eigen::AlignedBox3f>& boxes);

/**
 * The same for very many boxes: a tree of groups of neighbours, and in each of them a tree of its
 * own. Takes less time, as most of the halving is done within the processor's cache.
 *
 * @param ends of the groups in `order`, ascending; no group is empty.
 */
std::vector<TreeNode> BuildTreeOfGroups(std::vector<int>& order, const std::vector<int>& ends,
  const std::vector<Eigen::AlignedBox3f>& boxes);

/// Items in rows, numbered one after the other.
struct ItemGrid
{
  int First = 0, CountU = 1, CountV = 1;
  double LengthU = 1, LengthV = 1; ///< of an item, in the mean

  int ItemAt(int column, int row) const { return this->First + column + row * this->CountU; }
  int ColumnOf(int item) const { return (item - this->First) % this->CountU; }
  int RowOf(int item) const { return (item - this->First) / this->CountU; }
};

/// The same for boxes of items that lie in grids: if they are many, a tree of tiles of these, and
/// in each of them one by rows and columns, which asks for no sorting.
std::vector<TreeNode> BuildTreeOfGrids(
  const std::vector<ItemGrid>& grids, const std::vector<Eigen::AlignedBox3f>& boxes);

/// Deep enough for any tree: three more entries a level at most.
constexpr int TreeStackSize = 256;

/**
 * Visits what hangs in the tree in boxes that pass, until it is told to stop.
 *
 * @param pass of a node: which of its four boxes do, as Eigen::Array<bool, 4, 1>.
 * @param visit takes the index of an item and returns false to stop.
 * @return false if it was stopped.
 */
template <typename Pass, typename Visit>
bool ForItemsPassing(const std::vector<TreeNode>& nodes, const Pass& pass, Visit&& visit)
{
  int stack[TreeStackSize];
  int size = 0;
  stack[size++] = 0;
  while (size > 0)
  {
    const TreeNode& node = nodes[stack[--size]];
    const Eigen::Array<bool, 4, 1> passes = pass(node);
    for (int c = 0; c < 4; ++c)
    {
      const int child = node.Child[c];
      if (child == TreeNode::Empty || !passes[c])
      {
        continue;
      }
      if (child >= 0)
      {
        stack[size++] = child;
      }
      else if (!visit(~child))
      {
        return false;
      }
    }
  }
  return true;
}

/// Visits what hangs in the tree in boxes that meet one, if but by a face; see ForItemsPassing.
template <typename Visit>
bool ForItemsMeeting(
  const std::vector<TreeNode>& nodes, const Eigen::AlignedBox3f& box, Visit&& visit)
{
  const Eigen::Vector3f low = box.min(), high = box.max();
  const auto meets = [&](const TreeNode& node) -> Eigen::Array<bool, 4, 1>
  {
    return (node.Low[0] <= high[0]) && (node.High[0] >= low[0]) && (node.Low[1] <= high[1]) &&
      (node.High[1] >= low[1]) && (node.Low[2] <= high[2]) && (node.High[2] >= low[2]);
  };
  return ForItemsPassing(nodes, meets, std::forward<Visit>(visit));
}

}

#endif
