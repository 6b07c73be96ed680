/// @file TrialCreases.cxx
/// @brief Takes a trial's nodes to the sharp edges of the surface.
#include "TrialTrim.h"

#include "CreaseNodes.h"

#include <algorithm>

namespace trim
{

bool TrialTrim::MayFollowCreases(
  const nurbs::TrimmingSurface& surface, const LadderOptions& options)
{
  return options.QualityFloor > 0.0 && options.CorrectionType != Correction::Eliminate &&
    MayHaveCreases(surface);
}

void TrialTrim::FollowCreases(const Choices& choices, TrimmedBand& trimmed) const
{
  const Choices set = this->ForDecision(this->WithDemands(choices), trimmed);
  const std::vector<char> missed = this->PutOnCreases(set, {}, trimmed);
  if (this->Options.Treatment == Optimization::Degenerate &&
    std::find(missed.begin(), missed.end(), 1) != missed.end())
  {
    // The middle node of a pentahedron may be in the way: then it is dropped.
    Faults faults = this->FaultsOf(trimmed, this->GoalForLeft());
    int tried = 0;
    for (const auto& wedges :
      FindDroppable(this->TheBand, this->TheColumns, trimmed.Kept, trimmed.Treated))
    {
      if (missed[wedges.front().Dropped[0]] && tried++ < MostDrops && !this->Aborted())
      {
        this->DropAtCrease(set, wedges, faults, trimmed);
      }
    }
  }
}

/// Drops edges if that lets a node beside them go to a sharp edge.
void TrialTrim::DropAtCrease(const Choices& set, const std::vector<ReplacedElement>& wedges,
  Faults& faults, TrimmedBand& trimmed) const
{
  std::vector<char> beside(this->TheBand.NumberOfNodes(), 0);
  for (const auto& wedge : wedges)
  {
    std::for_each(wedge.Node.begin(), wedge.Node.begin() + 6, [&beside](int n) { beside[n] = 1; });
  }
  const std::vector<char> before = trimmed.OnCrease;
  const bool helped = this->Try(faults, trimmed,
    [&]
    {
      if (!DropEdges(wedges, trimmed.Treated))
      {
        return false;
      }
      this->PutOnCreases(set, beside, trimmed);
      return trimmed.OnCrease != before;
    });
  if (!helped)
  {
    trimmed.OnCrease = before;
  }
}

std::vector<char> TrialTrim::PutOnCreases(
  const Choices& set, const std::vector<char>& among, TrimmedBand& trimmed) const
{
  Shapes shapes = this->ShapesOf(set, trimmed, true);
  return trim::PutOnCreases(
    this->Guard(shapes, this->GoalForLeft(), trimmed), this->Surface, among, trimmed.OnCrease);
}

}
