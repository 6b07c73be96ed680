#include "EliminatedFraction.h"

#include "Status.h"
#include "TetrahedronShare.h"

#include <algorithm>

namespace trim
{
namespace
{

/// The edges of one element by the places of its nodes in OrderForTetrahedra.
struct ElementEdges
{
  const std::array<int, 8>& Node;
  const std::vector<unsigned char>& Status;
  const CutEdges& Edges;

  bool IsEliminated(int i) const { return this->Status[this->Node[i]] == NodeEliminate; }
  double Beyond(int eliminated, int other) const
  {
    return this->Edges.Beyond(this->Node[eliminated], this->Node[other]);
  }
};

}

ElementPoints PointsInOrder(const Band& band, int count, const std::array<int, 8>& nodes)
{
  ElementPoints points;
  std::transform(nodes.begin(), nodes.begin() + count, points.begin(),
    [&band](int node) -> const Vec3& { return band.Point[node]; });
  return points;
}

double MeasureVolume(const Band& band, int element, const std::array<int, 8>& nodes)
{
  const int count = band.Elements[element].Count;
  double total = 0.0;
  ForTetrahedra(PointsInOrder(band, count, nodes), count,
    [&total](const Tetrahedron&, double volume) { total += volume; });
  return total;
}

double MeasureEliminated(
  const Band& band, int element, const std::array<int, 8>& nodes, const CutEdges& edges)
{
  const int count = band.Elements[element].Count;
  const ElementEdges ofElement{ nodes, band.NodeStatus, edges };
  double eliminated = 0.0;
  ForTetrahedra(PointsInOrder(band, count, nodes), count,
    [&](const Tetrahedron& tetrahedron, double volume)
    { eliminated += volume * ShareOfTetrahedron(tetrahedron, ofElement); });
  return eliminated;
}

Vec3 MeanNormal(
  const Band& band, int element, const std::array<int, 8>& nodes, const CutEdges& edges)
{
  Vec3 sum = Vec3::Zero();
  const auto& topology = TopologyOf(band.Elements[element].Count);
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    int eliminated = nodes[topology.Edges[i].First];
    int kept = nodes[topology.Edges[i].Second];
    if (band.NodeStatus[kept] == NodeEliminate)
    {
      std::swap(eliminated, kept);
    }
    if (band.NodeStatus[eliminated] == NodeEliminate && band.NodeStatus[kept] == NodeKeep)
    {
      sum += edges.Normal(eliminated, kept);
    }
  }
  return sum.normalized();
}

}
