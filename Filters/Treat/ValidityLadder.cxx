#include "ValidityLadder.h"

#include "AddUnique.h"
#include "FloorClimb.h"

#include <algorithm>

namespace trim
{
namespace
{

constexpr int LongestClimb = 40;

/// Shares of the whole work, about.
constexpr double Climbed = 0.2, Raised = 0.5, Left = 0.7, Returned = 0.9;

class Ladder
{
public:
  Ladder(const TrimCase& given, const LadderOptions& options, LadderPosition& position)
    : Given(given)
    , TheChoices(given, options, position)
  {
  }

  TrimmedBand Climb(const ClimbPromises& promises)
  {
    const Progress& progress = this->Given.Tell;
    TrimmedBand trimmed =
      this->TheChoices.Trial.Make(this->TheChoices.At.Set, this->TheChoices.Quality);
    int climb = 0;
    for (; climb < LongestClimb && !progress(Climbed * climb / LongestClimb); ++climb)
    {
      const std::vector<int> bad = this->FindBadColumns(trimmed);
      if (std::all_of(bad.begin(), bad.end(),
            [this](int c) { return this->TheChoices.At.Rungs[c] == Rung::Left; }))
      {
        break;
      }
      if (!this->TheChoices.TakeInside(trimmed, bad))
      {
        for (const int column : bad)
        {
          this->StepUp(trimmed, column);
        }
      }
      trimmed =
        this->TheChoices.Trial.Make(this->TheChoices.At.Set, this->TheChoices.Quality, &trimmed);
    }
    if (climb > 0)
    {
      this->RelaxAnew(trimmed);
    }
    this->TheChoices.LeaveInvalid(this->TheChoices.Quality, true, trimmed);
    progress(Climbed);
    if (promises.Valid && !promises.Valid(trimmed))
    {
      return trimmed;
    }
    RaiseToFloor(this->Given, this->TheChoices, trimmed);
    progress(Raised);
    LeaveBelowFloor(this->TheChoices, trimmed);
    this->ReturnLeft(trimmed, Part(progress, Left, Returned));
    progress(Returned);
    if (promises.Returned && !promises.Returned(trimmed))
    {
      return trimmed;
    }
    std::shared_ptr<const TrimmedBand> unpolished;
    if (this->TheChoices.CountLeft(trimmed) > 0)
    {
      unpolished = std::make_shared<TrimmedBand>(trimmed);
    }
    this->Finish(trimmed);
    trimmed.RescuedBy = this->TheChoices.At.Rungs;
    trimmed.AgainstVolume = this->TheChoices.Trial.FindAgainstVolume(trimmed);
    trimmed.Unpolished = unpolished;
    return trimmed;
  }

  /// See FindCloser.
  std::shared_ptr<const TrimmedBand> ReturnToFloor(const TrimmedBand& trimmed) const
  {
    const auto closer =
      this->TheChoices.Trial.ReturnLeftToFloor(this->TheChoices.At.Set, this->Given.Tell, trimmed);
    if (closer)
    {
      this->Finish(*closer);
      closer->RescuedBy = this->TheChoices.At.Rungs;
      closer->AgainstVolume = this->TheChoices.Trial.FindAgainstVolume(*closer);
      this->TellReturned(*closer, closer->RescuedBy);
    }
    return closer;
  }

  /// See FollowCreases.
  void FollowCreases(TrimmedBand& trimmed) const
  {
    this->TheChoices.Trial.FollowCreases(this->TheChoices.At.Set, trimmed);
    this->TheChoices.Trial.Straighten(this->TheChoices.At.Set, trimmed);
    trimmed.BelowFloor = this->TheChoices.Quality.FindBelowFloor(trimmed);
  }

private:
  /// Places that were relaxed for other choices may be no good ones for those that it ended with.
  void RelaxAnew(TrimmedBand& trimmed)
  {
    TrimmedBand anew =
      this->TheChoices.Trial.Make(this->TheChoices.At.Set, this->TheChoices.Quality);
    if (anew.Invalid.size() <= trimmed.Invalid.size())
    {
      trimmed = std::move(anew);
    }
  }

  /// Takes nodes that were left back to the surface. Columns that needed a rung are saved by
  /// leaving if they have a node left in the end, else by another way to the surface.
  void ReturnLeft(TrimmedBand& trimmed, const Progress& progress)
  {
    if (std::all_of(this->TheChoices.At.Rungs.begin(), this->TheChoices.At.Rungs.end(),
          [](Rung r) { return r == Rung::None; }))
    {
      return;
    }
    this->TheChoices.Trial.ReturnLeft(this->TheChoices.At.Set, progress, trimmed);
    this->TellReturned(trimmed, this->TheChoices.At.Rungs);
  }

  void Finish(TrimmedBand& trimmed) const
  {
    this->TheChoices.Trial.Polish(this->TheChoices.At.Set, trimmed);
    if (this->TheChoices.Options.FollowsCreases)
    {
      this->TheChoices.Trial.FollowCreases(this->TheChoices.At.Set, trimmed);
    }
    // At the very end: if nodes go to sharp edges yet, pillars come straight after that.
    if (this->TheChoices.Options.FollowsCreases || !this->TheChoices.Trial.MayFollowCreases())
    {
      this->TheChoices.Trial.Straighten(this->TheChoices.At.Set, trimmed);
    }
    trimmed.BelowFloor = this->TheChoices.Quality.FindBelowFloor(trimmed);
  }

  /// @param[in,out] rungs by column.
  void TellReturned(const TrimmedBand& trimmed, std::vector<Rung>& rungs) const
  {
    const std::vector<int> users = CountUsers(this->TheChoices.TheBand, trimmed);
    std::vector<char> hasLeft(this->TheChoices.TheBand.NumberOfElements(), 0);
    for (int e = 0; e < this->TheChoices.TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheChoices.TheBand.Elements[e];
      hasLeft[this->TheChoices.TheColumns.Column[e]] |= std::any_of(element.begin(), element.end(),
        [&](int n) { return users[n] > 0 && this->TheChoices.IsLeft(trimmed, n); });
    }
    for (std::size_t c = 0; c < rungs.size(); ++c)
    {
      if (rungs[c] != Rung::None && hasLeft[c])
      {
        rungs[c] = Rung::Left;
      }
      else if (rungs[c] == Rung::Left)
      {
        rungs[c] = Rung::Correction;
      }
    }
  }

  std::vector<int> FindBadColumns(const TrimmedBand& trimmed) const
  {
    std::vector<int> elements = trimmed.Invalid;
    for (int e = 0; e < this->TheChoices.TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheChoices.TheBand.Elements[e];
      for (int i = 0; trimmed.Kept[e] && i < element.Count; ++i)
      {
        if (trimmed.NodeMoves.Failed[element.Node[i]])
        {
          elements.push_back(e);
          break;
        }
      }
    }
    return this->TheChoices.ColumnsOf(elements);
  }

  bool HasInvalid(const TrimmedBand& trimmed, int column) const
  {
    return std::any_of(trimmed.Invalid.begin(), trimmed.Invalid.end(),
      [&](int e) { return this->TheChoices.TheColumns.Column[e] == column; });
  }

  /// Another correction for a pillar, if it is not behind the cut.
  void Turn(int pillar, CorrectionChoice choice)
  {
    auto& set = this->TheChoices.At.Set.Corrections[pillar].Correction;
    set = set == CorrectionChoice::Inside ? set : choice;
  }

  /// Lets the nodes of a column that found no place stay where they were.
  void LeaveFailed(const TrimmedBand& trimmed, int column)
  {
    this->TheChoices.ForNodes(column,
      [&](int node)
      {
        if (trimmed.NodeMoves.Failed[node])
        {
          this->TheChoices.LeaveOnWay({ this->TheChoices.TheColumns.Pillar[node] }, 0.0);
        }
      });
  }

  /// Lets nodes of a column that found no place end at corners of the model, if that is all that
  /// is wrong, and others above or below them found one; false if it is not, or was no help.
  bool EndAtCorners(const TrimmedBand& trimmed, int column)
  {
    bool only = !this->HasInvalid(trimmed, column);
    std::vector<int> pillars, placed;
    this->TheChoices.ForNodes(column,
      [&](int node)
      {
        const int pillar = this->TheChoices.TheColumns.Pillar[node];
        if (only && trimmed.NodeMoves.Failed[node])
        {
          only = !this->TheChoices.At.Set.Corrections[pillar].MayEndAtCorner &&
            this->TheChoices.Trial.MayEndAtCorner(node);
        }
        AddUnique(trimmed.NodeMoves.Failed[node] ? pillars : placed, pillar);
      });
    only = only &&
      std::all_of(pillars.begin(), pillars.end(),
        [&](int pillar)
        { return std::find(placed.begin(), placed.end(), pillar) != placed.end(); });
    for (std::size_t i = 0; only && i < pillars.size(); ++i)
    {
      this->TheChoices.At.Set.Corrections[pillars[i]].MayEndAtCorner = true;
    }
    return only;
  }

  /// The other treatment for the pentahedra of a column; false if it has none.
  bool TreatOtherwise(const TrimmedBand& trimmed, int column)
  {
    if (trimmed.Treated.Exposed.empty() || !trimmed.Treated.Exposed[column])
    {
      return false;
    }
    const auto other = this->TheChoices.Options.Treatment == Optimization::Degenerate
      ? TreatmentChoice::Distribute
      : TreatmentChoice::Degenerate;
    this->TheChoices.ForMovingPillars(
      trimmed, column, [&](int pillar) { this->TheChoices.At.Set.Treatments[pillar] = other; });
    return true;
  }

  /// The other correction for a column, and again the treatment that was asked for.
  void CorrectOtherwise(const TrimmedBand& trimmed, int column)
  {
    this->TheChoices.ForMovingPillars(trimmed, column,
      [&](int pillar)
      {
        this->TheChoices.At.Set.Treatments[pillar] = TreatmentChoice::AsAsked;
        this->Turn(pillar, CorrectionChoice::Other);
      });
  }

  /// Eliminates a column whose fate was not set; false if too little of it lies beyond the surface.
  bool Eliminate(int column)
  {
    Fate& fate = this->TheChoices.At.Set.Fates[column];
    if (fate != Fate::ByVolume || this->TheChoices.Shares.Column[column] < SmallestShare)
    {
      return false;
    }
    fate = Fate::Eliminate;
    this->TheChoices.DisturbAround(column);
    return true;
  }

  /// Leaves nodes of a column off the surface: those that found no place, or, where an element is
  /// invalid, as few as that takes.
  void LeaveNodes(const TrimmedBand& trimmed, int column)
  {
    if (!this->HasInvalid(trimmed, column))
    {
      this->LeaveFailed(trimmed, column);
      return;
    }
    if (this->TheChoices.LeaveBest(trimmed, column,
          this->TheChoices.PillarsToLeave(trimmed, column),
          std::max(this->TheChoices.Aimed.GetFloor(), SmallestGoal)))
    {
      return;
    }
    this->TheChoices.ForMovingPillars(trimmed, column,
      [&](int pillar)
      {
        this->TheChoices.At.Set.Corrections[pillar].Correction = CorrectionChoice::Leave;
        this->TheChoices.At.Set.Treatments[pillar] = TreatmentChoice::LeaveCorner;
      });
  }

  /// Undoes the rung that did not help and takes the next one that there is.
  void StepUp(const TrimmedBand& trimmed, int column)
  {
    const bool mayChange = !this->TheChoices.At.Disturbed[column];
    Rung& rung = this->TheChoices.At.Rungs[column];
    Fate& fate = this->TheChoices.At.Set.Fates[column];
    switch (rung)
    {
      case Rung::None:
        // A border node without a place, mostly a corner that is kept: with the elements round
        // it kept it need not move.
        rung = Rung::FateFirst;
        if (this->TheChoices.KeepAround(trimmed, column, true))
        {
          return;
        }
        [[fallthrough]];
      case Rung::FateFirst:
        if (this->EndAtCorners(trimmed, column))
        {
          return;
        }
        rung = Rung::Treatment;
        if (this->TreatOtherwise(trimmed, column))
        {
          return;
        }
        [[fallthrough]];
      case Rung::Treatment:
        rung = Rung::Correction;
        this->CorrectOtherwise(trimmed, column);
        return;
      case Rung::Correction:
        this->TheChoices.ForMovingPillars(
          trimmed, column, [&](int pillar) { this->Turn(pillar, CorrectionChoice::AsAsked); });
        rung = Rung::Fate;
        if (mayChange && this->Eliminate(column))
        {
          return;
        }
        [[fallthrough]];
      case Rung::Fate:
        fate = Fate::ByVolume;
        rung = Rung::FateAround;
        if (mayChange && this->TheChoices.KeepAround(trimmed, column, false))
        {
          return;
        }
        [[fallthrough]];
      default:
        this->TheChoices.GiveBack(column);
        fate = Fate::ByVolume;
        rung = Rung::Left;
        this->LeaveNodes(trimmed, column);
        return;
    }
  }

  const TrimCase& Given;
  ColumnChoices TheChoices;
};

}

TrimmedBand ClimbLadder(const TrimCase& given, const LadderOptions& options,
  LadderPosition& position, const ClimbPromises& promises)
{
  return Ladder(given, options, position).Climb(promises);
}

std::shared_ptr<const TrimmedBand> FindCloser(
  TrimCase given, const ClimbMade& made, const TrimmedBand& trimmed)
{
  if (!trimmed.Unpolished)
  {
    return nullptr;
  }
  given.Memory = made.Memory;
  LadderPosition end = made.End;
  return Ladder(given, made.Options, end).ReturnToFloor(*trimmed.Unpolished);
}

bool FollowCreases(TrimCase given, const ClimbMade& made, TrimmedBand& trimmed)
{
  if (made.Options.FollowsCreases || !TrialTrim::MayFollowCreases(given.Surface, made.Options))
  {
    return false;
  }
  given.Memory = made.Memory;
  LadderPosition end = made.End;
  Ladder(given, made.Options, end).FollowCreases(trimmed);
  return true;
}

}
