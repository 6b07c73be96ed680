#include "Skin.h"

#include "ElementTopology.h"
#include "Runs.h"
#include "SortFour.h"

#include <algorithm>
#include <array>

namespace trim
{
namespace
{

constexpr int NoNode = -1;

/// A facet by its nodes in ascending order; the least one is known otherwise.
struct SortedFacet
{
  std::array<int, 3> Rest;
  int Face;
  Id Cell;
};

/// The nodes of a face in ascending order; a triangle has NoNode at the end.
std::array<int, 4> SortedNodes(const std::array<Id, 8>& cell, const FaceNodes& face)
{
  std::array<int, 4> n = {};
  for (int i = 0; i < 4; ++i)
  {
    n[i] = i < face.Count ? static_cast<int>(cell[face.Node[i]]) : VTK_INT_MAX;
  }
  SortFour(n);
  n[3] = face.Count == 4 ? n[3] : NoNode;
  return n;
}

/// Nodes of which one thread looks through the facets at a time.
struct NodeRange
{
  Id Begin, End;

  bool IsApart(const NodeRange& other) const
  {
    return this->End <= other.Begin || this->Begin >= other.End;
  }
};

/// The least range with all nodes of a cell.
NodeRange NodesOf(const std::array<Id, 8>& nodes, int count)
{
  const auto [least, largest] = std::minmax_element(nodes.begin(), nodes.begin() + count);
  return { *least, *largest + 1 };
}

/// Cells of which one look tells whether any has nodes in a range.
constexpr Id CellsInRun = 2000;

/// The least and the largest node of each run of cells, as a range.
std::vector<NodeRange> FindNodesOfRuns(const HexMesh& mesh)
{
  std::vector<NodeRange> runs(
    NumberOfRuns(mesh.NumberOfCells, CellsInRun), { mesh.NumberOfPoints, 0 });
  ForRuns(mesh.NumberOfCells, CellsInRun,
    [&](Id run, Id begin, Id end)
    {
      std::array<Id, 8> nodes = {};
      for (Id c = begin; c < end; ++c)
      {
        const int count = mesh.Cell(c, nodes);
        const NodeRange own = NodesOf(nodes, count);
        runs[run].Begin = std::min(runs[run].Begin, own.Begin);
        runs[run].End = std::max(runs[run].End, own.End);
      }
    });
  return runs;
}

/// Calls action(least node, rest, cell, face) for each facet whose least node is in the range.
/// @param runs from FindNodesOfRuns.
template <typename Action>
void ForEachFacet(const HexMesh& mesh, const std::vector<NodeRange>& runs, const NodeRange& range,
  const Action& action)
{
  const auto visit = [&](Id c)
  {
    std::array<Id, 8> nodes = {};
    const int count = mesh.Cell(c, nodes);
    if (NodesOf(nodes, count).IsApart(range))
    {
      return;
    }
    const ElementTopology& topology = TopologyOf(count);
    for (int f = 0; f < topology.NumberOfFaces; ++f)
    {
      const auto n = SortedNodes(nodes, topology.Faces[f]);
      if (n[0] >= range.Begin && n[0] < range.End)
      {
        action(n[0], std::array<int, 3>{ n[1], n[2], n[3] }, c, f);
      }
    }
  };
  for (std::size_t run = 0; run < runs.size(); ++run)
  {
    if (runs[run].IsApart(range))
    {
      continue;
    }
    const Id first = static_cast<Id>(run) * CellsInRun;
    for (Id c = first; c < std::min(mesh.NumberOfCells, first + CellsInRun); ++c)
    {
      visit(c);
    }
  }
}

/// The facets with their least node in the range that no other element has.
void FindSingles(const HexMesh& mesh, const std::vector<NodeRange>& runs, const NodeRange& range,
  std::vector<SkinFacet>& singles)
{
  std::vector<std::size_t> begin(range.End - range.Begin + 1, 0);
  ForEachFacet(mesh, runs, range,
    [&](Id least, const std::array<int, 3>&, Id, int) { ++begin[least - range.Begin + 1]; });
  for (std::size_t i = 1; i < begin.size(); ++i)
  {
    begin[i] += begin[i - 1];
  }
  std::vector<SortedFacet> facets(begin.back());
  std::vector<std::size_t> next = begin;
  ForEachFacet(mesh, runs, range,
    [&](Id least, const std::array<int, 3>& rest, Id cell, int face) {
      facets[next[least - range.Begin]++] = { rest, face, cell };
    });
  for (std::size_t i = 0; i + 1 < begin.size(); ++i)
  {
    const auto first = facets.begin() + static_cast<std::ptrdiff_t>(begin[i]);
    const auto last = facets.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
    for (auto facet = first; facet != last; ++facet)
    {
      const auto same = [&facet](const SortedFacet& other)
      { return &other != &*facet && other.Rest == facet->Rest; };
      if (std::none_of(first, last, same))
      {
        singles.push_back({ facet->Cell, facet->Face });
      }
    }
  }
}

/// Ranges of nodes with so few facets that a thread's memory holds them.
std::vector<NodeRange> DivideNodes(const HexMesh& mesh)
{
  constexpr Id CellsAtATime = 1000000;
  const Id threads = ThreadsForLoops();
  const Id count = std::max(threads, (mesh.NumberOfCells + CellsAtATime - 1) / CellsAtATime);
  std::vector<NodeRange> ranges;
  for (Id i = 0; i < count; ++i)
  {
    ranges.push_back({ mesh.NumberOfPoints * i / count, mesh.NumberOfPoints * (i + 1) / count });
  }
  return ranges;
}

}

std::vector<SkinFacet> FindSkin(const HexMesh& mesh)
{
  const std::vector<NodeRange> ranges = DivideNodes(mesh);
  const std::vector<NodeRange> runs = FindNodesOfRuns(mesh);
  std::vector<std::vector<SkinFacet>> found(ranges.size());
  ParallelFor(0, static_cast<Id>(ranges.size()), 1,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        FindSingles(mesh, runs, ranges[i], found[i]);
      }
    });

  // By element: each has a bit for each of its faces.
  std::vector<unsigned char> faces(mesh.NumberOfCells, 0);
  std::size_t count = 0;
  for (const auto& part : found)
  {
    count += part.size();
    for (const SkinFacet& facet : part)
    {
      faces[facet.Cell] |= static_cast<unsigned char>(1 << facet.Face);
    }
  }
  std::vector<SkinFacet> skin;
  skin.reserve(count);
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    for (int f = 0; faces[c] >> f; ++f)
    {
      if (faces[c] >> f & 1)
      {
        skin.push_back({ c, f });
      }
    }
  }
  return skin;
}

}
