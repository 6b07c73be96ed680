/**
 * @file ValidityLadder.h
 * @brief Decide, correct and treat, again and again with other choices where an element would
 * become invalid, until every touched element is valid and at the quality floor.
 *
 * First the nodes round a bad element are relaxed. The rungs, climbed column by column where
 * that does not do: the other pentahedral treatment, the other correction, the column's other
 * fate, and at last nodes left off the surface: where they were for elements that are invalid,
 * a part of their way for elements below the floor. What came below the floor is exempt. At the
 * end everything is relaxed once more, to a higher goal that binds nobody.
 */
#ifndef ValidityLadder_h
#define ValidityLadder_h

#include "Decision.h"
#include "TrimmedBand.h"

#include <functional>
#include <vector>

namespace trim
{

/// What has to be so for the sake of the offcut, whatever the ladder does; empty: nothing.
struct Demands
{
  std::vector<char> KeepColumn;  ///< by column
  std::vector<char> LeavePillar; ///< by pillar: its nodes stay where they are
};

struct LadderOptions
{
  Correction CorrectionType = Correction::Project; ///< Eliminate, Project or Slide
  Optimization Treatment = Optimization::Degenerate;
  double EliminationFraction = 0.5;
  /// Scaled Jacobian that touched elements have to reach, but for straight corners; 0: none.
  double QualityFloor = 0.2;
  Demands ForOffcut;
};

/**
 * @param precision absolute distance up to which a node is on the surface.
 * @param aborted true ends the work; the result is then of no use.
 */
TrimmedBand ClimbLadder(const Band& band, const Columns& columns, const VolumeShares& shares,
  const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
  double precision, const LadderOptions& options, const std::function<bool()>& aborted);

}

#endif
