#include "BandDecision.h"

#include "BestLayer.h"
#include "BorderCorners.h"
#include "BothParts.h"
#include "ColumnChoices.h"
#include "ElementsAstray.h"
#include "MoverMemory.h"
#include "NodeMover.h"
#include "Shortcomings.h"
#include "Shortfalls.h"
#include "StickingNodes.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// A node left farther than this many edges off the surface makes another trim worth the time.
constexpr double FarthestLeft = 0.5;
/// Where more are left, the cut runs along the mesh, and no decision would end it.
constexpr std::size_t MostLeft = 250;
/// Nodes that are left for the sake of a higher floor are so by any decision.
constexpr double HighestFloor = 0.5;
/// So many elements that no place of their nodes makes valid are worth to begin with a layer.
constexpr std::size_t ManyAslant = 100;
/// What one of them costs at least without a layer, as the square of a distance in edges: in blocks
/// cut by planes and waves, and in an O-grid, it was 0.027 to 0.24.
constexpr double SquaresAslant = 0.02;
/// So many nodes left when all is valid are worth to look whether a layer leaves none before the
/// long way from there on, which hardly ever brings all of them back.
constexpr std::size_t ManyLeft = 50;

/// @param memory see TrimCase.
TrimCase CaseOf(const TrimBand& near, const BandTask& task, const Progress& progress,
  std::shared_ptr<MoverMemory> memory = nullptr)
{
  return { near.Mesh, near.Structure, near.Shares, task.Surface, task.Precision, std::move(memory),
    progress };
}

ElementsAstray FindAstray(const TrimBand& near, const BandTask& task)
{
  return FindElementsAstray(near, task.Surface, task.Options.Ladder.CorrectionType);
}

/// Trims a band once more, as `climb` does that is given what there is; what was before comes back
/// where it is no better.
/// @param least the shortcomings of what there is, afterwards of what is taken.
/// @return the trim that was made and not taken; null if it was.
template <typename ClimbAnew, typename MeasureAll>
std::unique_ptr<BandTrim> TryAnew(
  TrimBand& near, const ClimbAnew& climb, const MeasureAll& measure, Shortcomings& least)
{
  BandTrim before = std::move(static_cast<BandTrim&>(near));
  climb(before);
  const Shortcomings now = measure();
  if (now < least)
  {
    least = now;
    return nullptr;
  }
  auto notTaken = std::make_unique<BandTrim>(std::move(static_cast<BandTrim&>(near)));
  static_cast<BandTrim&>(near) = std::move(before);
  return notTaken;
}

/// The shares by which elements without columns are decided.
VolumeShares SharesAlone(const VolumeShares& shares)
{
  return { shares.Volume, shares.Element, shares.Element };
}

/// Where columns take elements along that lie far from the surface, each sheet of a joint gets
/// columns of its own, or the elements are decided one by one, if that is better on the whole. If
/// no node is left and nothing lost the border is the surface, however far elements had to reach:
/// then nothing is better that leaves some, and elements one by one do.
/// @return the trim of elements one by one, if that was made and not taken.
std::unique_ptr<BandTrim> TryOtherColumns(
  TrimBand& near, const BandTask& task, const Progress& progress)
{
  std::vector<Columns> others;
  Columns sheets = FindJoinedSheets(near.Mesh);
  if (sheets.AnyHasThickness() && sheets.Complete(near.Mesh, 2))
  {
    others.push_back(std::move(sheets));
  }
  const bool leavesNone = near.NodesLeft.empty() && !FindAstray(near, task).MissesWhole() &&
    task.Options.Ladder.CorrectionType != Correction::Eliminate;
  if (!leavesNone)
  {
    others.push_back(NoColumns(near.Mesh, near.Structure.Part));
  }
  const auto measure = [&]
  {
    Shortcomings sum = MeasureShortcomings(near, task.Options.Ladder);
    sum.Squares += leavesNone && !near.NodesLeft.empty() ? std::numeric_limits<double>::infinity()
                                                         : FindAstray(near, task).Sum();
    return sum;
  };
  Shortcomings least = measure();
  std::unique_ptr<BandTrim> alone;
  for (Columns& other : others)
  {
    const bool isAlone = !other.AnyHasThickness();
    const auto climb = [&](const BandTrim& before)
    {
      near.Structure = std::move(other);
      near.Shares = isAlone ? SharesAlone(before.Shares) : before.Shares;
      if (!isAlone)
      {
        MeasureColumnShares(near.Structure, near.Shares);
      }
      ClimbBand(near, task, progress);
    };
    if (!progress(-1.0) && FindAstray(near, task).Any())
    {
      auto notTaken = TryAnew(near, climb, measure, least);
      alone = isAlone ? std::move(notTaken) : nullptr;
    }
  }
  return alone;
}

/// Whether something is kept that is nearly all beyond the surface.
bool KeepsCorners(const TrimBand& near)
{
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (near.Trimmed.Kept[e] && near.Shares.Column[e] > 1.0 - SmallestShare)
    {
      return true;
    }
  }
  return false;
}

/// Decides again, by other options or without columns, where that leaves less off the surface.
class OtherTrims
{
public:
  OtherTrims(TrimBand& near, const BandTask& task)
    : Near(near)
    , Task(task)
  {
  }

  /// Most trims leave nothing; where many nodes are left, or for a high floor, no other trim helps.
  bool AreWorthwhile() const
  {
    return !this->Near.NodesLeft.empty() && this->Near.NodesLeft.size() <= MostLeft &&
      this->Task.Options.Ladder.QualityFloor <= HighestFloor;
  }

  double Farthest() const { return MeasureLeft(this->Near).Farthest; }

  void Try(const BandOptions& with, bool columns, const Progress& progress)
  {
    this->TryBy(
      [&](const BandTrim& best)
      {
        this->Near.Structure =
          columns ? best.Structure : NoColumns(this->Near.Mesh, best.Structure.Part);
        this->Near.Shares = columns ? best.Shares : SharesAlone(best.Shares);
        ClimbBand(this->Near, { this->Task.Surface, this->Task.Precision, with }, progress);
      });
  }

  /// Takes a trim that was made already, if it is better.
  void Try(BandTrim made)
  {
    this->TryBy([&](const BandTrim&) { static_cast<BandTrim&>(this->Near) = std::move(made); });
  }

private:
  template <typename ClimbAnew>
  void TryBy(const ClimbAnew& climb)
  {
    const auto measure = [this]
    { return MeasureShortcomings(this->Near, this->Task.Options.Ladder); };
    Shortcomings least = measure();
    TryAnew(this->Near, climb, measure, least);
  }

  TrimBand& Near;
  const BandTask& Task;
};

bool CutsCornersOff(const TrimBand& near, const BandTask& task)
{
  return near.Structure.AnyHasThickness() &&
    !FindCornersCutOff(near.Mesh, near.Structure, task.Surface, near.Trimmed).empty();
}

/// Nodes at the border may have to come to the surface rather than slide behind the cut, and nodes
/// behind the cut to slide along a border that lies beyond the surface. What is kept
/// for a corner of the model may leave nodes farther off than the corner would be, and whole
/// columns do where the cut wanders through a block or along a wall; then it is decided again
/// without, every element for itself, and what comes nearest to the surface is taken.
/// @param valid see ClimbPromises, of the first climb; where it says no, progress has to end the
/// work.
void DecideWithMesh(
  TrimBand& near, const BandTask& task, const Progress& progress, const Promise& valid = {})
{
  auto memory = std::make_shared<MoverMemory>(near.Mesh);
  ClimbBand(near, task, Part(progress, 0.0, 0.3), memory, { valid, {} });
  OtherTrims others(near, task);
  if (!progress(-1.0) && others.AreWorthwhile() && CutsCornersOff(near, task))
  {
    BandOptions whole = task.Options;
    whole.Ladder.CutsCorners = false;
    others.Try(whole, true, Part(progress, 0.3, 0.35));
  }
  if (!progress(-1.0) && near.Structure.AnyHasThickness() && others.AreWorthwhile() &&
    SlidingMatters(near.Mesh, near.Structure, *memory))
  {
    BandOptions sliding = task.Options;
    sliding.Ladder.SlidesBehind = true;
    others.Try(sliding, true, Part(progress, 0.35, 0.4));
  }
  memory.reset(); // of other columns
  std::unique_ptr<BandTrim> alone;
  if (!progress(-1.0) && near.Structure.AnyHasThickness() && FindAstray(near, task).Any())
  {
    alone = TryOtherColumns(near, task, Part(progress, 0.4, 0.5));
  }
  if (!progress(-1.0) && others.AreWorthwhile() && others.Farthest() >= FarthestLeft &&
    KeepsCorners(near))
  {
    BandOptions without = task.Options;
    without.Ladder.KeepsCorners = false;
    others.Try(without, true, Part(progress, 0.5, 0.75));
  }
  if (!progress(-1.0) && others.AreWorthwhile() && others.Farthest() >= FarthestLeft &&
    near.Structure.AnyHasThickness())
  {
    if (alone)
    {
      others.Try(std::move(*alone));
    }
    else
    {
      others.Try(task.Options, false, Part(progress, 0.75, 1.0));
    }
  }
}

/// Elements that are invalid with all nodes on the surface, as they have faces of the cut on all
/// sides of a corner: where a block is cut aslant to all its elements.
std::size_t CountCutAslant(const TrimBand& near, const BandTask& task, const Progress& progress)
{
  if (near.Structure.AnyHasThickness())
  {
    return 0;
  }
  const TrimCase given = CaseOf(near, task, progress);
  LadderPosition foot;
  ColumnChoices choices(given, task.Options.Ladder, foot);
  return choices.Trial.Make(choices.At.Set, choices.Quality).Invalid.size();
}

}

void ClimbBand(TrimBand& near, const BandTask& task, const Progress& progress,
  std::shared_ptr<MoverMemory> memory, const ClimbPromises& promises)
{
  if (!memory)
  {
    memory = std::make_shared<MoverMemory>(near.Mesh);
  }
  const TrimCase given = CaseOf(near, task, progress, memory);
  if (task.Options.ProduceOffcut)
  {
    BothParts parts = ClimbForBothParts(given, task.Options.Ladder);
    near.Trimmed = std::move(parts.Kept);
    near.Rest = std::move(parts.Rest);
    near.Made = std::make_shared<ClimbMade>(std::move(parts.Made));
  }
  else
  {
    auto made = std::make_shared<ClimbMade>();
    made->Options = task.Options.Ladder;
    made->Memory = std::move(memory);
    near.Trimmed = ClimbLadder(given, made->Options, made->End, promises);
    near.Made = std::move(made);
  }
  near.NodesLeft = FindNodesLeft(near, task.Surface, task.Precision);
}

void TakeCloser(TrimBand& near, const BandTask& task, const Progress& progress)
{
  const TrimCase given = CaseOf(near, task, progress);
  const auto closer = FindCloser(given, *near.Made, near.Trimmed);
  near.Trimmed.Unpolished = nullptr;
  if (!closer)
  {
    return;
  }
  const Shortcomings before = MeasureLeft(near);
  TrimmedBand trimmed = std::exchange(near.Trimmed, *closer);
  Offcut rest = std::move(near.Rest);
  auto left = std::move(near.NodesLeft);
  if (task.Options.ProduceOffcut)
  {
    near.Rest = FitOffcut(given, task.Options.Ladder, near.Trimmed);
  }
  near.NodesLeft = FindNodesLeft(near, task.Surface, task.Precision);
  if (!(MeasureLeft(near) < before))
  {
    near.Trimmed = std::move(trimmed);
    near.Rest = std::move(rest);
    near.NodesLeft = std::move(left);
  }
}

void FollowCreases(TrimBand& near, const BandTask& task, const Progress& progress)
{
  const TrimCase given = CaseOf(near, task, progress);
  const auto made = std::exchange(near.Made, nullptr);
  if (FollowCreases(given, *made, near.Trimmed))
  {
    near.NodesLeft = FindNodesLeft(near, task.Surface, task.Precision);
  }
}

namespace
{

/// Decides without a layer, or finds one on the way that leaves nothing where much would be left.
/// @return that; null: there is none, and the one without is made.
std::unique_ptr<TrimBand> DecideWithMeshOrLayer(
  TrimBand& near, const BandTask& task, BestLayer& layer, const Progress& progress)
{
  std::unique_ptr<TrimBand> layered;
  const auto goesOn = [&](const TrimmedBand& trimmed)
  {
    near.Trimmed = trimmed;
    near.NodesLeft = FindNodesLeft(near, task.Surface, task.Precision);
    if (near.NodesLeft.size() >= ManyLeft)
    {
      layered = layer.FindWhole(MeasureLeft(near), Part(progress, 0.0, 0.3));
    }
    return !layered;
  };
  const auto ends = [&](double done) { return progress(done) || layered; };
  DecideWithMesh(near, task, Part(ends, 0.3, 0.9), goesOn);
  TakeCloser(near, task, Part(ends, 0.9, 1.0));
  return layered;
}

/// @return a trim with a layer that is better; null: there is none, and the one without is made.
std::unique_ptr<TrimBand> DecideOnce(
  TrimBand& near, const BandTask& task, BestLayer& layer, const Progress& progress)
{
  if (!task.Options.MayInsert())
  {
    DecideWithMesh(near, task, Part(progress, 0.0, 0.85));
    TakeCloser(near, task, Part(progress, 0.85, 0.9));
    FollowCreases(near, task, Part(progress, 0.9, 1.0));
    return nullptr;
  }
  std::unique_ptr<TrimBand> layered;
  // There the ladder without a layer is long, and in vain.
  const std::size_t aslant = CountCutAslant(near, task, progress);
  if (aslant >= ManyAslant)
  {
    Shortcomings without;
    without.Squares = SquaresAslant * static_cast<double>(aslant);
    layered = layer.Find(without, false, Part(progress, 0.0, 0.5));
  }
  if (!layered)
  {
    layered = DecideWithMeshOrLayer(near, task, layer, Part(progress, 0.5, 0.8));
    if (!layered && !progress(0.8) && !near.NodesLeft.empty())
    {
      layered = layer.Find(MeasureLeft(near), true, Part(progress, 0.8, 1.0));
    }
  }
  if (!layered)
  {
    FollowCreases(near, task, progress);
  }
  return layered;
}

}

void DecideBand(TrimBand& near, const BandTask& task, const Progress& progress)
{
  const Columns structure = near.Structure;
  const VolumeShares shares = near.Shares;
  const std::vector<signed char> axis = near.SheetAxis;
  BestLayer layer(near, task);
  auto layered = DecideOnce(near, task, layer, Part(progress, 0.0, 0.95));
  if (!layered && !progress(-1.0) && SticksOut(near, task.Surface, task.Precision))
  {
    // It is hardly ever so, and asking it of every place would take all trims time. The layers stay
    // inside, and are as they were.
    near = TrimBand(std::move(near.Mesh));
    near.Structure = structure;
    near.Shares = shares;
    near.SheetAxis = axis;
    const BandOptions inside = task.Options.StayingInside();
    layered =
      DecideOnce(near, { task.Surface, task.Precision, inside }, layer, Part(progress, 0.95, 1.0));
  }
  if (layered)
  {
    near = std::move(*layered);
  }
}

}
