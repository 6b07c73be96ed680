/**
 * @file ValidityLadder.h
 * @brief Decide, correct and treat, again and again with other choices where an element would
 * become invalid, until every touched element is valid.
 *
 * First the nodes round a bad element are relaxed. The rungs, climbed column by column where
 * that does not do: the other pentahedral treatment, the other correction, the column's other
 * fate, and at last, for elements that are not valid, its nodes left where they are.
 */
#ifndef ValidityLadder_h
#define ValidityLadder_h

#include "Decision.h"
#include "Jacobian.h"
#include "Pentahedra.h"

#include <functional>
#include <vector>

namespace trim
{

struct LadderOptions
{
  Correction CorrectionType = Correction::Project; ///< Eliminate, Project or Slide
  Optimization Treatment = Optimization::Degenerate;
  double EliminationFraction = 0.5;
  /// Scaled Jacobian that touched elements have to reach, but for straight corners; 0: none.
  double QualityFloor = 0.2;
};

/// The rung by which a column was saved.
enum class Rung : unsigned char
{
  None,
  FateFirst, ///< the eliminated elements round a node that has no place are kept
  Treatment,
  Correction,
  Fate,      ///< eliminated instead of kept
  FateAround, ///< kept, with its eliminated neighbours
  Left
};

/// The trimmed band.
struct TrimmedBand
{
  std::vector<char> Kept;       ///< by element
  Moves NodeMoves;
  Pentahedra Treated;
  std::vector<Rung> RescuedBy;  ///< by column (smallest element)
  std::vector<char> Relaxed;    ///< elements that were below the floor before the relaxation
  std::vector<int> BelowFloor;  ///< valid elements that stayed below the quality floor
  std::vector<int> Invalid;     ///< elements that no rung could save; empty as a rule
  std::vector<char> Moving;     ///< nodes that have to lie on the new boundary
};

/**
 * @param precision absolute distance up to which a node is on the surface.
 * @param aborted true ends the work; the result is then of no use.
 */
TrimmedBand ClimbLadder(const Band& band, const Columns& columns, const VolumeShares& shares,
  const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
  double precision, const LadderOptions& options, const std::function<bool()>& aborted);

/// Nodes and positions of a band element as it is after the trim.
struct FinalElement
{
  int Count = 0;
  std::array<int, 8> Node;
  ElementPoints Points;
  bool Touched = false; ///< has a moved node or was replaced
};
FinalElement FinalShape(const Band& band, const TrimmedBand& trimmed, int element);

}

#endif
