#include "EndInside.h"

#include "ElementMap.h"
#include "SortUnique.h"

#include <algorithm>
#include <unordered_map>

namespace trim
{
namespace
{
using nurbs::FootKind;

/// How far within elements the surface has to end to end inside the grid, in diagonals of one.
constexpr double InsideMargin = 1e-4;
/// The same where it goes through the midst of one: more than rounding.
constexpr double BareMargin = 1e-9;

/// Whether all that is round a place belongs to some of a few elements.
/// @param margin how far round it, in diagonals of an element.
bool IsWithin(const HexMesh& mesh, const std::vector<Id>& cells, const Vec3& place, double margin)
{
  ElementPoints points;
  const auto holds = [&](Id cell, const Vec3& at)
  {
    const int count = PointsOfCell(mesh, cell, points);
    Vec3 parameters;
    if (!FindParameters(points, count, at, parameters))
    {
      return false;
    }
    const auto outside = Outside(count, parameters);
    return *std::max_element(outside.begin(), outside.end()) <= 0.0;
  };
  const double step = margin * CellBox(mesh, cells.front()).diagonal().norm();
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 way(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    if (std::none_of(
          cells.begin(), cells.end(), [&](Id cell) { return holds(cell, place + step * way); }))
    {
      return false;
    }
  }
  return true;
}

/// Where the surface ends in or beside a cell: within the cells round it, or barely within them if
/// it goes through their midst.
std::optional<Vec3> FindEndWithin(
  const HexMesh& mesh, Id cell, const std::vector<Id>& round, const nurbs::TrimmingSurface& surface)
{
  ElementPoints points;
  const int count = PointsOfCell(mesh, cell, points);
  std::optional<Vec3> barely;
  bool goesThrough = false;
  for (int i = 0; i < 27; ++i)
  {
    const Vec3 at = ClampToElement(count, 0.5 * Vec3(i % 3, i / 3 % 3, i / 9));
    const auto foot = surface.ClosestPoint(MapToSpace(points, count, at));
    const bool ends = foot.Kind == FootKind::Border;
    const bool within = (ends || !goesThrough) && IsWithin(mesh, round, foot.Point, InsideMargin);
    if (ends && within)
    {
      return foot.Point;
    }
    goesThrough = goesThrough || within;
    if (ends && !barely && IsWithin(mesh, round, foot.Point, BareMargin))
    {
      barely = foot.Point;
    }
  }
  return goesThrough ? barely : std::nullopt;
}

/// Candidate cells that have a node in common with each of them.
class CellNeighbours
{
public:
  CellNeighbours(const HexMesh& mesh, const std::vector<Id>& cells)
    : Mesh(mesh)
  {
    this->ForNodes(cells, [this](Id node, Id cell) { this->CellsOf[node].push_back(cell); });
  }
  std::vector<Id> Round(Id cell) const
  {
    std::vector<Id> round;
    this->ForNodes({ cell },
      [&](Id node, Id)
      {
        const auto& cells = this->CellsOf.at(node);
        round.insert(round.end(), cells.begin(), cells.end());
      });
    SortUnique(round);
    return round;
  }

private:
  template <typename Visit>
  void ForNodes(const std::vector<Id>& cells, const Visit& visit) const
  {
    std::array<Id, 8> nodes;
    for (const Id c : cells)
    {
      const int count = this->Mesh.Cell(c, nodes);
      std::for_each(nodes.begin(), nodes.begin() + count, [&](Id node) { visit(node, c); });
    }
  }

  const HexMesh& Mesh;
  std::unordered_map<Id, std::vector<Id>> CellsOf;
};

}

std::optional<Vec3> FindEndInside(
  const HexMesh& mesh, const NodeClassification& nodes, const nurbs::TrimmingSurface& surface)
{
  const NodeFeet& near = nodes.Near;
  const auto isAtEnd = [&near](Id node)
  { return near.Feet[near.Find(node)].Kind == FootKind::Border; };
  if (std::none_of(near.Feet.begin(), near.Feet.end(),
        [](const nurbs::Foot& foot) { return foot.Kind == FootKind::Border; }))
  {
    return {};
  }
  std::array<Id, 8> cell;
  const CellNeighbours neighbours(mesh, nodes.CandidateCells);
  for (const Id c : nodes.CandidateCells)
  {
    const int count = mesh.Cell(c, cell);
    if (std::none_of(cell.begin(), cell.begin() + count, isAtEnd))
    {
      continue;
    }
    if (const auto end = FindEndWithin(mesh, c, neighbours.Round(c), surface))
    {
      return end;
    }
  }
  return {};
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
