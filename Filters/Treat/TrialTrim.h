/**
 * @file TrialTrim.h
 * @brief One pass through the steps of Fig. 8, decide, correct and treat, under given choices.
 */
#ifndef TrialTrim_h
#define TrialTrim_h

#include "BandQuality.h"
#include "Decision.h"
#include "ExposedEdges.h"
#include "FailedReturns.h"
#include "LadderOptions.h"
#include "LastAsked.h"
#include "Progress.h"
#include "Relaxation.h"
#include "ReturnedNodes.h"
#include "TrimCase.h"
#include "TrimmedBand.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace trim
{

/// Everything the ladder may set.
struct Choices
{
  std::vector<Fate> Fates;                 ///< by column
  std::vector<PillarChoice> Corrections;   ///< by pillar
  std::vector<TreatmentChoice> Treatments; ///< by pillar
};

/// Whether a trial may become a good one.
using Promise = std::function<bool(const TrimmedBand&)>;

/**
 * Trims the band as often as it is asked to, from the start; only relaxed places may be those of
 * another trial. What it is given must outlive it.
 */
class TrialTrim
{
public:
  TrialTrim(const TrimCase& given, const LadderOptions& options);

  /// The demands go before the choices. What is invalid is told.
  /// @param goal what elements are relaxed to.
  /// @param from another trial: only round what it has otherwise is relaxed anew.
  /// @param promises asked after a brief relaxation; where it does not, that was all.
  TrimmedBand Make(const Choices& choices, const BandQuality& goal,
    const TrimmedBand* from = nullptr, const Promise& promises = {});

  /// Takes nodes that were left off to the surface after all, or drops them, where the elements
  /// round them stand it.
  /// @param progress where it ends the work, the result is of no use.
  void ReturnLeft(const Choices& choices, const Progress& progress, TrimmedBand& trimmed) const;

  /// The same for nodes that were left although the floor does not ask for it, but what is aimed
  /// at. Null if none returned.
  std::shared_ptr<TrimmedBand> ReturnLeftToFloor(
    const Choices& choices, const Progress& progress, const TrimmedBand& from) const;

  /// Takes nodes that were left for the sake of the offcut to the surface, or nearer to it.
  /// @param stands whether the offcut stands a node where it lies in `trimmed`.
  void ReturnDemanded(
    const Choices& choices, const std::function<bool(int)>& stands, TrimmedBand& trimmed) const;

  /// Relaxes once more, to a higher goal, if a floor is asked for at all. What is invalid counts
  /// by TrimmedBand::Invalid; no more may become so.
  void Polish(const Choices& choices, TrimmedBand& trimmed) const;

  /// Takes nodes of relaxed pillars together again, where a floor is asked for.
  void Straighten(const Choices& choices, TrimmedBand& trimmed) const;

  /// Whether there may be sharp edges of a surface to be followed.
  static bool MayFollowCreases(const nurbs::TrimmingSurface& surface, const LadderOptions& options);
  bool MayFollowCreases() const { return MayFollowCreases(this->Surface, this->Options); }

  /// Takes nodes of the new boundary to the sharp edges that it passes, where the elements stand
  /// it.
  void FollowCreases(const Choices& choices, TrimmedBand& trimmed) const;

  /// Pillars that should go to the surface, as they lie beyond it, though no facet of the cut is at
  /// them: a surface that leans by more than an element has such.
  std::vector<char> FindPillarsBehind(const TrimmedBand& trimmed) const;

  /// Whether a node may go to a corner of the model instead of to the surface.
  bool MayEndAtCorner(int node) const { return this->Mover.EndAtCorner(node).Found; }

  Band::Range ElementsOf(int column) const { return this->TheDecision.ElementsOf(column); }

  /// By column: kept or eliminated against its volume, by the fate set or as the decision mends.
  std::vector<char> FindAgainstVolume(const TrimmedBand& trimmed) const;

private:
  const std::vector<ExposedPillar>& FindExposed(const std::vector<char>& kept);
  /// @param atCut by pillar.
  bool IsBehindOnBorder(int node, const std::vector<char>& atCut) const;
  Choices WithDemands(Choices choices) const;
  Choices ForDecision(Choices choices, const TrimmedBand& trimmed) const;
  std::vector<int> FindBad(const Choices& set, const BandQuality& goal, const TrimmedBand* from,
    TrimmedBand& trimmed) const;
  bool HasToFindShape(const std::vector<int>& bad) const;
  std::vector<int> DescendRound(
    const Choices& set, const std::vector<int>& bad, double quality, TrimmedBand& trimmed) const;
  void RelaxBad(const Choices& set, const std::vector<int>& bad, const BandQuality& goal,
    const Promise& promises, TrimmedBand& trimmed) const;
  std::vector<char> ElementsMoved(const Moves& before, const Moves& now) const;
  std::vector<char> NodesThatDiffer(const TrimmedBand& a, const TrimmedBand& b) const;
  bool IsHeld(const Choices& set, const TrimmedBand& trimmed, int node) const;
  std::vector<char> TakeRelaxed(
    const Choices& set, const TrimmedBand& from, TrimmedBand& trimmed) const;
  void ReturnToBorder(const Moves& before, const Moves& unpolished, TrimmedBand& trimmed) const;
  void PolishTo(const Choices& set, double goal, bool onCutToo, TrimmedBand& trimmed) const;
  double GoalForLeft() const;
  /// What must not become more when nodes that were left return.
  struct Faults
  {
    double Goal;                     ///< see OfGoal
    std::size_t Invalid, BelowFloor; ///< elements
    BandQuality::Shortage OfGoal;
  };
  Faults FaultsOf(const TrimmedBand& trimmed, double goal) const;
  /// Does something to the band; undoes it if it was no help or spoiled an element.
  /// @param action returns whether it has changed anything.
  template <typename Action>
  bool Try(Faults& faults, TrimmedBand& trimmed, const Action& action) const;
  /// What a RelaxationCase and a GuardedCase refer to.
  struct Shapes
  {
    std::vector<RelaxedElement> Elements;
    std::vector<char> Fixed, OnCut;
  };
  Shapes ShapesOf(const Choices& set, const TrimmedBand& trimmed, bool onCutToo) const;
  /// @param least scaled Jacobian that no element falls below.
  GuardedCase Guard(Shapes& shapes, double least, TrimmedBand& trimmed) const;
  void RelaxRound(const Choices& set, const std::vector<int>& active, double quality,
    const RelaxationEffort& effort, TrimmedBand& trimmed, bool onCutToo = true) const;
  /// Pillars of pentahedra that are tried without their nodes, at most.
  static constexpr int MostDrops = 100;

  // TrialReturns.cxx
  void BringNearer(const Choices& set, TrimmedBand& trimmed) const;
  void ReturnWithRoom(
    const Choices& set, double goal, const Progress& progress, TrimmedBand& trimmed) const;
  std::vector<int> FindLeft(
    const Choices& set, const TrimmedBand& trimmed, bool forOffcut = false) const;
  /// @param stands see GuardedCase::OthersStand.
  bool ReturnNodesLeft(const Choices& set, const std::vector<int>& left, double goal,
    ReturnEffort effort, TrimmedBand& trimmed, const std::function<bool(int)>& stands = {}) const;
  bool DropEdgesLeft(
    const Choices& set, FailedReturns& failures, Faults& faults, TrimmedBand& trimmed) const;
  bool DropAndRelax(const Choices& set, const std::vector<ReplacedElement>& wedges, double goal,
    const FailedReturns& failures, FailedReturns::Key& key, TrimmedBand& trimmed) const;

  // TrialCreases.cxx
  void DropAtCrease(const Choices& set, const std::vector<ReplacedElement>& wedges, Faults& faults,
    TrimmedBand& trimmed) const;
  /// @return nodes beside sharp edges that were missed.
  std::vector<char> PutOnCreases(
    const Choices& set, const std::vector<char>& among, TrimmedBand& trimmed) const;

  const Band& TheBand;
  const Columns& TheColumns;
  const nurbs::TrimmingSurface& Surface;
  const LadderOptions& Options;
  AbortCheck Aborted;
  BandQuality Quality;
  NodeMover Mover;
  Decision TheDecision;
  LastAsked<std::vector<char>, std::vector<ExposedPillar>> Exposed; ///< by what is kept
  /// The last trial in which many elements had to find their shape: others that begin at the start
  /// begin with that.
  std::shared_ptr<const TrimmedBand> Shaped;
};

template <typename Action>
bool TrialTrim::Try(Faults& faults, TrimmedBand& trimmed, const Action& action) const
{
  Moves moves = trimmed.NodeMoves;
  Pentahedra treated = trimmed.Treated;
  if (action())
  {
    const Faults now = this->FaultsOf(trimmed, faults.Goal);
    if (now.Invalid <= faults.Invalid && now.BelowFloor <= faults.BelowFloor &&
      now.OfGoal.Sum <= faults.OfGoal.Sum && now.OfGoal.Largest <= faults.OfGoal.Largest)
    {
      faults = now;
      return true;
    }
  }
  trimmed.NodeMoves = std::move(moves);
  trimmed.Treated = std::move(treated);
  return false;
}

}

#endif
