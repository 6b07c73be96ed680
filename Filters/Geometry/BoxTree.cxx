#include "BoxTree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

namespace nurbs
{
namespace
{

/// A leaf behind the key it is sorted by, so that whole numbers are compared and moved.
using Item = std::uint64_t;

int LeafOf(Item item)
{
  return static_cast<int>(item & 0xffffffffu);
}

/// Items go by rising value, those of the same value by leaf.
Item MakeItem(float value, int leaf)
{
  const float x = value + 0.0f; // -0 is 0
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  constexpr std::uint32_t sign = 0x80000000u;
  bits ^= (bits & sign) != 0 ? ~0u : sign;
  return (static_cast<Item>(bits) << 32) | static_cast<std::uint32_t>(leaf);
}

/// Median of five items spread over a range.
Item FindPivot(const Item* begin, const Item* end)
{
  const std::ptrdiff_t step = (end - begin - 1) / 4;
  Item sample[5];
  for (int k = 0; k < 5; ++k)
  {
    sample[k] = begin[k * step];
  }
  std::sort(sample, sample + 5);
  return sample[2];
}

/// std::nth_element for items, all different; without branches that cannot be foreseen.
void SelectItem(Item* begin, Item* middle, Item* end)
{
  constexpr std::ptrdiff_t Short = 24;
  constexpr int MaximumRounds = 64; // bad pivots; beyond them the library's guarantee is taken
  for (int round = 0; end - begin > Short && round < MaximumRounds; ++round)
  {
    const Item pivot = FindPivot(begin, end);
    Item* below = begin;
    for (Item* it = begin; it != end; ++it)
    {
      const Item item = *it;
      *it = *below;
      *below = item;
      below += item < pivot ? 1 : 0;
    }
    if (middle < below)
    {
      end = below;
    }
    else
    {
      begin = below;
    }
  }
  std::nth_element(begin, middle, end);
}

void SetChild(TreeNode& node, int c, int child, const Eigen::AlignedBox3f& box)
{
  node.Child[c] = child;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Empty children lie too far away for any query, but not so far that squares overflow.
    node.Low[axis][c] = child == TreeNode::Empty ? 1e18f : box.min()[axis];
    node.High[axis][c] = child == TreeNode::Empty ? 1e18f : box.max()[axis];
  }
}

class TreeBuilder
{
public:
  TreeBuilder(const std::vector<int>& leaves, const std::vector<Eigen::AlignedBox3f>& boxes)
    : Boxes(boxes)
  {
    this->Centers.reserve(boxes.size());
    for (const Eigen::AlignedBox3f& box : boxes)
    {
      this->Centers.emplace_back();
      this->Centers.back() << box.min() + box.max(), 0;
    }
    this->Items.reserve(leaves.size());
    for (const int leaf : leaves)
    {
      this->Items.push_back(MakeItem(0, leaf));
    }
    this->Nodes.reserve(2 * leaves.size() / 3 + 1); // at most: two leaves in each last node
  }

  std::vector<Item> Items;
  std::vector<TreeNode> Nodes;

  /// @return the box of all.
  Eigen::AlignedBox3f Build(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    const std::size_t index = this->Nodes.size();
    this->Nodes.emplace_back();
    std::ptrdiff_t bounds[5] = { begin, begin, 0, end, end };
    bounds[2] = this->Split(begin, end);
    bounds[1] = this->Split(begin, bounds[2]);
    bounds[3] = this->Split(bounds[2], end);
    Eigen::AlignedBox3f all;
    for (int c = 0; c < 4; ++c)
    {
      const std::ptrdiff_t first = bounds[c], count = bounds[c + 1] - first;
      Eigen::AlignedBox3f box;
      int child = TreeNode::Empty;
      if (count == 1)
      {
        child = ~static_cast<int>(first);
        box = this->Boxes[LeafOf(this->Items[first])];
      }
      else if (count > 1)
      {
        child = static_cast<int>(this->Nodes.size());
        box = this->Build(first, first + count);
      }
      all.extend(box);
      SetChild(this->Nodes[index], c, child, box); // Build may have moved the node
    }
    return all;
  }

private:
  /// Median along the longest axis of the centres; returns the index that parts the halves.
  std::ptrdiff_t Split(std::ptrdiff_t begin, std::ptrdiff_t end)
  {
    const std::ptrdiff_t middle = begin + (end - begin + 1) / 2;
    if (end - begin < 2)
    {
      return middle;
    }
    Eigen::Array4f low = this->Centers[LeafOf(this->Items[begin])], high = low;
    for (std::ptrdiff_t k = begin + 1; k < end; ++k)
    {
      const Eigen::Array4f& center = this->Centers[LeafOf(this->Items[k])];
      low = low.min(center);
      high = high.max(center);
    }
    int axis;
    (high - low).maxCoeff(&axis);
    for (std::ptrdiff_t k = begin; k < end; ++k)
    {
      const int leaf = LeafOf(this->Items[k]);
      this->Items[k] = MakeItem(this->Centers[leaf][axis], leaf);
    }
    Item* items = this->Items.data();
    SelectItem(items + begin, items + middle, items + end);
    return middle;
  }

  const std::vector<Eigen::AlignedBox3f>& Boxes;
  std::vector<Eigen::Array4f> Centers; ///< twice their coordinates
};

/// A rectangle of items of a grid.
struct GridTile
{
  const ItemGrid& Grid;
  int FirstU, FirstV, EndU, EndV;

  int CountU() const { return this->EndU - this->FirstU; }
  int CountV() const { return this->EndV - this->FirstV; }
  int Count() const { return this->CountU() * this->CountV(); }

  /// Across the longer side; the second half of a single item is empty.
  std::pair<GridTile, GridTile> Halve() const
  {
    const bool isLong = this->CountU() * this->Grid.LengthU >= this->CountV() * this->Grid.LengthV;
    GridTile low = *this, high = *this;
    if (isLong ? this->CountU() > 1 : this->CountV() <= 1)
    {
      low.EndU = high.FirstU = this->FirstU + (this->CountU() + 1) / 2;
    }
    else
    {
      low.EndV = high.FirstV = this->FirstV + (this->CountV() + 1) / 2;
    }
    return { low, high };
  }
};

/// @param most of the items of a tile.
void AddTiles(const GridTile& tile, int most, std::vector<GridTile>& tiles)
{
  if (tile.Count() <= most)
  {
    tiles.push_back(tile);
    return;
  }
  const auto [low, high] = tile.Halve();
  AddTiles(low, most, tiles);
  AddTiles(high, most, tiles);
}

/// Adds the tree of a tile.
/// @return the child of the node above that it is.
int HangTile(const GridTile& tile, const std::vector<Eigen::AlignedBox3f>& boxes,
  std::vector<TreeNode>& nodes, Eigen::AlignedBox3f& all)
{
  if (tile.Count() == 1)
  {
    const int item = tile.Grid.ItemAt(tile.FirstU, tile.FirstV);
    all = boxes[item];
    return ~item;
  }
  const int index = static_cast<int>(nodes.size());
  nodes.emplace_back();
  const auto [low, high] = tile.Halve();
  const auto [first, second] = low.Halve();
  const auto [third, fourth] = high.Halve();
  int c = 0;
  for (const GridTile& part : { first, second, third, fourth })
  {
    Eigen::AlignedBox3f box;
    const int child = part.Count() == 0 ? TreeNode::Empty : HangTile(part, boxes, nodes, box);
    all.extend(box);
    SetChild(nodes[index], c++, child, box);
  }
  return index;
}

}

std::vector<TreeNode> BuildTree(
  std::vector<int>& order, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  TreeBuilder builder(order, boxes);
  builder.Build(0, static_cast<std::ptrdiff_t>(order.size()));
  std::transform(builder.Items.begin(), builder.Items.end(), order.begin(), LeafOf);
  return std::move(builder.Nodes);
}

std::vector<TreeNode> BuildTreeOfGroups(std::vector<int>& order, const std::vector<int>& ends,
  const std::vector<Eigen::AlignedBox3f>& boxes)
{
  const auto beginOf = [&](int group) { return group > 0 ? ends[group - 1] : 0; };
  std::vector<int> groups(ends.size());
  std::vector<Eigen::AlignedBox3f> groupBoxes(ends.size());
  for (int g = 0; g < static_cast<int>(groups.size()); ++g)
  {
    groups[g] = g;
    for (int k = beginOf(g); k < ends[g]; ++k)
    {
      groupBoxes[g].extend(boxes[order[k]]);
    }
  }
  const std::vector<TreeNode> top = BuildTree(groups, groupBoxes);
  std::vector<int> sorted;
  sorted.reserve(order.size());
  for (const int g : groups)
  {
    sorted.insert(sorted.end(), order.begin() + beginOf(g), order.begin() + ends[g]);
  }
  TreeBuilder builder(sorted, boxes);
  builder.Nodes = top;
  builder.Nodes.reserve(top.size() + 2 * sorted.size() / 3 + 1);
  std::vector<int> roots;
  roots.reserve(groups.size());
  std::ptrdiff_t begin = 0;
  for (const int g : groups)
  {
    const std::ptrdiff_t end = begin + ends[g] - beginOf(g);
    roots.push_back(static_cast<int>(builder.Nodes.size()));
    builder.Build(begin, end);
    begin = end;
  }
  for (std::size_t n = 0; n < top.size(); ++n)
  {
    for (int& child : builder.Nodes[n].Child)
    {
      child = child < 0 ? roots[~child] : child;
    }
  }
  std::transform(builder.Items.begin(), builder.Items.end(), order.begin(), LeafOf);
  return std::move(builder.Nodes);
}

std::vector<TreeNode> BuildTreeOfGrids(
  const std::vector<ItemGrid>& grids, const std::vector<Eigen::AlignedBox3f>& boxes)
{
  // The best tree is one that is sorted down to the items: queries take a tenth less time then.
  constexpr std::size_t Few = 4096;
  const int most = boxes.size() > Few ? 16 : 1;
  std::vector<GridTile> tiles;
  for (const ItemGrid& grid : grids)
  {
    AddTiles({ grid, 0, 0, grid.CountU, grid.CountV }, most, tiles);
  }
  std::vector<int> order(tiles.size()), roots;
  std::iota(order.begin(), order.end(), 0);
  std::vector<Eigen::AlignedBox3f> tileBoxes(tiles.size());
  std::vector<TreeNode> ofTiles;
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    roots.push_back(HangTile(tiles[t], boxes, ofTiles, tileBoxes[t]));
  }
  std::vector<TreeNode> nodes = BuildTree(order, tileBoxes);
  const int top = static_cast<int>(nodes.size());
  const auto moved = [top](int child)
  { return child < 0 || child == TreeNode::Empty ? child : child + top; };
  for (TreeNode& node : nodes)
  {
    for (int& child : node.Child)
    {
      child = child < 0 ? moved(roots[order[~child]]) : child;
    }
  }
  nodes.insert(nodes.end(), ofTiles.begin(), ofTiles.end());
  for (std::size_t n = top; n < nodes.size(); ++n)
  {
    std::transform(nodes[n].Child, nodes[n].Child + 4, nodes[n].Child, moved);
  }
  return nodes;
}

}
