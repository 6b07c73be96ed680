/**
 * @file LadderOptions.h
 * @brief How the band is decided, corrected and treated, and what the validity ladder aims at.
 */
#ifndef LadderOptions_h
#define LadderOptions_h

#include "NodeMove.h"
#include "Pentahedra.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trim
{

class FailedReturns;

/// What has to be so for the sake of the offcut, whatever the ladder does; empty: nothing.
struct Demands
{
  /// Steps back from the surface to where a pillar's nodes were.
  static constexpr int Steps = 5;

  std::vector<char> KeepColumn;  ///< by column
  std::vector<char> LeavePillar; ///< by pillar: how many steps short of the surface its nodes stay

  /// How much of their way the nodes of a pillar go at the most.
  double WayOf(std::size_t pillar) const
  {
    return 1.0 - static_cast<double>(this->LeavePillar[pillar]) / Steps;
  }
};

/// What the ladder aims at where a lower floor is asked for, short of leaving nodes off.
constexpr double AimedFloor = 0.3;

/// Of decision, correction and treatment, and of the ladder that repeats them.
struct LadderOptions
{
  Correction CorrectionType = Correction::Project; ///< Eliminate, Project or Slide
  Optimization Treatment = Optimization::Degenerate;
  double EliminationFraction = 0.5;
  /// Scaled Jacobian that touched elements have to reach, but for straight corners; 0: none.
  double QualityFloor = 0.2;
  /// Whether what is nearly all beyond the surface may be kept so that a corner of the model need
  /// not move.
  bool KeepsCorners = true;
  bool SlidesBehind = false; ///< see NodeMover
  bool StaysInside = false;  ///< see NodeMover
  /// Whether a node beyond the surface may slide along the border behind the cut where the one next
  /// to it has left the border: the corner between border and surface may be cut off then.
  bool CutsCorners = true;
  /// Whether a climb takes nodes to the sharp edges of the surface, as the offcut has to fit; else
  /// FollowCreases does, once it is known that no other climb is better.
  bool FollowsCreases = false;
  Demands ForOffcut;
  FailedReturns* Failures = nullptr; ///< of climbs with other demands; none: there are no others

  /// Scaled Jacobian that touched elements are to reach short of leaving nodes off; 0: none.
  double AimedQuality() const
  {
    return this->QualityFloor > 0.0 ? std::max(this->QualityFloor, AimedFloor) : 0.0;
  }
};

}

#endif
