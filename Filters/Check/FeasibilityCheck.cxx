#include "FeasibilityCheck.h"

#include "BorderBridges.h"
#include "BorderChords.h"
#include "CrossedEdges.h"
#include "Curvature.h"
#include "ElementProbe.h"
#include "ElementTopology.h"
#include "NodeMover.h"
#include "OpenSeams.h"
#include "PartedStrips.h"
#include "PlacesAstray.h"
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
/// Between two nodes' feet the normal turns by at least as much as at a sharp edge where a bend is
/// read off it; beyond 120 degrees the feet lie on two opposite walls.
constexpr double LargestTurnCosine = -0.5;
constexpr double RightAngle = 0.5 * M_PI;
/// A node that went to a sharp edge is that near, in elements, to the planes on either side of it:
/// more than these bend away within an element.
constexpr double EdgeReach = 0.5;
/// Share of a ray within which a hit is its own start.
constexpr double RayStart = 1e-3;

class Checker
{
public:
  Checker(const HexMesh& mesh, const Ranks& ranks, const nurbs::TrimmingSurface& surface,
    const TrimResult& result)
    : Mesh(mesh)
    , All(ranks)
    , Surface(surface)
    , Result(result)
    , Crossed(FindCrossedEdges(mesh, surface, result.Nodes))
  {
  }

  /// Collective.
  std::vector<std::pair<Id, Feasibility>> Run()
  {
    const auto& cells = this->Result.Nodes.CandidateCells;
    if (this->Result.Near)
    {
      const TrimBand& near = *this->Result.Near;
      this->CellsAtSeams = CellsOf(near.Mesh, FindOpenSeams(near));
      this->CellsOfStrips = CellsOf(WithoutLayer(near.Mesh), FindPartedStrips(near));
    }
    std::vector<Feasibility> values(cells.size(), Feasibility::Fine);
    const int last = static_cast<int>(cells.size()) - 1;
    ForAll(
      last + 1,
      [&](int i)
      {
        // The cells lie here and there, so that the processor does not foresee them.
        constexpr int cellsAhead = 6, pointsAhead = 3;
        this->Mesh.PrefetchCell(cells[std::min(i + cellsAhead, last)]);
        this->Mesh.PrefetchPoints(cells[std::min(i + pointsAhead, last)]);
        values[i] = this->Check(cells[i]);
      },
      64);
    std::vector<std::pair<Id, Feasibility>> found;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (values[i] != Feasibility::Fine)
      {
        found.emplace_back(cells[i], values[i]);
      }
    }
    this->AddChords(found);
    return found;
  }

private:
  static bool IsIn(const std::vector<Id>& cells, Id cell)
  {
    return std::binary_search(cells.begin(), cells.end(), cell);
  }

  /// Adds cells with long chords of the surface, or of a bend of the border, cut or not, of which
  /// nothing else is told. Collective.
  /// @param[in,out] found by ascending cell.
  void AddChords(std::vector<std::pair<Id, Feasibility>>& found) const
  {
    if (!this->Result.Near)
    {
      return;
    }
    const TrimBand& near = *this->Result.Near;
    std::vector<int> chords =
      FindLongChords(near, this->Result.Nodes.Near, this->Surface, this->All);
    const std::vector<int> bridges = FindBridges(near.Mesh, this->Surface, near.Trimmed);
    chords.insert(chords.end(), bridges.begin(), bridges.end());
    const auto known = static_cast<std::ptrdiff_t>(found.size());
    for (const Id cell : CellsOf(near.Mesh, chords))
    {
      const auto at = std::lower_bound(found.begin(), found.begin() + known, cell,
        [](const auto& told, Id other) { return told.first < other; });
      if (cell >= 0 && (at == found.begin() + known || at->first != cell))
      {
        found.emplace_back(cell, Feasibility::Curved);
      }
    }
    std::inplace_merge(found.begin(), found.begin() + known, found.end());
  }

  Feasibility Check(Id cell) const
  {
    if (IsIn(this->CellsAtSeams, cell))
    {
      return Feasibility::OpenSeam;
    }
    if (IsIn(this->CellsOfStrips, cell))
    {
      return Feasibility::CrossedTwice;
    }
    ElementProbe probe;
    if (!MakeProbe(this->Mesh, this->Result, cell, probe))
    {
      return Feasibility::Fine;
    }
    if (HasEdge(probe, this->Crossed.AgainstSides))
    {
      return Feasibility::CrossedTwice;
    }
    const bool cut = this->Result.ElementStatus[cell] == ElementToTreat;
    const bool hidden = !cut && probe.HoldsNearestFoot();
    const bool narrow = (cut || hidden) && this->IsNarrow(probe);
    const bool twice = this->IsCrossedTwice(probe);
    if (this->IsInsideKept(probe) || ((twice || (hidden && narrow)) && this->StaysWhole(probe)))
    {
      return Feasibility::NotOpened;
    }
    if (twice && !this->IsAtFollowedTip(probe))
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
    // Under a surface that leans columns carry their elements to where others went.
    if (cut && this->IsLostTip(probe))
    {
      return Feasibility::CrossedTwice;
    }
    return cut && this->IsCurved(probe) ? Feasibility::Curved : Feasibility::Fine;
  }

  bool IsInclined(const ElementProbe& probe) const
  {
    return std::abs(probe.Feet[probe.Nearest]->Normal.dot(probe.Skin)) > SteepestCosine;
  }

  /// By the curvature at the feet; and, for sharp edges of the surface and bends that no foot hits,
  /// by the turn of the normal between two feet. Not where a node went to the edge.
  bool IsCurved(const ElementProbe& probe) const
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
      if ((isSmall(this->RadiusInElements(probe, foot)) && !this->IsAtFollowedEdge(probe)) ||
        std::any_of(inside.begin(), inside.begin() + count,
          [&](const Foot* other)
          {
            return isSmall(MeanRadius(probe, foot, *other)) &&
              !this->IsFollowedBetween(probe, foot, *other);
          }))
      {
        return true;
      }
      inside[count++] = &foot;
    }
    return false;
  }

  /// Whether a node of the element or of one next to it went to a sharp edge of the surface.
  bool IsAtFollowedEdge(const ElementProbe& probe) const
  {
    return this->HasFollowedEdge(probe, [](int) { return true; });
  }

  /// What lies between two walls of the surface is not lost where they meet in an edge that a node
  /// went to. The one that went to an edge may have gone to another.
  bool IsAtFollowedTip(const ElementProbe& probe) const
  {
    return this->IsAtFollowedEdge(probe) && !this->IsAstrayBetween(probe);
  }

  bool IsLostTip(const ElementProbe& probe) const
  {
    return probe.Element >= 0 && trim::IsLostTip(*this->Result.Near, probe.Element);
  }

  /// Whether what the surface has between two crossings is not as it has it, in the middle of all
  /// edges of the element that go the same way: a skin that bends is another one after the trim.
  bool IsAstrayBetween(const ElementProbe& probe) const
  {
    std::array<Vec3, 3> sum;
    sum.fill(Vec3::Zero());
    std::array<int, 3> count{};
    const auto& topology = TopologyOf(probe.Count);
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const auto& edge = topology.Edges[i];
      const Id a = probe.Node[edge.First];
      const Id b = probe.Node[edge.Second];
      for (const Vec3& place :
        PlacesBetweenCrossings(this->Mesh, this->Surface, { std::min(a, b), std::max(a, b) }))
      {
        sum[edge.Axis] += place;
        ++count[edge.Axis];
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (count[axis] > 0 &&
        IsAstray(*this->Result.Near, this->Surface, probe.Element, sum[axis] / count[axis]))
      {
        return true;
      }
    }
    return false;
  }

  /// Like IsAtFollowedEdge for the edge between two feet, and no other: a notch has several side by
  /// side.
  bool IsFollowedBetween(const ElementProbe& probe, const Foot& a, const Foot& b) const
  {
    return this->HasFollowedEdge(probe,
      [&](int node)
      {
        const Vec3& place = this->Result.Near->Trimmed.NodeMoves.Position[node];
        const auto isIn = [&](const Foot& foot)
        {
          const Vec3 off = foot.Normal * foot.Normal.dot(place - foot.Point);
          return probe.InElements(off) < EdgeReach;
        };
        return isIn(a) && isIn(b);
      });
  }

  /// @param isIt isIt(node) says whether the edge that a node went to counts.
  template <typename IsIt>
  bool HasFollowedEdge(const ElementProbe& probe, const IsIt& isIt) const
  {
    const int element = probe.Element;
    if (element < 0 || this->Result.Near->Trimmed.OnCrease.empty())
    {
      return false;
    }
    const auto isThere = [&](int n)
    { return this->Result.Near->Trimmed.OnCrease[n] != 0 && isIt(n); };
    return this->HasNode(element,
      [&](int node)
      {
        const auto at = this->Result.Near->Mesh.ElementsOfNode(node);
        return std::any_of(at.begin(), at.end(), [&](int e) { return this->HasNode(e, isThere); });
      });
  }

  /// In a sheet of the line in which surface and skin meet (its curvature is the surface's normal
  /// curvature over the sine of the angle between the two), else the smallest.
  double RadiusInElements(const ElementProbe& probe, const Foot& foot) const
  {
    if (!probe.HasSkin())
    {
      return nurbs::RadiusOfCurvature(this->Surface, foot, probe.ToElements);
    }
    const Vec3 along = probe.Skin.cross(foot.Normal);
    const double sine = along.norm();
    if (sine < SmallestSine)
    {
      return SmallestRadius;
    }
    const double radius = nurbs::RadiusOfCurvatureAlong(this->Surface, foot, along);
    return radius * sine * probe.InElements(along / sine);
  }

  /// Of the circle with the same chord and turn, in elements.
  static double MeanRadius(const ElementProbe& probe, const Foot& a, const Foot& b)
  {
    const Vec3 na = probe.Within(a.Normal);
    const Vec3 nb = probe.Within(b.Normal);
    const double lengths = na.norm() * nb.norm();
    const double cosine = na.dot(nb);
    if (lengths < SmallestSine || cosine > CreaseCosine * lengths ||
      cosine < LargestTurnCosine * lengths)
    {
      return SmallestRadius;
    }
    const double halfTurn = 0.5 * std::acos(cosine / lengths);
    return probe.InElements(probe.Within(a.Point - b.Point)) / (2.0 * std::sin(halfTurn));
  }

  /// Looks from the nearest foot across what is cut out, for the wall on the other side.
  bool IsNarrow(const ElementProbe& probe) const
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

  /// A kept element none of whose nodes is beyond the surface or has to move.
  bool StaysWhole(const ElementProbe& probe) const
  {
    const int element = probe.Element;
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
  bool IsInsideKept(const ElementProbe& probe) const
  {
    const int element = probe.Element;
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

  /// Those that the elements are, or on whose faces they were inserted; ascending.
  static std::vector<Id> CellsOf(const Band& band, const std::vector<int>& elements)
  {
    std::vector<Id> cells(elements.size());
    std::transform(
      elements.begin(), elements.end(), cells.begin(), [&band](int e) { return CellOf(band, e); });
    SortUnique(cells);
    return cells;
  }

  /// Whether the surface crosses a face twice, for all its nodes tell.
  bool HasMixedFace(const ElementProbe& probe) const
  {
    const auto& faces = TopologyOf(probe.Count).Faces;
    const auto& status = this->Result.Nodes.Status;
    return std::any_of(faces.begin(), faces.end(),
      [&](const FaceNodes& face) {
        return face.Count == 4 &&
          LieByTurns([&](int i) { return status[probe.Node[face.Node[i]]]; });
      });
  }

  bool IsCrossedTwice(const ElementProbe& probe) const
  {
    return this->HasMixedFace(probe) || HasEdge(probe, this->Crossed.Twice);
  }

  /// @param edges ascending.
  static bool HasEdge(const ElementProbe& probe, const std::vector<MeshEdge>& edges)
  {
    const auto& topology = TopologyOf(probe.Count);
    for (int i = 0; i < topology.NumberOfEdges && !edges.empty(); ++i)
    {
      const Id a = probe.Node[topology.Edges[i].First];
      const Id b = probe.Node[topology.Edges[i].Second];
      if (std::binary_search(
            edges.begin(), edges.end(), MeshEdge{ std::min(a, b), std::max(a, b) }))
      {
        return true;
      }
    }
    return false;
  }

  const HexMesh& Mesh;
  const Ranks& All;
  const nurbs::TrimmingSurface& Surface;
  const TrimResult& Result;
  CrossedEdges Crossed;
  std::vector<Id> CellsAtSeams, CellsOfStrips; ///< ascending
};

}

std::vector<std::pair<Id, Feasibility>> CheckFeasibility(const HexMesh& mesh, const Ranks& ranks,
  const nurbs::TrimmingSurface& surface, const TrimResult& result)
{
  return Checker(mesh, ranks, surface, result).Run();
}

}
