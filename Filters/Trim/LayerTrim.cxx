#include "LayerTrim.h"

#include "InsertedLayer.h"
#include "LayerPits.h"
#include "LayerRelaxation.h"
#include "LayerRoom.h"
#include "LayerSkin.h"
#include "NodesOfElements.h"
#include "Shortfalls.h"
#include "StickingNodes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace trim
{
namespace
{

/// How often the fates of elements are changed to give a layer room.
constexpr int MostAttempts = 24;
/// How often they are changed where elements of the layer are not good enough in the end.
constexpr int MostClimbs = 3;
/// More elements below the floor, and more of those at the layer, are not raised all: of 416 layers
/// those of which they were began with 68 of 551 at most, or 39 of 93.
constexpr std::size_t MostBelow = 100;
constexpr double LargestShareBelow = 0.2;
/// Nodes left off the surface with elements of the layer left out, of those left without.
constexpr std::size_t MostByPits = 2;
/// Squares of distances, in edges, that a layer leaves before nodes return, and after: of 530 those
/// that came below the limit had 11.1 and 0.5 more than four times that at the most.
struct MostLeftBy
{
  double Squares, TimesLimit;
};
constexpr MostLeftBy MostAtFirst{ 12.0, 4.0 }, MostReturned{ 1.0, 4.0 };

/// By whole columns in a sheet, element by element in a block: there the layer makes up for it.
Columns ColumnsFor(const Band& band, bool isSheet)
{
  Columns columns = FindColumns(band);
  return isSheet && columns.AllHaveThickness() && columns.Complete(band, 2)
    ? columns
    : NoColumns(band, std::move(columns.Part));
}

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

/// Looks for what is to be kept so that a layer on it has room.
class LayerSearch
{
public:
  LayerSearch(const TrimBand& near, const std::shared_ptr<const Band>& before, bool isSheet,
    double largestShare, const BandTask& task)
    : Near(near)
    , Before(before)
    , IsSheet(isSheet)
    , LargestShare(largestShare)
    , Task(task)
    , TheColumns(ColumnsFor(near.Mesh, isSheet))
    , Reach(LargestOfColumns(near.Shares, this->TheColumns))
    , TheDecision(near.Mesh, this->TheColumns, this->Reach, task.Surface, largestShare, false)
    , Mover(near.Mesh, this->TheColumns, task.Surface, task.Precision, false, nullptr,
        task.Options.Ladder.StaysInside)
    , Room(near.Mesh, this->TheColumns, this->Reach)
    , Fates(near.Mesh.NumberOfElements(), Fate::ByVolume)
  {
  }

  LayerSearch(const LayerSearch&) = delete; // the members refer to each other
  void operator=(const LayerSearch&) = delete;

  /// The band with a layer as good as it can be before any correction; none: there is no room.
  std::optional<Band> Find()
  {
    for (int attempt = 0; attempt < MostAttempts; ++attempt)
    {
      this->Kept = this->TheDecision.Take(this->Fates);
      BandCells cells;
      const std::vector<int> noRoom =
        InsertLayer(this->Near.Mesh, this->TheColumns, this->Mover, this->Kept, cells);
      if (noRoom.empty())
      {
        return this->Relaxed(std::move(cells));
      }
      if (!this->PartElsewhere(noRoom))
      {
        break;
      }
    }
    return std::nullopt;
  }

  /// Other elements at some nodes are to be kept from now on; false if there is no other choice.
  bool PartElsewhere(const std::vector<int>& nodes)
  {
    return this->Room.PartElsewhere(this->Kept, nodes, this->Fates);
  }

  /// What Find has kept of the mesh.
  const std::vector<char>& KeptUnderIt() const { return this->Kept; }

  /// Whether an element went, or stays, that neither its volume nor the layer's own share would
  /// have gone, or stay: to give the layer room, or with others of its column.
  bool IsAgainstVolume(int e) const
  {
    const auto& shares = this->Near.Shares;
    const double share = this->TheColumns.HasThickness(e) ? shares.Column[e] : shares.Element[e];
    const auto [least, most] =
      std::minmax(this->LargestShare, this->Task.Options.Ladder.EliminationFraction);
    return this->Kept[e] ? share > most : share <= least;
  }

  /// See ReturnToSkin.
  void ReturnToSkin(const Band& layered, TrimmedBand& trimmed) const
  {
    const LadderOptions& options = this->Task.Options.Ladder;
    const BandQuality quality(layered, options.Treatment, options.QualityFloor);
    trim::ReturnToSkin(layered, this->TheColumns, this->Mover, this->Kept, quality, trimmed);
  }

private:
  Band MakeBand(const BandCells& cells) const
  {
    Band layered(cells, this->Near.Mesh.NumberOfRings(), this->Near.Mesh.SinglePrecision);
    layered.BeforeLayer = this->Before;
    return layered;
  }

  Band Relaxed(BandCells cells) const
  {
    Band layered = this->MakeBand(cells);
    const Columns columns = ColumnsFor(layered, this->IsSheet);
    const LadderOptions& options = this->Task.Options.Ladder;
    const NodeMover mover(layered, columns, this->Task.Surface, this->Task.Precision, false,
      nullptr, options.StaysInside);
    const BandQuality quality(layered, options.Treatment, options.QualityFloor);
    return RelaxLayer(layered, mover, quality, options.QualityFloor, cells) ? this->MakeBand(cells)
                                                                            : layered;
  }

  const TrimBand& Near;
  const std::shared_ptr<const Band>& Before;
  bool IsSheet;
  double LargestShare;
  const BandTask& Task;
  Columns TheColumns;
  VolumeShares Reach;
  Decision TheDecision;
  NodeMover Mover;
  LayerRoom Room;
  std::vector<Fate> Fates;
  std::vector<char> Kept;
};

/// By which what is kept stays so, the layer with it, and nothing else.
VolumeShares SharesByFate(const Band& layered, const std::vector<char>& kept)
{
  VolumeShares shares;
  for (const Origin& origin : layered.ElementOrigins)
  {
    shares.Element.push_back(kept[origin.Index] ? 0.0 : 1.0);
  }
  shares.Column = shares.Element;
  return shares;
}

VolumeShares SharesOfOrigins(const Band& layered, const VolumeShares& shares)
{
  VolumeShares own;
  for (const Origin& origin : layered.ElementOrigins)
  {
    own.Volume.push_back(shares.Volume[origin.Index]);
    own.Element.push_back(shares.Element[origin.Index]);
    own.Column.push_back(shares.Column[origin.Index]);
  }
  return own;
}

/// The climb knows of the fates that it set alone, as all others are given to it.
void TellFates(const Band& layered, const Columns& columns, const LayerSearch& search,
  std::vector<char>& againstVolume)
{
  for (int e = 0; e < layered.NumberOfElements(); ++e)
  {
    if (!layered.IsInserted(e) && search.IsAgainstVolume(layered.ElementOrigins[e].Index))
    {
      againstVolume[columns.Column[e]] = 1;
    }
  }
}

/// Inserted nodes are moved where they lie elsewhere than those in whose place they are.
void TellInserted(const Band& layered, Moves& moves)
{
  for (int n = 0; n < layered.NumberOfNodes(); ++n)
  {
    if (layered.IsInsertedNode(n))
    {
      const bool moved =
        moves.Position[n] != layered.BeforeLayer->Point[layered.NodeOrigins[n].Index];
      moves.Applied[n] = moved ? Correction::Relax : Correction::None;
    }
  }
}

/// Elements that no place of their nodes makes good enough.
std::vector<int> FaultyElements(const TrimBand& layered)
{
  std::vector<int> elements = layered.Trimmed.Invalid;
  elements.insert(
    elements.end(), layered.Trimmed.BelowFloor.begin(), layered.Trimmed.BelowFloor.end());
  return elements;
}

/// The nodes of elements, as the mesh has them.
std::vector<int> NodesWithoutLayer(const Band& layered, const std::vector<int>& elements)
{
  std::vector<int> nodes = NodesOf(layered, elements);
  std::transform(nodes.begin(), nodes.end(), nodes.begin(),
    [&layered](int n) { return NodeWithoutLayer(layered, n); });
  SortUnique(nodes);
  return nodes;
}

/// Whether the elements below the floor are few enough for other choices to raise them.
bool MayBeRaised(const Band& band, const LadderOptions& options, const TrimmedBand& trimmed)
{
  const BandQuality quality(band, options.Treatment, options.QualityFloor);
  const std::size_t below = quality.FindBelowFloor(trimmed).size();
  std::size_t atLayer = 0;
  for (int e = 0; below > MostBelow && e < band.NumberOfElements(); ++e)
  {
    atLayer += trimmed.Kept[e] && band.HasInsertedNode(e);
  }
  return below <= MostBelow ||
    static_cast<double>(below) <= LargestShareBelow * static_cast<double>(atLayer);
}

/// Whether so much is left that it hardly ever comes below a limit.
bool LeavesTooMuch(TrimBand& layered, const TrimmedBand& trimmed, const Shortcomings& limit,
  const MostLeftBy& most, const BandTask& task)
{
  layered.Trimmed = trimmed;
  layered.NodesLeft = FindNodesLeft(layered, task.Surface, task.Precision);
  return MeasureLeft(layered).Squares > most.TimesLimit * limit.Squares + most.Squares;
}

/// @param isLast whether no other fates are tried after it.
/// @return false where it was given up.
bool ClimbWithLayer(TrimBand& layered, const LayerDemand& demand, bool isLast, const BandTask& task,
  const Progress& progress)
{
  const LadderOptions& options = task.Options.Ladder;
  const bool isLimited = demand.Limit && demand.Limit->Elements == 0;
  bool isOfUse = true;
  ClimbPromises promises;
  promises.Valid = [&](const TrimmedBand& trimmed)
  {
    if ((demand.GivesUp && !MayBeRaised(layered.Mesh, options, trimmed)) ||
      (isLimited && LeavesTooMuch(layered, trimmed, *demand.Limit, MostAtFirst, task)))
    {
      isOfUse = false;
    }
    return isOfUse;
  };
  promises.Returned = [&](const TrimmedBand& trimmed)
  {
    const BandQuality quality(layered.Mesh, options.Treatment, options.QualityFloor);
    // What is faulty is not mended altogether by what follows; it tells the next climb where.
    if (isLimited &&
      (LeavesTooMuch(layered, trimmed, *demand.Limit, MostReturned, task) ||
        (isLast && !(trimmed.Invalid.empty() && quality.FindBelowFloor(trimmed).empty()))))
    {
      isOfUse = false;
    }
    return isOfUse;
  };
  ClimbBand(layered, task, progress, nullptr, promises);
  return isOfUse;
}

/// Leaves faulty elements of the layer out where that leaves no more nodes off the surface than
/// are left anyway: in a long layer one is faulty somewhere whatever is kept.
void DigFewPits(TrimBand& layered, const BandTask& task)
{
  const std::vector<int> faulty = FaultyElements(layered);
  const TrimmedBand before = layered.Trimmed;
  if (faulty.empty() || !DigPits(layered.Mesh, layered.Structure, faulty, layered.Trimmed))
  {
    return;
  }
  auto left = FindNodesLeft(layered, task.Surface, task.Precision);
  if (left.size() <= MostByPits * layered.NodesLeft.size())
  {
    layered.NodesLeft = std::move(left);
  }
  else
  {
    layered.Trimmed = before;
  }
}

/// What comes after the climb.
void Complete(TrimBand& layered, const TrimBand& near, const LayerSearch& search,
  const BandTask& task, const Progress& progress)
{
  const Band& band = layered.Mesh;
  TakeCloser(layered, task, Part(progress, 0.0, 0.5));
  FollowCreases(layered, task, Part(progress, 0.5, 1.0));
  search.ReturnToSkin(band, layered.Trimmed);
  // Where the layer puts a node counts as a move, also of those that stay there.
  TellInserted(band, layered.Trimmed.NodeMoves);
  TellFates(band, layered.Structure, search, layered.Trimmed.AgainstVolume);
  layered.NodesLeft = FindNodesLeft(layered, task.Surface, task.Precision);
  DigFewPits(layered, task);
  layered.Shares = SharesOfOrigins(band, near.Shares);
  for (const Origin& origin : band.ElementOrigins)
  {
    layered.SheetAxis.push_back(near.SheetAxis[origin.Index]);
  }
}

}

std::unique_ptr<TrimBand> TrimWithLayer(const TrimBand& near,
  const std::shared_ptr<const Band>& before, double largestShare, const LayerDemand& demand,
  const BandTask& task, const Progress& progress)
{
  const bool isSheet = near.Structure.AllHaveThickness() && near.Structure.ChosenByCut.empty();
  LayerSearch search(near, before, isSheet, largestShare, task);
  std::unique_ptr<TrimBand> best;
  std::size_t fewest = 0;
  for (int climb = 0; climb < MostClimbs && !progress(-1.0); ++climb)
  {
    auto mesh = search.Find();
    if (!mesh)
    {
      break;
    }
    const Progress part =
      Part(progress, static_cast<double>(climb) / MostClimbs, (climb + 1.0) / MostClimbs);
    auto layered = std::make_unique<TrimBand>(std::move(*mesh));
    layered->Structure = ColumnsFor(layered->Mesh, isSheet);
    layered->Shares = SharesByFate(layered->Mesh, search.KeptUnderIt());
    const bool isLast = climb + 1 == MostClimbs;
    if (!ClimbWithLayer(*layered, demand, isLast, task, Part(part, 0.0, 0.8)))
    {
      break; // by other fates there would be more of the same
    }
    Complete(*layered, near, search, task, Part(part, 0.8, 1.0));
    if (!task.Options.Ladder.StaysInside && SticksOut(*layered, task.Surface, task.Precision))
    {
      // By other fates it mostly would, too.
      const BandOptions inside = task.Options.StayingInside();
      return TrimWithLayer(
        near, before, largestShare, demand, { task.Surface, task.Precision, inside }, part);
    }
    const std::vector<int> faulty = FaultyElements(*layered);
    const std::vector<int> nodes = NodesWithoutLayer(layered->Mesh, faulty);
    if (!best || faulty.size() < fewest)
    {
      best = std::move(layered);
      fewest = faulty.size();
    }
    if (nodes.empty() || !search.PartElsewhere(nodes))
    {
      break;
    }
  }
  return best;
}

}
