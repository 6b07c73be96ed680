#include "Decision.h"

#include "Jacobian.h"
#include "Manifold.h"
#include "SortUnique.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace trim
{
namespace
{

/// An element whose nodes all go to the surface collapses when less than this is left of it.
constexpr double CollapsedShare = 0.2;
/// Shares are known to this where places are, and at least to the coarser one.
constexpr double ShareRounding = 1e-9, CoarsestRounding = 1e-2;
/// Sweeps of mending; in the later half elements are only eliminated, so that it ends.
constexpr int MendingSweeps = 20;

/// A node with more elements has no pattern.
constexpr std::size_t MostInPattern = 64;

}

Decision::Decision(const Band& band, const Columns& columns, const VolumeShares& shares,
  const nurbs::TrimmingSurface& surface, double threshold, bool movesNodes)
  : TheBand(band)
  , TheColumns(columns)
  , Shares(shares)
  , Surface(surface)
  , Threshold(threshold)
  , MovesNodes(movesNodes)
  , Members(columns.Elements())
  , Moving(band, columns)
  , Whole(band.NumberOfElements(), 1)
  , Collapsing(band.NumberOfElements(), Unknown)
{
  this->FindInnerNodes();
}

const std::vector<char>& Decision::Take(const std::vector<Fate>& fate)
{
  return this->Taken.At(fate, [&] { return this->TakeAnew(fate); });
}

std::vector<char> Decision::TakeAnew(const std::vector<Fate>& fate)
{
  std::vector<char> kept(this->TheBand.NumberOfElements());
  for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
  {
    const int column = this->TheColumns.Column[e];
    kept[e] = fate[column] == Fate::ByVolume ? this->StaysByVolume(e) : fate[column] == Fate::Keep;
  }
  if (this->MovesNodes)
  {
    this->EliminateLostBorders(fate, kept);
  }
  for (int sweep = 0; sweep < MendingSweeps; ++sweep)
  {
    const bool onlyEliminate = sweep >= MendingSweeps / 2;
    const bool collapsed = this->MovesNodes && this->EliminateCollapsing(fate, kept);
    const bool pinched = this->MendPinches(onlyEliminate, kept);
    if (!collapsed && !pinched)
    {
      break;
    }
  }
  return kept;
}

/// Rounding must not decide: a share that equals the threshold stays (V^e <= 50 %: keep), but none
/// of a column that lies beyond as a whole.
bool Decision::StaysByVolume(int e) const
{
  const double share = this->Shares.Column[e];
  if (std::abs(share - this->Threshold) > 3.0 * CoarsestRounding)
  {
    return share < this->Threshold;
  }
  const double rounding = this->RoundingOf(this->TheColumns.Column[e]);
  return share <= std::min(this->Threshold, 1.0 - 2.0 * rounding) + rounding;
}

/// What the shares of a column are known to: floats, and places far from the origin, tell less.
double Decision::RoundingOf(int column) const
{
  double rounding = ShareRounding;
  for (const int e : this->ElementsOf(column))
  {
    const auto& element = this->TheBand.Elements[e];
    const auto& topology = TopologyOf(element.Count);
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const int a = element.Node[topology.Edges[i].First];
      const int b = element.Node[topology.Edges[i].Second];
      const double length = (this->TheBand.Point[b] - this->TheBand.Point[a]).norm();
      rounding = std::max(rounding, 4.0 * SpacingAt(this->TheBand, a) / length);
    }
  }
  return std::min(rounding, CoarsestRounding);
}

/// Nodes near the cut whose elements are all in the band.
void Decision::FindInnerNodes()
{
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    const auto elements = this->TheBand.ElementsOfNode(n);
    const bool inner = std::none_of(
      elements.begin(), elements.end(), [this](int e) { return this->TheBand.InHalo(e); });
    bool mixed = false;
    for (const int e : elements)
    {
      mixed |= this->TheBand.Elements[e].Ring <= 2;
    }
    if (inner && mixed)
    {
      this->InnerNodes.push_back(n);
    }
  }
  this->NotPinched.assign(this->InnerNodes.size(), 0);
}

void Decision::SetColumn(int column, char to, std::vector<char>& kept) const
{
  for (const int e : this->ElementsOf(column))
  {
    kept[e] = to;
  }
}

/// Kept columns that lose a whole side on the border of the mesh: their nodes there could reach
/// the surface only by leaving the border. Those behind come out to the surface instead; where
/// there are none, as in a strip of one element, the volume decides.
void Decision::EliminateLostBorders(const std::vector<Fate>& fate, std::vector<char>& kept) const
{
  const LostSides lost = this->FindLostSides(fate, kept);
  if (lost.empty())
  {
    return;
  }
  for (const int column : this->FindBacked(lost, kept))
  {
    this->SetColumn(column, 0, kept);
  }
}

Decision::LostSides Decision::FindLostSides(
  const std::vector<Fate>& fate, const std::vector<char>& kept) const
{
  // By column and the two pillars that bound the side; in a block by element and face.
  std::map<std::array<int, 3>, bool> lostSides;
  for (std::size_t f = 0; f < this->TheBand.Faces.size(); ++f)
  {
    const auto& face = this->TheBand.Faces[f];
    const int e = face.Element[0];
    if (!face.Exterior || !kept[e] || fate[this->TheColumns.Column[e]] == Fate::Keep ||
      this->TheColumns.IsLayerFace(this->TheBand, static_cast<int>(f)))
    {
      continue;
    }
    const bool ofColumn = this->TheColumns.HasThickness(e);
    std::array<int, 3> side{ this->TheColumns.Column[e],
      ofColumn ? std::numeric_limits<int>::max() : static_cast<int>(f), -1 };
    bool keeps = false;
    bool eliminates = false;
    for (int i = 0; i < face.Count; ++i)
    {
      if (ofColumn)
      {
        const int pillar = this->TheColumns.Pillar[face.Node[i]];
        side[1] = std::min(side[1], pillar);
        side[2] = std::max(side[2], pillar);
      }
      keeps |= this->TheBand.NodeStatus[face.Node[i]] == NodeKeep;
      eliminates |= this->TheBand.NodeStatus[face.Node[i]] == NodeEliminate;
    }
    const bool lost = !keeps && eliminates;
    const auto known = lostSides.emplace(side, lost);
    known.first->second = known.first->second && lost;
  }
  LostSides lost;
  for (const auto& [side, isLost] : lostSides)
  {
    if (isLost)
    {
      auto& pillars = lost[side[0]];
      const bool ofColumn = side[2] >= 0;
      const auto& face = this->TheBand.Faces[ofColumn ? 0 : side[1]];
      ofColumn ? pillars.insert(pillars.end(), { side[1], side[2] })
               : pillars.insert(pillars.end(), face.begin(), face.end());
    }
  }
  return lost;
}

/// Columns of those that lose a side that have a kept one behind it: opposite, or beside a wedge.
std::vector<int> Decision::FindBacked(const LostSides& lost, const std::vector<char>& kept) const
{
  std::vector<int> backed;
  for (std::size_t f = 0; f < this->TheBand.Faces.size(); ++f)
  {
    const auto& face = this->TheBand.Faces[f];
    for (int side = 0; side < 2 && !face.Exterior; ++side)
    {
      const int e = face.Element[side];
      const int behind = face.Element[1 - side];
      const auto known = e < 0 ? lost.end() : lost.find(this->TheColumns.Column[e]);
      if (known == lost.end() || this->TheColumns.IsLayerFace(this->TheBand, static_cast<int>(f)) ||
        (behind >= 0 && (!kept[behind] || lost.count(this->TheColumns.Column[behind]) > 0)))
      {
        continue;
      }
      const auto isLost = [&](int node)
      {
        const auto& pillars = known->second;
        return std::find(pillars.begin(), pillars.end(), this->TheColumns.Pillar[node]) !=
          pillars.end();
      };
      if (this->TheBand.Elements[e].Count == 6 || std::none_of(face.begin(), face.end(), isLost))
      {
        backed.push_back(known->first);
      }
    }
  }
  SortUnique(backed);
  return backed;
}

/// Kept columns whose nodes all go to the surface and leave nothing between them.
bool Decision::EliminateCollapsing(const std::vector<Fate>& fate, std::vector<char>& kept)
{
  const auto& moving = this->Moving.Find(kept);
  bool changed = false;
  for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
  {
    const auto& element = this->TheBand.Elements[e];
    const int column = this->TheColumns.Column[e];
    if (!kept[e] || fate[column] == Fate::Keep)
    {
      continue;
    }
    bool all = true;
    for (int i = 0; i < element.Count && all; ++i)
    {
      all = moving[element.Node[i]] || this->TheBand.NodeStatus[element.Node[i]] == NodeOnSurface;
    }
    if (all && this->Collapses(e))
    {
      this->SetColumn(column, 0, kept);
      changed = true;
    }
  }
  return changed;
}

bool Decision::Collapses(int e)
{
  if (this->Collapsing[e] == Unknown)
  {
    const auto& element = this->TheBand.Elements[e];
    const ElementPoints before = PointsOf(this->TheBand, e);
    ElementPoints after;
    for (int i = 0; i < element.Count; ++i)
    {
      // A node that the tolerance takes for on the surface stays where it is.
      const bool stays = this->TheBand.NodeStatus[element.Node[i]] == NodeOnSurface;
      after[i] = stays ? before[i] : this->Surface.ClosestPoint(before[i]).Point;
    }
    this->Collapsing[e] =
      VolumeOf(after, element.Count) < CollapsedShare * VolumeOf(before, element.Count);
  }
  return this->Collapsing[e] != 0;
}

/// Whether what is kept is no manifold at a node, where the whole mesh is one; where it is none
/// either, whether other edges than those of the whole join what is kept.
bool Decision::MakesPinch(int node, const std::vector<char>& kept) const
{
  if (IsManifoldAt(this->TheBand, kept, node))
  {
    return false;
  }
  if (IsManifoldAt(this->TheBand, this->Whole, node))
  {
    return true;
  }
  const std::vector<int> whole = FindPinchedEdgesAt(this->TheBand, this->Whole, node);
  const std::vector<int> now = FindPinchedEdgesAt(this->TheBand, kept, node);
  return !std::includes(whole.begin(), whole.end(), now.begin(), now.end());
}

/// The same, remembered.
bool Decision::IsPinched(std::size_t inner, const std::vector<char>& kept)
{
  const int node = this->InnerNodes[inner];
  const auto elements = this->TheBand.ElementsOfNode(node);
  const auto count = static_cast<std::size_t>(elements.size());
  std::uint64_t pattern = 0;
  std::size_t numberKept = 0;
  for (const int e : elements)
  {
    pattern = pattern << 1 | (kept[e] != 0);
    numberKept += kept[e] != 0;
  }
  if (numberKept == 0 || numberKept == count ||
    (count <= MostInPattern && this->NotPinched[inner] == pattern))
  {
    return false;
  }
  const bool pinched = this->MakesPinch(node, kept);
  if (!pinched)
  {
    this->NotPinched[inner] = pattern;
  }
  return pinched;
}

bool Decision::MendPinches(bool onlyEliminate, std::vector<char>& kept)
{
  bool changed = false;
  for (std::size_t i = 0; i < this->InnerNodes.size(); ++i)
  {
    if (this->IsPinched(i, kept))
    {
      changed |= this->MendPinch(this->InnerNodes[i], onlyEliminate, kept);
    }
  }
  return changed;
}

/// Turns round the column at the node whose share is nearest to the threshold.
bool Decision::MendPinch(int node, bool onlyEliminate, std::vector<char>& kept) const
{
  std::vector<std::pair<double, int>> candidates;
  for (const int e : this->TheBand.ElementsOfNode(node))
  {
    const int column = this->TheColumns.Column[e];
    if (onlyEliminate && !kept[e])
    {
      continue;
    }
    candidates.emplace_back(std::abs(this->Shares.Column[e] - this->Threshold), column);
  }
  SortUnique(candidates);
  for (const auto& candidate : candidates)
  {
    const char before = kept[candidate.second];
    this->SetColumn(candidate.second, !before, kept);
    if (!this->MakesPinch(node, kept))
    {
      return true;
    }
    this->SetColumn(candidate.second, before, kept);
  }
  // No single column mends it: take away all that is kept here but the largest share.
  for (const auto& candidate : candidates)
  {
    if (kept[candidate.second])
    {
      this->SetColumn(candidate.second, 0, kept);
      return true;
    }
  }
  return false;
}

}
