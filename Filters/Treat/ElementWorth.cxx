#include "ElementWorth.h"

#include "ElementTopology.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// More than sums of squares differ by the order of their terms.
constexpr double Rounding = 1e-9;

/// False if all edges of a hexahedron are so long that it is worth what its corners are.
bool MayVanish(const EdgeSquares& now, const EdgeSquares& before, double worth)
{
  const double least = (1.0 + Rounding) * worth * worth / (EdgeWorth * EdgeWorth);
  bool may = false;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    may |= !(now[i] >= least * before[i]).all();
  }
  return may;
}

}

double ShortestEdgeShare(
  const Band& band, const std::array<int, 8>& node, const ElementPoints& points, int count)
{
  const auto& topology = TopologyOf(count);
  double share = std::numeric_limits<double>::infinity();
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const int a = topology.Edges[i].First;
    const int b = topology.Edges[i].Second;
    share = std::min(
      share, (points[a] - points[b]).squaredNorm() / SquaredLengthBefore(band, node[a], node[b]));
  }
  return std::sqrt(share);
}

double WorthOf(const Band& band, const std::array<int, 8>& node, const ElementPoints& points,
  int count, const std::vector<char>* fixed, double limit, const EdgeSquares* before)
{
  EdgeSquares squares;
  double worth = ScaledJacobian(points, count, limit, before ? &squares : nullptr);
  if (before && count == 8 && worth > 0.0 && worth >= limit && !MayVanish(squares, *before, worth))
  {
    return worth;
  }
  const auto& topology = TopologyOf(count);
  for (int i = 0; worth > 0.0 && worth >= limit && i < topology.NumberOfEdges; ++i)
  {
    const int a = topology.Edges[i].First;
    const int b = topology.Edges[i].Second;
    const double length = (points[a] - points[b]).squaredNorm();
    const double before = SquaredLengthBefore(band, node[a], node[b]);
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
