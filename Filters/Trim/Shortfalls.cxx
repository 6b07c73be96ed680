#include "Shortfalls.h"

#include "NodeConstraint.h"
#include "Status.h"

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

/// @param isIn whether an element of the band belongs to the part.
template <typename IsIn>
std::vector<std::pair<int, Shortfall>> Gather(const TrimBand& near,
  const std::vector<int>& belowFloor, const std::vector<std::pair<int, float>>& left,
  const std::vector<int>& invalid, const IsIn& isIn)
{
  std::vector<Shortfall> values(near.Mesh.NumberOfElements(), Shortfall::None);
  for (const int e : belowFloor)
  {
    values[e] = Shortfall::BelowFloor;
  }
  for (const auto& node : left)
  {
    for (const int e : near.Mesh.ElementsOfNode(node.first))
    {
      values[e] = isIn(e) ? Shortfall::LeftOff : values[e];
    }
  }
  for (const int e : invalid)
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

std::vector<std::pair<int, float>> FindNodesLeft(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision)
{
  std::vector<std::pair<int, float>> left;
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  const std::vector<char> atCut = FindBoundaryNodes(near.Mesh, near.Trimmed);
  const auto& moves = near.Trimmed.NodeMoves;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (users[n] == 0 || !moves.Left[n])
    {
      continue;
    }
    const auto foot = surface.ClosestPoint(moves.Position[n]);
    const bool inside = !atCut[n] && foot.SignedDistance < 0.0;
    if (!inside && foot.Distance > StoredPrecision(near.Mesh, n, precision))
    {
      left.emplace_back(n, static_cast<float>(foot.Distance));
    }
  }
  return left;
}

std::vector<std::pair<int, Shortfall>> FindShortfalls(
  const TrimBand& near, const std::vector<std::pair<int, float>>& left)
{
  return Gather(near, near.Trimmed.BelowFloor, left, near.Trimmed.Invalid,
    [&near](int e) { return near.Trimmed.Kept[e] != 0; });
}

std::vector<std::pair<int, Shortfall>> FindShortfallsOfOffcut(
  const TrimBand& near, const std::vector<std::pair<int, float>>& left)
{
  std::vector<char> inOffcut(near.Mesh.NumberOfElements(), 0);
  for (const auto& element : near.Rest.Elements)
  {
    inOffcut[element.Element] = 1;
  }
  return Gather(near, near.Rest.BelowFloor, left, near.Rest.Invalid,
    [&inOffcut](int e) { return inOffcut[e] != 0; });
}

std::vector<std::pair<int, bool>> FindCornersLost(const TrimBand& near)
{
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  const std::vector<char> inOffcut = FindUsed(near.Mesh, near.Rest);
  // Else the constraint of a node forgets the sides that go whole with what is cut off.
  const std::vector<unsigned char> allKept(near.Mesh.NumberOfNodes(), NodeKeep);
  std::vector<std::pair<int, bool>> lost;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (!near.Structure.IsOnBorder(near.Mesh, n) || users[n] == 0 ||
      near.Trimmed.NodeMoves.Applied[n] == Correction::None)
    {
      continue;
    }
    const auto constraint = ConstrainNode(near.Mesh, near.Structure, allKept, n);
    if (!inOffcut[n] || constraint.SharpCorner || constraint.Kind == ConstraintKind::Fixed)
    {
      lost.emplace_back(n, true);
    }
  }
  return lost;
}

}
