#include "Shortcomings.h"

#include "BandQuality.h"

#include <algorithm>

namespace trim
{
Shortcomings MeasureLeft(const TrimBand& near)
{
  const Band& band = WithoutLayer(near.Mesh);
  Shortcomings sum;
  sum.Elements =
    near.Trimmed.Invalid.size() + near.Trimmed.BelowFloor.size() + near.Rest.Invalid.size();
  sum.Squares = SquaresOfElement * static_cast<double>(near.Rest.BelowFloor.size());
  const std::vector<char> atCut =
    near.Mesh.BeforeLayer ? FindBoundaryNodes(near.Mesh, near.Trimmed) : std::vector<char>();
  for (const auto& [left, distance] : near.NodesLeft)
  {
    if (near.Mesh.IsInsertedNode(left) && !atCut[left])
    {
      continue; // it sticks out under one of the new boundary
    }
    const int node = NodeWithoutLayer(near.Mesh, left);
    double length = 0.0;
    const auto edges = band.EdgesOfNode(node);
    for (const int edge : edges)
    {
      length += (band.Point[band.OtherEnd(edge, node)] - band.Point[node]).norm() / edges.size();
    }
    sum.Squares += distance * distance / (length * length);
    sum.Farthest = std::max(sum.Farthest, distance / length);
  }
  return sum;
}

Shortcomings MeasureShortcomings(const TrimBand& near, const LadderOptions& options)
{
  const BandQuality aimed(near.Mesh, options.Treatment, options.AimedQuality(), Measure::Worth);
  Shortcomings sum = MeasureLeft(near);
  sum.Squares += SquaresOfElement * static_cast<double>(aimed.FindBelowFloor(near.Trimmed).size());
  return sum;
}

}
