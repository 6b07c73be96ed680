/**
 * @file ValidityLadder.h
 * @brief Decide, correct and treat, again and again with other choices where an element would
 * become invalid, until every touched element is valid and at the quality floor.
 *
 * First the nodes round a bad element are relaxed. The rungs, climbed column by column where
 * that does not do: nodes beyond the surface that are not at the cut stay behind it; the other
 * pentahedral treatment, the other correction, the column's other fate, and at last nodes left off
 * the surface: where they were for elements that are invalid, a part of their way for elements
 * below the floor. Nodes whose border ends at a corner of the model right beside the surface may
 * end there. What came below the floor is held to 0.2, or exempt if it came below that, too. Then
 * nodes that were left return to the surface, as many as can without elements that fall below what
 * is aimed at, and in a second result without such that fall below the floor. Then everything
 * is relaxed once more, to a higher goal that binds nobody, nodes go to the sharp edges of the
 * surface, and at the end pillars that all this has bent come straight again.
 */
#ifndef ValidityLadder_h
#define ValidityLadder_h

#include "ColumnChoices.h"

#include <memory>

namespace trim
{

/// What is asked on the way; where it says no, the climb ends there, and the result is of no use.
/// Empty: it is not asked.
struct ClimbPromises
{
  Promise Valid;    ///< when all is valid, before the long way to the floor
  Promise Returned; ///< when nodes that were left have returned, before all is polished
};

/// @param[in,out] position where the climb starts, and where it ended.
TrimmedBand ClimbLadder(const TrimCase& given, const LadderOptions& options,
  LadderPosition& position, const ClimbPromises& promises = {});

/// How a climb went that is completed later, if at all: most of those that are made to find the
/// best one are not taken.
struct ClimbMade
{
  LadderOptions Options;
  LadderPosition End;
  std::shared_ptr<MoverMemory> Memory;     ///< see TrimCase
  std::shared_ptr<FailedReturns> Failures; ///< what the options refer to; null: nothing
};

/**
 * The same with more nodes on the surface, where elements are above the floor, but not above what
 * is aimed at; null: no nodes were left for the sake of that.
 *
 * @param given as for the climb.
 */
std::shared_ptr<const TrimmedBand> FindCloser(
  TrimCase given, const ClimbMade& made, const TrimmedBand& trimmed);

/**
 * Takes nodes of the new boundary to the sharp edges of the surface that it passes, where the
 * elements stand it; false, and nothing is done, if that is done, or not to be done.
 *
 * @param given as for the climb.
 */
bool FollowCreases(TrimCase given, const ClimbMade& made, TrimmedBand& trimmed);

}

#endif
