#include "TrialTrim.h"

#include "JointRelaxation.h"
#include "MovingNodes.h"
#include "NodesOfElements.h"
#include "ShapeDescent.h"
#include "StraightPillars.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <tuple>

namespace trim
{
namespace
{

/// Elements up to which the relaxation takes its time, again and again.
constexpr std::size_t MostThorough = 40;
/// What elements are polished to at last, as far as the nodes round them can give it, where a
/// lower floor is asked for: the floor is what they must reach.
constexpr double PolishedGoal = 0.6;
/// Below this the nodes on the cut move along it too: then the offcut of another run, with the
/// side inverted, need not fit node by node.
constexpr double PolishedOnCutGoal = 0.5;
/// Of elements round one that left the border of the model, as its nodes alone may not help.
constexpr int MostRings = 3;

}

TrialTrim::TrialTrim(const TrimCase& given, const LadderOptions& options)
  : TheBand(given.TheBand)
  , TheColumns(given.TheColumns)
  , Surface(given.Surface)
  , Options(options)
  , Aborted(AbortOf(given.Tell))
  , Quality(
      BandQuality(given.TheBand, options.Treatment, options.QualityFloor).WithBorder(given.Surface))
  , Mover(given.TheBand, given.TheColumns, given.Surface, given.Precision, options.SlidesBehind,
      given.Memory, options.StaysInside)
  , TheDecision(given.TheBand, given.TheColumns, given.Shares, given.Surface,
      options.EliminationFraction, options.CorrectionType != Correction::Eliminate)
{
}

Choices TrialTrim::WithDemands(Choices set) const
{
  const Demands& demands = this->Options.ForOffcut;
  for (std::size_t c = 0; c < demands.KeepColumn.size(); ++c)
  {
    set.Fates[c] = demands.KeepColumn[c] ? Fate::Keep : set.Fates[c];
  }
  for (std::size_t p = 0; p < demands.LeavePillar.size(); ++p)
  {
    if (demands.LeavePillar[p])
    {
      auto& choice = set.Corrections[p];
      const double way = demands.WayOf(p);
      const bool leaves = choice.Correction == CorrectionChoice::Leave;
      choice = { CorrectionChoice::Leave, leaves ? std::min(way, choice.Way) : way };
      set.Treatments[p] = TreatmentChoice::LeaveCorner;
    }
  }
  return set;
}

std::vector<char> TrialTrim::FindAgainstVolume(const TrimmedBand& trimmed) const
{
  // The elements of a column fall together; its index is its smallest element.
  std::vector<char> against(trimmed.Kept.size(), 0);
  for (const int column : this->TheColumns.Column)
  {
    against[column] = (trimmed.Kept[column] != 0) != this->TheDecision.StaysByVolume(column);
  }
  return against;
}

std::vector<char> TrialTrim::FindPillarsBehind(const TrimmedBand& trimmed) const
{
  std::vector<char> behind(this->TheBand.NumberOfNodes(), 0);
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    behind[this->TheColumns.Pillar[n]] |= trimmed.Moving[n];
  }
  std::vector<char> atCut(this->TheBand.NumberOfNodes(), 0);
  const std::vector<char> cutNodes = FindCutNodes(this->TheBand, trimmed.Kept);
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    atCut[this->TheColumns.Pillar[n]] |= cutNodes[n];
  }
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    const int pillar = this->TheColumns.Pillar[n];
    if (behind[pillar])
    {
      behind[pillar] = !atCut[pillar] &&
        (!this->TheColumns.IsOnBorder(this->TheBand, n) || this->IsBehindOnBorder(n, atCut));
    }
  }
  return behind;
}

/// Whether a node beyond the surface slides along a straight border, next to the cut. Another one
/// has to go to the surface: there the border itself is cut.
bool TrialTrim::IsBehindOnBorder(int node, const std::vector<char>& atCut) const
{
  const auto edges = this->TheBand.EdgesOfNode(node);
  return this->Mover.MayRelax(node, false) &&
    std::any_of(edges.begin(), edges.end(),
      [&](int edge)
      {
        const int other = this->TheBand.OtherEnd(edge, node);
        return atCut[this->TheColumns.Pillar[other]] &&
          this->TheColumns.IsOnBorder(this->TheBand, other) &&
          (this->Options.CutsCorners ||
            !this->Mover.FreedomOf(other).Constraint.RidgeEdges.empty());
      });
}

/// A pillar that has come to the cut by another decision is behind it no more.
Choices TrialTrim::ForDecision(Choices set, const TrimmedBand& trimmed) const
{
  const auto inside = [](const PillarChoice& choice)
  { return choice.Correction == CorrectionChoice::Inside; };
  if (std::any_of(set.Corrections.begin(), set.Corrections.end(), inside))
  {
    const std::vector<char> behind = this->FindPillarsBehind(trimmed);
    for (std::size_t p = 0; p < behind.size(); ++p)
    {
      if (!behind[p] && inside(set.Corrections[p]))
      {
        set.Corrections[p].Correction = CorrectionChoice::AsAsked;
      }
    }
  }
  return set;
}

TrimmedBand TrialTrim::Make(
  const Choices& choices, const BandQuality& goal, const TrimmedBand* from, const Promise& promises)
{
  Choices set = this->WithDemands(choices);
  TrimmedBand trimmed;
  trimmed.Kept = this->TheDecision.Take(set.Fates);
  if (this->Options.CorrectionType == Correction::Eliminate)
  {
    trimmed.Moving.assign(this->TheBand.NumberOfNodes(), 0);
  }
  else
  {
    trimmed.Moving = this->TheDecision.FindMovingNodes(trimmed.Kept);
  }
  set = this->ForDecision(std::move(set), trimmed);
  trimmed.NodeMoves = MoveNodes(
    this->TheBand, this->Mover, trimmed.Moving, this->Options.CorrectionType, set.Corrections);
  if (this->Options.CorrectionType != Correction::Eliminate)
  {
    trimmed.Treated =
      TreatPentahedra(this->TheBand, this->TheColumns, this->Mover, this->FindExposed(trimmed.Kept),
        { this->Options.Treatment, set.Treatments }, trimmed.NodeMoves);
    trimmed.Unrelaxed = trimmed.NodeMoves;
    const std::vector<int> bad = this->FindBad(set, goal, from, trimmed);
    if (bad.empty())
    {
      return trimmed;
    }
    const Moves before = trimmed.NodeMoves;
    this->RelaxBad(set, bad, goal, promises, trimmed);
    trimmed.Invalid = this->Quality.FindInvalid(
      trimmed, this->ElementsMoved(before, trimmed.NodeMoves), trimmed.Invalid);
    if (!from && this->HasToFindShape(bad))
    {
      this->Shaped = std::make_shared<const TrimmedBand>(trimmed);
    }
    return trimmed;
  }
  trimmed.Invalid = this->Quality.FindInvalid(trimmed);
  return trimmed;
}

const std::vector<ExposedPillar>& TrialTrim::FindExposed(const std::vector<char>& kept)
{
  // A straight corner that stays is one between facets of the cut.
  const bool lostSides = this->Options.Treatment == Optimization::Degenerate;
  return this->Exposed.At(
    kept, [&] { return FindExposedPillars(this->TheBand, this->TheColumns, kept, lostSides); });
}

/// By element: whether it has a node that is elsewhere, or was not moved before.
std::vector<char> TrialTrim::ElementsMoved(const Moves& before, const Moves& now) const
{
  std::vector<char> moved(this->TheBand.NumberOfElements(), 0);
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    if (now.Position[n] != before.Position[n] || now.Applied[n] != before.Applied[n])
    {
      for (const int e : this->TheBand.ElementsOfNode(n))
      {
        moved[e] = 1;
      }
    }
  }
  return moved;
}

/// The nodes of elements that are kept, shaped or placed otherwise, before any relaxation.
std::vector<char> TrialTrim::NodesThatDiffer(const TrimmedBand& a, const TrimmedBand& b) const
{
  std::vector<char> differs(this->TheBand.NumberOfNodes(), 0);
  const auto tell = [&](int e)
  {
    const auto& element = this->TheBand.Elements[e];
    std::for_each(element.begin(), element.end(), [&differs](int n) { differs[n] = 1; });
  };
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    if (a.Moving[n] != b.Moving[n] || a.Unrelaxed.Position[n] != b.Unrelaxed.Position[n] ||
      a.Unrelaxed.Applied[n] != b.Unrelaxed.Applied[n] ||
      a.Unrelaxed.Left[n] != b.Unrelaxed.Left[n])
    {
      const auto elements = this->TheBand.ElementsOfNode(n);
      std::for_each(elements.begin(), elements.end(), tell);
    }
  }
  for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
  {
    if (a.Kept[e] != b.Kept[e])
    {
      tell(e);
    }
  }
  std::vector<ReplacedElement> wedges; // of one of them alone
  std::set_symmetric_difference(a.Treated.Wedges.begin(), a.Treated.Wedges.end(),
    b.Treated.Wedges.begin(), b.Treated.Wedges.end(), std::back_inserter(wedges),
    [](const ReplacedElement& one, const ReplacedElement& other)
    { return std::tie(one.Element, one.Node) < std::tie(other.Element, other.Node); });
  for (const ReplacedElement& wedge : wedges)
  {
    tell(wedge.Element);
  }
  return differs;
}

/// Whether a node stays where it is left; one that has come to the surface moves on along it.
bool TrialTrim::IsHeld(const Choices& set, const TrimmedBand& trimmed, int n) const
{
  const bool returned = trimmed.Moving[n] && !trimmed.NodeMoves.Left[n];
  return !returned &&
    set.Corrections[this->TheColumns.Pillar[n]].Correction == CorrectionChoice::Leave;
}

/// Takes the relaxed places of another trial where both are the same before, but for nodes that
/// have to stay now; returns the elements round the rest.
std::vector<char> TrialTrim::TakeRelaxed(
  const Choices& set, const TrimmedBand& from, TrimmedBand& trimmed) const
{
  const std::vector<char> differs = this->NodesThatDiffer(from, trimmed);
  std::vector<char> near(this->TheBand.NumberOfElements(), 0);
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    const bool stays =
      this->IsHeld(set, trimmed, n) && from.NodeMoves.Position[n] != trimmed.NodeMoves.Position[n];
    if (!differs[n] && !stays)
    {
      trimmed.NodeMoves.Position[n] = from.NodeMoves.Position[n];
      trimmed.NodeMoves.Applied[n] = from.NodeMoves.Applied[n];
      continue;
    }
    for (const int e : this->TheBand.ElementsOfNode(n))
    {
      near[e] = 1;
    }
  }
  return near;
}

/// What is invalid or short of the goal, without what another trial has relaxed already.
std::vector<int> TrialTrim::FindBad(
  const Choices& set, const BandQuality& goal, const TrimmedBand* from, TrimmedBand& trimmed) const
{
  std::vector<char> near(this->TheBand.NumberOfElements(), 1);
  if (from)
  {
    near = this->TakeRelaxed(set, *from, trimmed);
  }
  else if (this->Shaped) // nearer to good places than the start, but all may be relaxed anew
  {
    this->TakeRelaxed(set, *this->Shaped, trimmed);
  }
  trimmed.Relaxed.assign(this->TheBand.NumberOfElements(), 0);
  trimmed.Invalid = from ? this->Quality.FindInvalid(trimmed, near, from->Invalid)
                         : this->Quality.FindInvalid(trimmed);
  for (const int e : trimmed.Invalid)
  {
    trimmed.Relaxed[e] = 1;
  }
  for (const int e : goal.FindBelowFloor(trimmed, near))
  {
    trimmed.Relaxed[e] = 1;
  }
  std::vector<int> bad;
  for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
  {
    if (!near[e])
    {
      trimmed.Relaxed[e] = from->Relaxed[e];
    }
    else if (trimmed.Relaxed[e])
    {
      bad.push_back(e);
    }
  }
  return bad;
}

void TrialTrim::RelaxBad(const Choices& set, const std::vector<int>& bad, const BandQuality& goal,
  const Promise& promises, TrimmedBand& trimmed) const
{
  const double quality = std::max(goal.GetFloor(), SmallestGoal);
  std::vector<int> active = bad;
  if (this->HasToFindShape(bad))
  {
    // Once: of 790 descents that went on from the end of another one 39 raised anything.
    std::vector<int> left = this->DescendRound(set, bad, quality, trimmed);
    if (left.size() < bad.size())
    {
      active = std::move(left);
    }
  }
  if (active.size() > MostThorough)
  {
    this->RelaxRound(set, active, quality, Brief, trimmed);
    return;
  }
  if (promises)
  {
    this->RelaxRound(set, active, quality, Probing, trimmed);
  }
  if (!promises || promises(trimmed))
  {
    this->RelaxRound(set, active, quality, Thorough, trimmed);
  }
}

/// Whether so many elements are bad because a layer's have to find their shape yet.
bool TrialTrim::HasToFindShape(const std::vector<int>& bad) const
{
  return bad.size() > MostThorough && HasLayerInSolid(this->TheBand, this->TheColumns);
}

/// @return elements that are short of the quality then.
std::vector<int> TrialTrim::DescendRound(
  const Choices& set, const std::vector<int>& bad, double quality, TrimmedBand& trimmed) const
{
  const auto [elements, fixed, onCut] = this->ShapesOf(set, trimmed, true);
  const RelaxationCase given{ this->TheBand, this->Mover, elements, fixed, onCut, this->Aborted };
  return DescendToShape(given, bad, quality, trimmed.NodeMoves);
}

/// Takes nodes back to where they were, round elements that left the border of the model meanwhile,
/// unless others become invalid, or short of what is aimed at, by that.
/// @param unpolished what had left the border by these moves may.
void TrialTrim::ReturnToBorder(
  const Moves& before, const Moves& unpolished, TrimmedBand& trimmed) const
{
  const auto findLeft = [&]
  {
    const std::vector<int> now =
      this->Quality.FindLeavingBorder(trimmed, this->ElementsMoved(unpolished, trimmed.NodeMoves));
    std::vector<int> left;
    if (!now.empty())
    {
      TrimmedBand first = trimmed;
      first.NodeMoves = unpolished;
      const std::vector<int> leaving = this->Quality.FindLeavingBorder(first);
      std::set_difference(
        now.begin(), now.end(), leaving.begin(), leaving.end(), std::back_inserter(left));
    }
    return left;
  };
  std::vector<int> left = findLeft();
  if (left.empty())
  {
    return;
  }
  const auto countFaults = [&]
  {
    return this->Quality.FindInvalid(trimmed).size() +
      this->Quality.FindShortOf(trimmed, this->Options.AimedQuality()).size();
  };
  const Moves polished = trimmed.NodeMoves;
  const std::size_t faults = countFaults();
  for (int rings = 0; rings < MostRings && !left.empty(); ++rings)
  {
    for (const int n : NodesOf(this->TheBand, RingsRound(this->TheBand, left, rings)))
    {
      trimmed.NodeMoves.Position[n] = before.Position[n];
      trimmed.NodeMoves.Applied[n] = before.Applied[n];
    }
    left = findLeft();
  }
  if (countFaults() > faults)
  {
    trimmed.NodeMoves = polished;
  }
}

void TrialTrim::Polish(const Choices& choices, TrimmedBand& trimmed) const
{
  if (this->Options.QualityFloor <= 0.0 || this->Options.QualityFloor >= PolishedGoal ||
    this->Options.CorrectionType == Correction::Eliminate)
  {
    return;
  }
  const Choices set = this->ForDecision(this->WithDemands(choices), trimmed);
  const double aim = this->Options.AimedQuality();
  std::vector<std::function<void()>> steps;
  if (this->Options.Treatment == Optimization::Degenerate)
  {
    steps.emplace_back([&]
      { this->RelaxRound(set, this->Quality.FindShortOf(trimmed, aim), aim, Thorough, trimmed); });
  }
  steps.emplace_back([&] { this->PolishTo(set, PolishedGoal, false, trimmed); });
  steps.emplace_back([&] { this->PolishTo(set, PolishedOnCutGoal, true, trimmed); });
  // What the mesh had below the floor may gain at the cost of its neighbours: where that spoils
  // one, step by step.
  const std::size_t below = this->Quality.FindBelowFloor(trimmed).size();
  const Moves unpolished = trimmed.NodeMoves;
  const auto polish = [&](auto first, auto last)
  {
    const Moves before = trimmed.NodeMoves;
    std::for_each(first, last, [](const auto& step) { step(); });
    this->ReturnToBorder(before, unpolished, trimmed);
    const bool good = this->Quality.FindBelowFloor(trimmed).size() <= below &&
      this->Quality.FindInvalid(trimmed).size() <= trimmed.Invalid.size();
    if (!good)
    {
      trimmed.NodeMoves = before;
    }
    return good;
  };
  if (!polish(steps.begin(), steps.end()))
  {
    for (auto step = steps.begin(); step != steps.end(); ++step)
    {
      polish(step, step + 1);
    }
  }
}

void TrialTrim::Straighten(const Choices& choices, TrimmedBand& trimmed) const
{
  if (this->Options.QualityFloor <= 0.0 || !this->TheColumns.AnyHasThickness())
  {
    return;
  }
  std::vector<Stack> bent =
    FindBentPillars(this->TheBand, this->TheColumns, this->Mover, trimmed.NodeMoves);
  if (bent.empty())
  {
    return;
  }
  const Choices set = this->ForDecision(this->WithDemands(choices), trimmed);
  Shapes shapes = this->ShapesOf(set, trimmed, true);
  for (std::size_t n = 0; n < trimmed.OnCrease.size(); ++n)
  {
    shapes.Fixed[n] = shapes.Fixed[n] || trimmed.OnCrease[n];
  }
  StraightenPillars(this->Guard(shapes, this->GoalForLeft(), trimmed), std::move(bent));
}

/// Relaxes what is short of the goal and was not so before.
void TrialTrim::PolishTo(const Choices& set, double goal, bool onCutToo, TrimmedBand& trimmed) const
{
  this->RelaxRound(
    set, this->Quality.FindShortOf(trimmed, goal), PolishedGoal, Brief, trimmed, onCutToo);
}

/// What elements are not to fall below for nodes that were left.
double TrialTrim::GoalForLeft() const
{
  return std::max(this->Options.AimedQuality(), SmallestGoal);
}

TrialTrim::Faults TrialTrim::FaultsOf(const TrimmedBand& trimmed, double goal) const
{
  const BandQuality quality = this->Quality.With(goal, Measure::Worth);
  return { goal, this->Quality.FindInvalid(trimmed).size(),
    this->Quality.FindBelowFloor(trimmed).size(), quality.MeasureShortage(trimmed) };
}

TrialTrim::Shapes TrialTrim::ShapesOf(
  const Choices& set, const TrimmedBand& trimmed, bool onCutToo) const
{
  const int count = this->TheBand.NumberOfElements();
  Shapes shapes;
  auto& elements = shapes.Elements;
  elements.resize(count);
  for (int e = 0; e < count; ++e)
  {
    if (trimmed.Kept[e])
    {
      elements[e] = { this->TheBand.Elements[e].Count, this->TheBand.Elements[e].Node };
    }
  }
  for (const auto& wedge : trimmed.Treated.Wedges)
  {
    if (trimmed.Kept[wedge.Element])
    {
      elements[wedge.Element] = { 6, wedge.Node };
    }
  }
  shapes.OnCut = FindBoundaryNodes(this->TheBand, trimmed);
  auto& onCut = shapes.OnCut;
  auto& fixed = shapes.Fixed;
  fixed.assign(this->TheBand.NumberOfNodes(), 0);
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    const auto choice = set.Corrections[this->TheColumns.Pillar[n]].Correction;
    if (choice == CorrectionChoice::Inside)
    {
      continue;
    }
    const bool corrected = trimmed.NodeMoves.Applied[n] != Correction::None;
    onCut[n] = onCut[n] || (trimmed.Moving[n] && corrected);
    fixed[n] =
      (trimmed.Moving[n] && !corrected) || (onCut[n] && !onCutToo) || this->IsHeld(set, trimmed, n);
  }
  return shapes;
}

GuardedCase TrialTrim::Guard(Shapes& shapes, double least, TrimmedBand& trimmed) const
{
  return { { this->TheBand, this->Mover, shapes.Elements, shapes.Fixed, shapes.OnCut,
             this->Aborted },
    this->Quality, least, shapes.Fixed, shapes.OnCut, trimmed.NodeMoves, this->Options.Failures };
}

void TrialTrim::RelaxRound(const Choices& set, const std::vector<int>& active, double quality,
  const RelaxationEffort& effort, TrimmedBand& trimmed, bool onCutToo) const
{
  if (active.empty())
  {
    return;
  }
  const auto [elements, fixed, onCut] = this->ShapesOf(set, trimmed, onCutToo);
  const RelaxationCase given{ this->TheBand, this->Mover, elements, fixed, onCut, this->Aborted };
  const RelaxationGoal towards{ quality, this->Options.QualityFloor, effort };
  Relax(given, active, towards, trimmed.NodeMoves);
  // Straight corners that stay would pull nodes along the cut for nothing.
  if (quality < PolishedGoal && effort.Joint && active.size() <= MostThorough &&
    this->Options.Treatment == Optimization::Degenerate)
  {
    RelaxJointly(given, active, towards, trimmed.NodeMoves);
  }
}

}
