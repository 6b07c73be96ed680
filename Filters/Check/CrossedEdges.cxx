#include "CrossedEdges.h"

#include "BandCells.h"
#include "ElementTopology.h"
#include "Runs.h"
#include "SortUnique.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trim
{
namespace
{

/// Within one element a surface of the smallest radius that nodes can follow turns by 29 degrees
/// (chord 1, radius 2). What turns less between two crossings of an edge merely touches it.
constexpr double CrossingCosine = 0.866;
/// Normals within this angle of one direction turn less than that against each other.
constexpr double HalfCrossingAngle = 0.2618;
/// Share of an edge from one crossing to the next, above which two that lead to the same side are
/// of two surfaces: those of faces that overlap in one surface lie together.
constexpr double DoubledShare = 0.05;
/// Cosine of the angle between a surface's normal and an edge below which it runs along the edge.
constexpr double AlongCosine = 0.05;

/// For each candidate cell whether the surface certainly turns too little near it to cross an edge
/// of it twice.
std::vector<char> FindFlat(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes)
{
  const auto& cells = nodes.CandidateCells;
  std::vector<char> flat(cells.size());
  ForAll(static_cast<int>(cells.size()),
    [&](int i)
    {
      const Vec3& normal = nodes.Near.Feet[nodes.Near.Find(mesh.FirstNode(cells[i]))].Normal;
      flat[i] = surface.NormalsLieWithin(CellBox(mesh, cells[i]), normal, HalfCrossingAngle);
    });
  return flat;
}

/// Whether two nodes have their feet on two surfaces: on one that is flat between them the plane at
/// one foot is as far from the other node as its own foot, about.
bool SeeTwo(const HexMesh& mesh, Id a, Id b, const nurbs::Foot& footOfA, const nurbs::Foot& footOfB)
{
  const double fromPlane = (mesh.Point(b) - footOfA.Point).dot(footOfA.Normal);
  return std::abs(fromPlane - footOfB.SignedDistance) >
    DoubledShare * (mesh.Point(a) - mesh.Point(b)).norm();
}

/// Appends the edges of a cell that are near enough to the surface to be crossed otherwise than
/// once: it is nowhere nearer to a node than its foot.
/// @param flat see FindFlat.
void AddNearEdges(const HexMesh& mesh, const NodeClassification& nodes, Id cell, bool flat,
  std::vector<MeshEdge>& edges)
{
  std::array<Id, 8> node;
  const auto& topology = TopologyOf(mesh.OrientedCell(cell, node));
  std::array<const nurbs::Foot*, 8> foot;
  for (int i = 0; i < topology.NumberOfNodes; ++i)
  {
    foot[i] = &nodes.Near.Feet[nodes.Near.Find(node[i])];
  }
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const auto& edge = topology.Edges[i];
    const Id a = node[edge.First];
    const Id b = node[edge.Second];
    const bool within = nodes.Status[a] == NodeOnSurface && nodes.Status[b] == NodeOnSurface;
    const nurbs::Foot& footOfA = *foot[edge.First];
    const nurbs::Foot& footOfB = *foot[edge.Second];
    if (footOfA.Distance + footOfB.Distance <= (mesh.Point(a) - mesh.Point(b)).norm() &&
      (flat ? SeeTwo(mesh, a, b, footOfA, footOfB) : !within))
    {
      edges.push_back({ std::min(a, b), std::max(a, b) });
    }
  }
}

std::vector<MeshEdge> FindNearEdges(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes)
{
  const std::vector<char> flat = FindFlat(mesh, surface, nodes);
  std::vector<MeshEdge> edges;
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    AddNearEdges(mesh, nodes, nodes.CandidateCells[i], flat[i], edges);
  }
  SortUnique(edges);
  return edges;
}

/// From the end that comes first by its place, so that the numbering has no say.
struct WayAlong
{
  WayAlong(const HexMesh& mesh, const MeshEdge& edge)
    : Ends(
        LiesBefore(mesh.Point(edge[0]), mesh.Point(edge[1])) ? edge : MeshEdge{ edge[1], edge[0] })
    , From(mesh.Point(this->Ends[0]))
    , To(mesh.Point(this->Ends[1]))
  {
  }

  MeshEdge Ends;
  Vec3 From, To;
};

/// Takes away the crossings at which the surface runs along the edge, as a side of a contour on a
/// line of the mesh does.
void RemoveAlong(const WayAlong& edge, std::vector<nurbs::LineHit>& hits)
{
  const Vec3 way = (edge.To - edge.From).normalized();
  hits.erase(
    std::remove_if(hits.begin(), hits.end(),
      [&way](const nurbs::LineHit& hit) { return std::abs(hit.Normal.dot(way)) < AlongCosine; }),
    hits.end());
}

bool TurnsBetween(const nurbs::LineHit& one, const nurbs::LineHit& next)
{
  return next.Normal.dot(one.Normal) < CrossingCosine;
}

/// Whether the surface leads twice to the same side, and so is there twice: one face beside another
/// that is written differently, or two cuts that face the same way.
/// @param gap between faces of one surface.
bool IsDoubled(const nurbs::LineHit& one, const nurbs::LineHit& next, const Vec3& way, double gap)
{
  return one.Normal.dot(way) * next.Normal.dot(way) > 0.0 && next.K - one.K > DoubledShare &&
    (next.Point - one.Point).norm() > gap;
}

/// Whether next to the crossing before a node lies the side that the node does not have: of two
/// cuts that face the same way the other one has it.
/// @param crossing with none between it and the node.
bool IsAgainstSide(const nurbs::TrimmingSurface& surface, const Vec3& crossing, const Vec3& node,
  unsigned char sideOfNode, double length)
{
  if (sideOfNode == NodeOnSurface)
  {
    return false;
  }
  const Vec3 way = node - crossing;
  const double away = std::min(0.5 * way.norm(), DoubledShare * length);
  const nurbs::Foot foot = surface.ClosestPoint(crossing + away * way.stableNormalized());
  const unsigned char side = foot.SignedDistance < 0.0 ? NodeKeep : NodeEliminate;
  return foot.Kind == nurbs::FootKind::Interior && side != sideOfNode &&
    foot.Distance > AlongCosine * away;
}

/// @param hits all of them.
bool IsAgainstSides(const nurbs::TrimmingSurface& surface, const NodeClassification& nodes,
  const WayAlong& edge, const std::vector<nurbs::LineHit>& hits)
{
  const unsigned char first = nodes.Status[edge.Ends[0]];
  const unsigned char last = nodes.Status[edge.Ends[1]];
  if (hits.empty() && first != NodeOnSurface && last != NodeOnSurface)
  {
    return false;
  }
  // A node that is on the surface may not be hit, but for rounding.
  const Vec3 firstCrossing = hits.empty() ? edge.To : hits.front().Point;
  const Vec3 lastCrossing = hits.empty() ? edge.From : hits.back().Point;
  const double length = (edge.To - edge.From).norm();
  return IsAgainstSide(surface, firstCrossing, edge.From, first, length) ||
    IsAgainstSide(surface, lastCrossing, edge.To, last, length);
}

enum Crossed : char
{
  CrossedOnce, ///< or not at all
  CrossedTwice,
  CrossedAgainstSides
};

Crossed HowCrossed(const HexMesh& mesh, const nurbs::TrimmingSurface& surface,
  const NodeClassification& nodes, const MeshEdge& ends)
{
  const WayAlong edge(mesh, ends);
  auto hits = surface.Intersect(edge.From, edge.To);
  if (IsAgainstSides(surface, nodes, edge, hits))
  {
    return CrossedAgainstSides;
  }
  RemoveAlong(edge, hits);
  const Vec3 way = edge.To - edge.From;
  const double gap = surface.WidestGap();
  if (std::adjacent_find(hits.begin(), hits.end(),
        [&](const nurbs::LineHit& one, const nurbs::LineHit& next)
        { return IsDoubled(one, next, way, gap); }) != hits.end())
  {
    return CrossedAgainstSides;
  }
  return std::adjacent_find(hits.begin(), hits.end(), TurnsBetween) != hits.end() ? CrossedTwice
                                                                                  : CrossedOnce;
}

}

CrossedEdges FindCrossedEdges(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes)
{
  const std::vector<MeshEdge> edges = FindNearEdges(mesh, surface, nodes);
  std::vector<char> crossed(edges.size());
  ForAll(static_cast<int>(edges.size()),
    [&](int i) { crossed[i] = HowCrossed(mesh, surface, nodes, edges[i]); });
  CrossedEdges found;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (crossed[i] != CrossedOnce)
    {
      (crossed[i] == CrossedTwice ? found.Twice : found.AgainstSides).push_back(edges[i]);
    }
  }
  return found;
}

std::vector<Vec3> PlacesBetweenCrossings(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& ends)
{
  const WayAlong edge(mesh, ends);
  auto hits = surface.Intersect(edge.From, edge.To);
  RemoveAlong(edge, hits);
  std::vector<Vec3> places;
  for (std::size_t i = 1; i < hits.size(); ++i)
  {
    if (TurnsBetween(hits[i - 1], hits[i]))
    {
      places.emplace_back(0.5 * (hits[i - 1].Point + hits[i].Point));
    }
  }
  return places;
}

}
