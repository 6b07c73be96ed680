#include "LayerTrim.h"

#include "LayerPits.h"
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

/// How often the fates of elements are changed where those of the layer are not good enough in the
/// end.
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
  if (faulty.empty())
  {
    return;
  }
  const TrimmedBand before = layered.Trimmed;
  if (!DigPits(layered.Mesh, layered.Structure, faulty, layered.Trimmed))
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
  const std::shared_ptr<const Band>& before, const LayerKind& kind, const LayerDemand& demand,
  const BandTask& task, const Progress& progress)
{
  const bool isSheet = near.Structure.AllHaveThickness() && near.Structure.ChosenByCut.empty();
  LayerSearch search(near, before, isSheet, kind, task, AbortOf(progress));
  std::unique_ptr<TrimBand> best;
  std::size_t fewest = 0;
  for (int climb = 0; climb < MostClimbs && !progress(-1.0); ++climb)
  {
    auto mesh = search.Find();
    if (!mesh || (climb == 0 && kind.MayBeBare && !search.HasBareNodes()))
    {
      break; // no room, or the same as of the kind without bare nodes
    }
    const Progress part =
      Part(progress, static_cast<double>(climb) / MostClimbs, (climb + 1.0) / MostClimbs);
    auto layered = std::make_unique<TrimBand>(std::move(*mesh));
    layered->Structure = ColumnsForLayer(layered->Mesh, isSheet);
    layered->Shares = search.SharesByFate(layered->Mesh);
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
        near, before, kind, demand, { task.Surface, task.Precision, inside }, part);
    }
    const std::vector<int> faulty = FaultyElements(*layered);
    const std::vector<int> nodes = NodesWithoutLayer(layered->Mesh, faulty);
    const bool isBetter = !best || faulty.size() < fewest;
    if (isBetter)
    {
      best = std::move(layered);
      fewest = faulty.size();
    }
    if (!isBetter || nodes.empty() || !search.PartElsewhere(nodes))
    {
      break;
    }
  }
  return best;
}

}
