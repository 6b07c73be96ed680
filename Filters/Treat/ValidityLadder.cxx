#include "ValidityLadder.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

constexpr int LongestClimb = 40;
/// How many columns below the quality floor are tried with the other correction.
constexpr int MostFloorTrials = 32;
/// Columns below what is aimed at, but not below the floor, that are worth other choices.
constexpr std::size_t MostAimedColumns = 24;
/// A choice that leaves more than this of what misses the floor is none.
constexpr double LeastProgress = 0.999;
/// After a brief relaxation it may miss so many times as much, and one floor.
constexpr double MostPromising = 1.5;
/// Columns with less than this share beyond the surface are never eliminated by the ladder, nor
/// are those with more than the complement kept: the trim would wander off.
constexpr double SmallestShare = 0.15;

/// An element counts on this much more than the floor from a pillar that is left.
constexpr double FloorMargin = 1.1;
/// Rounds in which single pillars are left for the sake of the floor, or all of a column go so
/// much of their way; then all of a column stay where they were.
constexpr int GradualRounds = 8;
constexpr double GradualWay = 0.7;

/// Shares of the whole work, about.
constexpr double Climbed = 0.2, Raised = 0.4, Left = 0.6, Returned = 0.9;

void AddUnique(std::vector<int>& list, int value)
{
  if (std::find(list.begin(), list.end(), value) == list.end())
  {
    list.push_back(value);
  }
}

class Ladder
{
public:
  Ladder(const Band& band, const Columns& columns, const VolumeShares& shares,
    const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
    double precision, const LadderOptions& options, LadderPosition& position)
    : TheBand(band)
    , TheColumns(columns)
    , Shares(shares)
    , Options(options)
    , Quality(band, options.Treatment, options.QualityFloor)
    , Aimed(band, options.Treatment, options.AimedQuality())
    , Trial(band, columns, shares, nodeStatus, surface, precision, options)
    , Members(columns.Elements())
    , At(position)
  {
    if (!this->At.Rungs.empty())
    {
      return;
    }
    this->At.Rungs.assign(band.NumberOfElements(), Rung::None);
    this->At.Disturbed.assign(band.NumberOfElements(), 0);
    this->At.Set.Fates.assign(band.NumberOfElements(), Fate::ByVolume);
    this->At.Set.Corrections.assign(band.NumberOfNodes(), PillarChoice());
    this->At.Set.Treatments.assign(band.NumberOfNodes(), TreatmentChoice::AsAsked);
  }

  TrimmedBand Climb(const Progress& progress)
  {
    const auto aborted = [&progress] { return progress(-1.0); };
    TrimmedBand trimmed = this->Trial.Make(this->At.Set, this->Quality);
    int climb = 0;
    for (; climb < LongestClimb && !progress(Climbed * climb / LongestClimb); ++climb)
    {
      trimmed.Invalid = this->Quality.FindInvalid(trimmed);
      const std::vector<int> bad = this->FindBadColumns(trimmed);
      if (std::all_of(
            bad.begin(), bad.end(), [this](int c) { return this->At.Rungs[c] == Rung::Left; }))
      {
        break;
      }
      if (!this->TakeInside(trimmed, bad))
      {
        for (const int column : bad)
        {
          this->StepUp(trimmed, column);
        }
      }
      trimmed = this->Trial.Make(this->At.Set, this->Quality, &trimmed);
    }
    if (climb > 0)
    {
      this->RelaxAnew(trimmed);
    }
    this->LeaveInvalid(this->Quality, true, trimmed, aborted);
    progress(Climbed);
    this->RaiseToFloor(trimmed, aborted);
    progress(Raised);
    this->LeaveBelowFloor(trimmed, aborted);
    this->ReturnLeft(trimmed, Part(progress, Left, Returned));
    progress(Returned);
    this->Trial.Polish(this->At.Set, trimmed);
    trimmed.RescuedBy = this->At.Rungs;
    trimmed.BelowFloor = this->Quality.FindBelowFloor(trimmed);
    return trimmed;
  }

private:
  /// Places that were relaxed for other choices may be no good ones for those that it ended with.
  void RelaxAnew(TrimmedBand& trimmed) const
  {
    TrimmedBand anew = this->Trial.Make(this->At.Set, this->Quality);
    anew.Invalid = this->Quality.FindInvalid(anew);
    if (anew.Invalid.size() <= trimmed.Invalid.size())
    {
      trimmed = std::move(anew);
    }
  }

  /// The first rung: pillars of columns and round them that are behind the cut stay there; false if
  /// there are no others.
  bool TakeInside(const TrimmedBand& trimmed, const std::vector<int>& columns)
  {
    const std::vector<char> behind = this->Trial.FindPillarsBehind(trimmed);
    bool changed = false;
    const auto take = [&](int e)
    {
      const auto& element = this->TheBand.Elements[e];
      for (int i = 0; i < element.Count; ++i)
      {
        const int pillar = this->TheColumns.Pillar[element.Node[i]];
        auto& set = this->At.Set.Corrections[pillar];
        if (behind[pillar] && set.Correction < CorrectionChoice::Leave)
        {
          set = { CorrectionChoice::Inside, 0.0 };
          changed = true;
        }
      }
    };
    for (const int column : columns)
    {
      const auto& element = this->TheBand.Elements[column];
      for (int i = 0; i < element.Count; ++i)
      {
        for (const int e : this->TheBand.ElementsOfNode(element.Node[i]))
        {
          take(e);
        }
      }
    }
    return changed;
  }

  /// Whether a node of the new boundary is not on the surface.
  bool IsLeft(const TrimmedBand& trimmed, int node) const
  {
    return trimmed.NodeMoves.Left[node] &&
      this->At.Set.Corrections[this->TheColumns.Pillar[node]].Correction !=
      CorrectionChoice::Inside;
  }

  int CountLeft(const TrimmedBand& trimmed) const
  {
    int left = 0;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      left += this->IsLeft(trimmed, n);
    }
    return left;
  }

  /// The other correction, and then the other fates, for columns that relaxation could not raise
  /// to the aim. A trial is kept only where it helps and spoils nothing.
  void RaiseToFloor(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    if (!this->Aimed.FindBelowFloor(trimmed).empty())
    {
      this->TryForFloor(trimmed, nullptr);
    }
    else if (this->Quality.FindBelowFloor(trimmed).empty())
    {
      return;
    }
    this->TakeInsideForFloor(trimmed);
    std::vector<char> tried(this->TheBand.NumberOfElements(), 0);
    for (int trial = 0; trial < MostFloorTrials && !aborted(); ++trial)
    {
      const std::vector<int> below = this->Quality.FindBelowFloor(trimmed);
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

  /// The first rung for columns below the floor, on to their neighbours as long as it helps.
  void TakeInsideForFloor(TrimmedBand& trimmed)
  {
    for (int round = 0; round < MostFloorTrials; ++round)
    {
      const Choices before = this->At.Set;
      const auto columns = this->ColumnsOf(this->Quality.FindBelowFloor(trimmed));
      if (!this->TakeInside(trimmed, columns) || !this->TryForFloor(trimmed, &trimmed))
      {
        this->At.Set = before;
        return;
      }
    }
  }

  /// The first column of a list of elements that was not tried; -1: none.
  int NextColumn(const std::vector<int>& elements, const std::vector<char>& tried) const
  {
    const auto next = std::find_if(
      elements.begin(), elements.end(), [&](int e) { return !tried[this->TheColumns.Column[e]]; });
    return next == elements.end() ? -1 : this->TheColumns.Column[*next];
  }

  /// Elements below the aim, if they are of a few columns only: a border that is short of it all
  /// along is not worth the time.
  std::vector<int> FindFewShort(const TrimmedBand& trimmed) const
  {
    const std::vector<int> below = this->Aimed.FindBelowFloor(trimmed);
    return this->ColumnsOf(below).size() <= MostAimedColumns ? below : std::vector<int>();
  }

  /// Climbs the rungs of one column until it reaches the aim.
  void RaiseColumn(TrimmedBand& trimmed, int column, bool otherFates)
  {
    for (const Rung rung : { Rung::Correction, Rung::Fate, Rung::FateAround })
    {
      const LadderPosition before = this->At;
      if ((!otherFates && rung != Rung::Correction) || !this->SetForFloor(trimmed, column, rung) ||
        !this->TryForFloor(trimmed, &trimmed))
      {
        this->At = before;
        continue;
      }
      this->At.Rungs[column] = rung;
      if (!this->IsShort(trimmed, column))
      {
        return;
      }
    }
  }

  /// Whether a column has an element below the aim.
  bool IsShort(const TrimmedBand& trimmed, int column) const
  {
    const std::vector<int> below = this->Aimed.FindBelowFloor(trimmed);
    return std::any_of(
      below.begin(), below.end(), [&](int e) { return this->TheColumns.Column[e] == column; });
  }

  /// Sets one rung for a column below the floor; false if it has no such choice.
  bool SetForFloor(const TrimmedBand& trimmed, int column, Rung rung)
  {
    switch (rung)
    {
      case Rung::Correction:
        this->ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            if (this->At.Set.Corrections[pillar].Correction == CorrectionChoice::AsAsked)
            {
              this->At.Set.Corrections[pillar].Correction = CorrectionChoice::Other;
            }
          });
        return true;
      case Rung::Fate:
        if (this->Shares.Column[column] < SmallestShare)
        {
          return false;
        }
        this->At.Set.Fates[column] = Fate::Eliminate;
        return true;
      default:
        return this->KeepAround(trimmed, column, false);
    }
  }

  /// Takes the trial into `trimmed` if it is nearer to the aim, and no worse otherwise.
  /// @param from see TrialTrim::Make.
  bool TryForFloor(TrimmedBand& trimmed, const TrimmedBand* from) const
  {
    const int left = this->CountLeft(trimmed);
    const double before = this->Quality.MeasureShortage(trimmed).Sum;
    const auto promises = [&](const TrimmedBand& trial)
    {
      return this->CountLeft(trial) <= left &&
        this->Quality.MeasureShortage(trial).Sum <=
        MostPromising * before + this->Options.QualityFloor;
    };
    TrimmedBand other = this->Trial.Make(this->At.Set, this->Aimed, from, promises);
    other.Invalid = this->Quality.FindInvalid(other);
    if (other.Invalid.size() > trimmed.Invalid.size() || this->CountLeft(other) > left)
    {
      return false;
    }
    const double after = this->Quality.MeasureShortage(other).Sum;
    const auto aimedBefore = this->Aimed.MeasureShortage(trimmed);
    const auto aimedAfter = this->Aimed.MeasureShortage(other);
    if (after > before || aimedAfter.Largest > aimedBefore.Largest ||
      (after > LeastProgress * before && aimedAfter.Sum > LeastProgress * aimedBefore.Sum))
    {
      return false;
    }
    trimmed = std::move(other);
    return true;
  }

  /// What is below the floor all the same: of the nodes of such a column one pillar is left off
  /// the surface, that which helps most, or all of them, little by little, if none does. An element
  /// that the nodes behind the cut spoil keeps its own where they were.
  void LeaveBelowFloor(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    bool anew = false;
    for (int round = 0; !aborted(); ++round)
    {
      const std::vector<int> below = this->Quality.FindBelowFloor(trimmed);
      bool changed = false;
      std::vector<char> seen(this->TheBand.NumberOfNodes(), 0);
      for (const int e : below)
      {
        changed |= this->LeaveForFloor(trimmed, e, round, seen);
      }
      for (std::size_t i = 0; anew && !changed && i < below.size(); ++i)
      {
        changed = this->LeaveWhole(below[i]);
      }
      if (!changed && (anew || below.empty()))
      {
        return;
      }
      // Places that were relaxed for other choices may keep an element below the floor: then from
      // the start.
      anew |= !changed;
      trimmed = this->Trial.Make(this->At.Set, this->Aimed, anew ? nullptr : &trimmed);
      this->LeaveInvalid(this->Aimed, anew, trimmed, aborted);
    }
  }

  /// Leaves pillars of the column of an element below the floor; false if there is nothing more to
  /// leave.
  /// @param seen pillars of columns that had their turn in this round.
  bool LeaveForFloor(const TrimmedBand& trimmed, int element, int round, std::vector<char>& seen)
  {
    const int column = this->TheColumns.Column[element];
    const std::vector<int> pillars = this->PillarsToLeave(trimmed, column);
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
    this->At.Rungs[column] = Rung::Left;
    const double least = FloorMargin * this->Options.QualityFloor;
    const double aim = this->Aimed.GetFloor();
    if (gradual &&
      ((aim > least && this->LeaveBest(trimmed, column, pillars, aim)) ||
        this->LeaveBest(trimmed, column, pillars, least)))
    {
      return true;
    }
    this->LeaveOnWay(pillars, gradual ? GradualWay : 0.0);
    return !pillars.empty() || this->LeaveCorners(element);
  }

  /// Pillars of a column that go to the surface, or part of the way.
  std::vector<int> PillarsToLeave(const TrimmedBand& trimmed, int column)
  {
    std::vector<int> pillars;
    this->ForMovingPillars(trimmed, column,
      [&](int pillar)
      {
        const auto& set = this->At.Set.Corrections[pillar];
        if (set.Correction != CorrectionChoice::Leave || set.Way > 0.0)
        {
          AddUnique(pillars, pillar);
        }
      });
    return pillars;
  }

  /// Leaves that pillar of a column off the surface that can go farthest of its way with no element
  /// of the column below `least`, or all of them; false if no part of the way does it.
  bool LeaveBest(
    const TrimmedBand& trimmed, int column, const std::vector<int>& pillars, double least)
  {
    std::vector<std::vector<int>> choices;
    for (const int pillar : pillars)
    {
      choices.push_back({ pillar });
    }
    for (const auto& together : { choices, { pillars } })
    {
      for (const double way : { 0.75, 0.5, 0.25, 0.0 })
      {
        const std::vector<int>* best = nullptr;
        double quality = least;
        for (const auto& choice : together)
        {
          const double found =
            this->Quality.LowestIfLeft(trimmed, this->TheColumns, column, choice, way);
          if (found >= quality)
          {
            quality = found;
            best = &choice;
          }
        }
        if (best)
        {
          this->LeaveOnWay(*best, way);
          return true;
        }
      }
    }
    return false;
  }

  /// Shortens the ways of pillars.
  void LeaveOnWay(const std::vector<int>& pillars, double way)
  {
    for (const int pillar : pillars)
    {
      auto& set = this->At.Set.Corrections[pillar];
      const double gone = set.Correction == CorrectionChoice::Leave ? set.Way : 1.0;
      set = { CorrectionChoice::Leave, gone * way };
    }
  }

  /// Takes nodes that were left back to the surface. Columns that needed a rung are saved by
  /// leaving if they have a node left in the end, else by another way to the surface.
  void ReturnLeft(TrimmedBand& trimmed, const Progress& progress)
  {
    if (std::all_of(
          this->At.Rungs.begin(), this->At.Rungs.end(), [](Rung r) { return r == Rung::None; }))
    {
      return;
    }
    this->Trial.ReturnLeft(this->At.Set, progress, trimmed);
    const std::vector<int> users = CountUsers(this->TheBand, trimmed);
    std::vector<char> hasLeft(this->TheBand.NumberOfElements(), 0);
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheBand.Elements[e];
      hasLeft[this->TheColumns.Column[e]] |=
        std::any_of(element.Node.begin(), element.Node.begin() + element.Count,
          [&](int n) { return users[n] > 0 && this->IsLeft(trimmed, n); });
    }
    for (std::size_t c = 0; c < this->At.Rungs.size(); ++c)
    {
      if (this->At.Rungs[c] != Rung::None && hasLeft[c])
      {
        this->At.Rungs[c] = Rung::Left;
      }
      else if (this->At.Rungs[c] == Rung::Left)
      {
        this->At.Rungs[c] = Rung::Correction;
      }
    }
  }

  /// All edges of an element stay; false if that was set already.
  bool LeaveCorners(int e)
  {
    bool changed = false;
    const auto& element = this->TheBand.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      auto& treatment = this->At.Set.Treatments[this->TheColumns.Pillar[element.Node[i]]];
      changed |= treatment != TreatmentChoice::LeaveCorner;
      treatment = TreatmentChoice::LeaveCorner;
    }
    return changed;
  }

  /// Lets all nodes of an element stay where they were, those behind the cut too; false if they do.
  bool LeaveWhole(int e)
  {
    this->At.Rungs[this->TheColumns.Column[e]] = Rung::Left;
    bool changed = this->LeaveCorners(e);
    const auto& element = this->TheBand.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      auto& set = this->At.Set.Corrections[this->TheColumns.Pillar[element.Node[i]]];
      changed |= set.Correction != CorrectionChoice::Leave || set.Way > 0.0;
      set = { CorrectionChoice::Leave, 0.0 };
    }
    return changed;
  }

  /// The end of the ladder, which always holds: all nodes of what is still invalid stay where
  /// they were. The set of such nodes only grows, and an element that has only such is as it came.
  /// @param anew whether what had not changed is relaxed anew too.
  void LeaveInvalid(
    const BandQuality& goal, bool anew, TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    while (!aborted())
    {
      trimmed.Invalid = this->Quality.FindInvalid(trimmed);
      bool changed = false;
      for (const int e : trimmed.Invalid)
      {
        changed |= this->LeaveWhole(e);
      }
      if (!changed)
      {
        return;
      }
      trimmed = this->Trial.Make(this->At.Set, goal, anew ? nullptr : &trimmed);
    }
  }

  std::vector<int> FindBadColumns(const TrimmedBand& trimmed) const
  {
    std::vector<int> elements = trimmed.Invalid;
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheBand.Elements[e];
      for (int i = 0; trimmed.Kept[e] && i < element.Count; ++i)
      {
        if (trimmed.NodeMoves.Failed[element.Node[i]])
        {
          elements.push_back(e);
          break;
        }
      }
    }
    return this->ColumnsOf(elements);
  }

  bool HasInvalid(const TrimmedBand& trimmed, int column) const
  {
    return std::any_of(trimmed.Invalid.begin(), trimmed.Invalid.end(),
      [&](int e) { return this->TheColumns.Column[e] == column; });
  }

  /// The columns of elements, each once, ascending.
  std::vector<int> ColumnsOf(const std::vector<int>& elements) const
  {
    std::vector<int> columns;
    for (const int e : elements)
    {
      columns.push_back(this->TheColumns.Column[e]);
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
  }

  /// Calls action(node) for the nodes of each element of a column.
  template <typename Action>
  void ForNodes(int column, const Action& action) const
  {
    for (const int* e = this->Members.begin(column); e != this->Members.end(column); ++e)
    {
      const auto& element = this->TheBand.Elements[*e];
      std::for_each(element.Node.begin(), element.Node.begin() + element.Count, action);
    }
  }

  template <typename Action>
  void ForMovingPillars(const TrimmedBand& trimmed, int column, const Action& action) const
  {
    this->ForNodes(column,
      [&](int node)
      {
        if (trimmed.Moving[node])
        {
          action(this->TheColumns.Pillar[node]);
        }
      });
  }

  /// Keeps the eliminated columns that share nodes with a column, or only those nodes that found
  /// no place; false if there are none.
  bool KeepAround(const TrimmedBand& trimmed, int column, bool failedOnly)
  {
    auto& kept = this->At.KeptFor[column];
    const std::size_t before = kept.size();
    this->ForNodes(column,
      [&](int node)
      {
        if (failedOnly && !trimmed.NodeMoves.Failed[node])
        {
          return;
        }
        for (const int other : this->TheBand.ElementsOfNode(node))
        {
          const int around = this->TheColumns.Column[other];
          if (!trimmed.Kept[other] && this->At.Set.Fates[around] == Fate::ByVolume &&
            this->Shares.Column[around] <= 1.0 - SmallestShare)
          {
            this->At.Set.Fates[around] = Fate::Keep;
            this->DisturbAround(around);
            kept.push_back(around);
          }
        }
      });
    return kept.size() > before;
  }

  /// What was kept for a column that had no use of it is decided by its volume again.
  void GiveBack(int column)
  {
    for (const int around : this->At.KeptFor[column])
    {
      this->At.Set.Fates[around] = Fate::ByVolume;
    }
    this->At.KeptFor[column].clear();
  }

  /// A fate that was changed may spoil the next columns. Theirs are not changed then: trouble would
  /// wander along the cut without an end.
  void DisturbAround(int changed)
  {
    this->ForNodes(changed,
      [this](int node)
      {
        for (const int other : this->TheBand.ElementsOfNode(node))
        {
          const int next = this->TheColumns.Column[other];
          this->At.Disturbed[next] |= this->At.Rungs[next] == Rung::None;
        }
      });
  }

  /// Another correction for a pillar, if it is not behind the cut.
  void Turn(int pillar, CorrectionChoice choice)
  {
    auto& set = this->At.Set.Corrections[pillar].Correction;
    set = set == CorrectionChoice::Inside ? set : choice;
  }

  /// Lets the nodes of a column that found no place stay where they were.
  void LeaveFailed(const TrimmedBand& trimmed, int column)
  {
    this->ForNodes(column,
      [&](int node)
      {
        if (trimmed.NodeMoves.Failed[node])
        {
          this->LeaveOnWay({ this->TheColumns.Pillar[node] }, 0.0);
        }
      });
  }

  /// Lets nodes of a column that found no place end at corners of the model, if that is all that
  /// is wrong, and others above or below them found one; false if it is not, or was no help.
  bool EndAtCorners(const TrimmedBand& trimmed, int column)
  {
    bool only = !this->HasInvalid(trimmed, column);
    std::vector<int> pillars, placed;
    this->ForNodes(column,
      [&](int node)
      {
        const int pillar = this->TheColumns.Pillar[node];
        if (only && trimmed.NodeMoves.Failed[node])
        {
          only =
            !this->At.Set.Corrections[pillar].MayEndAtCorner && this->Trial.MayEndAtCorner(node);
        }
        AddUnique(trimmed.NodeMoves.Failed[node] ? pillars : placed, pillar);
      });
    only = only &&
      std::all_of(pillars.begin(), pillars.end(),
        [&](int pillar)
        { return std::find(placed.begin(), placed.end(), pillar) != placed.end(); });
    for (std::size_t i = 0; only && i < pillars.size(); ++i)
    {
      this->At.Set.Corrections[pillars[i]].MayEndAtCorner = true;
    }
    return only;
  }

  /// Undoes the rung that did not help and takes the next one.
  void StepUp(const TrimmedBand& trimmed, int column)
  {
    const bool mayChange = !this->At.Disturbed[column];
    switch (this->At.Rungs[column])
    {
      case Rung::None:
        // A border node without a place, mostly a corner that is kept: with the elements round
        // it kept it need not move.
        this->At.Rungs[column] = Rung::FateFirst;
        if (this->KeepAround(trimmed, column, true))
        {
          return;
        }
        [[fallthrough]];
      case Rung::FateFirst:
        if (this->EndAtCorners(trimmed, column))
        {
          return;
        }
        this->At.Rungs[column] = Rung::Treatment;
        if (trimmed.Treated.Exposed.size() && trimmed.Treated.Exposed[column])
        {
          const auto other = this->Options.Treatment == Optimization::Degenerate
            ? TreatmentChoice::Distribute
            : TreatmentChoice::Degenerate;
          this->ForMovingPillars(
            trimmed, column, [&](int pillar) { this->At.Set.Treatments[pillar] = other; });
          return;
        }
        [[fallthrough]];
      case Rung::Treatment:
        this->At.Rungs[column] = Rung::Correction;
        this->ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            this->At.Set.Treatments[pillar] = TreatmentChoice::AsAsked;
            this->Turn(pillar, CorrectionChoice::Other);
          });
        return;
      case Rung::Correction:
        this->ForMovingPillars(
          trimmed, column, [&](int pillar) { this->Turn(pillar, CorrectionChoice::AsAsked); });
        this->At.Rungs[column] = Rung::Fate;
        if (mayChange && this->At.Set.Fates[column] == Fate::ByVolume &&
          this->Shares.Column[column] >= SmallestShare)
        {
          this->At.Set.Fates[column] = Fate::Eliminate;
          this->DisturbAround(column);
          return;
        }
        [[fallthrough]];
      case Rung::Fate:
        this->At.Set.Fates[column] = Fate::ByVolume;
        this->At.Rungs[column] = Rung::FateAround;
        if (mayChange && this->KeepAround(trimmed, column, false))
        {
          return;
        }
        [[fallthrough]];
      default:
        this->GiveBack(column);
        this->At.Set.Fates[column] = Fate::ByVolume;
        this->At.Rungs[column] = Rung::Left;
        if (!this->HasInvalid(trimmed, column))
        {
          this->LeaveFailed(trimmed, column);
          return;
        }
        if (this->LeaveBest(trimmed, column, this->PillarsToLeave(trimmed, column),
              std::max(this->Aimed.GetFloor(), SmallestGoal)))
        {
          return;
        }
        this->ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            this->At.Set.Corrections[pillar].Correction = CorrectionChoice::Leave;
            this->At.Set.Treatments[pillar] = TreatmentChoice::LeaveCorner;
          });
        return;
    }
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const LadderOptions& Options;
  BandQuality Quality;
  BandQuality Aimed;
  TrialTrim Trial;
  const Band::Lists Members; ///< elements of each column
  LadderPosition& At;
};

}

TrimmedBand ClimbLadder(const Band& band, const Columns& columns, const VolumeShares& shares,
  const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
  double precision, const LadderOptions& options, const Progress& progress,
  LadderPosition& position)
{
  return Ladder(band, columns, shares, nodeStatus, surface, precision, options, position)
    .Climb(progress);
}

}
