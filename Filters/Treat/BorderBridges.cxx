#include "BorderBridges.h"

#include "BorderSearch.h"

#include <algorithm>

namespace trim
{
namespace
{

/// A facet is looked at where it has an edge so many times as long as the longest one that its
/// element came with: others do not reach across more than one bend.
constexpr double Stretched = 1.3;
/// How far the border may be from the facet, in that edge.
constexpr double LargestGap = 0.2;
/// The same for a node that is on it.
constexpr double NoGap = 1e-3;
/// How many facets along the border a node goes at most.
constexpr int LongestSlide = 5;

/// What an element has of a face: as a wedge it may do without some of its nodes.
struct Polygon
{
  std::array<Vec3, 4> Corner;
  int Count = 0;

  Vec3 MiddleOfEdge(int i) const
  {
    return 0.5 * (this->Corner[i] + this->Corner[(i + 1) % this->Count]);
  }

  double LongestEdge() const
  {
    double longest = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      longest = std::max(longest, (this->Corner[(i + 1) % this->Count] - this->Corner[i]).norm());
    }
    return longest;
  }

  Vec3 Middle() const
  {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < this->Count; ++i)
    {
      sum += this->Corner[i];
    }
    return sum / this->Count;
  }

  /// Whether the middle of it, or of an edge, passes a test.
  template <typename Test>
  bool AnyMiddle(const Test& test) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      if (test(this->MiddleOfEdge(i)))
      {
        return true;
      }
    }
    return test(this->Middle());
  }
};

Polygon PolygonOf(
  const BandFace& face, const std::array<int, 8>& node, const ElementPoints& points, int count)
{
  Polygon polygon;
  for (const int n : face)
  {
    const auto* const end = node.data() + count;
    const auto* const at = std::find(node.data(), end, n);
    if (at != end)
    {
      polygon.Corner[polygon.Count++] = points[at - node.data()];
    }
  }
  return polygon;
}

}

bool HasBridge(const Band& band, const nurbs::TrimmingSurface& surface, int e, double longest,
  const std::array<int, 8>& node, const ElementPoints& points, int count)
{
  const BandElement& element = band.Elements[e];
  for (int slot = 0; slot < TopologyOf(element.Count).NumberOfFaces; ++slot)
  {
    const int face = element.Face[slot];
    if (!band.Faces[face].Exterior)
    {
      continue;
    }
    const Polygon polygon = PolygonOf(band.Faces[face], node, points, count);
    if (polygon.Count < 3 || !(polygon.LongestEdge() > Stretched * longest))
    {
      continue;
    }
    BorderSearch border(band, face, LongestSlide);
    const double gap = LargestGap * longest;
    const auto isAstray = [&](const Vec3& place)
    { return !border.Has(place, gap) && surface.ClosestPoint(place).Distance > gap; };
    // Middles first, as most are on the face itself. Nodes that left the border for the surface
    // have their own reasons.
    if (polygon.AnyMiddle(isAstray) &&
      std::all_of(polygon.Corner.begin(), polygon.Corner.begin() + polygon.Count,
        [&](const Vec3& corner) { return border.Has(corner, NoGap * longest); }))
    {
      return true;
    }
  }
  return false;
}

std::vector<int> FindBridges(
  const Band& band, const nurbs::TrimmingSurface& surface, const TrimmedBand& trimmed)
{
  return FindElements(band, trimmed,
    [&](int e, const FinalElement& final)
    {
      return !band.IsInserted(e) &&
        HasBridge(band, surface, e, LongestEdgeOf(band, e), final.Node, final.Points, final.Count);
    });
}

}
