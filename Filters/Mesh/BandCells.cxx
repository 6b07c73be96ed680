#include "BandCells.h"

#include "Band.h"

#include <algorithm>
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

/// The cells among which the rings grow, in numbers of their own.
struct NearMesh
{
  std::vector<Id> Nodes;
  std::vector<std::array<int, 8>> Cells;
  std::vector<int> Counts;
  PageVector<int> Number; ///< of each node of the mesh plus one, 0: it has none
};

NearMesh TakeNearMesh(const HexMesh& mesh, const std::vector<Id>& near)
{
  NearMesh taken;
  taken.Number.resize(mesh.NumberOfPoints);
  taken.Cells.resize(near.size());
  taken.Counts.resize(near.size());
  std::array<Id, 8> nodes;
  for (std::size_t c = 0; c < near.size(); ++c)
  {
    taken.Counts[c] = mesh.OrientedCell(near[c], nodes);
    for (int i = 0; i < taken.Counts[c]; ++i)
    {
      int& number = taken.Number[nodes[i]];
      if (number == 0)
      {
        taken.Nodes.push_back(nodes[i]);
        number = static_cast<int>(taken.Nodes.size());
      }
      taken.Cells[c][i] = number - 1;
    }
  }
  return taken;
}

/// Nodes of the front cells that no ring has reached yet, with what was reached elsewhere.
std::vector<int> ReachNodes(const NearMesh& mesh, const std::vector<int>& front,
  const SpreadRing& spread, std::vector<char>& seen)
{
  std::vector<int> reached;
  for (const int c : front)
  {
    for (int i = 0; i < mesh.Counts[c]; ++i)
    {
      const int node = mesh.Cells[c][i];
      if (!seen[node])
      {
        seen[node] = 1;
        reached.push_back(node);
      }
    }
  }
  if (!spread)
  {
    return reached;
  }
  std::vector<Id> ids(reached.size());
  std::transform(
    reached.begin(), reached.end(), ids.begin(), [&](int node) { return mesh.Nodes[node]; });
  spread(ids);
  for (std::size_t i = reached.size(); i < ids.size(); ++i)
  {
    const int node = mesh.Number[ids[i]] - 1;
    if (node >= 0 && !seen[node])
    {
      seen[node] = 1;
      reached.push_back(node);
    }
  }
  return reached;
}

/// Breadth-first rings over cells that share a node; -1 outside.
std::vector<int> GrowRings(
  const NearMesh& mesh, const std::vector<int>& seeds, int rings, const SpreadRing& spread)
{
  const int numberOfNodes = static_cast<int>(mesh.Nodes.size());
  const auto links = BuildLists(numberOfNodes,
    [&](auto&& add)
    {
      for (std::size_t c = 0; c < mesh.Cells.size(); ++c)
      {
        for (int i = 0; i < mesh.Counts[c]; ++i)
        {
          add(mesh.Cells[c][i], static_cast<int>(c));
        }
      }
    });
  std::vector<int> ring(mesh.Cells.size(), -1);
  std::vector<char> seen(numberOfNodes, 0);
  std::vector<int> front = seeds;
  for (const int c : front)
  {
    ring[c] = 0;
  }
  for (int r = 1; r <= rings; ++r)
  {
    const std::vector<int> reached = ReachNodes(mesh, front, spread, seen);
    front.clear();
    for (const int node : reached)
    {
      for (const int* other = links.begin(node); other != links.end(node); ++other)
      {
        if (ring[*other] < 0)
        {
          ring[*other] = r;
          front.push_back(*other);
        }
      }
    }
  }
  return ring;
}

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

std::vector<int> OrderNodes(const BandCells& band)
{
  std::vector<std::pair<Vec3, int>> places;
  places.reserve(band.Nodes.size());
  for (const auto& node : band.Nodes)
  {
    places.emplace_back(node.Point, static_cast<int>(places.size()));
  }
  std::sort(places.begin(), places.end(),
    [](const auto& a, const auto& b)
    { return a.first == b.first ? a.second < b.second : LiesBefore(a.first, b.first); });
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& place : places)
  {
    order.push_back(place.second);
  }
  SplitTies(band, order);
  return order;
}

/// By their sorted nodes; mostly the first of these decides.
std::vector<int> OrderCells(const BandCells& band)
{
  std::vector<std::pair<int, int>> cells; // first node and cell
  cells.reserve(band.Cells.size());
  for (const auto& cell : band.Cells)
  {
    cells.emplace_back(*std::min_element(cell.Node.begin(), cell.Node.begin() + cell.Count),
      static_cast<int>(cells.size()));
  }
  const auto key = [&band](int c) { return CellKey(band.Cells[c], [](int node) { return node; }); };
  std::sort(cells.begin(), cells.end(),
    [&key](const auto& a, const auto& b)
    {
      if (a.first != b.first)
      {
        return a.first < b.first;
      }
      const auto keyA = key(a.second);
      const auto keyB = key(b.second);
      return keyA == keyB ? a.second < b.second : keyA < keyB;
    });
  std::vector<int> order;
  order.reserve(cells.size());
  for (const auto& cell : cells)
  {
    order.push_back(cell.second);
  }
  return order;
}

}

BandCells CollectBandCells(const HexMesh& mesh, const std::vector<Id>& seeds,
  const std::vector<Id>& near, int rings, const PageVector<unsigned char>& nodeStatus,
  const PageVector<unsigned char>& elementStatus, const SpreadRing& spread)
{
  const NearMesh nearMesh = TakeNearMesh(mesh, near);
  std::vector<int> seedCells;
  for (const Id seed : seeds)
  {
    seedCells.push_back(Locate(near, seed));
  }
  const auto ring = GrowRings(nearMesh, seedCells, rings, spread);
  BandCells band;
  std::vector<int> local(nearMesh.Nodes.size(), -1);
  for (std::size_t c = 0; c < near.size(); ++c)
  {
    if (ring[c] < 0)
    {
      continue;
    }
    BandCells::Cell cell{ near[c], nearMesh.Counts[c], ring[c], elementStatus[near[c]], {} };
    for (int i = 0; i < cell.Count; ++i)
    {
      int& at = local[nearMesh.Cells[c][i]];
      if (at < 0)
      {
        const Id node = nearMesh.Nodes[nearMesh.Cells[c][i]];
        at = static_cast<int>(band.Nodes.size());
        band.Nodes.push_back({ node, mesh.Point(node), nodeStatus[node] });
      }
      cell.Node[i] = at;
    }
    band.Cells.push_back(cell);
  }
  return band;
}

void SortByPlace(BandCells& band)
{
  const std::vector<int> order = OrderNodes(band);
  std::vector<int> number(order.size());
  std::vector<BandCells::Node> nodes(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    number[order[i]] = static_cast<int>(i);
    nodes[i] = band.Nodes[order[i]];
  }
  band.Nodes = std::move(nodes);
  for (auto& cell : band.Cells)
  {
    for (int i = 0; i < cell.Count; ++i)
    {
      cell.Node[i] = number[cell.Node[i]];
    }
  }
  std::vector<BandCells::Cell> cells;
  cells.reserve(band.Cells.size());
  for (const int c : OrderCells(band))
  {
    cells.push_back(band.Cells[c]);
  }
  band.Cells = std::move(cells);
}

}
