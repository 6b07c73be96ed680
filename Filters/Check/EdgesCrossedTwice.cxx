#include "EdgesCrossedTwice.h"

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

/// Appends the edges of a cell that are near enough to the surface to be crossed: it is nowhere
/// nearer to a node than its foot.
void AddNearEdges(
  const HexMesh& mesh, const NodeClassification& nodes, Id cell, std::vector<MeshEdge>& edges)
{
  std::array<Id, 8> node;
  const auto& topology = TopologyOf(mesh.OrientedCell(cell, node));
  std::array<double, 8> distance;
  for (int i = 0; i < topology.NumberOfNodes; ++i)
  {
    distance[i] = nodes.Near.Feet[nodes.Near.Find(node[i])].Distance;
  }
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const auto& edge = topology.Edges[i];
    const Id a = node[edge.First];
    const Id b = node[edge.Second];
    const bool within = nodes.Status[a] == NodeOnSurface && nodes.Status[b] == NodeOnSurface;
    if (!within &&
      distance[edge.First] + distance[edge.Second] <= (mesh.Point(a) - mesh.Point(b)).norm())
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
    if (!flat[i])
    {
      AddNearEdges(mesh, nodes, nodes.CandidateCells[i], edges);
    }
  }
  SortUnique(edges);
  return edges;
}

/// From the end that comes first by its place, so that the numbering has no say; without those at
/// which the surface runs along the edge, as a side of a contour on a line of the mesh does.
std::vector<nurbs::LineHit> Crossings(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& edge)
{
  const Vec3 a = mesh.Point(edge[0]);
  const Vec3 b = mesh.Point(edge[1]);
  auto hits = LiesBefore(a, b) ? surface.Intersect(a, b) : surface.Intersect(b, a);
  const Vec3 way = (b - a).normalized();
  hits.erase(
    std::remove_if(hits.begin(), hits.end(),
      [&way](const nurbs::LineHit& hit) { return std::abs(hit.Normal.dot(way)) < AlongCosine; }),
    hits.end());
  return hits;
}

bool TurnsBetween(const nurbs::LineHit& one, const nurbs::LineHit& next)
{
  return next.Normal.dot(one.Normal) < CrossingCosine;
}

bool IsCrossedTwice(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& edge)
{
  const auto hits = Crossings(mesh, surface, edge);
  return std::adjacent_find(hits.begin(), hits.end(), TurnsBetween) != hits.end();
}

}

std::vector<MeshEdge> FindEdgesCrossedTwice(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const NodeClassification& nodes)
{
  const std::vector<MeshEdge> edges = FindNearEdges(mesh, surface, nodes);
  std::vector<char> twice(edges.size());
  ForAll(static_cast<int>(edges.size()),
    [&](int i) { twice[i] = IsCrossedTwice(mesh, surface, edges[i]); });
  std::vector<MeshEdge> found;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    if (twice[i])
    {
      found.push_back(edges[i]);
    }
  }
  return found;
}

std::vector<Vec3> PlacesBetweenCrossings(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const MeshEdge& edge)
{
  const auto hits = Crossings(mesh, surface, edge);
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
