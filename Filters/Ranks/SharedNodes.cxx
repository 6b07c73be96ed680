#include "SharedNodes.h"

#include "ElementTopology.h"
#include "MeshBlocks.h"
#include "Place.h"
#include "PlaceText.h"

#include <algorithm>
#include <cstdint>

namespace trim
{
namespace
{
using nurbs::SparseVector;

/// The space that all pieces cover is divided into so many boxes along each axis.
constexpr int BoxesPerAxis = 64;

/// Spreads an id over 64 bits (the finaliser of splitmix64).
std::uint64_t Scatter(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Where the nodes of this piece may be other ranks' as well.
struct MeetingPlaces
{
  Box3 Whole;               ///< all pieces
  std::vector<Box3> Others; ///< each other rank's piece, wider by a box of SpaceGrid

  bool MayHold(const Vec3& p) const
  {
    return std::any_of(
      this->Others.begin(), this->Others.end(), [&p](const Box3& box) { return box.contains(p); });
  }
  bool MayMeet(const Box3& part) const
  {
    return std::any_of(this->Others.begin(), this->Others.end(),
      [&part](const Box3& box) { return box.intersects(part); });
  }
};

MeetingPlaces FindMeetingPlaces(const Box3& own, const Ranks& ranks)
{
  using Corners = std::array<Place, 2>;
  MeetingPlaces places;
  const auto all = ranks.Gather(std::vector<Corners>{ { ToPlace(own.min()), ToPlace(own.max()) } });
  for (int rank = 0; rank < ranks.Count(); ++rank)
  {
    const Box3 box(ToVec3(all[rank][0]), ToVec3(all[rank][1]));
    if (!box.isEmpty())
    {
      places.Whole.extend(box);
      if (rank != ranks.Rank())
      {
        places.Others.push_back(box);
      }
    }
  }
  // A little more, against rounding.
  const Vec3 margin = 1.01 / BoxesPerAxis * places.Whole.sizes();
  for (Box3& box : places.Others)
  {
    box = Grown(box, margin);
  }
  return places;
}

/**
 * Nodes, where pieces may meet, of faces that have a cell on one side only. Each face gives its
 * nodes the same random number from both its cells, so that those of inner faces cancel out; no
 * face is ever stored.
 */
std::vector<Id> FindBorderNodes(
  const HexMesh& mesh, const MeshBlocks& blocks, const MeetingPlaces& places)
{
  const std::vector<Id> cells =
    CellsOfRuns(mesh, FindRuns(blocks, [&places](const Box3& box) { return places.MayMeet(box); }));
  SparseVector<std::uint64_t> sum(mesh.NumberOfPoints);
  std::array<Id, 8> nodes;
  std::array<std::uint64_t, 8> scattered;
  for (const Id c : cells)
  {
    const int count = mesh.Cell(c, nodes);
    const auto& topology = TopologyOf(count);
    for (int i = 0; i < count; ++i)
    {
      scattered[i] = Scatter(static_cast<std::uint64_t>(nodes[i]));
    }
    for (int slot = 0; slot < topology.NumberOfFaces; ++slot)
    {
      const auto& face = topology.Faces[slot];
      std::uint64_t number = 0;
      for (int i = 0; i < face.Count; ++i)
      {
        number += scattered[face.Node[i]];
      }
      number = Scatter(number);
      for (int i = 0; i < face.Count; ++i)
      {
        sum[nodes[face.Node[i]]] ^= number;
      }
    }
  }
  std::vector<Id> border;
  for (const Id c : cells)
  {
    const int count = mesh.Cell(c, nodes);
    for (int i = 0; i < count; ++i)
    {
      // Of other nodes not all cells were asked.
      if (sum[nodes[i]] != 0 && places.MayHold(mesh.Point(nodes[i])))
      {
        border.push_back(nodes[i]);
        sum[nodes[i]] = 0; // once
      }
    }
  }
  return border;
}

/// Divides the space of all pieces into boxes.
class SpaceGrid
{
public:
  explicit SpaceGrid(const Box3& whole)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Low[k] = whole.min()[k];
      const double width = whole.max()[k] - this->Low[k];
      this->Scale[k] = width > 0.0 ? BoxesPerAxis / width : 0.0;
    }
  }

  int BoxOf(const Vec3& p) const
  {
    int box = 0;
    for (int k = 0; k < 3; ++k)
    {
      // Not a number, where the width overflows, counts as zero.
      const double at = (p[k] - this->Low[k]) * this->Scale[k];
      box =
        box * BoxesPerAxis + (at > 0.0 ? static_cast<int>(std::min(at, BoxesPerAxis - 1.0)) : 0);
    }
    return box;
  }

private:
  Place Low{}, Scale{};
};

/// Those of the nodes that lie in boxes which another rank has nodes in as well.
std::vector<Id> FindMeetingNodes(const HexMesh& mesh, const MeshBlocks& blocks, const Ranks& ranks)
{
  const MeetingPlaces places = FindMeetingPlaces(blocks.Bounds, ranks);
  const std::vector<Id> nodes = FindBorderNodes(mesh, blocks, places);
  const SpaceGrid grid(places.Whole);
  constexpr int boxes = BoxesPerAxis * BoxesPerAxis * BoxesPerAxis;
  std::vector<char> mine(boxes, 0);
  std::vector<int> filled;
  for (const Id n : nodes)
  {
    const int box = grid.BoxOf(mesh.Point(n));
    if (!mine[box])
    {
      mine[box] = 1;
      filled.push_back(box);
    }
  }
  std::vector<int> ranksIn(boxes, 0);
  for (const int box : ranks.Gather(filled))
  {
    ++ranksIn[box];
  }
  std::vector<Id> meeting;
  for (const Id n : nodes)
  {
    if (ranksIn[grid.BoxOf(mesh.Point(n))] > 1)
    {
      meeting.push_back(n);
    }
  }
  return meeting;
}

/// A node as the other ranks see it.
struct SentNode
{
  Place At;
  Id GlobalId; ///< -1: told apart by its place
  Id Local;
};

struct Entry
{
  SentNode Node;
  int Rank;
};

bool SameNode(const SentNode& a, const SentNode& b)
{
  return a.GlobalId == b.GlobalId && (a.GlobalId >= 0 || a.At == b.At);
}

/// The nodes of all ranks, the same ones side by side.
std::vector<Entry> GatherSorted(const std::vector<SentNode>& mine, const Ranks& ranks)
{
  std::vector<std::size_t> ends;
  const auto all = ranks.Gather(mine, ends);
  std::vector<Entry> entries;
  entries.reserve(all.size());
  int rank = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    while (i >= ends[rank])
    {
      ++rank;
    }
    entries.push_back({ all[i], rank });
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b)
    {
      if (a.Node.GlobalId != b.Node.GlobalId)
      {
        return a.Node.GlobalId < b.Node.GlobalId;
      }
      if (a.Node.At != b.Node.At)
      {
        return a.Node.At < b.Node.At;
      }
      return a.Rank != b.Rank ? a.Rank < b.Rank : a.Node.Local < b.Node.Local;
    });
  return entries;
}

/// What is wrong with a run of entries that are one node; empty: nothing.
std::string FindDefect(const std::vector<Entry>& entries, std::size_t begin, std::size_t end)
{
  for (std::size_t i = begin + 1; i < end; ++i)
  {
    const auto& a = entries[i - 1];
    const auto& b = entries[i];
    if (a.Node.At == b.Node.At && a.Rank != b.Rank)
    {
      continue;
    }
    const std::string place = nurbs::PlaceText(ToVec3(b.Node.At));
    if (a.Node.At != b.Node.At)
    {
      return "The global point id " + std::to_string(b.Node.GlobalId) +
        " stands for two places, one of them at " + place +
        ": make the ids anew, or take them away.";
    }
    return "Several nodes of one rank's piece lie at " + place +
      ", where the piece borders on another: if every rank holds the whole grid, distribute it, "
      "e.g. with Redistribute DataSet; else give the points global ids, which tell the nodes "
      "apart, or merge them with Clean to Grid.";
  }
  return {};
}

}

Id SharedNodes::NumberOf(Id local) const
{
  const auto it = std::lower_bound(this->Local.begin(), this->Local.end(), local);
  return it != this->Local.end() && *it == local ? this->Number[it - this->Local.begin()] : -1;
}

bool FindSharedNodes(const HexMesh& mesh, const MeshBlocks& blocks, const Id* globalIds,
  const Ranks& ranks, SharedNodes& shared, std::string& error)
{
  shared = SharedNodes{};
  if (ranks.Alone())
  {
    return true;
  }
  std::vector<SentNode> mine;
  for (const Id n : FindMeetingNodes(mesh, blocks, ranks))
  {
    // Added to zero, so that there is one zero only.
    const Vec3 at = mesh.Point(n) + Vec3::Zero();
    mine.push_back({ ToPlace(at), globalIds ? globalIds[n] : Id(-1), n });
  }
  const auto entries = GatherSorted(mine, ranks);
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end)
  {
    bool several = false;
    for (end = begin; end < entries.size() && SameNode(entries[begin].Node, entries[end].Node);
         ++end)
    {
      several |= entries[end].Rank != entries[begin].Rank;
    }
    if (!several)
    {
      continue;
    }
    error = FindDefect(entries, begin, end);
    if (!error.empty())
    {
      return false;
    }
    shared.LocalByNumber.push_back(-1);
    for (std::size_t i = begin; i < end; ++i)
    {
      if (entries[i].Rank == ranks.Rank())
      {
        shared.LocalByNumber.back() = entries[i].Node.Local;
      }
    }
  }
  std::vector<std::pair<Id, Id>> own;
  for (Id number = 0; number < shared.Total(); ++number)
  {
    if (shared.LocalByNumber[number] >= 0)
    {
      own.emplace_back(shared.LocalByNumber[number], number);
    }
  }
  std::sort(own.begin(), own.end());
  for (const auto& node : own)
  {
    shared.Local.push_back(node.first);
    shared.Number.push_back(node.second);
  }
  return true;
}

}
