#include "Pillars.h"

#include "DisjointSets.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace trim
{
namespace
{

/// More nodes than this through the thickness are no sheet.
constexpr int MostLayers = 24;
/// Fewer nodes in a pillar, on average, are not worth it.
constexpr double LeastMean = 1.8;

/// The parallel edges of each direction of a hexahedron, and of the one of a wedge.
using Edges = std::array<std::array<int, 2>, 4>;
constexpr std::array<Edges, 3> HexahedronEdges = { { { { { 0, 1 }, { 3, 2 }, { 4, 5 }, { 7, 6 } } },
  { { { 0, 3 }, { 1, 2 }, { 4, 7 }, { 5, 6 } } },
  { { { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } } } } };
constexpr Edges WedgeEdges = { { { 0, 3 }, { 1, 4 }, { 2, 5 }, { 2, 5 } } };

/// The edges of the direction whose edge at the first node is the shortest.
const Edges& ShortestEdges(const int* nodes, int count, const NodePlaces& position, Vec3& direction)
{
  const Vec3 first = position(nodes[0]);
  if (count == 6)
  {
    direction = position(nodes[3]) - first;
    return WedgeEdges;
  }
  const Vec3 edge[3] = { position(nodes[1]) - first, position(nodes[3]) - first,
    position(nodes[4]) - first };
  int shortest = 2;
  for (const int axis : { 1, 0 })
  {
    // Among equals the third direction, the one that meshers extrude along.
    if (edge[axis].squaredNorm() < (1 - 1e-6) * edge[shortest].squaredNorm())
    {
      shortest = axis;
    }
  }
  direction = edge[shortest];
  return HexahedronEdges[shortest];
}

/// Nodes by pillar, and in each by their height along `up`.
void Arrange(const NodePlaces& position, const Vec3& up, Pillars& pillars)
{
  pillars.Start.assign(pillars.Count + 1, 0);
  for (const int pillar : pillars.Pillar)
  {
    ++pillars.Start[pillar + 1];
  }
  std::partial_sum(pillars.Start.begin(), pillars.Start.end(), pillars.Start.begin());
  pillars.Node.resize(pillars.Pillar.size());
  PageVector<int> next(pillars.Start.begin(), pillars.Start.end() - 1);
  for (std::size_t n = 0; n < pillars.Pillar.size(); ++n)
  {
    pillars.Node[next[pillars.Pillar[n]]++] = static_cast<int>(n);
  }
  vtkSMPTools::For(0, pillars.Count, 10000,
    [&](Id begin, Id end)
    {
      std::array<std::pair<double, int>, MostLayers> heights;
      for (Id p = begin; p < end; ++p)
      {
        const int first = pillars.Start[p];
        const int size = pillars.Start[p + 1] - first;
        for (int i = 0; i < size; ++i)
        {
          const int node = pillars.Node[first + i];
          heights[i] = { position(node).dot(up), node };
        }
        std::sort(heights.begin(), heights.begin() + size);
        for (int i = 0; i < size; ++i)
        {
          pillars.Node[first + i] = heights[i].second;
        }
      }
    });
}

}

Pillars SingleNodes(int numberOfNodes)
{
  Pillars pillars;
  pillars.Count = numberOfNodes;
  pillars.Pillar.resize(numberOfNodes);
  std::iota(pillars.Pillar.begin(), pillars.Pillar.end(), 0);
  pillars.Node = pillars.Pillar;
  pillars.Start.resize(numberOfNodes + 1);
  std::iota(pillars.Start.begin(), pillars.Start.end(), 0);
  return pillars;
}

Pillars FindPillars(const NodeGraph& graph, const NodePlaces& position)
{
  DisjointSets<int> sets(graph.NumberOfNodes);
  Vec3 up = Vec3::Zero();
  for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
  {
    const int* nodes = graph.Connectivity.data() + graph.Offset[e];
    Vec3 direction;
    for (const auto& edge :
      ShortestEdges(nodes, graph.Offset[e + 1] - graph.Offset[e], position, direction))
    {
      sets.Unite(nodes[edge[0]], nodes[edge[1]]);
    }
    up += direction.dot(up) < 0.0 ? Vec3(-direction) : direction;
  }
  Pillars pillars;
  pillars.Pillar.resize(graph.NumberOfNodes);
  PageVector<int> size;
  for (int n = 0; n < graph.NumberOfNodes; ++n)
  {
    // The root is the smallest member, so it comes first and has its number already.
    const int root = sets.Find(n);
    if (root == n)
    {
      size.push_back(0);
    }
    pillars.Pillar[n] = root == n ? static_cast<int>(size.size()) - 1 : pillars.Pillar[root];
    if (++size[pillars.Pillar[n]] > MostLayers)
    {
      return SingleNodes(graph.NumberOfNodes);
    }
  }
  pillars.Count = static_cast<int>(size.size());
  if (graph.NumberOfNodes < LeastMean * pillars.Count)
  {
    return SingleNodes(graph.NumberOfNodes);
  }
  Arrange(position, up, pillars);
  return pillars;
}

}
