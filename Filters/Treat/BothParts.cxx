#include "BothParts.h"

#include "OffcutGuard.h"

#include <algorithm>
#include <memory>

namespace trim
{
namespace
{

/// Rounds in which columns change sides; after them nodes are left off the surface.
constexpr int RoundsOfFates = 4;
constexpr int MostRounds = 24;
/// Rounds in which nodes are left a step farther off each time; then they stay where they were.
constexpr int RoundsOfSteps = 14;
/// Columns with more than this share beyond the surface are not kept for the offcut's sake.
constexpr double LargestShare = 0.85;

/// What has to change for the invalid elements of an offcut.
class Demander
{
public:
  Demander(const TrimCase& given, Demands& demands)
    : TheBand(given.TheBand)
    , TheColumns(given.TheColumns)
    , Shares(given.Shares)
    , TheDemands(demands)
  {
  }

  /// False if there is nothing left to change.
  bool Add(const BothParts& parts, int round)
  {
    const bool mayTurn = round < RoundsOfFates;
    const int steps = round < RoundsOfSteps ? 1 : Demands::Steps;
    const Demands before = this->TheDemands;
    bool changed = false;
    for (const int e : parts.Rest.Invalid)
    {
      const int column = this->TheColumns.Column[e];
      const double share = this->Shares.Column[column];
      if (mayTurn && !parts.Kept.Kept[e] && !before.KeepColumn[column] && share > 0.0 &&
        share <= LargestShare)
      {
        this->TheDemands.KeepColumn[column] = 1;
        changed = true;
      }
      else
      {
        changed |= this->LeaveFarther(e, steps, before);
      }
    }
    return changed;
  }

private:
  /// Leaves the nodes of an element so many steps farther off the surface than before; false if
  /// they have none to go.
  bool LeaveFarther(int element, int steps, const Demands& before)
  {
    bool changed = false;
    for (const int node : this->TheBand.Elements[element])
    {
      const int pillar = this->TheColumns.Pillar[node];
      const int left = before.LeavePillar[pillar];
      this->TheDemands.LeavePillar[pillar] =
        static_cast<char>(std::min(left + steps, Demands::Steps));
      changed |= left < Demands::Steps;
    }
    return changed;
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  Demands& TheDemands;
};

/// Nodes that were left for the offcut come nearer to the surface as far as both parts stand it.
void ReturnForBoth(const TrimCase& given, const LadderOptions& options, BothParts& parts)
{
  const BandQuality quality(given.TheBand, options.Treatment, options.QualityFloor);
  OffcutGuard guard(given.TheBand, quality, parts.Kept, parts.Rest);
  TrialTrim(given, options)
    .ReturnDemanded(
      parts.Made.End.Set, [&guard](int node) { return guard.Stands(node); }, parts.Kept);
  guard.Follow();
}

}

Offcut FitOffcut(const TrimCase& given, const LadderOptions& options, const TrimmedBand& kept)
{
  const NodeMover mover(given.TheBand, given.TheColumns, given.Surface, given.Precision, false,
    given.Memory, options.StaysInside);
  const BandQuality quality(given.TheBand, options.Treatment, options.QualityFloor);
  const double goal = std::max(options.QualityFloor, SmallestGoal);
  return FitOffcut(given, mover, kept, quality, goal);
}

BothParts ClimbForBothParts(const TrimCase& alone, const LadderOptions& options)
{
  const Band& band = alone.TheBand;
  TrimCase given = alone;
  if (!given.Memory)
  {
    given.Memory = std::make_shared<MoverMemory>(band); // of all climbs
  }
  BothParts parts;
  parts.Made.Options = options;
  parts.Made.Memory = given.Memory;
  parts.Made.Failures = std::make_shared<FailedReturns>();
  LadderOptions& demanding = parts.Made.Options;
  demanding.FollowsCreases = TrialTrim::MayFollowCreases(given.Surface, options);
  demanding.ForOffcut.KeepColumn.assign(band.NumberOfElements(), 0);
  demanding.ForOffcut.LeavePillar.assign(band.NumberOfNodes(), 0);
  demanding.Failures = parts.Made.Failures.get();
  Demander demander(given, demanding.ForOffcut);
  double done = 0.0;
  for (int round = 0; round < MostRounds; ++round)
  {
    // Mostly there is one round; each takes half of what is left.
    const double next = 0.5 * (done + 1.0);
    given.Tell = Part(alone.Tell, done, next);
    parts.Kept = ClimbLadder(given, demanding, parts.Made.End);
    done = next;
    if (alone.Tell(done))
    {
      return parts;
    }
    parts.Rest = FitOffcut(given, options, parts.Kept);
    // Nobody would climb for what is added last.
    if (round + 1 == MostRounds || !demander.Add(parts, round))
    {
      break;
    }
  }
  ReturnForBoth(given, demanding, parts);
  return parts;
}

}
