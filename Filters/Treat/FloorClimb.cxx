#include "FloorClimb.h"

#include <algorithm>

namespace trim
{
namespace
{

/// How many columns below the quality floor are tried with the other correction.
constexpr int MostFloorTrials = 32;
/// Columns below what is aimed at, but not below the floor, that are worth other choices.
constexpr std::size_t MostAimedColumns = 24;
/// A choice that leaves more than this of what misses the floor is none.
constexpr double LeastProgress = 0.999;
/// After a brief relaxation it may miss so many times as much, and one floor.
constexpr double MostPromising = 1.5;
/// An element counts on this much more than the floor from a pillar that is left.
constexpr double FloorMargin = 1.1;
/// Rounds in which single pillars are left for the sake of the floor, or all of a column go so
/// much of their way; then all of a column stay where they were.
constexpr int GradualRounds = 8;
constexpr double GradualWay = 0.7;

class FloorClimb
{
public:
  explicit FloorClimb(ColumnChoices& choices)
    : TheChoices(choices)
  {
  }

  /// The other correction, and then the other fates, for columns that relaxation could not raise
  /// to the aim. A trial is kept only where it helps and spoils nothing.
  void RaiseToFloor(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    if (!this->TheChoices.Aimed.FindBelowFloor(trimmed).empty())
    {
      this->TryForFloor(trimmed, nullptr);
    }
    else if (this->TheChoices.Quality.FindBelowFloor(trimmed).empty())
    {
      return;
    }
    this->TakeInsideForFloor(trimmed);
    std::vector<char> tried(this->TheChoices.TheBand.NumberOfElements(), 0);
    for (int trial = 0; trial < MostFloorTrials && !aborted(); ++trial)
    {
      const std::vector<int> below = this->TheChoices.Quality.FindBelowFloor(trimmed);
      int column = this->NextColumn(below, tried);
      if (column < 0)
      {
        column = this->NextColumn(this->FindFewShort(trimmed), tried);
      }
      if (column < 0)
      {
        return;
      }
      tried[column] = 1;
      // Where many are below, other fates would not end it.
      this->RaiseColumn(trimmed, column, below.size() <= MostFloorTrials);
    }
  }

  /// What is below the floor all the same: of the nodes of such a column one pillar is left off
  /// the surface, that which helps most, or all of them, little by little, if none does. An element
  /// that the nodes behind the cut spoil keeps its own where they were.
  void LeaveBelowFloor(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    bool anew = false;
    for (int round = 0; !aborted(); ++round)
    {
      const std::vector<int> below = this->TheChoices.Quality.FindBelowFloor(trimmed);
      bool changed = false;
      std::vector<char> seen(this->TheChoices.TheBand.NumberOfNodes(), 0);
      for (const int e : below)
      {
        changed |= this->LeaveForFloor(trimmed, e, round, seen);
      }
      for (std::size_t i = 0; anew && !changed && i < below.size(); ++i)
      {
        changed = this->TheChoices.LeaveWhole(below[i]);
      }
      if (!changed && (anew || below.empty()))
      {
        return;
      }
      // Places that were relaxed for other choices may keep an element below the floor: then from
      // the start.
      anew |= !changed;
      trimmed = this->TheChoices.Trial.Make(
        this->TheChoices.At.Set, this->TheChoices.Aimed, anew ? nullptr : &trimmed);
      this->TheChoices.LeaveInvalid(this->TheChoices.Aimed, anew, trimmed, aborted);
    }
  }

private:
  /// The first rung for columns below the floor, on to their neighbours as long as it helps.
  void TakeInsideForFloor(TrimmedBand& trimmed)
  {
    for (int round = 0; round < MostFloorTrials; ++round)
    {
      const Choices before = this->TheChoices.At.Set;
      const auto columns =
        this->TheChoices.ColumnsOf(this->TheChoices.Quality.FindBelowFloor(trimmed));
      if (!this->TheChoices.TakeInside(trimmed, columns) || !this->TryForFloor(trimmed, &trimmed))
      {
        this->TheChoices.At.Set = before;
        return;
      }
    }
  }

  /// The first column of a list of elements that was not tried; -1: none.
  int NextColumn(const std::vector<int>& elements, const std::vector<char>& tried) const
  {
    const auto next = std::find_if(elements.begin(), elements.end(),
      [&](int e) { return !tried[this->TheChoices.TheColumns.Column[e]]; });
    return next == elements.end() ? -1 : this->TheChoices.TheColumns.Column[*next];
  }

  /// Elements below the aim, if they are of a few columns only: a border that is short of it all
  /// along is not worth the time.
  std::vector<int> FindFewShort(const TrimmedBand& trimmed) const
  {
    const std::vector<int> below = this->TheChoices.Aimed.FindBelowFloor(trimmed);
    return this->TheChoices.ColumnsOf(below).size() <= MostAimedColumns ? below
                                                                        : std::vector<int>();
  }

  /// Climbs the rungs of one column until it reaches the aim.
  void RaiseColumn(TrimmedBand& trimmed, int column, bool otherFates)
  {
    for (const Rung rung : { Rung::Correction, Rung::Fate, Rung::FateAround })
    {
      const LadderPosition before = this->TheChoices.At;
      if ((!otherFates && rung != Rung::Correction) || !this->SetForFloor(trimmed, column, rung) ||
        !this->TryForFloor(trimmed, &trimmed))
      {
        this->TheChoices.At = before;
        continue;
      }
      this->TheChoices.At.Rungs[column] = rung;
      if (!this->IsShort(trimmed, column))
      {
        return;
      }
    }
  }

  /// Whether a column has an element below the aim.
  bool IsShort(const TrimmedBand& trimmed, int column) const
  {
    const std::vector<int> below = this->TheChoices.Aimed.FindBelowFloor(trimmed);
    return std::any_of(below.begin(), below.end(),
      [&](int e) { return this->TheChoices.TheColumns.Column[e] == column; });
  }

  /// Sets one rung for a column below the floor; false if it has no such choice.
  bool SetForFloor(const TrimmedBand& trimmed, int column, Rung rung)
  {
    switch (rung)
    {
      case Rung::Correction:
        this->TheChoices.ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            if (this->TheChoices.At.Set.Corrections[pillar].Correction == CorrectionChoice::AsAsked)
            {
              this->TheChoices.At.Set.Corrections[pillar].Correction = CorrectionChoice::Other;
            }
          });
        return true;
      case Rung::Fate:
        if (this->TheChoices.Shares.Column[column] < SmallestShare)
        {
          return false;
        }
        this->TheChoices.At.Set.Fates[column] = Fate::Eliminate;
        return true;
      default:
        return this->TheChoices.KeepAround(trimmed, column, false);
    }
  }

  /// Takes the trial into `trimmed` if it is nearer to the aim, and no worse otherwise.
  /// @param from see TrialTrim::Make.
  bool TryForFloor(TrimmedBand& trimmed, const TrimmedBand* from) const
  {
    const int left = this->TheChoices.CountLeft(trimmed);
    const double before = this->TheChoices.Quality.MeasureShortage(trimmed).Sum;
    const auto promises = [&](const TrimmedBand& trial)
    {
      return this->TheChoices.CountLeft(trial) <= left &&
        this->TheChoices.Quality.MeasureShortage(trial).Sum <=
        MostPromising * before + this->TheChoices.Options.QualityFloor;
    };
    TrimmedBand other =
      this->TheChoices.Trial.Make(this->TheChoices.At.Set, this->TheChoices.Aimed, from, promises);
    if (other.Invalid.size() > trimmed.Invalid.size() || this->TheChoices.CountLeft(other) > left)
    {
      return false;
    }
    const double after = this->TheChoices.Quality.MeasureShortage(other).Sum;
    const auto aimedBefore = this->TheChoices.Aimed.MeasureShortage(trimmed);
    const auto aimedAfter = this->TheChoices.Aimed.MeasureShortage(other);
    if (after > before || aimedAfter.Largest > aimedBefore.Largest ||
      (after > LeastProgress * before && aimedAfter.Sum > LeastProgress * aimedBefore.Sum))
    {
      return false;
    }
    trimmed = std::move(other);
    return true;
  }

  /// Leaves pillars of the column of an element below the floor; false if there is nothing more to
  /// leave.
  /// @param seen pillars of columns that had their turn in this round.
  bool LeaveForFloor(const TrimmedBand& trimmed, int element, int round, std::vector<char>& seen)
  {
    const int column = this->TheChoices.TheColumns.Column[element];
    const std::vector<int> pillars = this->TheChoices.PillarsToLeave(trimmed, column);
    const bool gradual = round < GradualRounds;
    // Of neighbours the first one: it may help the others.
    const bool waits = gradual &&
      std::any_of(pillars.begin(), pillars.end(), [&](int pillar) { return seen[pillar]; });
    for (const int pillar : pillars)
    {
      seen[pillar] = 1;
    }
    if (waits)
    {
      return true;
    }
    this->TheChoices.At.Rungs[column] = Rung::Left;
    const double least = FloorMargin * this->TheChoices.Options.QualityFloor;
    const double aim = this->TheChoices.Aimed.GetFloor();
    if (gradual &&
      ((aim > least && this->TheChoices.LeaveBest(trimmed, column, pillars, aim)) ||
        this->TheChoices.LeaveBest(trimmed, column, pillars, least)))
    {
      return true;
    }
    this->TheChoices.LeaveOnWay(pillars, gradual ? GradualWay : 0.0);
    return !pillars.empty() || this->TheChoices.LeaveCorners(element);
  }

  ColumnChoices& TheChoices;
};

}

void RaiseToFloor(
  ColumnChoices& choices, const std::function<bool()>& aborted, TrimmedBand& trimmed)
{
  FloorClimb(choices).RaiseToFloor(trimmed, aborted);
}

void LeaveBelowFloor(
  ColumnChoices& choices, const std::function<bool()>& aborted, TrimmedBand& trimmed)
{
  FloorClimb(choices).LeaveBelowFloor(trimmed, aborted);
}

}
