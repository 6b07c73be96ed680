#include "Offcut.h"

#include "CoincidentNodes.h"
#include "ElementTopology.h"
#include "Relaxation.h"

#include <algorithm>
#include <map>

namespace trim
{
namespace
{

/// Places of a node dropped by the kept part: shares of the way from the new facet into the offcut.
constexpr std::array<double, 5> DropPlaces{ 0.15, 0.3, 0.45, 0.6, 0.8 };
/// A part of an element is taken for better only by this much.
constexpr double SmallestGain = 1e-3;

/// A node that the kept part dropped, and its neighbours along the cut.
struct DroppedNode
{
  int Node, Previous, Next;
};

class Fitter
{
public:
  Fitter(const TrimCase& given, const NodeMover& mover, const TrimmedBand& trimmed,
    const BandQuality& quality, double goal)
    : TheBand(given.TheBand)
    , TheColumns(given.TheColumns)
    , Aborted(AbortOf(given.Tell))
    , Mover(mover)
    , Trimmed(trimmed)
    , Quality(quality)
    , Goal(goal)
    , Slots(given.TheBand.NumberOfElements())
    , SplitCorner(given.TheBand.NumberOfElements(), -1)
    , Shared(given.TheBand.NumberOfNodes(), 0)
    , Members(given.TheColumns.Elements())
  {
  }

  Offcut Run()
  {
    this->TakeNodes();
    this->TakeElements();
    this->DropCollapsed();
    this->PlaceDropped();
    this->SplitBad(true);
    this->RelaxBad();
    this->SplitBad(false);
    this->Finish();
    return std::move(this->Result);
  }

private:
  /// Nodes of the kept part lie where it has them, all others where they were.
  void TakeNodes()
  {
    this->Result.NodeMoves = this->Trimmed.NodeMoves;
    const std::vector<int> users = CountUsers(this->TheBand, this->Trimmed);
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      this->Shared[n] = users[n] > 0;
      if (!this->Shared[n])
      {
        this->Result.NodeMoves.Position[n] = this->TheBand.Point[n];
        this->Result.NodeMoves.Applied[n] = Correction::None;
      }
    }
  }

  void TakeElements()
  {
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      if (!this->Trimmed.Kept[e])
      {
        this->Slots[e] = { this->TheBand.Elements[e].Count, this->TheBand.Elements[e].Node };
      }
    }
    for (const ReplacedElement& kept : this->Trimmed.Treated.Wedges)
    {
      RelaxedElement rest{ 6, {} };
      rest.Node = { kept.Node[2], kept.Dropped[0], kept.Node[0], kept.Node[5], kept.Dropped[1],
        kept.Node[3], -1, -1 };
      this->Slots[kept.Element] = rest;
      for (const int i : { 0, 3 })
      {
        const int node = rest.Node[i + 1];
        this->Dropped[this->TheColumns.Pillar[node]].push_back(
          { node, rest.Node[i], rest.Node[i + 2] });
      }
    }
  }

  /// Where nodes of the cut came to a corner of the model, columns of the offcut have lost a side:
  /// they do without the nodes that were there before, if no other elements have them.
  void DropCollapsed()
  {
    for (int column = 0; column < this->TheBand.NumberOfElements(); ++column)
    {
      const auto* first = this->Members.begin(column);
      const auto* last = this->Members.end(column);
      const bool whole = first != last &&
        std::all_of(first, last,
          [this](int e) { return this->Slots[e].Count == 8 && this->TheColumns.HasThickness(e); });
      for (int corner = 0; whole && corner < 4; ++corner)
      {
        const int pillar = this->PillarAt(*first, corner);
        if (this->IsOnlyIn(column, pillar) &&
          (this->HaveMet(column, pillar, this->PillarAt(*first, corner + 1)) ||
            this->HaveMet(column, pillar, this->PillarAt(*first, corner + 3))))
        {
          std::for_each(first, last,
            [&](int e) { this->Slots[e] = this->HalfOf(e, this->CornerAt(e, pillar) + 1, 0); });
          break;
        }
      }
    }
  }

  /// Calls test(element, node, end) for the nodes of a pillar in a column; false if one fails or
  /// an element does not have them.
  template <typename Test>
  bool AllOfPillar(int column, int pillar, const Test& test) const
  {
    return std::all_of(this->Members.begin(column), this->Members.end(column),
      [&](int e)
      {
        const int corner = this->CornerAt(e, pillar);
        return corner >= 0 && test(e, this->NodeAt(e, 0, corner), 0) &&
          test(e, this->NodeAt(e, 1, corner), 1);
      });
  }

  /// Whether no elements but those of a column have the nodes of a pillar.
  bool IsOnlyIn(int column, int pillar) const
  {
    return this->AllOfPillar(column, pillar,
      [&](int, int node, int)
      {
        const auto elements = this->TheBand.ElementsOfNode(node);
        return !this->Shared[node] &&
          std::all_of(elements.begin(), elements.end(),
            [&](int e) { return this->TheColumns.Column[e] == column; });
      });
  }

  /// Whether two pillars of a column have come together in all its layers.
  bool HaveMet(int column, int a, int b) const
  {
    return this->AllOfPillar(column, a,
      [&](int e, int node, int end)
      {
        const int corner = this->CornerAt(e, b);
        const int other = corner >= 0 ? this->NodeAt(e, end, corner) : -1;
        const auto distance = [node, other](const std::vector<Vec3>& at)
        { return (at[node] - at[other]).norm(); };
        return other >= 0 &&
          distance(this->Result.NodeMoves.Position) <
          SmallestDistanceShare * distance(this->TheBand.Point);
      });
  }

  ElementPoints Points(const RelaxedElement& element) const
  {
    return PointsAt(this->Result.NodeMoves.Position, element);
  }

  double QualityOf(const RelaxedElement& element) const
  {
    return ScaledJacobian(this->Points(element), element.Count);
  }

  double QualityRound(const std::vector<DroppedNode>& nodes) const
  {
    double quality = this->Goal;
    for (const auto& node : nodes)
    {
      for (const int e : this->TheBand.ElementsOfNode(node.Node))
      {
        if (this->Slots[e].Count > 0)
        {
          quality = std::min(quality, this->QualityOf(this->Slots[e]));
        }
      }
    }
    return quality;
  }

  /// Dropped nodes stay where they were or, where that leaves too little of their element, go
  /// into the offcut; all nodes of a pillar alike.
  void PlaceDropped()
  {
    for (const auto& pillar : this->Dropped)
    {
      const auto& nodes = pillar.second;
      const bool free = std::all_of(nodes.begin(), nodes.end(),
        [this](const DroppedNode& n)
        { return !this->Shared[n.Node] && this->Mover.MayRelax(n.Node, false); });
      double best = this->QualityRound(nodes);
      if (!free || best >= this->Goal)
      {
        continue;
      }
      std::vector<Vec3> places = this->PlacesOf(nodes);
      for (const double share : DropPlaces)
      {
        if (!this->Place(nodes, share))
        {
          this->Restore(nodes, places);
          continue;
        }
        const double quality = this->QualityRound(nodes);
        if (quality > best + SmallestGain)
        {
          best = quality;
          places = this->PlacesOf(nodes);
        }
        this->Restore(nodes, places);
      }
    }
  }

  std::vector<Vec3> PlacesOf(const std::vector<DroppedNode>& nodes) const
  {
    std::vector<Vec3> places;
    for (const auto& node : nodes)
    {
      places.push_back(this->Result.NodeMoves.Position[node.Node]);
    }
    return places;
  }

  void Restore(const std::vector<DroppedNode>& nodes, const std::vector<Vec3>& places)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      this->SetPlace(nodes[i].Node, places[i]);
    }
  }

  void SetPlace(int node, const Vec3& place)
  {
    this->Result.NodeMoves.Position[node] = place;
    this->Result.NodeMoves.Applied[node] =
      place != this->TheBand.Point[node] ? Correction::Relax : Correction::None;
  }

  bool Place(const std::vector<DroppedNode>& nodes, double share)
  {
    for (const auto& node : nodes)
    {
      const auto& position = this->Result.NodeMoves.Position;
      const Vec3 from = 0.5 * (position[node.Previous] + position[node.Next]);
      NodeFreedom freedom = this->Mover.FreedomOf(node.Node);
      Vec3 place;
      if (!this->Mover.Constrained(
            node.Node, freedom, from + share * (this->InsideOf(node.Node) - from), false, place))
      {
        return false;
      }
      this->SetPlace(node.Node, AsStored(this->TheBand, place));
    }
    return true;
  }

  /// The middle of the nodes beside a dropped one that only the offcut has, as they were.
  Vec3 InsideOf(int node) const
  {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      const int other = this->TheBand.OtherEnd(edge, node);
      if (this->Mover.IsLateral(node, other) && !this->Shared[other])
      {
        sum += this->TheBand.Point[other];
        ++count;
      }
    }
    return count > 0 ? Vec3(sum / count) : this->TheBand.Point[node];
  }

  bool Moved(const RelaxedElement& element) const
  {
    return std::any_of(element.begin(), element.end(),
      [this](int n) { return this->Result.NodeMoves.Applied[n] != Correction::None; });
  }

  /// Elements that have to become better; those that came as bad as they are do not.
  bool IsBad(int e) const
  {
    const auto& slot = this->Slots[e];
    if (slot.Count == 0 || (!this->Trimmed.Kept[e] && !this->Moved(slot)))
    {
      return false;
    }
    const ElementPoints points = this->Points(slot);
    return this->Quality.FallsBelowFloor(e, points, slot.Count) ||
      this->Quality.Spoils(e, points, slot.Count);
  }

  void RelaxBad()
  {
    std::vector<int> active;
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      if (this->SplitCorner[e] < 0 && this->IsBad(e))
      {
        active.push_back(e);
      }
    }
    if (active.empty())
    {
      return;
    }
    std::vector<char> fixed = this->Shared;
    std::vector<RelaxedElement> elements = this->Slots;
    for (std::size_t e = 0; e < elements.size(); ++e)
    {
      for (int i = 0; this->SplitCorner[e] >= 0 && i < elements[e].Count; ++i)
      {
        fixed[elements[e].Node[i]] = 1;
      }
      elements[e].Count = this->SplitCorner[e] >= 0 ? 0 : elements[e].Count;
    }
    const std::vector<char> onCut(this->Shared.size(), 0);
    Relax({ this->TheBand, this->Mover, elements, fixed, onCut, this->Aborted }, active,
      { this->Goal, this->Goal, Thorough }, this->Result.NodeMoves);
  }

  /// Divides columns that are bad into wedges where that is better.
  /// @param pinned only where the kept part has all three nodes of a corner: nothing else helps.
  void SplitBad(bool pinned)
  {
    for (int column = 0; column < this->TheBand.NumberOfElements(); ++column)
    {
      double whole = this->Goal;
      bool bad = false;
      bool divisible = this->Members.begin(column) != this->Members.end(column);
      for (auto* e = this->Members.begin(column); e != this->Members.end(column); ++e)
      {
        divisible = divisible && this->Slots[*e].Count == 8 && this->TheColumns.HasThickness(*e) &&
          this->SplitCorner[*e] < 0;
        if (!divisible)
        {
          break;
        }
        bad |= this->IsBad(*e);
        whole = std::min(whole, this->QualityOf(this->Slots[*e]));
      }
      if (divisible && bad)
      {
        this->SplitColumn(column, whole, pinned);
      }
    }
  }

  void SplitColumn(int column, double whole, bool pinned)
  {
    int best = -1;
    double quality = whole + SmallestGain;
    const int first = *this->Members.begin(column);
    for (int corner = 0; corner < 4; ++corner)
    {
      const int pillar = this->PillarAt(first, corner);
      double parts = this->Goal;
      bool mayBe = true;
      for (auto* e = this->Members.begin(column); e != this->Members.end(column); ++e)
      {
        const int k = this->CornerAt(*e, pillar);
        mayBe = mayBe && k >= 0 && (!pinned || this->IsPinned(*e, k));
        for (int half = 0; mayBe && half < 2; ++half)
        {
          parts = std::min(parts, this->QualityOf(this->HalfOf(*e, k, half)));
        }
      }
      if (mayBe && parts > quality)
      {
        quality = parts;
        best = pillar;
      }
    }
    for (auto* e = this->Members.begin(column); best >= 0 && e != this->Members.end(column); ++e)
    {
      this->SplitCorner[*e] = static_cast<signed char>(this->CornerAt(*e, best));
    }
  }

  int NodeAt(int e, int end, int corner) const
  {
    return this->Slots[e].Node[AxisEnds[this->TheColumns.Axis[e]][end][corner % 4]];
  }
  int PillarAt(int e, int corner) const
  {
    return this->TheColumns.Pillar[this->NodeAt(e, 0, corner)];
  }
  int CornerAt(int e, int pillar) const
  {
    for (int corner = 0; corner < 4; ++corner)
    {
      if (this->PillarAt(e, corner) == pillar)
      {
        return corner;
      }
    }
    return -1;
  }

  bool IsPinned(int e, int corner) const
  {
    for (const int k : { corner, corner + 1, corner + 3 })
    {
      if (!this->Shared[this->NodeAt(e, 0, k)] || !this->Shared[this->NodeAt(e, 1, k)])
      {
        return false;
      }
    }
    return true;
  }

  /// One of the two wedges at the diagonal from a corner.
  RelaxedElement HalfOf(int e, int corner, int half) const
  {
    RelaxedElement wedge{ 6, {} };
    wedge.Node.fill(-1);
    for (int end = 0; end < 2; ++end)
    {
      wedge.Node[3 * end] = this->NodeAt(e, end, corner);
      wedge.Node[3 * end + 1] = this->NodeAt(e, end, corner + 1 + half);
      wedge.Node[3 * end + 2] = this->NodeAt(e, end, corner + 2 + half);
    }
    return wedge;
  }

  void Finish()
  {
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      if (this->Slots[e].Count == 0)
      {
        continue;
      }
      std::vector<RelaxedElement> parts{ this->Slots[e] };
      if (this->SplitCorner[e] >= 0)
      {
        parts = { this->HalfOf(e, this->SplitCorner[e], 0),
          this->HalfOf(e, this->SplitCorner[e], 1) };
      }
      bool invalid = false;
      bool below = false;
      for (const auto& part : parts)
      {
        this->Result.Elements.push_back({ e, part.Count, part.Node });
        if (IsTouched(this->TheBand, this->Result, this->Result.Elements.back()))
        {
          const ElementPoints points = this->Points(part);
          invalid |= this->Quality.Spoils(e, points, part.Count);
          below |= this->Quality.FallsBelowFloor(e, points, part.Count);
        }
      }
      if (invalid || below)
      {
        (invalid ? this->Result.Invalid : this->Result.BelowFloor).push_back(e);
      }
    }
  }

  const Band& TheBand;
  const Columns& TheColumns;
  AbortCheck Aborted;
  const NodeMover& Mover;
  const TrimmedBand& Trimmed;
  const BandQuality& Quality;
  double Goal;
  std::vector<RelaxedElement> Slots;    ///< by element of the band; Count 0: not in the offcut
  std::vector<signed char> SplitCorner; ///< -1: whole
  std::vector<char> Shared;             ///< nodes that the kept part uses
  Band::Lists Members;                  ///< elements of each column
  std::map<int, std::vector<DroppedNode>> Dropped; ///< by pillar
  Offcut Result;
};

}

ElementPoints PointsOf(const Offcut& offcut, const OffcutElement& element)
{
  return PointsAt(offcut.NodeMoves.Position, element);
}

bool IsTouched(const Band& band, const Offcut& offcut, const OffcutElement& element)
{
  return element.Count != band.Elements[element.Element].Count ||
    std::any_of(element.begin(), element.end(),
      [&offcut](int n) { return offcut.NodeMoves.Applied[n] != Correction::None; });
}

std::vector<char> FindUsed(const Band& band, const Offcut& offcut)
{
  std::vector<char> used(band.NumberOfNodes(), 0);
  for (const auto& element : offcut.Elements)
  {
    for (int i = 0; i < element.Count; ++i)
    {
      used[element.Node[i]] = 1;
    }
  }
  return used;
}

Offcut FitOffcut(const TrimCase& given, const NodeMover& mover, const TrimmedBand& trimmed,
  const BandQuality& quality, double goal)
{
  return Fitter(given, mover, trimmed, quality, goal).Run();
}

}
