#include "Decision.h"

#include "DisjointSets.h"
#include "EliminatedFraction.h"
#include "Jacobian.h"
#include "Manifold.h"
#include "SortUnique.h"
#include "Status.h"

#include <vtkSMPTools.h>

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
  , Whole(band.NumberOfElements(), 1)
  , Collapsing(band.NumberOfElements(), Unknown)
{
  this->FindInnerNodes();
}

std::vector<char> Decision::Take(const std::vector<Fate>& fate)
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
/// the surface only by leaving the border.
void Decision::EliminateLostBorders(const std::vector<Fate>& fate, std::vector<char>& kept) const
{
  // By column and the two pillars that bound the side; in a block by element and face.
  std::map<std::array<int, 3>, bool> lostSides;
  for (std::size_t f = 0; f < this->TheBand.Faces.size(); ++f)
  {
    const auto& face = this->TheBand.Faces[f];
    const int e = face.Element[0];
    if (!face.Exterior || !kept[e] ||
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
  for (const auto& side : lostSides)
  {
    if (side.second && fate[side.first[0]] != Fate::Keep)
    {
      this->SetColumn(side.first[0], 0, kept);
    }
  }
}

/// Kept columns whose nodes all go to the surface and leave nothing between them.
bool Decision::EliminateCollapsing(const std::vector<Fate>& fate, std::vector<char>& kept)
{
  const auto moving = FindMovingNodes(this->TheBand, this->TheColumns, kept);
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
      after[i] = this->Surface.ClosestPoint(before[i]).Point;
    }
    this->Collapsing[e] =
      VolumeOf(after, element.Count) < CollapsedShare * VolumeOf(before, element.Count);
  }
  return this->Collapsing[e] != 0;
}

/// Whether what is kept is no manifold at a node, where the whole mesh is one.
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
  const bool pinched =
    !IsManifoldAt(this->TheBand, kept, node) && IsManifoldAt(this->TheBand, this->Whole, node);
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
    if (IsManifoldAt(this->TheBand, kept, node))
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

namespace
{

/// Nodes beyond the surface in a cut-out of a sheet that holds no whole element, and of which none
/// goes, nor any beside it: there is no border that they could lie on, and moving them would spoil
/// the elements for nothing.
std::vector<char> FindShutCutOuts(
  const Band& band, const Columns& columns, const std::vector<char>& touchesEliminated)
{
  std::vector<char> shut(band.NumberOfNodes(), 0);
  bool any = false;
  for (int n = 0; n < band.NumberOfNodes() && !any; ++n)
  {
    any = band.NodeStatus[n] == NodeEliminate && !touchesEliminated[n] &&
      !columns.IsChosenByCut(n) && !columns.IsOnBorder(band, n);
  }
  if (!any)
  {
    return shut; // as a rule
  }
  std::vector<char> open(band.NumberOfNodes(), 0);
  DisjointSets<int> cutOuts(band.NumberOfNodes());
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    const auto begin = element.Node.begin(), end = begin + element.Count;
    const bool beside = !columns.HasThickness(e) || band.ElementStatus[e] == ElementEliminate ||
      std::any_of(begin, end, [&touchesEliminated](int n) { return touchesEliminated[n] != 0; });
    int first = -1;
    for (auto n = begin; n != end; ++n)
    {
      if (band.NodeStatus[*n] == NodeEliminate)
      {
        open[*n] |= beside;
        first = first < 0 ? *n : first;
        cutOuts.Unite(first, *n);
      }
    }
  }
  std::vector<char> ofRoot(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (band.NodeStatus[n] == NodeEliminate)
    {
      ofRoot[cutOuts.Find(n)] |= open[n] || columns.IsChosenByCut(n) || columns.IsOnBorder(band, n);
    }
  }
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    shut[n] = band.NodeStatus[n] == NodeEliminate && !ofRoot[cutOuts.Find(n)];
  }
  return shut;
}

}

bool MeasureShares(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface,
  double gap, VolumeShares& shares, std::array<int, 2>& missedEdge)
{
  const int count = band.NumberOfElements();
  shares.Volume.assign(count, 0.0);
  shares.Element.assign(count, 0.0);
  const CutEdges edges(band, surface, gap);
  missedEdge = edges.FindMissed();
  if (missedEdge[0] >= 0)
  {
    return false;
  }
  vtkSMPTools::For(0, count, 64,
    [&](Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        const auto volumes = MeasureEliminated(band, static_cast<int>(e), edges);
        shares.Volume[e] = volumes.Total;
        shares.Element[e] = band.ElementStatus[e] == ElementKeep ? 0.0
          : band.ElementStatus[e] == ElementEliminate            ? 1.0
                                                                 : volumes.Fraction();
      }
    });
  MeasureColumnShares(columns, shares);
  return true;
}

void MeasureColumnShares(const Columns& columns, VolumeShares& shares)
{
  const std::size_t count = shares.Element.size();
  std::vector<double> total(count, 0.0);
  std::vector<double> eliminated(count, 0.0);
  for (std::size_t e = 0; e < count; ++e)
  {
    total[columns.Column[e]] += shares.Volume[e];
    eliminated[columns.Column[e]] += shares.Volume[e] * shares.Element[e];
  }
  shares.Column.resize(count);
  for (std::size_t e = 0; e < count; ++e)
  {
    const int column = columns.Column[e];
    shares.Column[e] = total[column] > 0.0 ? eliminated[column] / total[column] : 0.0;
  }
}

std::vector<char> FindMovingNodes(
  const Band& band, const Columns& columns, const std::vector<char>& kept)
{
  std::vector<char> touchesKept(band.NumberOfNodes(), 0), touchesEliminated = touchesKept;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      (kept[e] ? touchesKept : touchesEliminated)[element.Node[i]] = 1;
    }
  }
  const std::vector<char> shut = FindShutCutOuts(band, columns, touchesEliminated);
  std::vector<char> moving(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    const bool beyond = band.NodeStatus[n] == NodeEliminate && !shut[n];
    moving[n] =
      touchesKept[n] && band.NodeStatus[n] != NodeOnSurface && (touchesEliminated[n] || beyond);
  }
  return moving;
}

std::vector<char> FindCutNodes(const Band& band, const std::vector<char>& kept)
{
  std::vector<char> onCut(band.NumberOfNodes(), 0);
  for (const auto& face : band.Faces)
  {
    for (int i = 0; IsCutFace(face, kept) && i < face.Count; ++i)
    {
      onCut[face.Node[i]] = 1;
    }
  }
  return onCut;
}

}
