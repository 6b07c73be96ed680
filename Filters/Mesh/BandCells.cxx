#include "BandCells.h"

#include "Band.h"
#include "Runs.h"
#include "SortUnique.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// Position of a value in an ascending list, or -1.
int Locate(const std::vector<Id>& sorted, Id value)
{
  const auto it = std::lower_bound(sorted.begin(), sorted.end(), value);
  return it != sorted.end() && *it == value ? static_cast<int>(it - sorted.begin()) : -1;
}

/// Breadth-first rings over cells that share a node, among the cells near the cut.
class Rings
{
public:
  Rings(const HexMesh& mesh, const std::vector<Id>& near, const std::vector<Id>& seeds)
    : Near(near)
    , Nodes(near.size())
    , Counts(near.size())
    , OfCell(near.size(), -1)
    , Marks(mesh.NumberOfPoints)
  {
    constexpr Id ahead = 24;
    const Id last = static_cast<Id>(near.size()) - 1;
    this->ForCells(
      [&](Id c)
      {
        mesh.PrefetchCell(near[std::min(c + ahead, last)]);
        this->Counts[c] = mesh.OrientedCell(near[c], this->Nodes[c]);
      });
    ForAll(
      static_cast<int>(seeds.size()), [&](int i) { this->Take(Locate(near, seeds[i]), 0); },
      LightGrain);
  }

  void Grow(int rings, const SpreadRing& spread)
  {
    for (int ring = 1; ring <= rings; ++ring)
    {
      if (spread)
      {
        this->SpreadNodes(ring, spread);
      }
      // What a cell of this ring marks is of no account for the others of it.
      this->ForCells(
        [&](Id c)
        {
          if (this->OfCell[c] < 0 && this->IsReached(c, ring))
          {
            this->Take(c, ring);
          }
        });
    }
  }

  /// The cells of all rings, their nodes numbered in the order in which they come.
  /// @param[out] ids of these nodes.
  std::vector<BandCells::Cell> Cells(std::vector<Id>& ids)
  {
    std::vector<BandCells::Cell> cells;
    cells.reserve(this->Near.size() -
      std::count(this->OfCell.begin(), this->OfCell.end(), -1)); // as a growing list is copied
    for (std::size_t c = 0; c < this->Near.size(); ++c)
    {
      if (this->OfCell[c] >= 0)
      {
        cells.push_back({ this->Near[c], this->Counts[c], this->OfCell[c], 0, {} });
        for (int i = 0; i < this->Counts[c]; ++i)
        {
          cells.back().Node[i] = this->NumberOf(this->Nodes[c][i], ids);
        }
      }
    }
    return cells;
  }

private:
  template <typename Action>
  void ForCells(const Action& action)
  {
    ForAll(static_cast<int>(this->Near.size()), action, LightGrain);
  }

  int MarkOf(Id node) const { return this->Marks[node].load(std::memory_order_relaxed); }
  void Mark(Id node, int mark)
  {
    if (this->MarkOf(node) == 0)
    {
      this->Marks[node].store(mark, std::memory_order_relaxed);
    }
  }

  void Take(Id c, int ring)
  {
    this->OfCell[c] = ring;
    for (int i = 0; i < this->Counts[c]; ++i)
    {
      this->Mark(this->Nodes[c][i], ring + 1);
    }
  }

  bool IsReached(Id c, int ring) const
  {
    const auto& nodes = this->Nodes[c];
    return std::any_of(nodes.begin(), nodes.begin() + this->Counts[c],
      [&](Id node)
      {
        const int mark = this->MarkOf(node);
        return mark > 0 && mark <= ring;
      });
  }

  /// Marks what nodes the ring before has reached elsewhere.
  void SpreadNodes(int ring, const SpreadRing& spread)
  {
    std::vector<Id> reached;
    for (std::size_t c = 0; c < this->Near.size(); ++c)
    {
      const auto& nodes = this->Nodes[c];
      std::copy_if(nodes.begin(), nodes.begin() + (this->OfCell[c] < 0 ? 0 : this->Counts[c]),
        std::back_inserter(reached), [&](Id node) { return this->MarkOf(node) == ring; });
    }
    SortUnique(reached);
    spread(reached);
    for (const Id node : reached)
    {
      this->Mark(node, ring);
    }
  }

  int NumberOf(Id node, std::vector<Id>& ids)
  {
    int mark = this->MarkOf(node);
    if (mark > 0)
    {
      ids.push_back(node);
      mark = -static_cast<int>(ids.size());
      this->Marks[node].store(mark, std::memory_order_relaxed);
    }
    return -mark - 1;
  }

  const std::vector<Id>& Near;
  PageVector<std::array<Id, 8>> Nodes;
  std::vector<int> Counts;
  std::vector<int> OfCell; ///< -1: not reached
  /// Of each node of the mesh: one more than the first ring with a cell of it, 0: none; at last, of
  /// those in rings, how far below zero its number is, the first being -1.
  PageVector<std::atomic<int>> Marks;
};

/// Node places (equal where the coordinates are) that a cell joins, ascending.
template <typename PlaceOf>
std::array<int, 8> CellKey(const BandCells::Cell& cell, const PlaceOf& placeOf)
{
  std::array<int, 8> key;
  key.fill(std::numeric_limits<int>::max());
  for (int i = 0; i < cell.Count; ++i)
  {
    key[i] = placeOf(cell.Node[i]);
  }
  std::sort(key.begin(), key.end());
  return key;
}

/// Orders runs of nodes at one place by the cells round them.
void SplitTies(const BandCells& band, std::vector<int>& order)
{
  const auto same = [&](int a, int b) { return band.Nodes[a].Point == band.Nodes[b].Point; };
  if (std::adjacent_find(order.begin(), order.end(), same) == order.end())
  {
    return;
  }
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool tied = i > 0 && same(order[i - 1], order[i]);
    place[order[i]] = tied ? place[order[i - 1]] : static_cast<int>(i);
  }
  std::vector<std::vector<std::array<int, 8>>> keys(order.size());
  for (const auto& cell : band.Cells)
  {
    for (int i = 0; i < cell.Count; ++i)
    {
      keys[cell.Node[i]].push_back(CellKey(cell, [&place](int node) { return place[node]; }));
    }
  }
  for (auto& list : keys)
  {
    std::sort(list.begin(), list.end());
  }
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return place[a] != place[b] ? place[a] < place[b] : keys[a] < keys[b]; });
}

/// Nodes by x, roughly: each list holds those before all of the next one.
Band::Lists BucketNodes(const std::vector<BandCells::Node>& nodes)
{
  const auto count = static_cast<int>(nodes.size());
  const auto range = std::minmax_element(nodes.begin(), nodes.end(),
    [](const auto& a, const auto& b) { return a.Point[0] < b.Point[0]; });
  const double low = count > 0 ? range.first->Point[0] : 0.0;
  const double width = count > 0 ? range.second->Point[0] - low : 0.0;
  const int buckets = 1 + count / 32;
  const double scale = width > 0.0 ? buckets / width : 0.0;
  return BuildLists(buckets,
    [&](auto&& add)
    {
      for (int n = 0; n < count; ++n)
      {
        // Rounded, too, no step of this turns the order round.
        add(static_cast<int>(std::min(buckets - 1.0, scale * (nodes[n].Point[0] - low))), n);
      }
    });
}

std::vector<int> OrderNodes(const BandCells& band)
{
  Band::Lists buckets = BucketNodes(band.Nodes);
  const auto pointOf = [&band](int node) -> const Vec3& { return band.Nodes[node].Point; };
  ForAll(
    static_cast<int>(buckets.Offset.size()) - 1,
    [&](int bucket)
    {
      std::sort(buckets.Item.begin() + buckets.Offset[bucket],
        buckets.Item.begin() + buckets.Offset[bucket + 1],
        [&pointOf](int a, int b)
        { return pointOf(a) == pointOf(b) ? a < b : LiesBefore(pointOf(a), pointOf(b)); });
    },
    50);
  SplitTies(band, buckets.Item);
  return std::move(buckets.Item);
}

/// By their sorted nodes; mostly the first of these decides.
std::vector<int> OrderCells(const BandCells& band)
{
  Band::Lists byFirstNode = BuildLists(static_cast<int>(band.Nodes.size()),
    [&band](auto&& add)
    {
      int c = 0;
      for (const auto& cell : band.Cells)
      {
        add(*std::min_element(cell.begin(), cell.end()), c++);
      }
    });
  const auto key = [&band](int c) { return CellKey(band.Cells[c], [](int node) { return node; }); };
  const auto isBefore = [&key](int a, int b)
  {
    const auto keyA = key(a);
    const auto keyB = key(b);
    return keyA == keyB ? a < b : keyA < keyB;
  };
  ForAll(
    static_cast<int>(band.Nodes.size()),
    [&](int n)
    {
      std::sort(byFirstNode.Item.begin() + byFirstNode.Offset[n],
        byFirstNode.Item.begin() + byFirstNode.Offset[n + 1], isBefore);
    },
    LightGrain / 2);
  return std::move(byFirstNode.Item);
}

}

BandCells CollectBandCells(const HexMesh& mesh, const std::vector<Id>& seeds,
  const std::vector<Id>& near, int rings, const UnsetVector<unsigned char>& nodeStatus,
  const UnsetVector<unsigned char>& elementStatus, const SpreadRing& spread)
{
  Rings grown(mesh, near, seeds);
  grown.Grow(rings, spread);
  std::vector<Id> ids;
  BandCells band;
  band.Cells = grown.Cells(ids);
  for (auto& cell : band.Cells)
  {
    cell.Status = elementStatus[cell.Global];
  }
  band.Nodes.resize(ids.size());
  ForAll(
    static_cast<int>(ids.size()),
    [&](int n) {
      band.Nodes[n] = { ids[n], mesh.Point(ids[n]), nodeStatus[ids[n]] };
    },
    LightGrain);
  return band;
}

void SortByPlace(BandCells& band)
{
  const std::vector<int> order = OrderNodes(band);
  std::vector<int> number(order.size());
  std::vector<BandCells::Node> nodes(order.size());
  ForAll(
    static_cast<int>(order.size()),
    [&](int i)
    {
      number[order[i]] = i;
      nodes[i] = band.Nodes[order[i]];
    },
    LightGrain);
  band.Nodes = std::move(nodes);
  const auto count = static_cast<int>(band.Cells.size());
  ForAll(
    count,
    [&](int c)
    {
      auto& cell = band.Cells[c];
      for (int i = 0; i < cell.Count; ++i)
      {
        cell.Node[i] = number[cell.Node[i]];
      }
    },
    LightGrain);
  const std::vector<int> cellOrder = OrderCells(band);
  std::vector<BandCells::Cell> cells(count);
  ForAll(
    count, [&](int i) { cells[i] = band.Cells[cellOrder[i]]; }, LightGrain);
  band.Cells = std::move(cells);
}

}
