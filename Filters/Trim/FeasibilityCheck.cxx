#include "FeasibilityCheck.h"

#include "ElementChain.h"
#include "ElementTopology.h"
#include "OpenSeams.h"
#include "Runs.h"
#include "SortUnique.h"
#include "Status.h"

#include <vtkSMPTools.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{
using nurbs::Foot;
using nurbs::FootKind;

/// Radius of curvature, in elements, that nodes of the mesh can follow.
constexpr double SmallestRadius = 2.0;
/// Shares of an element, and of that radius, that rounding may take: it must not decide.
constexpr double Rounding = 1e-6;
/// Width of a hole or slot, in elements.
constexpr double SmallestWidth = 3.0;
/// Cosine of the smallest angle between surface and skin (45 degrees).
constexpr double SteepestCosine = 0.7071;
/// Sine of the angle between surface and skin below which there is no direction within the skin.
constexpr double SmallestSine = 0.05;
/// Within one element a surface of the smallest radius turns by 29 degrees (chord 1, radius 2).
/// What turns less between two crossings of an edge merely touches it.
constexpr double CrossingCosine = 0.866;
/// Cosine of the angle between a surface's normal and an edge below which it runs along the edge.
constexpr double AlongCosine = 0.05;
/// Normals within this angle of one direction turn less than that against each other.
constexpr double HalfCrossingAngle = 0.2618;
/// Between two nodes' feet the normal turns by at least 20 degrees where a bend is read off it;
/// beyond 120 degrees the feet lie on two opposite walls.
constexpr double SmallestTurnCosine = 0.940;
constexpr double LargestTurnCosine = -0.5;
constexpr double RightAngle = 0.5 * M_PI;
/// Share of a ray within which a hit is its own start.
constexpr double RayStart = 1e-3;

/// One element with what is measured in it.
struct Probe
{
  Id Cell = -1;
  int Count = 0;
  std::array<Id, 8> Node;
  std::array<Vec3, 8> Point;
  std::array<const Foot*, 8> Feet;
  Eigen::Matrix3d ToElements; ///< from a vector in space to one in elements
  Vec3 Skin = Vec3::Zero();   ///< unit normal of the skin, zero without thickness
  int Nearest = -1;           ///< node with the nearest foot that has a side

  bool HasSkin() const { return this->Skin.squaredNorm() > 0.0; }
  double InElements(const Vec3& v) const { return (this->ToElements * v).norm(); }
  /// The part of a direction within the skin, not normalised.
  Vec3 Within(const Vec3& v) const { return v - this->Skin * this->Skin.dot(v); }
};

/// Mean edges of a hexahedron by axis; of a wedge the axis and two sides of its triangles.
Eigen::Matrix3d MeanEdges(const Probe& probe)
{
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  const auto& topology = TopologyOf(probe.Count);
  if (probe.Count == 8)
  {
    for (const auto& edge : topology.Edges)
    {
      edges.col(edge.Axis) += 0.25 * (probe.Point[edge.Second] - probe.Point[edge.First]);
    }
    return edges;
  }
  for (int i = 0; i < 3; ++i)
  {
    edges.col(0) += (probe.Point[i + 3] - probe.Point[i]) / 3.0;
  }
  for (int i = 1; i < 3; ++i)
  {
    edges.col(i) = 0.5 * (probe.Point[i] - probe.Point[0] + probe.Point[i + 3] - probe.Point[3]);
  }
  return edges;
}

class Checker
{
public:
  Checker(const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const TrimResult& result)
    : Mesh(mesh)
    , Surface(surface)
    , Result(result)
  {
  }

  std::vector<std::pair<Id, Feasibility>> Run()
  {
    const auto& cells = this->Result.Nodes.CandidateCells;
    this->FindCrossedTwice();
    this->FindCellsAtSeams();
    std::vector<Feasibility> values(cells.size(), Feasibility::Fine);
    vtkSMPTools::For(0, static_cast<Id>(cells.size()), 64,
      [&](Id begin, Id end)
      {
        for (Id i = begin; i < end; ++i)
        {
          values[i] = this->Check(cells[i]);
        }
      });
    std::vector<std::pair<Id, Feasibility>> found;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (values[i] != Feasibility::Fine)
      {
        found.emplace_back(cells[i], values[i]);
      }
    }
    return found;
  }

private:
  using Edge = std::array<Id, 2>;

  /// The element of the band, or -1.
  int ElementOf(Id cell) const
  {
    return this->Result.Near ? this->Result.Near->Mesh.FindElement(cell) : -1;
  }

  /// False for an element that has no volume to measure by.
  bool MakeProbe(Id cell, Probe& probe) const
  {
    const auto& near = this->Result.Nodes.Near;
    probe.Cell = cell;
    probe.Count = this->Mesh.OrientedCell(cell, probe.Node);
    for (int i = 0; i < probe.Count; ++i)
    {
      probe.Point[i] = this->Mesh.Point(probe.Node[i]);
      probe.Feet[i] = &near.Feet[near.Find(probe.Node[i])];
      if (probe.Feet[i]->Kind == FootKind::Interior &&
        (probe.Nearest < 0 || probe.Feet[i]->Distance < probe.Feet[probe.Nearest]->Distance))
      {
        probe.Nearest = i;
      }
    }
    const Eigen::Matrix3d edges = MeanEdges(probe);
    const double volume = std::abs(edges.determinant());
    const double scale = edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
    if (probe.Nearest < 0 || !(volume > 1e-6 * scale))
    {
      return false;
    }
    probe.ToElements = edges.inverse();
    const int element = this->ElementOf(cell);
    const int axis = element < 0 ? -1 : this->Result.Near->SheetAxis[element];
    if (axis >= 0 && this->MeetsSkin(probe, element, axis))
    {
      probe.Skin = edges.col((axis + 1) % 3).cross(edges.col((axis + 2) % 3)).normalized();
    }
    return true;
  }

  /// False where the surface cuts an element between two skins that lie whole on one side, as the
  /// wall of a hole along a bar does: to the surface the element is one of a block.
  bool MeetsSkin(const Probe& probe, int element, int axis) const
  {
    const Band& band = this->Result.Near->Mesh;
    const auto& status = this->Result.Nodes.Status;
    const bool oneSided = std::all_of(probe.Node.begin(), probe.Node.begin() + probe.Count,
      [&](Id node) { return status[node] == status[probe.Node[0]]; });
    if (oneSided)
    {
      return true;
    }
    const Chain chain = MeasureChain(band, element, axis);
    std::array<bool, 3> met{};
    for (const int f : chain.EndFace)
    {
      const auto& face = band.Faces[f];
      std::for_each(face.begin(), face.end(), [&](int n) { met[band.NodeStatus[n]] = true; });
    }
    return met[NodeOnSurface] || met[NodeKeep] == met[NodeEliminate];
  }

  Feasibility Check(Id cell) const
  {
    if (std::binary_search(this->CellsAtSeams.begin(), this->CellsAtSeams.end(), cell))
    {
      return Feasibility::OpenSeam;
    }
    Probe probe;
    if (!this->MakeProbe(cell, probe))
    {
      return Feasibility::Fine;
    }
    const bool cut = this->Result.ElementStatus[cell] == ElementToTreat;
    const bool hidden = !cut && this->HoldsNearestFoot(probe);
    const bool narrow = (cut || hidden) && this->IsNarrow(probe);
    const bool twice = this->IsCrossedTwice(probe);
    if (this->IsInsideKept(probe) || ((twice || (hidden && narrow)) && this->StaysWhole(probe)))
    {
      return Feasibility::NotOpened;
    }
    // A tip that a node went to is not lost.
    if (twice && !this->IsAtFollowedEdge(probe))
    {
      return Feasibility::CrossedTwice;
    }
    if (narrow)
    {
      return Feasibility::Narrow;
    }
    if (cut && this->IsInclined(probe))
    {
      return Feasibility::Inclined;
    }
    return cut && this->IsCurved(probe) && !this->IsAtFollowedEdge(probe) ? Feasibility::Curved
                                                                          : Feasibility::Fine;
  }

  bool IsInclined(const Probe& probe) const
  {
    return std::abs(probe.Feet[probe.Nearest]->Normal.dot(probe.Skin)) > SteepestCosine;
  }

  /// By the curvature at the feet; and, for sharp edges of the surface and bends that no foot hits,
  /// by the turn of the normal between two feet.
  bool IsCurved(const Probe& probe) const
  {
    Box3 box;
    for (int i = 0; i < probe.Count; ++i)
    {
      box.extend(probe.Point[i]);
    }
    const auto isSmall = [](double radius) { return radius < (1.0 - Rounding) * SmallestRadius; };
    std::array<const Foot*, 8> inside;
    int count = 0;
    for (int i = 0; i < probe.Count; ++i)
    {
      const Foot& foot = *probe.Feet[i];
      if (foot.Kind != FootKind::Interior || !box.contains(foot.Point))
      {
        continue;
      }
      if (isSmall(this->RadiusInElements(probe, foot)) ||
        std::any_of(inside.begin(), inside.begin() + count,
          [&](const Foot* other) { return isSmall(MeanRadius(probe, foot, *other)); }))
      {
        return true;
      }
      inside[count++] = &foot;
    }
    return false;
  }

  /// Whether a node of the element or of one next to it went to a sharp edge of the surface.
  bool IsAtFollowedEdge(const Probe& probe) const
  {
    const int element = this->ElementOf(probe.Cell);
    if (element < 0 || this->Result.Near->Trimmed.OnCrease.empty())
    {
      return false;
    }
    const auto isThere = [this](int n) { return this->Result.Near->Trimmed.OnCrease[n] != 0; };
    return this->HasNode(element,
      [&](int node)
      {
        const auto at = this->Result.Near->Mesh.ElementsOfNode(node);
        return std::any_of(at.begin(), at.end(), [&](int e) { return this->HasNode(e, isThere); });
      });
  }

  /// In a sheet of the line in which surface and skin meet (its curvature is the surface's normal
  /// curvature over the sine of the angle between the two), else the smallest.
  double RadiusInElements(const Probe& probe, const Foot& foot) const
  {
    if (!probe.HasSkin())
    {
      return this->Surface.MappedRadiusOfCurvature(foot, probe.ToElements);
    }
    const Vec3 along = probe.Skin.cross(foot.Normal);
    const double sine = along.norm();
    if (sine < SmallestSine)
    {
      return SmallestRadius;
    }
    const double radius = this->Surface.RadiusOfCurvature(foot, along);
    return radius * sine * probe.InElements(along / sine);
  }

  /// Of the circle with the same chord and turn, in elements.
  static double MeanRadius(const Probe& probe, const Foot& a, const Foot& b)
  {
    const Vec3 na = probe.Within(a.Normal);
    const Vec3 nb = probe.Within(b.Normal);
    const double lengths = na.norm() * nb.norm();
    const double cosine = na.dot(nb);
    if (lengths < SmallestSine || cosine > SmallestTurnCosine * lengths ||
      cosine < LargestTurnCosine * lengths)
    {
      return SmallestRadius;
    }
    const double halfTurn = 0.5 * std::acos(cosine / lengths);
    return probe.InElements(probe.Within(a.Point - b.Point)) / (2.0 * std::sin(halfTurn));
  }

  /// Looks from the nearest foot across what is cut out, for the wall on the other side.
  bool IsNarrow(const Probe& probe) const
  {
    const Foot& foot = *probe.Feet[probe.Nearest];
    Vec3 across = probe.Within(foot.Normal);
    if (across.norm() < SmallestSine)
    {
      return false;
    }
    across *= SmallestWidth / probe.InElements(across);
    Box3 way(foot.Point);
    way.extend(Vec3(foot.Point + across));
    if (this->Surface.NormalsLieWithin(way, across.normalized(), RightAngle))
    {
      return false;
    }
    for (const auto& hit :
      this->Surface.Intersect(foot.Point, Vec3(foot.Point + across), RayStart, 1.0))
    {
      if (hit.Normal.dot(across) < 0.0)
      {
        return true;
      }
    }
    return false;
  }

  /// Whether the surface comes into the element though all its nodes are on one side: what lies
  /// beyond it right there is in the element. One that touches it from outside does not.
  static bool HoldsNearestFoot(const Probe& probe)
  {
    const auto& topology = TopologyOf(probe.Count);
    Vec3 centre = Vec3::Zero();
    for (int i = 0; i < probe.Count; ++i)
    {
      centre += probe.Point[i] / probe.Count;
    }
    const Foot& foot = *probe.Feet[probe.Nearest];
    const Vec3 x = foot.Point + foot.Normal * (RayStart / probe.InElements(foot.Normal));
    for (int f = 0; f < topology.NumberOfFaces; ++f)
    {
      const auto& face = topology.Faces[f];
      const auto corner = [&](int i) -> const Vec3& { return probe.Point[face.Node[i]]; };
      const Vec3 normal = face.Count == 4 ? (corner(2) - corner(0)).cross(corner(3) - corner(1))
                                          : (corner(1) - corner(0)).cross(corner(2) - corner(0));
      Vec3 middle = Vec3::Zero();
      for (int i = 0; i < face.Count; ++i)
      {
        middle += corner(i) / face.Count;
      }
      if (normal.dot(x - middle) * normal.dot(centre - middle) < 0.0)
      {
        return false;
      }
    }
    return true;
  }

  /// A kept element none of whose nodes is beyond the surface or has to move.
  bool StaysWhole(const Probe& probe) const
  {
    const int element = this->ElementOf(probe.Cell);
    if (element >= 0 && !this->Result.Near->Trimmed.Kept[element])
    {
      return false;
    }
    const auto& status = this->Result.Nodes.Status;
    if (std::any_of(probe.Node.begin(), probe.Node.begin() + probe.Count,
          [&status](Id node) { return status[node] == NodeEliminate; }))
    {
      return false;
    }
    return element < 0 ||
      !this->HasNode(
        element, [this](int node) { return this->Result.Near->Trimmed.Moving[node] != 0; });
  }

  /// Whether a node of an element of the band passes a test.
  template <typename Test>
  bool HasNode(int element, const Test& test) const
  {
    const auto& shape = this->Result.Near->Mesh.Elements[element];
    return std::any_of(shape.begin(), shape.end(), test);
  }

  /// Whether a node of the element lies beyond the surface with only kept elements round it,
  /// off the border of the model.
  bool IsInsideKept(const Probe& probe) const
  {
    const int element = this->ElementOf(probe.Cell);
    return element >= 0 &&
      this->HasNode(element,
        [this](int node) {
          return this->Result.Near->Mesh.NodeStatus[node] == NodeEliminate &&
            this->HasOnlyKept(node);
        });
  }

  bool HasOnlyKept(int node) const
  {
    const auto& near = *this->Result.Near;
    for (const int e : near.Mesh.ElementsOfNode(node))
    {
      if (!near.Trimmed.Kept[e])
      {
        return false;
      }
    }
    // Under a surface that leans by more than an element, nodes beyond it go behind the cut.
    const bool wentBehind = near.Trimmed.NodeMoves.Applied[node] == Correction::Relax &&
      this->Surface.ClosestPoint(near.Trimmed.NodeMoves.Position[node]).SignedDistance <=
        Rounding * LongestEdgeAt(near.Mesh, node);
    return !wentBehind && !near.Structure.IsOnBorder(near.Mesh, node);
  }

  /// Whether the surface certainly turns too little near a cell to cross an edge of it twice.
  bool IsFlatAt(Id cell) const
  {
    const auto& near = this->Result.Nodes.Near;
    const Vec3& normal = near.Feet[near.Find(this->Mesh.FirstNode(cell))].Normal;
    return this->Surface.NormalsLieWithin(CellBox(this->Mesh, cell), normal, HalfCrossingAngle);
  }

  /// Edges near enough to the surface to be crossed: it is nowhere nearer to a node than its foot.
  std::vector<Edge> FindNearEdges() const
  {
    const auto& near = this->Result.Nodes.Near;
    const auto& cells = this->Result.Nodes.CandidateCells;
    std::vector<char> flat(cells.size());
    ForAll(static_cast<int>(cells.size()), [&](int i) { flat[i] = this->IsFlatAt(cells[i]); });
    std::vector<Edge> edges;
    std::array<Id, 8> nodes;
    for (std::size_t at = 0; at < cells.size(); ++at)
    {
      if (flat[at])
      {
        continue;
      }
      const Id c = cells[at];
      const auto& topology = TopologyOf(this->Mesh.OrientedCell(c, nodes));
      std::array<double, 8> distance;
      for (int i = 0; i < topology.NumberOfNodes; ++i)
      {
        distance[i] = near.Feet[near.Find(nodes[i])].Distance;
      }
      for (int i = 0; i < topology.NumberOfEdges; ++i)
      {
        const auto& edge = topology.Edges[i];
        const Id a = nodes[edge.First];
        const Id b = nodes[edge.Second];
        const bool within = this->Result.Nodes.Status[a] == NodeOnSurface &&
          this->Result.Nodes.Status[b] == NodeOnSurface;
        if (!within &&
          distance[edge.First] + distance[edge.Second] <=
            (this->Mesh.Point(a) - this->Mesh.Point(b)).norm())
        {
          edges.push_back({ std::min(a, b), std::max(a, b) });
        }
      }
    }
    SortUnique(edges);
    return edges;
  }

  /// From the end that comes first by its place, so that the numbering has no say; without those at
  /// which the surface runs along the edge, as a side of a contour on a line of the mesh does.
  std::vector<nurbs::LineHit> Crossings(const Edge& edge) const
  {
    const Vec3 a = this->Mesh.Point(edge[0]);
    const Vec3 b = this->Mesh.Point(edge[1]);
    auto hits = LiesBefore(a, b) ? this->Surface.Intersect(a, b) : this->Surface.Intersect(b, a);
    const Vec3 way = (b - a).normalized();
    hits.erase(
      std::remove_if(hits.begin(), hits.end(),
        [&way](const nurbs::LineHit& hit) { return std::abs(hit.Normal.dot(way)) < AlongCosine; }),
      hits.end());
    return hits;
  }

  void FindCrossedTwice()
  {
    const std::vector<Edge> edges = this->FindNearEdges();
    std::vector<char> twice(edges.size(), 0);
    vtkSMPTools::For(0, static_cast<Id>(edges.size()), 256,
      [&](Id begin, Id end)
      {
        for (Id i = begin; i < end; ++i)
        {
          const auto hits = this->Crossings(edges[i]);
          for (std::size_t k = 1; k < hits.size(); ++k)
          {
            twice[i] |= hits[k].Normal.dot(hits[k - 1].Normal) < CrossingCosine;
          }
        }
      });
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
      if (twice[i])
      {
        this->CrossedTwice.push_back(edges[i]);
      }
    }
  }

  void FindCellsAtSeams()
  {
    const std::vector<int> seams =
      this->Result.Near ? FindOpenSeams(*this->Result.Near) : std::vector<int>();
    for (const int e : seams)
    {
      this->CellsAtSeams.push_back(this->Result.Near->Mesh.Elements[e].Global);
    }
    std::sort(this->CellsAtSeams.begin(), this->CellsAtSeams.end());
  }

  /// Whether the surface crosses a face twice, for all its nodes tell.
  bool HasMixedFace(const Probe& probe) const
  {
    const auto& faces = TopologyOf(probe.Count).Faces;
    const auto& status = this->Result.Nodes.Status;
    return std::any_of(faces.begin(), faces.end(),
      [&](const FaceNodes& face) {
        return face.Count == 4 &&
          LieByTurns([&](int i) { return status[probe.Node[face.Node[i]]]; });
      });
  }

  bool IsCrossedTwice(const Probe& probe) const
  {
    if (this->HasMixedFace(probe))
    {
      return true;
    }
    const auto& topology = TopologyOf(probe.Count);
    for (int i = 0; i < topology.NumberOfEdges && !this->CrossedTwice.empty(); ++i)
    {
      const Id a = probe.Node[topology.Edges[i].First];
      const Id b = probe.Node[topology.Edges[i].Second];
      if (std::binary_search(this->CrossedTwice.begin(), this->CrossedTwice.end(),
            Edge{ std::min(a, b), std::max(a, b) }))
      {
        return true;
      }
    }
    return false;
  }

  const HexMesh& Mesh;
  const nurbs::TrimmingSurface& Surface;
  const TrimResult& Result;
  std::vector<Edge> CrossedTwice; ///< ascending
  std::vector<Id> CellsAtSeams;   ///< ascending
};

}

std::vector<std::pair<Id, Feasibility>> CheckFeasibility(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, const TrimResult& result)
{
  return Checker(mesh, surface, result).Run();
}

}
