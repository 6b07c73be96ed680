#include "LayerSearch.h"

#include "CountBytes.h"
#include "InsertedLayer.h"
#include "LayerRelaxation.h"
#include "LayerSkin.h"
#include "MovingNodes.h"
#include "SortUnique.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// How often the fates of elements are changed to give a layer room, or it is left out at more
/// nodes.
constexpr int MostAttempts = 24;
/// Nodes at which a layer is left out, of those of the cut, at most: where they are more, so much
/// is wrong with the mesh that a layer without them leaves more off the surface than none.
constexpr double LargestShareBare = 0.05;

/// Of each element the largest share in its column.
VolumeShares LargestOfColumns(const VolumeShares& shares, const Columns& columns)
{
  VolumeShares reach = shares;
  std::vector<double> largest(shares.Element.size(), 0.0);
  for (std::size_t e = 0; e < largest.size(); ++e)
  {
    double& ofColumn = largest[columns.Column[e]];
    ofColumn = std::max(ofColumn, shares.Element[e]);
  }
  for (std::size_t e = 0; e < largest.size(); ++e)
  {
    reach.Column[e] = largest[columns.Column[e]];
  }
  return reach;
}

}

Columns ColumnsForLayer(const Band& band, bool isSheet)
{
  Columns columns = FindColumns(band);
  return isSheet && columns.AllHaveThickness() && columns.Complete(band, 2)
    ? columns
    : NoColumns(band, std::move(columns.Part));
}

LayerSearch::LayerSearch(const TrimBand& near, const std::shared_ptr<const Band>& before,
  bool isSheet, const LayerKind& kind, const BandTask& task, AbortCheck aborted)
  : Near(near)
  , Before(before)
  , IsSheet(isSheet)
  , Kind(kind)
  , Task(task)
  , Aborted(std::move(aborted))
  , TheColumns(ColumnsForLayer(near.Mesh, isSheet))
  , Reach(LargestOfColumns(near.Shares, this->TheColumns))
  , TheDecision(near.Mesh, this->TheColumns, this->Reach, task.Surface, kind.LargestShare, false)
  , Mover(near.Mesh, this->TheColumns, task.Surface, task.Precision, false, nullptr,
      task.Options.Ladder.StaysInside)
  , Room(near.Mesh, this->TheColumns, this->Reach)
  , Fates(near.Mesh.NumberOfElements(), Fate::ByVolume)
  , Bare(near.Mesh.NumberOfNodes(), 0)
{
}

std::optional<Band> LayerSearch::Find()
{
  std::vector<int> fewest;
  std::vector<Fate> fatesOfFewest;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    BandCells cells;
    const std::vector<int> noRoom = this->Insert(cells);
    if (noRoom.empty())
    {
      return this->WithoutSpoiled(this->Relaxed(std::move(cells)));
    }
    if (attempt == 0 || noRoom.size() < fewest.size())
    {
      fewest = noRoom;
      fatesOfFewest = this->Fates;
    }
    if (!this->PartElsewhere(noRoom))
    {
      break;
    }
  }
  if (!this->Kind.MayBeBare)
  {
    return std::nullopt;
  }
  this->Fates = fatesOfFewest;
  return this->FindWithBareNodes(fewest);
}

/// The band with a layer that is left out where it spoils kept elements, if it may be.
Band LayerSearch::WithoutSpoiled(Band layered)
{
  const auto spoiling = this->Kind.MayBeBare ? this->FindSpoiling(layered) : std::vector<int>();
  auto better = spoiling.empty() ? std::nullopt : this->FindWithBareNodes(spoiling);
  return better ? std::move(*better) : std::move(layered);
}

/// @return nodes where there is no room for the layer.
std::vector<int> LayerSearch::Insert(BandCells& cells)
{
  this->Kept = this->TheDecision.Take(this->Fates);
  return InsertLayer(this->Near.Mesh, this->TheColumns, this->Mover, this->Kept, this->Bare, cells);
}

/// The band with a layer that is left out at some nodes, and at those that turn out to have no room
/// then; none: these are more than a few.
std::optional<Band> LayerSearch::FindWithBareNodes(std::vector<int> bare)
{
  const std::vector<char> before = this->Bare;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    for (const int n : bare)
    {
      this->Bare[n] = 1;
    }
    if (!this->FewAreBare())
    {
      break;
    }
    BandCells cells;
    bare = this->Insert(cells);
    if (bare.empty())
    {
      Band layered = this->Relaxed(std::move(cells));
      bare = this->FindSpoiling(layered);
      if (bare.empty())
      {
        return layered;
      }
    }
  }
  this->Bare = before;
  return std::nullopt;
}

bool LayerSearch::HasBareNodes() const
{
  return CountBytes(this->Bare, 1) > 0;
}

bool LayerSearch::FewAreBare() const
{
  const Id onCut = CountBytes(FindCutNodes(this->Near.Mesh, this->Kept), 1);
  return static_cast<double>(CountBytes(this->Bare, 1)) <=
    LargestShareBare * static_cast<double>(onCut);
}

/// Nodes of the cut where a kept element is below the floor, as the layer takes their place.
std::vector<int> LayerSearch::FindSpoiling(const Band& layered) const
{
  const BandQuality quality = this->QualityOf(layered);
  std::vector<int> nodes;
  for (int e = 0; e < layered.NumberOfElements(); ++e)
  {
    const BandElement& element = layered.Elements[e];
    if (layered.IsInserted(e) || !layered.HasInsertedNode(e) ||
      !quality.FallsBelowFloor(e, PointsOf(layered, e), element.Count))
    {
      continue;
    }
    for (const int n : element)
    {
      const int node = NodeWithoutLayer(layered, n);
      if (layered.IsInsertedNode(n) && !this->Bare[node])
      {
        nodes.push_back(node);
      }
    }
  }
  SortUnique(nodes);
  return nodes;
}

Band LayerSearch::MakeBand(const BandCells& cells) const
{
  Band layered(cells, this->Near.Mesh.NumberOfRings(), this->Near.Mesh.SinglePrecision);
  layered.BeforeLayer = this->Before;
  return layered;
}

Band LayerSearch::Relaxed(BandCells cells) const
{
  Band layered = this->MakeBand(cells);
  const Columns columns = ColumnsForLayer(layered, this->IsSheet);
  const LadderOptions& options = this->Task.Options.Ladder;
  const NodeMover mover(layered, columns, this->Task.Surface, this->Task.Precision, false, nullptr,
    options.StaysInside);
  return RelaxLayer(layered, mover, this->QualityOf(layered), options.QualityFloor, this->Bare,
           this->Aborted, cells)
    ? this->MakeBand(cells)
    : layered;
}

BandQuality LayerSearch::QualityOf(const Band& layered) const
{
  const LadderOptions& options = this->Task.Options.Ladder;
  return { layered, options.Treatment, options.QualityFloor };
}

VolumeShares LayerSearch::SharesByFate(const Band& layered) const
{
  VolumeShares shares;
  for (int e = 0; e < layered.NumberOfElements(); ++e)
  {
    const bool stays =
      this->Kept[ElementWithoutLayer(layered, e)] && !IsOnBareNode(layered, this->Bare, e);
    shares.Element.push_back(stays ? 0.0 : 1.0);
  }
  shares.Column = shares.Element;
  return shares;
}

bool LayerSearch::IsAgainstVolume(int e) const
{
  const auto& shares = this->Near.Shares;
  const double share = this->TheColumns.HasThickness(e) ? shares.Column[e] : shares.Element[e];
  const auto [least, most] =
    std::minmax(this->Kind.LargestShare, this->Task.Options.Ladder.EliminationFraction);
  return this->Kept[e] ? share > most : share <= least;
}

void LayerSearch::ReturnToSkin(const Band& layered, TrimmedBand& trimmed) const
{
  trim::ReturnToSkin(
    layered, this->TheColumns, this->Mover, this->Kept, this->QualityOf(layered), trimmed);
}

}
