#include "EndInside.h"

#include "ElementMap.h"
#include "NodeNumbers.h"
#include "Place.h"
#include "SortUnique.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace trim
{
namespace
{
using nurbs::FootKind;

/// How far within elements the surface has to end to end inside the grid, in diagonals of one.
constexpr double InsideMargin = 1e-4;
/// The same where it goes through the midst of one: more than rounding.
constexpr double BareMargin = 1e-9;

/// A candidate cell at the border of the surface, as all ranks see it.
struct EndCell
{
  int Count;
  bool AtEnd;             ///< the border is what some node of it is nearest to
  std::array<Id, 8> Node; ///< numbers over all ranks
  std::array<Place, 8> At;

  ElementPoints Points() const
  {
    ElementPoints points;
    std::transform(this->At.begin(), this->At.begin() + this->Count, points.begin(), ToVec3);
    return points;
  }
  /// The same on all ranks, and whatever the order of the nodes.
  std::array<Place, 8> Key() const
  {
    std::array<Place, 8> key{};
    std::copy_n(this->At.begin(), this->Count, key.begin());
    std::sort(key.begin(), key.begin() + this->Count);
    return key;
  }
};

/// A cell among those of all ranks, in order.
struct EndElement
{
  std::array<Place, 8> Key;
  const EndCell* Cell;
  ElementPoints Points;
  bool Own;
};

/// Whether all that is round a place belongs to some of a few elements.
/// @param margin how far round it, in diagonals of an element.
bool IsWithin(const std::vector<const EndElement*>& cells, const Vec3& place, double margin)
{
  const auto holds = [](const EndElement& element, const Vec3& at)
  {
    const int count = element.Cell->Count;
    Vec3 parameters;
    if (!FindParameters(element.Points, count, at, parameters))
    {
      return false;
    }
    const auto outside = Outside(count, parameters);
    return *std::max_element(outside.begin(), outside.end()) <= 0.0;
  };
  const EndElement& first = *cells.front();
  Box3 box;
  std::for_each(first.Points.begin(), first.Points.begin() + first.Cell->Count,
    [&box](const Vec3& p) { box.extend(p); });
  const double step = margin * box.diagonal().norm();
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 way(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    if (std::none_of(cells.begin(), cells.end(),
          [&](const EndElement* element) { return holds(*element, place + step * way); }))
    {
      return false;
    }
  }
  return true;
}

/// Where the surface ends in or beside a cell: within the cells round it, or barely within them if
/// it goes through their midst.
std::optional<Vec3> FindEndWithin(const EndElement& element,
  const std::vector<const EndElement*>& round, const nurbs::TrimmingSurface& surface)
{
  const int count = element.Cell->Count;
  std::optional<Vec3> barely;
  bool goesThrough = false;
  for (int i = 0; i < 27; ++i)
  {
    const Vec3 at = ClampToElement(count, 0.5 * Vec3(i % 3, i / 3 % 3, i / 9));
    const auto foot = surface.ClosestPoint(MapToSpace(element.Points, count, at));
    const bool ends = foot.Kind == FootKind::Border;
    const bool within = (ends || !goesThrough) && IsWithin(round, foot.Point, InsideMargin);
    if (ends && within)
    {
      return foot.Point;
    }
    goesThrough = goesThrough || within;
    if (ends && !barely && IsWithin(round, foot.Point, BareMargin))
    {
      barely = foot.Point;
    }
  }
  return goesThrough ? barely : std::nullopt;
}

/// This rank's candidate cells with a node that the border is nearest to on some rank, and those
/// that share a node with them. Collective.
std::vector<EndCell> FindEndCells(
  const HexMesh& mesh, const Piece& piece, const NodeClassification& nodes)
{
  const NodeFeet& near = nodes.Near;
  const NodeNumbers numbers(mesh, piece);
  std::array<Id, 8> node;
  const auto hasAny = [&](Id cell, const auto& test)
  {
    const int count = mesh.Cell(cell, node);
    return std::any_of(node.begin(), node.begin() + count, test);
  };
  const auto isAtEnd = [&near](Id n) { return near.Feet[near.Find(n)].Kind == FootKind::Border; };
  std::unordered_set<Id> ofEnds;
  std::vector<Id> shared;
  for (const Id c : nodes.CandidateCells)
  {
    if (hasAny(c, isAtEnd))
    {
      const int count = mesh.Cell(c, node);
      for (int i = 0; i < count; ++i)
      {
        const Id number = numbers.NumberOf(node[i]);
        if (ofEnds.insert(number).second && numbers.IsShared(number))
        {
          shared.push_back(number);
        }
      }
    }
  }
  shared = piece.All.Gather(shared);
  ofEnds.insert(shared.begin(), shared.end());
  std::vector<EndCell> found;
  for (const Id c : nodes.CandidateCells)
  {
    if (hasAny(c, [&](Id n) { return ofEnds.count(numbers.NumberOf(n)) > 0; }))
    {
      EndCell cell{ 0, hasAny(c, isAtEnd), {}, {} };
      cell.Count = mesh.OrientedCell(c, node);
      for (int i = 0; i < cell.Count; ++i)
      {
        cell.Node[i] = numbers.NumberOf(node[i]);
        cell.At[i] = ToPlace(mesh.Point(node[i]));
      }
      found.push_back(cell);
    }
  }
  return found;
}

std::vector<EndElement> InOrder(
  const std::vector<EndCell>& cells, std::size_t first, std::size_t end)
{
  std::vector<EndElement> elements;
  elements.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    elements.push_back({ cells[i].Key(), &cells[i], cells[i].Points(), i >= first && i < end });
  }
  std::sort(elements.begin(), elements.end(),
    [](const EndElement& a, const EndElement& b) { return a.Key < b.Key; });
  return elements;
}

/// What one rank has found, by the cell beside it.
struct FoundEnd
{
  std::array<Place, 8> Key;
  Place At;
};

/// The first one among the cells of this rank.
std::vector<FoundEnd> FindFirstEnd(
  const std::vector<EndElement>& elements, const nurbs::TrimmingSurface& surface)
{
  std::unordered_map<Id, std::vector<const EndElement*>> ofNode;
  const auto forNodes = [](const EndElement& element, const auto& visit)
  {
    const auto& node = element.Cell->Node;
    std::for_each(node.begin(), node.begin() + element.Cell->Count, visit);
  };
  for (const EndElement& element : elements)
  {
    forNodes(element, [&](Id node) { ofNode[node].push_back(&element); });
  }
  for (const EndElement& element : elements)
  {
    if (!element.Own || !element.Cell->AtEnd)
    {
      continue;
    }
    std::vector<const EndElement*> round;
    forNodes(element,
      [&](Id node) { round.insert(round.end(), ofNode[node].begin(), ofNode[node].end()); });
    SortUnique(round); // in the order of the elements
    if (const auto end = FindEndWithin(element, round, surface))
    {
      return { { element.Key, ToPlace(*end) } };
    }
  }
  return {};
}

}

std::optional<Vec3> FindEndInside(const HexMesh& mesh, const Piece& piece,
  const NodeClassification& nodes, const nurbs::TrimmingSurface& surface)
{
  const auto& feet = nodes.Near.Feet;
  if (!piece.All.Any(std::any_of(feet.begin(), feet.end(),
        [](const nurbs::Foot& foot) { return foot.Kind == FootKind::Border; })))
  {
    return {};
  }
  std::vector<std::size_t> ends;
  const auto cells = piece.All.Gather(FindEndCells(mesh, piece, nodes), ends);
  const int self = piece.All.Rank();
  const auto elements = InOrder(cells, self > 0 ? ends[self - 1] : 0, ends[self]);
  const auto found = piece.All.Gather(FindFirstEnd(elements, surface));
  const auto first = std::min_element(
    found.begin(), found.end(), [](const FoundEnd& a, const FoundEnd& b) { return a.Key < b.Key; });
  return first == found.end() ? std::nullopt : std::optional<Vec3>(ToVec3(first->At));
}

std::optional<Vec3> FindEndBeside(
  const nurbs::TrimmingSurface& surface, const Vec3& eliminated, const Vec3& kept)
{
  // The side changes within the hole, where the border is nearer than all else.
  constexpr int halvings = 50;
  Vec3 beyond = eliminated, before = kept;
  for (int i = 0; i < halvings; ++i)
  {
    const Vec3 middle = 0.5 * (beyond + before);
    const nurbs::Foot foot = surface.ClosestPoint(middle);
    if (foot.Kind == nurbs::FootKind::Border)
    {
      return foot.Point;
    }
    (foot.SignedDistance > 0.0 ? beyond : before) = middle;
  }
  return {};
}

}
