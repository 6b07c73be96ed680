#include "Shortfalls.h"

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// Distance up to which a node lies on the surface as exactly as the mesh can store it.
double StoredPrecision(const Band& band, int node, double precision)
{
  const double spacing = band.Point[node].cwiseAbs().maxCoeff() *
    (band.SinglePrecision ? std::numeric_limits<float>::epsilon()
                          : std::numeric_limits<double>::epsilon());
  return std::max(precision, 2.0 * spacing);
}

}

std::vector<std::pair<int, float>> FindNodesLeft(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision)
{
  std::vector<std::pair<int, float>> left;
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  const auto& moves = near.Trimmed.NodeMoves;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (users[n] == 0 || !near.Trimmed.Moving[n] || moves.Applied[n] != Correction::None)
    {
      continue;
    }
    const double distance = surface.ClosestPoint(moves.Position[n]).Distance;
    if (distance > StoredPrecision(near.Mesh, n, precision))
    {
      left.emplace_back(n, static_cast<float>(distance));
    }
  }
  return left;
}

std::vector<std::pair<int, Shortfall>> FindShortfalls(
  const TrimBand& near, const std::vector<std::pair<int, float>>& left)
{
  std::vector<Shortfall> values(near.Mesh.NumberOfElements(), Shortfall::None);
  for (const int e : near.Trimmed.BelowFloor)
  {
    values[e] = Shortfall::BelowFloor;
  }
  for (const auto& node : left)
  {
    for (const int e : near.Mesh.ElementsOfNode(node.first))
    {
      values[e] = near.Trimmed.Kept[e] ? Shortfall::LeftOff : values[e];
    }
  }
  for (const int e : near.Trimmed.Invalid)
  {
    values[e] = Shortfall::Invalid;
  }
  std::vector<std::pair<int, Shortfall>> found;
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (values[e] != Shortfall::None)
    {
      found.emplace_back(e, values[e]);
    }
  }
  return found;
}

}
