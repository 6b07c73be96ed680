/// @file FloorRaise.cxx
/// @brief Other corrections and fates for what is below the floor.
#include "FloorClimb.h"

#include "Runs.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

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

class FloorRaise
{
public:
  FloorRaise(const TrimCase& given, ColumnChoices& choices)
    : Given(given)
    , TheChoices(choices)
  {
  }

  /// The other correction, and then the other fates, for columns that relaxation could not raise
  /// to the aim. A trial is kept only where it helps and spoils nothing.
  void RaiseToFloor(TrimmedBand& trimmed)
  {
    if (!this->TheChoices.Aimed.FindBelowFloor(trimmed).empty())
    {
      TakeIfBetter(TryForFloor(this->TheChoices, trimmed, nullptr), trimmed);
    }
    else if (this->TheChoices.Quality.FindBelowFloor(trimmed).empty())
    {
      return;
    }
    this->TakeInsideForFloor(trimmed);
    Tried tried;
    tried.Columns.assign(this->TheChoices.TheBand.NumberOfElements(), 0);
    while (!this->TheChoices.Aborted())
    {
      const std::vector<Step> steps = this->StepsFrom(trimmed, tried);
      const std::size_t taken = this->TakeFirst(steps, trimmed);
      if (taken == steps.size())
      {
        return;
      }
      for (std::size_t i = 0; i <= taken; ++i)
      {
        tried.Count += !std::exchange(tried.Columns[steps[i].Column], 1);
      }
      tried.Last = steps[taken];
    }
  }

private:
  /// What is tried for a column.
  struct Step
  {
    int Column;
    Rung With;
    bool OtherFates; ///< may follow for this column
  };

  struct Tried
  {
    std::vector<char> Columns;
    int Count = 0;
    std::optional<Step> Last; ///< that helped
  };

  /// Choices of its own for a thread.
  struct Fork
  {
    LadderPosition At;
    ColumnChoices Choices;

    Fork(const TrimCase& given, const ColumnChoices& from)
      : At(from.At)
      , Choices(given, from.Options, this->At)
    {
    }
  };

  static bool TakeIfBetter(std::optional<TrimmedBand> better, TrimmedBand& trimmed)
  {
    if (better)
    {
      trimmed = std::move(*better);
    }
    return better.has_value();
  }

  /// The first rung for columns below the floor, on to their neighbours as long as it helps.
  void TakeInsideForFloor(TrimmedBand& trimmed)
  {
    for (int round = 0; round < MostFloorTrials; ++round)
    {
      const Choices before = this->TheChoices.At.Set;
      const auto columns =
        this->TheChoices.ColumnsOf(this->TheChoices.Quality.FindBelowFloor(trimmed));
      if (!this->TheChoices.TakeInside(trimmed, columns) ||
        !TakeIfBetter(TryForFloor(this->TheChoices, trimmed, &trimmed), trimmed))
      {
        this->TheChoices.At.Set = before;
        return;
      }
    }
  }

  /// Elements below the aim, if they are of a few columns only: a border that is short of it all
  /// along is not worth the time.
  std::vector<int> FindFewShort(const TrimmedBand& trimmed) const
  {
    const std::vector<int> below = this->TheChoices.Aimed.FindBelowFloor(trimmed);
    return this->TheChoices.ColumnsOf(below).size() <= MostAimedColumns ? below
                                                                        : std::vector<int>();
  }

  /// What is left to be tried one after the other, if nothing of it helps: of a column that has not
  /// reached the aim yet the other rungs, then columns below the floor, and those below the aim.
  std::vector<Step> StepsFrom(const TrimmedBand& trimmed, const Tried& tried) const
  {
    std::vector<Step> steps;
    const auto add = [&steps](const Step& first)
    {
      steps.push_back(first);
      for (const Rung rung : { Rung::Fate, Rung::FateAround })
      {
        if (first.OtherFates && rung > first.With)
        {
          steps.push_back({ first.Column, rung, true });
        }
      }
    };
    if (tried.Last && this->IsShort(trimmed, tried.Last->Column))
    {
      add(*tried.Last);
      steps.erase(steps.begin()); // that one was taken
    }
    const std::vector<int> below = this->TheChoices.Quality.FindBelowFloor(trimmed);
    // Where many are below, other fates would not end it.
    const bool otherFates = below.size() <= MostFloorTrials;
    std::vector<char> seen = tried.Columns;
    int count = tried.Count;
    for (const auto& elements : { below, this->FindFewShort(trimmed) })
    {
      for (const int e : elements)
      {
        const int column = this->TheChoices.TheColumns.Column[e];
        if (count < MostFloorTrials && !std::exchange(seen[column], 1))
        {
          ++count;
          add({ column, Rung::Correction, otherFates });
        }
      }
    }
    return steps;
  }

  /// Tries steps from where the columns are, each by itself, several at once, and takes the first
  /// that helps: as they all start there, it is the same one with any number of threads.
  /// @return which; the number of steps if none does.
  std::size_t TakeFirst(const std::vector<Step>& steps, TrimmedBand& trimmed)
  {
    const std::size_t atOnce = ThreadsForLoops();
    for (std::size_t next = 0; next < steps.size() && !this->TheChoices.Aborted();)
    {
      std::vector<std::size_t> trials;
      for (; next < steps.size() && trials.size() < atOnce; ++next)
      {
        ColumnChoices& own = this->ForkOf(trials.size());
        own.At = this->TheChoices.At;
        if (SetForFloor(own, trimmed, steps[next]))
        {
          trials.push_back(next);
        }
      }
      std::vector<std::optional<TrimmedBand>> made(trials.size());
      ForAll(
        static_cast<int>(trials.size()),
        [&](int i) { made[i] = TryForFloor(this->ForkOf(i), trimmed, &trimmed); }, 1);
      for (std::size_t i = 0; i < trials.size(); ++i)
      {
        if (TakeIfBetter(std::move(made[i]), trimmed))
        {
          const Step& step = steps[trials[i]];
          this->TheChoices.At = std::move(this->ForkOf(i).At);
          this->TheChoices.At.Rungs[step.Column] = step.With;
          return trials[i];
        }
      }
    }
    return steps.size();
  }

  /// Those of the `place`th thread. To be asked for once by the thread that forks.
  ColumnChoices& ForkOf(std::size_t place)
  {
    while (this->Forks.size() <= place)
    {
      this->Forks.push_back(std::make_unique<Fork>(this->Given, this->TheChoices));
    }
    return this->Forks[place]->Choices;
  }

  /// Whether a column has an element below the aim.
  bool IsShort(const TrimmedBand& trimmed, int column) const
  {
    const std::vector<int> below = this->TheChoices.Aimed.FindBelowFloor(trimmed);
    return std::any_of(below.begin(), below.end(),
      [&](int e) { return this->TheChoices.TheColumns.Column[e] == column; });
  }

  /// Sets one rung for a column below the floor; false if it has no such choice.
  static bool SetForFloor(ColumnChoices& choices, const TrimmedBand& trimmed, const Step& step)
  {
    switch (step.With)
    {
      case Rung::Correction:
        choices.ForMovingPillars(trimmed, step.Column,
          [&](int pillar)
          {
            auto& correction = choices.At.Set.Corrections[pillar].Correction;
            if (correction == CorrectionChoice::AsAsked)
            {
              correction = CorrectionChoice::Other;
            }
          });
        return true;
      case Rung::Fate:
        if (choices.Shares.Column[step.Column] < SmallestShare)
        {
          return false;
        }
        choices.At.Set.Fates[step.Column] = Fate::Eliminate;
        return true;
      default:
        return choices.KeepAround(trimmed, step.Column, false);
    }
  }

  /// The trial with what is chosen, if it is nearer to the aim, and no worse otherwise.
  /// @param from see TrialTrim::Make.
  static std::optional<TrimmedBand> TryForFloor(
    ColumnChoices& choices, const TrimmedBand& trimmed, const TrimmedBand* from)
  {
    const int left = choices.CountLeft(trimmed);
    const double before = choices.Quality.MeasureShortage(trimmed).Sum;
    const auto promises = [&](const TrimmedBand& trial)
    {
      return choices.CountLeft(trial) <= left &&
        choices.Quality.MeasureShortage(trial).Sum <=
        MostPromising * before + choices.Options.QualityFloor;
    };
    TrimmedBand other = choices.Trial.Make(choices.At.Set, choices.Aimed, from, promises);
    if (other.Invalid.size() > trimmed.Invalid.size() || choices.CountLeft(other) > left)
    {
      return std::nullopt;
    }
    const double after = choices.Quality.MeasureShortage(other).Sum;
    const auto aimedBefore = choices.Aimed.MeasureShortage(trimmed);
    const auto aimedAfter = choices.Aimed.MeasureShortage(other);
    if (after > before || aimedAfter.Largest > aimedBefore.Largest ||
      (after > LeastProgress * before && aimedAfter.Sum > LeastProgress * aimedBefore.Sum))
    {
      return std::nullopt;
    }
    return other;
  }

  const TrimCase& Given;
  ColumnChoices& TheChoices;
  std::vector<std::unique_ptr<Fork>> Forks;
};

}

void RaiseToFloor(const TrimCase& given, ColumnChoices& choices, TrimmedBand& trimmed)
{
  FloorRaise(given, choices).RaiseToFloor(trimmed);
}

}
