#include "Pillars.h"

#include "ConcurrentSets.h"
#include "ElementTopology.h"
#include "Runs.h"
#include "Team.h"

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

using Edges = std::array<std::array<int, 2>, 4>;

/// The parallel edges of one direction of an element; of a wedge, which has three, the last twice.
constexpr Edges EdgesAlong(const ElementTopology& topology, int axis)
{
  Edges edges{};
  std::size_t count = 0;
  for (const EdgeNodes& edge : topology.Edges)
  {
    if (edge.Axis == axis)
    {
      edges[count++] = { edge.First, edge.Second };
    }
  }
  for (; count < edges.size(); ++count)
  {
    edges[count] = edges[count - 1];
  }
  return edges;
}

constexpr std::array<Edges, 3> HexahedronEdges = { EdgesAlong(HexahedronTopology, 0),
  EdgesAlong(HexahedronTopology, 1), EdgesAlong(HexahedronTopology, 2) };
constexpr Edges WedgeEdges = EdgesAlong(WedgeTopology, 0);

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

/// Sorts the nodes of each pillar by their height along `up`, those at one height as they came;
/// fills in the centres.
void Arrange(const NodePlaces& position, const Vec3& up, Pillars& pillars)
{
  pillars.Centre.resize(pillars.Count);
  ParallelFor(0, pillars.Count, 10000,
    [&](Id begin, Id end)
    {
      struct Layer
      {
        double Height;
        int Node;
        Vec3 Place;
      };
      std::array<Layer, MostLayers> layers;
      for (Id p = begin; p < end; ++p)
      {
        const int first = pillars.Start[p];
        const int size = pillars.Size(p);
        for (int i = 0; i < size; ++i)
        {
          const int node = pillars.Node[first + i];
          const Vec3 place = position(node);
          const double height = place.dot(up);
          int at = i;
          for (; at > 0 && height < layers[at - 1].Height; --at) // mostly they come in order
          {
            layers[at] = layers[at - 1];
          }
          layers[at] = { height, node, place };
        }
        Vec3 sum = Vec3::Zero();
        for (int i = 0; i < size; ++i)
        {
          pillars.Node[first + i] = layers[i].Node;
          sum += layers[i].Place;
        }
        pillars.Centre[p] = sum / size;
      }
    });
}

}

Pillars SingleNodes(const NodePlaces& position, int numberOfNodes)
{
  Pillars pillars;
  pillars.Count = numberOfNodes;
  pillars.Pillar.resize(numberOfNodes);
  std::iota(pillars.Pillar.begin(), pillars.Pillar.end(), 0);
  pillars.Node = pillars.Pillar;
  pillars.Start.resize(numberOfNodes + 1);
  std::iota(pillars.Start.begin(), pillars.Start.end(), 0);
  pillars.Centre.resize(numberOfNodes);
  ForAll(
    numberOfNodes, [&](int n) { pillars.Centre[n] = position(n); }, LightGrain);
  return pillars;
}

namespace
{

/// Elements or nodes for a thread at a time; the same whatever threads there are.
constexpr Id Grain = 30000;

/// To a sum of directions, whichever way it points.
void AddAlong(const Vec3& direction, Vec3& sum)
{
  sum += direction.dot(sum) < 0.0 ? Vec3(-direction) : direction;
}

/// Unites the nodes above one another; returns the mean direction from one to the next.
Vec3 UniteShortEdges(const NodeGraph& graph, const NodePlaces& position, ConcurrentSets<int>& sets)
{
  const auto count = static_cast<Id>(graph.Offset.size()) - 1;
  std::vector<Vec3> up(NumberOfRuns(count, Grain), Vec3::Zero());
  ForRuns(count, Grain,
    [&](Id grain, Id begin, Id end)
    {
      Vec3 direction, sum = Vec3::Zero();
      for (Id e = begin; e < end; ++e)
      {
        const int* nodes = graph.Connectivity.data() + graph.Offset[e];
        for (const auto& edge :
          ShortestEdges(nodes, graph.Offset[e + 1] - graph.Offset[e], position, direction))
        {
          sets.Unite(nodes[edge[0]], nodes[edge[1]]);
        }
        AddAlong(direction, sum);
      }
      up[grain] = sum;
    });
  Vec3 sum = Vec3::Zero();
  for (const Vec3& part : up)
  {
    AddAlong(part, sum);
  }
  return sum;
}

/// Numbers the sets in the order of their roots: sets Count, Pillar, and in Start the sizes.
void NumberSets(const ConcurrentSets<int>& sets, Pillars& pillars)
{
  // In ascending order, so that the parent of a node has its number already.
  for (std::size_t n = 0; n < pillars.Pillar.size(); ++n)
  {
    const int parent = sets.Parent(static_cast<int>(n));
    const bool isRoot = parent == static_cast<int>(n);
    const int own = isRoot ? pillars.Count++ : pillars.Pillar[parent];
    pillars.Pillar[n] = own;
    ++pillars.Start[own];
  }
  pillars.Start.resize(pillars.Count + 1);
}

/// Fills in the nodes by pillar, ascending, and turns sizes into Start.
void ListNodes(Pillars& pillars)
{
  std::partial_sum(pillars.Start.begin(), pillars.Start.end(), pillars.Start.begin());
  pillars.Node.resize(pillars.Pillar.size());
  for (int n = static_cast<int>(pillars.Pillar.size()) - 1; n >= 0; --n) // from the ends
  {
    pillars.Node[--pillars.Start[pillars.Pillar[n]]] = n;
  }
}

}

Pillars FindPillars(const NodeGraph& graph, const NodePlaces& position)
{
  ConcurrentSets<int> sets(graph.NumberOfNodes);
  const Vec3 up = UniteShortEdges(graph, position, sets);
  Pillars pillars;
  pillars.Pillar.resize(graph.NumberOfNodes);
  pillars.Start.resize(graph.NumberOfNodes + 1); // at most; what is not written to takes no memory
  NumberSets(sets, pillars);
  if (graph.NumberOfNodes < LeastMean * pillars.Count ||
    *std::max_element(pillars.Start.begin(), pillars.Start.end()) > MostLayers)
  {
    return SingleNodes(position, graph.NumberOfNodes);
  }
  ListNodes(pillars);
  Arrange(position, up, pillars);
  return pillars;
}

PageVector<int> FirstNumbers(const Pillars& pillars, const PageVector<int>& order)
{
  PageVector<int> first(pillars.Count);
  int next = 0;
  for (const int p : order)
  {
    first[p] = next;
    next += pillars.Size(p);
  }
  return first;
}

}
