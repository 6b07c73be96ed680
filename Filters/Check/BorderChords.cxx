#include "BorderChords.h"

#include "MovingNodes.h"
#include "NodeMover.h"
#include "Place.h"
#include "Status.h"

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// An edge is looked at where it is so many times as long as the longest one that its element came
/// with, of those within a layer in a sheet: others are as long as a border of the mesh has them.
/// Where layers are higher than that, all edges through them are.
constexpr double Stretched = 1.5;
/// How far the surface may be from the middle of such an edge, in the longest edge before.
constexpr double LargestSag = 0.2;
/// Of other edges, where the surface turns by more than 60 degrees between their ends: one that
/// goes from wall to wall of it, or cuts off a corner that no node went to. Where nothing is wrong
/// they are half as far off.
constexpr double LargestShortSag = 0.25;
constexpr double ShortTurnCosine = 0.5;
/// From layer to layer of a sheet, where no node can go in between: an edge of the surface along
/// the skin, or a bend, by which it turns by more than at a sharp edge. In the longest edge, be it
/// the height of the layer.
constexpr double LargestSagThrough = 0.1;

/// Of the surface at the foot of a node of the band.
struct FootNormal
{
  int Node;
  Place Normal;
};

/// The longest edges that an element came with.
struct Size
{
  double Longest;
  double WithinLayer; ///< of those that do not go through a layer of a sheet
};

class ChordSearch
{
public:
  /// Collective.
  ChordSearch(const TrimBand& near, const NodeFeet& feet, const nurbs::TrimmingSurface& surface,
    const Ranks& ranks)
    : Mesh(near.Mesh)
    , Structure(near.Structure)
    , Trimmed(near.Trimmed)
    , Surface(surface)
    , Normals(near.Mesh.NumberOfNodes(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()))
  {
    this->ShareNormals(feet, ranks);
  }

  bool HasLongChord(int e) const
  {
    const ReplacedElement* const wedge = FindWedge(this->Trimmed.Treated, e);
    if (wedge && this->IsLongChord(e, OpenedFacet(*wedge)))
    {
      return true;
    }
    const BandElement& element = this->Mesh.Elements[e];
    for (int slot = 0; slot < TopologyOf(element.Count).NumberOfFaces; ++slot)
    {
      const BandFace& face = this->Mesh.Faces[element.Face[slot]];
      const bool whole = !wedge ||
        std::none_of(wedge->Dropped.begin(), wedge->Dropped.end(),
          [&face](int n) { return CornerOf(face, n) < face.Count; });
      // Of the model's border what lay beyond the surface. The skin of a sheet is none: the mouth
      // of a tab that is one element wide has all its nodes on the surface, too.
      const bool isSkin = this->Structure.IsLayerFace(this->Mesh, element.Face[slot]);
      const bool ofBorder = (face.Exterior && !isSkin) || IsCutFace(face, this->Trimmed.Kept);
      if (whole && ofBorder && this->IsLongChord(e, face))
      {
        return true;
      }
    }
    return false;
  }

private:
  template <typename Facet>
  bool IsLongChord(int e, const Facet& facet) const
  {
    const Moves& moves = this->Trimmed.NodeMoves;
    if (!std::all_of(facet.begin(), facet.end(), [this](int n) { return this->IsOnSurface(n); }))
    {
      return false; // a node that was left is told of as such
    }
    const Size before = this->SizeBefore(e);
    int last = *(facet.end() - 1);
    for (const int node : facet)
    {
      const Vec3 &a = moves.Position[last], &b = moves.Position[node];
      const double length = (b - a).norm();
      const double sag = this->SagAllowed(last, node, length, before);
      // No edge is farther off the surface than half its length.
      const bool mayBe = length > 2.0 * sag;
      last = node;
      if (mayBe && this->Surface.ClosestPoint(0.5 * (a + b)).Distance > sag)
      {
        return true;
      }
    }
    return false;
  }

  /// The surface goes through the layers of a sheet, and is off a facet along them: their height is
  /// no measure of that.
  Size SizeBefore(int e) const
  {
    const double longest = LongestEdgeOf(this->Mesh, e);
    return { longest,
      this->Structure.HasThickness(e)
        ? LongestEdgeOf(this->Mesh, e, [this](int a, int b) { return !this->IsThrough(a, b); })
        : longest };
  }

  double SagAllowed(int a, int b, double length, const Size& before) const
  {
    const bool stretched = length > Stretched * before.WithinLayer;
    if (this->IsThrough(a, b) && this->TurnsBetween(a, b, CreaseCosine))
    {
      const double sag = LargestSagThrough * before.Longest;
      return stretched ? std::min(sag, LargestSag * before.WithinLayer) : sag;
    }
    if (stretched)
    {
      return LargestSag * before.WithinLayer;
    }
    return this->TurnsBetween(a, b, ShortTurnCosine) ? LargestShortSag * before.WithinLayer
                                                     : std::numeric_limits<double>::infinity();
  }

  bool IsThrough(int a, int b) const
  {
    return this->Structure.Pillar[a] == this->Structure.Pillar[b];
  }

  /// The feet of an element's nodes may be known to another rank alone: that of the elements which
  /// the surface meets there.
  void ShareNormals(const NodeFeet& feet, const Ranks& ranks)
  {
    std::vector<FootNormal> own;
    for (int n = 0; n < this->Mesh.NumberOfNodes(); ++n)
    {
      const nurbs::Foot* const foot =
        this->IsOnSurface(n) ? feet.FootOf(this->Mesh.GlobalNode[n]) : nullptr;
      if (foot)
      {
        own.push_back({ n, ToPlace(foot->Normal) });
      }
    }
    for (const auto& [node, normal] : ranks.Gather(own))
    {
      this->Normals[node] = ToVec3(normal);
    }
  }

  /// Whether the normals at the places of the surface nearest to where the nodes came from differ.
  bool TurnsBetween(int a, int b, double cosine) const
  {
    return this->Normals[a].dot(this->Normals[b]) < cosine; // false if one is unknown
  }

  bool IsOnSurface(int node) const
  {
    return this->Mesh.NodeStatus[node] == NodeOnSurface ||
      (this->Trimmed.Moving[node] && !this->Trimmed.NodeMoves.Left[node]);
  }

  const Band& Mesh;
  const Columns& Structure;
  const TrimmedBand& Trimmed;
  const nurbs::TrimmingSurface& Surface;
  std::vector<Vec3> Normals; ///< at the feet of nodes on the surface; NaN: no rank has one
};

}

std::vector<int> FindLongChords(const TrimBand& near, const NodeFeet& feet,
  const nurbs::TrimmingSurface& surface, const Ranks& ranks)
{
  const ChordSearch search(near, feet, surface, ranks);
  std::vector<int> found = FindTouchedElements(near.Mesh, near.Trimmed);
  found.erase(std::remove_if(
                found.begin(), found.end(), [&search](int e) { return !search.HasLongChord(e); }),
    found.end());
  return found;
}

}
