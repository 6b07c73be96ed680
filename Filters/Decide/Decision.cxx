#include "Decision.h"

#include "EliminatedFraction.h"
#include "Jacobian.h"
#include "Manifold.h"
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
/// Sweeps of mending; in the later half elements are only eliminated, so that it ends.
constexpr int MendingSweeps = 20;

/// The working state of one decision.
class Mender
{
public:
  Mender(const Band& band, const Columns& columns, const VolumeShares& shares,
    const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
    double threshold, const std::vector<Fate>& fate, bool movesNodes, std::vector<char>& kept)
    : TheBand(band)
    , TheColumns(columns)
    , Shares(shares)
    , NodeStatus(nodeStatus)
    , Surface(surface)
    , Threshold(threshold)
    , Fates(fate)
    , MovesNodes(movesNodes)
    , Kept(kept)
    , Members(columns.Elements())
    , Whole(band.NumberOfElements(), 1)
  {
    this->FindInnerNodes();
  }

  void Run()
  {
    if (this->MovesNodes)
    {
      this->EliminateLostBorders();
    }
    for (int sweep = 0; sweep < MendingSweeps; ++sweep)
    {
      const bool onlyEliminate = sweep >= MendingSweeps / 2;
      const bool collapsed = this->MovesNodes && this->EliminateCollapsing();
      const bool pinched = this->MendPinches(onlyEliminate);
      if (!collapsed && !pinched)
      {
        return;
      }
    }
  }

private:
  /// Nodes near the cut whose elements are all in the band.
  void FindInnerNodes()
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
  }

  void SetColumn(int column, char kept)
  {
    for (auto* e = this->Members.begin(column); e != this->Members.end(column); ++e)
    {
      this->Kept[*e] = kept;
    }
  }

  /// Kept columns that lose a whole side on the border of the mesh: their nodes there could reach
  /// the surface only by leaving the border.
  void EliminateLostBorders()
  {
    // By column and the two pillars (in a block: nodes) that bound the side.
    std::map<std::array<int, 3>, bool> lostSides;
    for (std::size_t f = 0; f < this->TheBand.Faces.size(); ++f)
    {
      const auto& face = this->TheBand.Faces[f];
      const int e = face.Element[0];
      if (!face.Exterior || !this->Kept[e] ||
        this->TheColumns.IsLayerFace(this->TheBand, static_cast<int>(f)))
      {
        continue;
      }
      std::array<int, 3> side{ this->TheColumns.Column[e], std::numeric_limits<int>::max(), -1 };
      bool keeps = false;
      bool eliminates = false;
      for (int i = 0; i < face.Count; ++i)
      {
        const int pillar = this->TheColumns.Pillar[face.Node[i]];
        side[1] = std::min(side[1], pillar);
        side[2] = std::max(side[2], pillar);
        keeps |= this->NodeStatus[face.Node[i]] == NodeKeep;
        eliminates |= this->NodeStatus[face.Node[i]] == NodeEliminate;
      }
      const bool lost = !keeps && eliminates;
      const auto known = lostSides.emplace(side, lost);
      known.first->second = known.first->second && lost;
    }
    for (const auto& side : lostSides)
    {
      if (side.second && this->Fates[side.first[0]] != Fate::Keep)
      {
        this->SetColumn(side.first[0], 0);
      }
    }
  }

  /// Kept columns whose nodes all go to the surface and leave nothing between them.
  bool EliminateCollapsing()
  {
    const auto moving = FindMovingNodes(this->TheBand, this->Kept, this->NodeStatus);
    bool changed = false;
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheBand.Elements[e];
      const int column = this->TheColumns.Column[e];
      if (!this->Kept[e] || this->Fates[column] == Fate::Keep)
      {
        continue;
      }
      bool all = true;
      for (int i = 0; i < element.Count && all; ++i)
      {
        all = moving[element.Node[i]] || this->NodeStatus[element.Node[i]] == NodeOnSurface;
      }
      if (all && this->Collapses(element))
      {
        this->SetColumn(column, 0);
        changed = true;
      }
    }
    return changed;
  }

  bool Collapses(const BandElement& element) const
  {
    ElementPoints before;
    ElementPoints after;
    for (int i = 0; i < element.Count; ++i)
    {
      before[i] = this->TheBand.Point[element.Node[i]];
      after[i] = this->Surface.ClosestPoint(before[i]).Point;
    }
    return VolumeOf(after, element.Count) < CollapsedShare * VolumeOf(before, element.Count);
  }

  /// Whether what is kept is no manifold at a node, where the whole mesh is one.
  bool IsPinched(int node) const
  {
    const auto elements = this->TheBand.ElementsOfNode(node);
    const auto isKept = [this](int e) { return this->Kept[e] != 0; };
    const auto kept = std::count_if(elements.begin(), elements.end(), isKept);
    return kept > 0 && kept < elements.size() && !IsManifoldAt(this->TheBand, this->Kept, node) &&
      IsManifoldAt(this->TheBand, this->Whole, node);
  }

  bool MendPinches(bool onlyEliminate)
  {
    bool changed = false;
    for (const int n : this->InnerNodes)
    {
      if (this->IsPinched(n))
      {
        changed |= this->MendPinch(n, onlyEliminate);
      }
    }
    return changed;
  }

  /// Turns round the column at the node whose share is nearest to the threshold.
  bool MendPinch(int node, bool onlyEliminate)
  {
    std::vector<std::pair<double, int>> candidates;
    for (const int e : this->TheBand.ElementsOfNode(node))
    {
      const int column = this->TheColumns.Column[e];
      if (onlyEliminate && !this->Kept[e])
      {
        continue;
      }
      candidates.emplace_back(std::abs(this->Shares.Column[e] - this->Threshold), column);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const auto& candidate : candidates)
    {
      const char before = this->Kept[candidate.second];
      this->SetColumn(candidate.second, !before);
      if (IsManifoldAt(this->TheBand, this->Kept, node))
      {
        return true;
      }
      this->SetColumn(candidate.second, before);
    }
    // No single column mends it: take away all that is kept here but the largest share.
    for (const auto& candidate : candidates)
    {
      if (this->Kept[candidate.second])
      {
        this->SetColumn(candidate.second, 0);
        return true;
      }
    }
    return false;
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const std::vector<unsigned char>& NodeStatus;
  const nurbs::TrimmingSurface& Surface;
  double Threshold;
  const std::vector<Fate>& Fates;
  bool MovesNodes;
  std::vector<char>& Kept;
  Band::Lists Members;
  std::vector<char> Whole;
  std::vector<int> InnerNodes;
};

}

bool MeasureShares(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, const std::vector<unsigned char>& elementStatus,
  const nurbs::TrimmingSurface& surface, double gap, VolumeShares& shares,
  std::array<int, 2>& missedEdge)
{
  const int count = band.NumberOfElements();
  shares.Element.assign(count, 0.0);
  shares.Column.assign(count, 0.0);
  std::vector<double> volume(count, 0.0);
  const CutEdges edges(band, nodeStatus, surface, gap);
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
        const auto volumes = MeasureEliminated(band, static_cast<int>(e), nodeStatus, edges);
        volume[e] = volumes.Total;
        shares.Element[e] = elementStatus[e] == ElementKeep ? 0.0
          : elementStatus[e] == ElementEliminate            ? 1.0
                                                            : volumes.Fraction();
      }
    });
  std::vector<double> total(count, 0.0);
  std::vector<double> eliminated(count, 0.0);
  for (int e = 0; e < count; ++e)
  {
    total[columns.Column[e]] += volume[e];
    eliminated[columns.Column[e]] += volume[e] * shares.Element[e];
  }
  for (int e = 0; e < count; ++e)
  {
    const int column = columns.Column[e];
    shares.Column[e] = total[column] > 0.0 ? eliminated[column] / total[column] : 0.0;
  }
  return true;
}

std::vector<char> Decide(const Band& band, const Columns& columns, const VolumeShares& shares,
  const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
  double threshold, const std::vector<Fate>& fate, bool movesNodes)
{
  std::vector<char> kept(band.NumberOfElements());
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const Fate set = fate[columns.Column[e]];
    // Rounding must not decide: a share that equals the threshold stays (V^e <= 50 %: keep).
    kept[e] = set == Fate::ByVolume ? shares.Column[e] <= threshold + 1e-9 : set == Fate::Keep;
  }
  Mender(band, columns, shares, nodeStatus, surface, threshold, fate, movesNodes, kept).Run();
  return kept;
}

std::vector<char> FindMovingNodes(
  const Band& band, const std::vector<char>& kept, const std::vector<unsigned char>& nodeStatus)
{
  std::vector<char> moving(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    bool touchesKept = false;
    bool touchesEliminated = nodeStatus[n] == NodeEliminate;
    for (const int e : band.ElementsOfNode(n))
    {
      touchesKept |= kept[e] != 0;
      touchesEliminated |= kept[e] == 0;
    }
    moving[n] = touchesKept && touchesEliminated && nodeStatus[n] != NodeOnSurface;
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
