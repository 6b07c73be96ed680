/**
 * @file ColumnChoices.h
 * @brief What the ladder chooses for columns and pillars, and what that takes with it.
 */
#ifndef ColumnChoices_h
#define ColumnChoices_h

#include "TrialTrim.h"

#include <map>
#include <vector>

namespace trim
{

/// Where a climb came to. Another one, with other demands, may go on from there.
struct LadderPosition
{
  Choices Set;                 ///< empty: at the foot
  std::vector<Rung> Rungs;     ///< by column
  std::vector<char> Disturbed; ///< by column: the fate of one next to it was changed before its own
  std::map<int, std::vector<int>> KeptFor; ///< columns that are kept for the sake of another one
};

/// Columns with less than this share beyond the surface are never eliminated by the ladder, nor
/// are those with more than the complement kept: the trim would wander off.
constexpr double SmallestShare = 0.15;
/// The same for what is kept so that a corner of the model need not move.
constexpr double SmallestCornerShare = 0.01;

/// What the climbs of the ladder have in common. What it is given must outlive it.
struct ColumnChoices
{
  /// @param[in,out] position what is chosen; an empty one is filled.
  ColumnChoices(const TrimCase& given, const LadderOptions& options, LadderPosition& position);

  /// The first rung: pillars of columns and round them that are behind the cut stay there; false if
  /// there are no others.
  bool TakeInside(const TrimmedBand& trimmed, const std::vector<int>& columns);

  /// Whether a node of the new boundary is not on the surface.
  bool IsLeft(const TrimmedBand& trimmed, int node) const;

  int CountLeft(const TrimmedBand& trimmed) const;

  /// Pillars of a column that go to the surface, or part of the way.
  std::vector<int> PillarsToLeave(const TrimmedBand& trimmed, int column);

  /// Leaves that pillar of a column off the surface that can go farthest of its way with no element
  /// of the column below `least`, or all of them; false if no part of the way does it.
  bool LeaveBest(
    const TrimmedBand& trimmed, int column, const std::vector<int>& pillars, double least);

  /// Shortens the ways of pillars.
  void LeaveOnWay(const std::vector<int>& pillars, double way);

  /// All edges of an element stay; false if that was set already.
  bool LeaveCorners(int e);

  /// Lets all nodes of an element stay where they were, those behind the cut too; false if they do.
  bool LeaveWhole(int e);

  /// The end of the ladder, which always holds: all nodes of what is still invalid stay where
  /// they were. The set of such nodes only grows, and an element that has only such is as it came.
  /// @param anew whether what had not changed is relaxed anew too.
  void LeaveInvalid(const BandQuality& goal, bool anew, TrimmedBand& trimmed);

  /// The columns of elements, each once, ascending.
  std::vector<int> ColumnsOf(const std::vector<int>& elements) const;

  /// Keeps the eliminated columns that share nodes with a column, or only those nodes that found
  /// no place; false if there are none.
  bool KeepAround(const TrimmedBand& trimmed, int column, bool failedOnly);

  /// What was kept for a column that had no use of it is decided by its volume again.
  void GiveBack(int column);

  /// A fate that was changed may spoil the next columns. Theirs are not changed then: trouble would
  /// wander along the cut without an end.
  void DisturbAround(int changed);

  /// Calls action(node) for the nodes of each element of a column.
  template <typename Action>
  void ForNodes(int column, const Action& action) const
  {
    for (const int e : this->Trial.ElementsOf(column))
    {
      const auto& element = this->TheBand.Elements[e];
      std::for_each(element.begin(), element.end(), action);
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

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const LadderOptions& Options;
  AbortCheck Aborted;
  BandQuality Quality;
  BandQuality Aimed; ///< at what is aimed at short of leaving nodes off
  TrialTrim Trial;
  const Band::Lists PillarNodes; ///< nodes of each pillar
  LadderPosition& At;
};

}

#endif
