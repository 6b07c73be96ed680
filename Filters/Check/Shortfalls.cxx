#include "Shortfalls.h"

#include "BandQuality.h"
#include "BorderCorners.h"
#include "BorderSearch.h"
#include "ElementsAstray.h"
#include "Jacobian.h"
#include "NodeConstraint.h"
#include "NodeMover.h"
#include "OffcutHinges.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace trim
{
namespace
{

/// A node farther off than this share of its longest edge makes a step in the new boundary.
constexpr double BesideShare = 0.05;

/// Share of an edge by which a node on the border may be beside it.
constexpr double BorderTolerance = 1e-5;
/// Share of its longest edge by which the border may pass a node's place by.
constexpr double PassedShare = 0.05;
/// The least that is asked for where much is missing in all and no node tells of it: many small
/// bends add up.
constexpr double LeastPassedShare = PassedShare / 64.0;
/// Of the volume of an element: what both parts may miss, or have too much, in all.
constexpr double LargestMissing = 0.5;

/// Distance up to which a node lies on the surface as exactly as the mesh can store it.
double StoredPrecision(const Band& band, int node, double precision)
{
  return std::max(precision, 2.0 * SpacingAt(band, node));
}

/// Elements of one part of the mesh that are not as asked.
struct FaultyElements
{
  const std::vector<int>& BelowFloor;
  const std::vector<int>& Invalid;
  std::vector<int> CameInvalid;
  std::vector<int> ShortEdged;
  std::vector<int> Loose;
};

/// Whether a shortfall is told of though its element has a graver one: that of an invalid element
/// says that it is below the floor, too, and DistanceLeft tells of nodes left.
bool IsToldBesideGraver(Shortfall value)
{
  return value == Shortfall::LoosePart || value == Shortfall::ShortEdge;
}

/// @param isIn whether an element of the band belongs to the part.
template <typename IsIn>
std::vector<std::pair<int, Shortfall>> ListShortfalls(const TrimBand& near,
  const FaultyElements& faulty, const std::vector<std::pair<int, float>>& left, const IsIn& isIn)
{
  std::vector<std::pair<int, Shortfall>> all;
  const auto add = [&all](const std::vector<int>& elements, Shortfall value)
  {
    std::transform(elements.begin(), elements.end(), std::back_inserter(all),
      [value](int e) { return std::make_pair(e, value); });
  };
  add(faulty.BelowFloor, Shortfall::BelowFloor);
  add(faulty.Invalid, Shortfall::Invalid);
  add(faulty.CameInvalid, Shortfall::CameInvalid);
  add(faulty.ShortEdged, Shortfall::ShortEdge);
  add(faulty.Loose, Shortfall::LoosePart);
  for (const auto& node : left)
  {
    for (const int e : near.Mesh.ElementsOfNode(node.first))
    {
      if (isIn(e))
      {
        all.emplace_back(e, Shortfall::LeftOff);
      }
    }
  }
  std::sort(all.begin(), all.end(), ComesBefore<int>);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<std::pair<int, Shortfall>> found;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (i == 0 || all[i - 1].first != all[i].first || IsToldBesideGraver(all[i].second))
    {
      found.push_back(all[i]);
    }
  }
  return found;
}

/// Whether the border of both parts passes a place of the mesh's by, from which its node slid on: a
/// corner of the model is cut off, which need not be sharp.
/// @param places of the nodes in the part that has them.
/// @param share see PassedShare.
bool IsPassedBy(const Band& band, const std::vector<Vec3>& places, int node, double share)
{
  std::vector<int> faces;
  for (const int f : band.FacesOfNode(node))
  {
    if (band.Faces[f].Exterior)
    {
      faces.push_back(f);
    }
  }
  const double most = share * LongestEdgeAt(band, node);
  const std::vector<int> around = BorderAround(band, faces);
  return std::none_of(around.begin(), around.end(),
    [&](int f)
    { return LiesOn(FacetSearch(Facet(places, band.Faces[f])), band.Point[node], most); });
}

bool IsOnExterior(const Band& band, int node)
{
  const auto faces = band.FacesOfNode(node);
  return std::any_of(faces.begin(), faces.end(), [&band](int f) { return band.Faces[f].Exterior; });
}

/// Whether a node went off a side of the model: what was behind it there is in no part.
bool LeftBorder(const Band& band, int node, const Vec3& place)
{
  const double tolerance =
    BorderTolerance * LongestEdgeAt(band, node) + 2.0 * SpacingAt(band, node);
  const auto faces = band.FacesOfNode(node);
  return std::any_of(faces.begin(), faces.end(),
    [&](int f)
    {
      return band.Faces[f].Exterior &&
        !BorderSearch(band, f, LongestRidgeWalk).Has(place, tolerance);
    });
}

}

std::vector<std::pair<int, float>> FindNodesLeft(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision)
{
  std::vector<std::pair<int, float>> left;
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  std::vector<char> atCut = FindBoundaryNodes(near.Mesh, near.Trimmed);
  for (const int n : FindCornersCutOff(near.Mesh, near.Structure, surface, near.Trimmed))
  {
    atCut[n] = 1;
  }
  const auto& moves = near.Trimmed.NodeMoves;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    // What is relaxed behind nodes that are left may come to stick out as well.
    if (users[n] == 0 || !(moves.Left[n] || moves.Applied[n] == Correction::Relax))
    {
      continue;
    }
    const auto foot = surface.ClosestPoint(moves.Position[n]);
    // The border of another face, as of one that ends between two sheets, has no sides.
    const bool isBesideEnd = foot.Kind == nurbs::FootKind::Border && !moves.Left[n];
    const bool inside = !atCut[n] && (isBesideEnd || foot.SignedDistance < 0.0);
    if (!inside && foot.Distance > StoredPrecision(near.Mesh, n, precision))
    {
      left.emplace_back(n, static_cast<float>(foot.Distance));
    }
  }
  return left;
}

std::vector<std::pair<int, float>> FindNodesBeside(
  const TrimBand& near, const nurbs::TrimmingSurface& surface)
{
  std::vector<std::pair<int, float>> beside;
  const std::vector<char> atCut = FindBoundaryNodes(near.Mesh, near.Trimmed);
  const auto& moves = near.Trimmed.NodeMoves;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (!atCut[n] || near.Mesh.NodeStatus[n] != NodeOnSurface || moves.Left[n])
    {
      continue;
    }
    const auto foot = surface.ClosestPoint(moves.Position[n]);
    if (foot.Distance > BesideShare * LongestEdgeAt(near.Mesh, n))
    {
      beside.emplace_back(n, static_cast<float>(foot.Distance));
    }
  }
  return beside;
}

std::vector<std::pair<int, Shortfall>> FindShortfalls(const TrimBand& near,
  const std::vector<std::pair<int, float>>& left, const std::vector<int>& loose, bool hasFloor)
{
  const FaultyElements faulty{ near.Trimmed.BelowFloor, near.Trimmed.Invalid,
    FindStillInvalid(near.Mesh, near.Trimmed),
    hasFloor ? FindShortEdged(near.Mesh, near.Trimmed) : std::vector<int>(), loose };
  return ListShortfalls(near, faulty, left, [&near](int e) { return near.Trimmed.Kept[e] != 0; });
}

std::vector<std::pair<int, Shortfall>> FindShortfallsOfOffcut(
  const TrimBand& near, const std::vector<std::pair<int, float>>& left)
{
  FaultyElements faulty{ near.Rest.BelowFloor, near.Rest.Invalid, {}, {}, FindHinges(near) };
  std::vector<char> inOffcut(near.Mesh.NumberOfElements(), 0);
  for (const auto& element : near.Rest.Elements)
  {
    inOffcut[element.Element] = 1;
    if (IsTouched(near.Mesh, near.Rest, element) &&
      StaysInvalid(near.Mesh, element.Element, PointsOf(near.Rest, element), element.Count))
    {
      faulty.CameInvalid.push_back(element.Element);
    }
  }
  return ListShortfalls(near, faulty, left, [&inOffcut](int e) { return inOffcut[e] != 0; });
}

double MeasureMissing(const TrimBand& near)
{
  const Band& band = near.Mesh;
  double missing = 0.0;
  double cut = 0.0;
  int count = 0;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (band.ElementStatus[e] == ElementToTreat)
    {
      cut += VolumeBefore(band, e);
      ++count;
    }
  }
  // What neither part has touched is in one of them, as it was.
  for (const int e : FindTouchedElements(band, near.Trimmed))
  {
    const FinalElement shape = FinalShape(band, near.Trimmed, e);
    missing += VolumeBefore(band, e) - std::abs(VolumeOf(shape.Points, shape.Count));
  }
  const OffcutElement* last = nullptr;
  for (const OffcutElement& part : near.Rest.Elements)
  {
    // Pieces of one element come one after the other; that of a kept one is what its wedge lacks.
    const bool isFirst = !last || last->Element != part.Element;
    last = &part;
    if (IsTouched(band, near.Rest, part))
    {
      const bool isWhole = isFirst && !near.Trimmed.Kept[part.Element];
      missing += isWhole ? VolumeBefore(band, part.Element) : 0.0;
      missing -= std::abs(VolumeOf(PointsOf(near.Rest, part), part.Count));
    }
  }
  return count > 0 ? missing / cut * count : 0.0;
}

namespace
{

/// @param asksSkin for nodes that slid past a bend of the skin, too.
/// @param share see PassedShare.
std::vector<int> FindCornersPassed(const TrimBand& near, bool asksSkin, double share)
{
  const Band& band = near.Mesh;
  const std::vector<int> users = CountUsers(band, near.Trimmed);
  const std::vector<char> inOffcut = FindUsed(band, near.Rest);
  // Else the constraint of a node forgets the sides that go whole with what is cut off.
  const std::vector<unsigned char> allKept(band.NumberOfNodes(), NodeKeep);
  const auto movesOf = [&](int n) -> const Moves&
  { return users[n] > 0 ? near.Trimmed.NodeMoves : near.Rest.NodeMoves; };
  std::vector<Vec3> places;
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    places.push_back(movesOf(n).Position[n]);
  }
  std::vector<int> lost;
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    const Moves& moves = movesOf(n);
    if ((users[n] == 0 && !inOffcut[n]) || moves.Applied[n] == Correction::None)
    {
      continue;
    }
    const auto constraint = ConstrainNode(band, near.Structure, allKept, n);
    if (!near.Structure.IsOnBorder(band, n) && constraint.RidgeEdges.empty())
    {
      // Slides on one side of the model. Where that bends outwards and inwards it is much the same
      // in all: what the layers lose on one side they have more on the other.
      if (asksSkin && IsOnExterior(band, n) && IsPassedBy(band, places, n, share))
      {
        lost.push_back(n);
      }
      continue;
    }
    const bool wasCorner = constraint.SharpCorner || constraint.Kind == ConstraintKind::Fixed;
    if ((users[n] > 0 && wasCorner) || LeftBorder(band, n, places[n]) ||
      IsPassedBy(band, places, n, share))
    {
      lost.push_back(n);
    }
  }
  return lost;
}

}

std::vector<int> FindCornersLost(const TrimBand& near, double missing)
{
  const bool isMuch = std::abs(missing) > LargestMissing;
  auto lost = FindCornersPassed(near, isMuch, PassedShare);
  for (double share = 0.5 * PassedShare; isMuch && lost.empty() && share >= LeastPassedShare;
       share *= 0.5)
  {
    lost = FindCornersPassed(near, true, share);
  }
  return lost;
}

}
