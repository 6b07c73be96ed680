#include "PlacesAstray.h"

#include "ElementMap.h"
#include "NodesOfElements.h"
#include "Status.h"

#include <algorithm>
#include <vector>

namespace trim
{
namespace
{

/// How far from the border of an element a place has to be for it to be astray, in its parameters:
/// skins that bend have other facets after the trim.
constexpr double Slack = 0.1;
/// As far as columns carry their elements under a surface that leans, and over flat layers.
constexpr int Rings = 4;

/// @param slack how far outside of the element the place may be.
bool Holds(const TrimBand& near, int element, const Vec3& place, double slack)
{
  const FinalElement shape = FinalShape(near.Mesh, near.Trimmed, element);
  nurbs::Box3 box;
  for (int i = 0; i < shape.Count; ++i)
  {
    box.extend(shape.Points[i]);
  }
  const Vec3 margin = 2.0 * Slack * box.sizes();
  if (((place - box.min() + margin).array() < 0.0).any() ||
    ((box.max() + margin - place).array() < 0.0).any())
  {
    return false;
  }
  Vec3 parameters = Vec3::Zero();
  if (!FindParameters(shape.Points, shape.Count, place, parameters))
  {
    return false;
  }
  const auto outside = Outside(shape.Count, parameters);
  return *std::max_element(outside.begin(), outside.end()) < slack;
}

bool IsLost(const TrimBand& near, int node)
{
  const Band& band = near.Mesh;
  const auto elements = band.ElementsOfNode(node);
  return band.NodeStatus[node] == NodeKeep &&
    std::none_of(
      elements.begin(), elements.end(), [&near](int e) { return near.Trimmed.Kept[e] != 0; }) &&
    !near.Structure.IsOnBorder(band, node);
}

bool AnyMoves(const TrimBand& near, const std::vector<int>& elements)
{
  const std::vector<int> nodes = NodesOf(near.Mesh, elements);
  return std::any_of(
    nodes.begin(), nodes.end(), [&near](int n) { return near.Trimmed.Moving[n] != 0; });
}

/// Whether a place lies in one of the elements that is kept, as it is after the trim.
bool IsHeld(const TrimBand& near, const std::vector<int>& around, const Vec3& place, double slack)
{
  return std::any_of(around.begin(), around.end(),
    [&](int e) { return near.Trimmed.Kept[e] && Holds(near, e, place, slack); });
}

}

bool IsAstray(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, int element, const Vec3& place)
{
  const bool due = surface.ClosestPoint(place).SignedDistance < 0.0;
  const std::vector<int> around = RingsRound(near.Mesh, { element }, Rings);
  return due ? !IsHeld(near, around, place, Slack) : IsHeld(near, around, place, -Slack);
}

bool IsLostTip(const TrimBand& near, int element)
{
  if (near.Trimmed.Kept[element])
  {
    return false;
  }
  Vec3 place = Vec3::Zero();
  int lost = 0;
  for (const int node : near.Mesh.Elements[element])
  {
    if (IsLost(near, node))
    {
      place += near.Mesh.Point[node];
      ++lost;
    }
  }
  if (lost == 0)
  {
    return false;
  }
  const std::vector<int> around = RingsRound(near.Mesh, { element }, Rings);
  return AnyMoves(near, around) && !IsHeld(near, around, place / lost, Slack);
}

}
