#include "NodeConstraint.h"

#include "AddUnique.h"
#include "Facet.h"
#include "Status.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// Under more than 35 degrees a ridge goes on, though it fades.
constexpr double FadingCosine = 0.8192;
/// A border that turns by more than 30 degrees at a node has a corner there.
constexpr double CornerCosine = 0.866;
/// An edge goes on straight with another one that turns by less than 45 degrees.
constexpr double StraightOn = 0.7071;
/// How far along the border a cut that leans is looked for, in edges.
constexpr int LongestStepsBack = 4;
/// Nodes of a pillar that are looked at.
constexpr std::size_t MostLayers = 200;

/// Edges at the node that faces of a set share under more than an angle.
void AddCreases(const Band& band, const std::vector<int>& faces, int node, double cosine,
  std::vector<int>& ridgeEdges)
{
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const auto& a = band.Faces[faces[i]];
    const auto endsOfA = NeighboursOf(a, node);
    normals.push_back(Facet(band, a).MeanNormal());
    for (std::size_t j = 0; j < i; ++j)
    {
      const auto& b = band.Faces[faces[j]];
      const auto endsOfB = NeighboursOf(b, node);
      for (const int end : endsOfA)
      {
        if ((end == endsOfB[0] || end == endsOfB[1]) &&
          TurnCosine(a, normals[i], b, normals[j]) < cosine)
        {
          AddUnique(ridgeEdges, band.FindEdge(node, end));
        }
      }
    }
  }
}

/// Edges along the layers that faces of the lateral border have at a node.
std::vector<int> LateralEdges(
  const Band& band, const Columns& columns, const std::vector<int>& faces, int node)
{
  std::vector<int> edges;
  for (const int f : faces)
  {
    for (const int end : NeighboursOf(band.Faces[f], node))
    {
      const int edge = band.FindEdge(node, end);
      if (!columns.IsThicknessEdge(band, edge))
      {
        AddUnique(edges, edge);
      }
    }
  }
  return edges;
}

/// Edges of a node along the lateral border of a sheet.
std::vector<int> BorderEdges(const Band& band, const Columns& columns, int node)
{
  std::vector<int> faces;
  for (const int f : band.FacesOfNode(node))
  {
    if (band.Faces[f].Exterior && !columns.IsLayerFace(band, f))
    {
      faces.push_back(f);
    }
  }
  return LateralEdges(band, columns, faces, node);
}

/// What holds the nodes of a pillar on the border of a sheet.
struct PillarHold
{
  bool Stays = false; ///< one does not lie beyond the surface
  /// From those that do to their neighbours on the border that do not.
  std::vector<Vec3> Ways;

  bool IsWay(const Vec3& way) const
  {
    return !this->Ways.empty() &&
      std::all_of(this->Ways.begin(), this->Ways.end(),
        [&way](const Vec3& other) { return way.dot(other) > 0.0; });
  }
};

PillarHold FindHold(
  const Band& band, const Columns& columns, const std::vector<unsigned char>& nodeStatus, int node)
{
  PillarHold hold;
  // Corrupt grids have pillars that branch and close.
  std::vector<int> pillar{ node };
  for (std::size_t i = 0; i < pillar.size() && pillar.size() < MostLayers; ++i)
  {
    const bool stays = nodeStatus[pillar[i]] != NodeEliminate;
    hold.Stays |= stays;
    for (const int edge : band.EdgesOfNode(pillar[i]))
    {
      if (columns.IsThicknessEdge(band, edge))
      {
        AddUnique(pillar, band.OtherEnd(edge, pillar[i]));
      }
    }
    for (const int edge : stays ? std::vector<int>() : BorderEdges(band, columns, pillar[i]))
    {
      const int other = band.OtherEnd(edge, pillar[i]);
      if (nodeStatus[other] != NodeEliminate)
      {
        hold.Ways.push_back(band.Point[other] - band.Point[pillar[i]]);
      }
    }
  }
  return hold;
}

/// How many edges straight on from a node the first one is that does not lie beyond the surface.
int StepsBack(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, int node, int edge, int most)
{
  for (int steps = 1; steps <= most; ++steps)
  {
    const int other = band.OtherEnd(edge, node);
    if (nodeStatus[other] != NodeEliminate)
    {
      return steps;
    }
    const Vec3 way = (band.Point[other] - band.Point[node]).normalized();
    double straightest = StraightOn;
    int next = -1;
    for (const int e : band.EdgesOfNode(other))
    {
      const double straight =
        way.dot((band.Point[band.OtherEnd(e, other)] - band.Point[other]).normalized());
      if (!columns.IsThicknessEdge(band, e) && straight > straightest)
      {
        straightest = straight;
        next = e;
      }
    }
    if (next < 0)
    {
      break;
    }
    node = other;
    edge = next;
  }
  return most + 1;
}

/**
 * A cut that leans takes away a layer of the border before it comes to another. A node beyond it
 * stays on the border all the same if others of its pillar do, or slide along it the same way, and
 * the surface is nearer along the border than into the sheet.
 */
bool StaysOnBorder(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, const std::vector<int>& borderEdges, int node)
{
  const PillarHold hold =
    borderEdges.empty() ? PillarHold() : FindHold(band, columns, nodeStatus, node);
  if (!hold.Stays && (hold.Ways.empty() || columns.IsChosenByCut(node)))
  {
    return false;
  }
  int along = LongestStepsBack + 1;
  bool sameWay = false;
  for (const int edge : borderEdges)
  {
    const int steps = StepsBack(band, columns, nodeStatus, node, edge, LongestStepsBack);
    if (steps > along)
    {
      continue;
    }
    const bool same = hold.IsWay(band.Point[band.OtherEnd(edge, node)] - band.Point[node]);
    sameWay = same && (sameWay || steps < along);
    along = steps;
  }
  // In a sheet what the others do tips the scales.
  const int nearer = sameWay && !columns.IsChosenByCut(node) ? along - 1 : along;
  const auto edges = band.EdgesOfNode(node);
  return along <= LongestStepsBack &&
    std::none_of(edges.begin(), edges.end(),
      [&](int edge)
      {
        return !columns.IsThicknessEdge(band, edge) &&
          std::find(borderEdges.begin(), borderEdges.end(), edge) == borderEdges.end() &&
          StepsBack(band, columns, nodeStatus, node, edge, nearer) <= nearer;
      });
}

/// Whether the one ridge edge of a node does not go on at all.
bool RidgeEnds(const Band& band, int node, const NodeConstraint& constraint)
{
  std::vector<int> edges = constraint.RidgeEdges;
  AddCreases(band, constraint.Faces, node, FadingCosine, edges);
  return edges.size() == 1;
}

/// @param isCut the rest of its ridge may have gone with what is cut off.
void SetKind(const Band& band, int node, bool isCut, NodeConstraint& constraint)
{
  const auto& ridges = constraint.RidgeEdges;
  if (ridges.empty())
  {
    constraint.Kind = constraint.Faces.empty() ? ConstraintKind::Free : ConstraintKind::Faces;
    return;
  }
  constraint.Kind = ridges.size() <= 2 ? ConstraintKind::Ridge : ConstraintKind::Fixed;
  if (ridges.size() == 2)
  {
    const Vec3& p = band.Point[node];
    const Vec3 in = (p - band.Point[band.OtherEnd(ridges[0], node)]).normalized();
    const Vec3 out = (band.Point[band.OtherEnd(ridges[1], node)] - p).normalized();
    constraint.SharpCorner = in.dot(out) < CornerCosine;
  }
  else if (ridges.size() == 1)
  {
    constraint.SharpCorner = !isCut && RidgeEnds(band, node, constraint);
  }
}

}

bool GoesWhole(const BandFace& face, const std::vector<unsigned char>& nodeStatus)
{
  bool eliminates = false;
  for (int i = 0; i < face.Count; ++i)
  {
    if (nodeStatus[face.Node[i]] == NodeKeep)
    {
      return false;
    }
    eliminates |= nodeStatus[face.Node[i]] == NodeEliminate;
  }
  return eliminates;
}

double TurnCosine(
  const BandFace& a, const Vec3& normalOfA, const BandFace& b, const Vec3& normalOfB)
{
  const double cosine = normalOfA.dot(normalOfB);
  return a.Exterior && b.Exterior ? cosine : std::abs(cosine);
}

namespace
{

/// At a step of the thickness the skin goes on between the layers. Where the side of the step goes
/// with what is cut off, that leads beneath what is no more: the skin that stays holds the node.
void KeepToSkin(
  const Band& band, const std::vector<unsigned char>& nodeStatus, std::vector<int>& layerFaces)
{
  const bool skinStays = std::any_of(layerFaces.begin(), layerFaces.end(),
    [&](int f) { return band.Faces[f].Exterior && !GoesWhole(band.Faces[f], nodeStatus); });
  if (skinStays)
  {
    layerFaces.erase(std::remove_if(layerFaces.begin(), layerFaces.end(),
                       [&band](int f) { return !band.Faces[f].Exterior; }),
      layerFaces.end());
  }
}

/// The constraint by these of the faces of a node.
NodeConstraint ConstrainBy(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, int node, const std::vector<int>& faces)
{
  NodeConstraint constraint;
  std::vector<int> lateral;
  std::vector<int> exterior;
  bool sheet = false;
  for (const int f : faces)
  {
    const auto& face = band.Faces[f];
    const bool layer = columns.IsLayerFace(band, f);
    sheet |= columns.HasThickness(face.Element[0]);
    if (layer)
    {
      constraint.Faces.push_back(f);
    }
    else if (face.Exterior)
    {
      lateral.push_back(f);
      if (!GoesWhole(face, nodeStatus))
      {
        exterior.push_back(f);
      }
    }
  }
  bool stays = false;
  if (sheet)
  {
    if (!lateral.empty() && exterior.empty())
    {
      KeepToSkin(band, nodeStatus, constraint.Faces);
    }
    const auto border = LateralEdges(band, columns, lateral, node);
    stays =
      nodeStatus[node] == NodeEliminate && StaysOnBorder(band, columns, nodeStatus, border, node);
    constraint.RidgeEdges = stays ? border : LateralEdges(band, columns, exterior, node);
    // Folds of the skin without a radius hold their nodes; inner layers fold alike.
    AddCreases(band, constraint.Faces, node, SameSideCosine, constraint.RidgeEdges);
  }
  else
  {
    constraint.Faces = exterior;
    AddCreases(band, exterior, node, SameSideCosine, constraint.RidgeEdges);
  }
  // A ridge that lies beyond the surface to both sides of the node goes with what is cut off.
  const bool ridgeGoes = nodeStatus[node] == NodeEliminate && !stays &&
    std::all_of(constraint.RidgeEdges.begin(), constraint.RidgeEdges.end(),
      [&](int edge) { return nodeStatus[band.OtherEnd(edge, node)] == NodeEliminate; });
  if (ridgeGoes)
  {
    constraint.RidgeEdges.clear();
  }
  SetKind(band, node, nodeStatus[node] == NodeEliminate, constraint);
  return constraint;
}

}

NodeConstraint ConstrainNode(
  const Band& band, const Columns& columns, const std::vector<unsigned char>& nodeStatus, int node)
{
  const auto faces = band.FacesOfNode(node);
  return ConstrainBy(band, columns, nodeStatus, node, { faces.begin(), faces.end() });
}

NodeConstraint ConstrainNode(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, const std::vector<char>& kept, int node)
{
  std::vector<int> faces;
  for (const int f : band.FacesOfNode(node))
  {
    const auto& face = band.Faces[f];
    if (kept[face.Element[0]] && (face.Element[1] < 0 || kept[face.Element[1]]))
    {
      faces.push_back(f);
    }
  }
  return ConstrainBy(band, columns, nodeStatus, node, faces);
}

}
