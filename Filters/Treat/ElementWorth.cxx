#include "ElementWorth.h"

#include "ElementTopology.h"

#include <algorithm>
#include <cmath>

namespace trim
{

double ShortestEdgeShare(
  const Band& band, const std::array<int, 8>& node, const ElementPoints& points, int count)
{
  const auto& topology = TopologyOf(count);
  double share = std::numeric_limits<double>::infinity();
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const int a = topology.Edges[i].First;
    const int b = topology.Edges[i].Second;
    share = std::min(share,
      (points[a] - points[b]).squaredNorm() /
        (band.Point[node[a]] - band.Point[node[b]]).squaredNorm());
  }
  return std::sqrt(share);
}

double WorthOf(const Band& band, const std::array<int, 8>& node, const ElementPoints& points,
  int count, const std::vector<char>* fixed, double limit)
{
  double worth = ScaledJacobian(points, count, limit);
  const auto& topology = TopologyOf(count);
  for (int i = 0; worth > 0.0 && worth >= limit && i < topology.NumberOfEdges; ++i)
  {
    const int a = topology.Edges[i].First;
    const int b = topology.Edges[i].Second;
    const double length = (points[a] - points[b]).squaredNorm();
    const double before = (band.Point[node[a]] - band.Point[node[b]]).squaredNorm();
    // Hardly any edge is so short.
    if (EdgeWorth * EdgeWorth * length < worth * worth * before &&
      !(fixed && (*fixed)[node[a]] && (*fixed)[node[b]]))
    {
      worth = EdgeWorth * std::sqrt(length / before);
    }
  }
  return worth;
}

}
