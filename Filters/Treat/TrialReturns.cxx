/// @file TrialReturns.cxx
/// @brief What becomes of nodes that a trial left off the surface: they return to it, or are
/// dropped.
#include "TrialTrim.h"

#include "NodesOfElements.h"

#include <algorithm>

namespace trim
{
namespace
{

/// How often nodes that are left come nearer to the surface and their neighbours make room.
constexpr int ApproachPasses = 4;

}

void TrialTrim::ReturnLeft(
  const Choices& choices, const Progress& progress, TrimmedBand& trimmed) const
{
  const Choices set = this->ForDecision(this->WithDemands(choices), trimmed);
  const double aim = this->GoalForLeft();
  this->ReturnWithRoom(set, aim, progress, trimmed);
  this->BringNearer(set, trimmed);
  // Some have come so near that nothing keeps them from the surface any more.
  const std::vector<int> left = this->FindLeft(set, trimmed);
  if (!left.empty())
  {
    Faults faults = this->FaultsOf(trimmed, aim);
    this->Try(faults, trimmed,
      [&] { return this->ReturnNodesLeft(set, left, aim, ReturnEffort::Alone, trimmed); });
  }
}

std::shared_ptr<TrimmedBand> TrialTrim::ReturnLeftToFloor(
  const Choices& choices, const Progress& progress, const TrimmedBand& from) const
{
  const double floor = this->Options.QualityFloor;
  const Choices set = this->ForDecision(this->WithDemands(choices), from);
  const std::size_t left = this->FindLeft(set, from).size();
  if (left == 0 || floor <= 0.0 || floor >= this->GoalForLeft())
  {
    return nullptr;
  }
  auto trimmed = std::make_shared<TrimmedBand>(from);
  this->ReturnWithRoom(set, floor, progress, *trimmed);
  this->BringNearer(set, *trimmed);
  return this->FindLeft(set, *trimmed).size() < left ? trimmed : nullptr;
}

/// @param goal what elements are not to fall below for it.
void TrialTrim::ReturnWithRoom(
  const Choices& set, double goal, const Progress& progress, TrimmedBand& trimmed) const
{
  Faults faults = this->FaultsOf(trimmed, goal);
  FailedReturns failures; // of edges to drop: what else there is wrong only gets less
  bool changed = true;
  double done = 0.0;
  // What makes room for one node may do so for others.
  for (const auto effort : { ReturnEffort::Alone, ReturnEffort::Relaxed, ReturnEffort::Alone })
  {
    progress(done);
    done += 1.0 / 3.0;
    const std::vector<int> left = this->FindLeft(set, trimmed);
    if (left.empty() || (!changed && effort == ReturnEffort::Alone))
    {
      break;
    }
    changed = this->Try(
      faults, trimmed, [&] { return this->ReturnNodesLeft(set, left, goal, effort, trimmed); });
    changed |= this->DropEdgesLeft(set, failures, faults, trimmed);
  }
}

/// Nodes that have to be left come as near to the surface as the floor lets them, and their
/// neighbours make room.
void TrialTrim::BringNearer(const Choices& set, TrimmedBand& trimmed) const
{
  const std::vector<int> left = this->FindLeft(set, trimmed);
  if (left.empty())
  {
    return;
  }
  const std::size_t invalid = this->Quality.FindInvalid(trimmed).size();
  const std::size_t below = this->Quality.FindBelowFloor(trimmed).size();
  std::vector<int> round = ElementsAt(this->TheBand, left);
  round.erase(
    std::remove_if(round.begin(), round.end(), [&trimmed](int e) { return !trimmed.Kept[e]; }),
    round.end());
  for (int pass = 0; pass < ApproachPasses && !this->Aborted(); ++pass)
  {
    const Moves before = trimmed.NodeMoves;
    if (pass > 0)
    {
      this->RelaxRound(set, round, this->GoalForLeft(), Brief, trimmed);
    }
    const bool changed =
      this->ReturnNodesLeft(set, left, this->GoalForLeft(), ReturnEffort::Nearer, trimmed);
    if (!changed || this->Quality.FindInvalid(trimmed).size() > invalid ||
      this->Quality.FindBelowFloor(trimmed).size() > below)
    {
      trimmed.NodeMoves = before;
      return;
    }
  }
}

/// Nodes that should be on the surface and are not: those that the offcut needs there, or all
/// others.
std::vector<int> TrialTrim::FindLeft(
  const Choices& set, const TrimmedBand& trimmed, bool forOffcut) const
{
  const std::vector<int> users = CountUsers(this->TheBand, trimmed);
  const auto& demanded = this->Options.ForOffcut.LeavePillar;
  std::vector<int> left;
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    const int pillar = this->TheColumns.Pillar[n];
    if (users[n] > 0 && trimmed.NodeMoves.Left[n] &&
      set.Corrections[pillar].Correction != CorrectionChoice::Inside &&
      (!demanded.empty() && demanded[pillar] != 0) == forOffcut)
    {
      left.push_back(n);
    }
  }
  return left;
}

void TrialTrim::ReturnDemanded(
  const Choices& choices, const std::function<bool(int)>& stands, TrimmedBand& trimmed) const
{
  const Choices set = this->ForDecision(this->WithDemands(choices), trimmed);
  for (const auto effort : { ReturnEffort::Alone, ReturnEffort::Nearer })
  {
    const std::vector<int> left = this->FindLeft(set, trimmed, true);
    if (left.empty())
    {
      return;
    }
    this->ReturnNodesLeft(set, left, this->GoalForLeft(), effort, trimmed, stands);
  }
}

bool TrialTrim::ReturnNodesLeft(const Choices& set, const std::vector<int>& left, double goal,
  ReturnEffort effort, TrimmedBand& trimmed, const std::function<bool(int)>& stands) const
{
  Shapes shapes = this->ShapesOf(set, trimmed, true);
  GuardedCase guarded = this->Guard(shapes, goal, trimmed);
  guarded.OthersStand = stands;
  return ReturnNodes(guarded, left, effort);
}

/// Pentahedra that kept their middle nodes as those were left may do without them.
bool TrialTrim::DropEdgesLeft(
  const Choices& set, FailedReturns& failures, Faults& faults, TrimmedBand& trimmed) const
{
  const std::vector<int> left = this->FindLeft(set, trimmed);
  if (left.empty() || this->Options.Treatment != Optimization::Degenerate)
  {
    return false;
  }
  const auto isLeft = [&](int n) { return std::binary_search(left.begin(), left.end(), n); };
  bool dropped = false;
  int tried = 0;
  for (const auto& wedges :
    FindDroppable(this->TheBand, this->TheColumns, trimmed.Kept, trimmed.Treated))
  {
    const bool helps = std::any_of(wedges.begin(), wedges.end(),
      [&](const ReplacedElement& w) { return isLeft(w.Dropped[0]) || isLeft(w.Dropped[1]); });
    if (helps && tried++ < MostDrops && !this->Aborted())
    {
      FailedReturns::Key key;
      const bool stood = this->Try(faults, trimmed,
        [&] { return this->DropAndRelax(set, wedges, faults.Goal, failures, key, trimmed); });
      dropped |= stood;
      if (!stood)
      {
        failures.Add(key);
      }
    }
  }
  return dropped;
}

/// @param[out] key of what it depends on.
/// @return false, too, if it is one of the failures.
bool TrialTrim::DropAndRelax(const Choices& set, const std::vector<ReplacedElement>& wedges,
  double goal, const FailedReturns& failures, FailedReturns::Key& key, TrimmedBand& trimmed) const
{
  if (!DropEdges(wedges, trimmed.Treated))
  {
    return false;
  }
  std::vector<int> elements;
  for (const auto& wedge : wedges)
  {
    elements.push_back(wedge.Element);
  }
  std::sort(elements.begin(), elements.end());
  const auto [shapes, fixed, onCut] = this->ShapesOf(set, trimmed, true);
  const RelaxedMesh mesh(
    { this->TheBand, this->Mover, shapes, fixed, onCut, this->Aborted }, trimmed.NodeMoves);
  key = StateRound(mesh, fixed, elements, RelaxedRings);
  if (failures.Contain(key))
  {
    return false;
  }
  this->RelaxRound(set, elements, goal, Decisive, trimmed);
  return true;
}

}
