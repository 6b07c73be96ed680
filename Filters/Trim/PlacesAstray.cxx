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

/// @param slack how far outside of the element the place may be.
bool Holds(const TrimBand& near, int element, const Vec3& place, double slack)
{
  const FinalElement shape = FinalShape(near.Mesh, near.Trimmed, element);
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

/// An element and those that share a node with it or with one that does: nodes that go farther than
/// that leave little of their elements.
std::vector<int> TwoRings(const Band& band, int element)
{
  const std::vector<int> ring = ElementsAt(band, NodesOf(band, { element }));
  return ElementsAt(band, NodesOf(band, ring));
}

/// Whether a place near an element lies in one that is kept, as it is after the trim.
bool IsHeld(const TrimBand& near, int element, const Vec3& place, double slack)
{
  const std::vector<int> around = TwoRings(near.Mesh, element);
  return std::any_of(around.begin(), around.end(),
    [&](int e) { return near.Trimmed.Kept[e] && Holds(near, e, place, slack); });
}

}

bool IsAstray(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, int element, const Vec3& place)
{
  const bool due = surface.ClosestPoint(place).SignedDistance < 0.0;
  return due ? !IsHeld(near, element, place, Slack) : IsHeld(near, element, place, -Slack);
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
  return lost > 0 && AnyMoves(near, TwoRings(near.Mesh, element)) &&
    !IsHeld(near, element, place / lost, Slack);
}

}
