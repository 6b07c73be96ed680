/// @file FloorLeave.cxx
/// @brief Nodes that are left off the surface for what is below the floor.
#include "FloorClimb.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace trim
{
namespace
{

/// An element counts on this much more than the floor from a pillar that is left.
constexpr double FloorMargin = 1.1;
/// Rounds in which single pillars are left for the sake of the floor, or all of a column go so
/// much of their way; then all of a column stay where they were.
constexpr int GradualRounds = 8;
constexpr double GradualWay = 0.7;
/// Rounds anew in which no fewer elements of a layer come to be below the floor, before it is given
/// up: of 326 layers 13 gained anew, after six rounds in vain at most.
constexpr int MostVainRounds = 6;

class FloorLeave
{
public:
  explicit FloorLeave(ColumnChoices& choices)
    : TheChoices(choices)
  {
  }

  /// What is below the floor all the same: of the nodes of such a column one pillar is left off
  /// the surface, that which helps most, or all of them, little by little, if none does. An element
  /// that the nodes behind the cut spoil keeps its own where they were. Without a layer that ends
  /// with none below it; with one, whose elements were not good before, with the fewest.
  void LeaveBelowFloor(TrimmedBand& trimmed)
  {
    bool anew = false;
    int atOnce = 1;
    for (int round = 0; !this->TheChoices.Aborted(); ++round)
    {
      const std::vector<int> below = this->TheChoices.Quality.FindBelowFloor(trimmed);
      if (this->IsInVain(below.size(), anew, trimmed))
      {
        break;
      }
      bool changed = false;
      std::vector<char> seen(this->TheChoices.TheBand.NumberOfNodes(), 0);
      for (const int e : below)
      {
        changed |= this->LeaveForFloor(trimmed, e, round, seen);
      }
      if (anew && !changed)
      {
        changed = this->LeaveSome(below, atOnce);
        atOnce *= 2;
      }
      if (!changed && (anew || below.empty()))
      {
        break;
      }
      // Places that were relaxed for other choices may keep an element below the floor: then from
      // the start.
      anew |= !changed;
      trimmed = this->TheChoices.Trial.Make(
        this->TheChoices.At.Set, this->TheChoices.Aimed, anew ? nullptr : &trimmed);
      this->TheChoices.LeaveInvalid(this->TheChoices.Aimed, anew, trimmed);
    }
    if (this->Fewest)
    {
      trimmed = std::move(this->Fewest->Trimmed);
      this->TheChoices.At = std::move(this->Fewest->At);
    }
  }

private:
  struct Found
  {
    std::size_t Below;
    TrimmedBand Trimmed;
    LadderPosition At;
  };

  /// Keeps what has the fewest elements below the floor where there is a layer; true if more rounds
  /// hardly find fewer.
  bool IsInVain(std::size_t below, bool anew, const TrimmedBand& trimmed)
  {
    if (!this->TheChoices.TheBand.BeforeLayer)
    {
      return false;
    }
    if (!this->Fewest || below < this->Fewest->Below)
    {
      this->Fewest = { below, trimmed, this->TheChoices.At };
      this->RoundsInVain = 0;
    }
    else if (anew)
    {
      ++this->RoundsInVain;
    }
    return this->RoundsInVain > MostVainRounds;
  }

  /// Leaves elements below the floor as they were; false if all are. One may help the others: it
  /// is one at first, but of hundreds ever more, as each takes a trial.
  bool LeaveSome(const std::vector<int>& below, int most)
  {
    int some = 0;
    for (std::size_t i = 0; some < most && i < below.size(); ++i)
    {
      some += this->TheChoices.LeaveWhole(below[i]);
    }
    return some > 0;
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
  std::optional<Found> Fewest;
  int RoundsInVain = 0; ///< anew, since there were fewer
};

}

void LeaveBelowFloor(ColumnChoices& choices, TrimmedBand& trimmed)
{
  FloorLeave(choices).LeaveBelowFloor(trimmed);
}

}
