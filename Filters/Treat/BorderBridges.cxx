#include "BorderBridges.h"

#include "Facet.h"
#include "NodeConstraint.h"

#include <algorithm>
#include <cstddef>

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
/// Parameters by which a place may lie beyond the edges of a facet of the border.
constexpr double BorderSlack = 1e-4;
/// How many facets along the border a node goes at most.
constexpr int LongestSlide = 5;

/// The border of the model, and the surface, near one of its faces.
class BorderSearch
{
public:
  BorderSearch(const Band& band, const nurbs::TrimmingSurface& surface, int face)
    : TheBand(band)
    , Surface(surface)
    , Around{ face }
  {
  }

  bool IsAstray(const Vec3& place, double gap)
  {
    return !this->IsOnBorder(place, gap) && this->Surface.ClosestPoint(place).Distance > gap;
  }

  bool IsOnBorder(const Vec3& place, double gap)
  {
    for (std::size_t i = 0; i < this->Around.size() || this->Widen(); ++i)
    {
      if (i == this->Facets.size())
      {
        this->Facets.emplace_back(Facet(this->TheBand, this->TheBand.Faces[this->Around[i]]));
      }
      const FacetSearch& facet = this->Facets[i];
      Vec3 on;
      if (!facet.IsFarther(place, gap) && facet.FindInside(place, BorderSlack, on) &&
        (on - place).norm() <= gap)
      {
        return true;
      }
    }
    return false;
  }

private:
  /// Takes the faces round those known so far; false if there are none, or it is too far.
  bool Widen()
  {
    if (this->Rings == LongestSlide)
    {
      return false;
    }
    const std::size_t before = this->Around.size();
    this->Around = SideAround(this->TheBand, this->Around,
      [this](int, int other) { return this->TheBand.Faces[other].Exterior; });
    ++this->Rings;
    return this->Around.size() > before;
  }

  const Band& TheBand;
  const nurbs::TrimmingSurface& Surface;
  std::vector<int> Around;         ///< faces
  std::vector<FacetSearch> Facets; ///< of the first of them
  int Rings = 0;
};

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
    // Middles first, as most are on the face itself. Nodes that left the border for the surface have
    // their own reasons.
    BorderSearch search(band, surface, face);
    if (polygon.AnyMiddle(
          [&](const Vec3& middle) { return search.IsAstray(middle, LargestGap * longest); }) &&
      std::all_of(polygon.Corner.begin(), polygon.Corner.begin() + polygon.Count,
        [&](const Vec3& corner) { return search.IsOnBorder(corner, NoGap * longest); }))
    {
      return true;
    }
  }
  return false;
}

std::vector<int> FindBridges(
  const Band& band, const nurbs::TrimmingSurface& surface, const TrimmedBand& trimmed)
{
  std::vector<int> found;
  for (const int e : FindTouchedElements(band, trimmed))
  {
    const FinalElement final = FinalShape(band, trimmed, e);
    if (!band.IsInserted(e) &&
      HasBridge(band, surface, e, LongestEdgeOf(band, e), final.Node, final.Points, final.Count))
    {
      found.push_back(e);
    }
  }
  return found;
}

}
