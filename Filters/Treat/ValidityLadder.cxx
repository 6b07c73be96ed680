#include "ValidityLadder.h"

#include "BandQuality.h"
#include "Relaxation.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

constexpr int LongestClimb = 40;
/// How many columns below the quality floor are tried with the other correction.
constexpr int MostFloorTrials = 16;
/// What invalid elements are relaxed to where no floor is asked for.
constexpr double SmallestGoal = 0.05;
/// Columns with less than this share beyond the surface are never eliminated by the ladder, nor
/// are those with more than the complement kept: the trim would wander off.
constexpr double SmallestShare = 0.15;

/// Everything the ladder may set.
struct Choices
{
  std::vector<Fate> Fates;                   // by column
  std::vector<CorrectionChoice> Corrections; // by pillar
  std::vector<TreatmentChoice> Treatments;   // by pillar
};

class Ladder
{
public:
  Ladder(const Band& band, const Columns& columns, const VolumeShares& shares,
    const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
    double precision, const LadderOptions& options)
    : TheBand(band)
    , TheColumns(columns)
    , Shares(shares)
    , NodeStatus(nodeStatus)
    , Surface(surface)
    , Options(options)
    , Quality(band, options.Treatment, options.QualityFloor)
    , Mover(band, columns, nodeStatus, surface, precision)
    , Rungs(band.NumberOfElements(), Rung::None)
  {
    this->Set.Fates.assign(band.NumberOfElements(), Fate::ByVolume);
    this->Set.Corrections.assign(band.NumberOfNodes(), CorrectionChoice::AsAsked);
    this->Set.Treatments.assign(band.NumberOfNodes(), TreatmentChoice::AsAsked);
  }

  TrimmedBand Climb(const std::function<bool()>& aborted)
  {
    TrimmedBand trimmed = this->Attempt();
    for (int climb = 0; climb < LongestClimb && !aborted(); ++climb)
    {
      const std::vector<int> bad = this->FindBadColumns(trimmed);
      if (bad.empty())
      {
        break;
      }
      for (const int column : bad)
      {
        this->StepUp(trimmed, column);
      }
      trimmed = this->Attempt();
    }
    this->LeaveInvalid(trimmed, aborted);
    this->RaiseToFloor(trimmed, aborted);
    trimmed.RescuedBy = this->Rungs;
    trimmed.BelowFloor = this->Quality.FindBelowFloor(trimmed);
    return trimmed;
  }

private:
  Choices WithDemands() const
  {
    Choices set = this->Set;
    const Demands& demands = this->Options.ForOffcut;
    for (std::size_t c = 0; c < demands.KeepColumn.size(); ++c)
    {
      set.Fates[c] = demands.KeepColumn[c] ? Fate::Keep : set.Fates[c];
    }
    for (std::size_t p = 0; p < demands.LeavePillar.size(); ++p)
    {
      if (demands.LeavePillar[p])
      {
        set.Corrections[p] = CorrectionChoice::Leave;
        set.Treatments[p] = TreatmentChoice::LeaveCorner;
      }
    }
    return set;
  }

  TrimmedBand Attempt() const
  {
    const Choices set = this->WithDemands();
    TrimmedBand trimmed;
    trimmed.Kept = Decide(this->TheBand, this->TheColumns, this->Shares, this->NodeStatus,
      this->Surface, this->Options.EliminationFraction, set.Fates,
      this->Options.CorrectionType != Correction::Eliminate);
    if (this->Options.CorrectionType == Correction::Eliminate)
    {
      trimmed.Moving.assign(this->TheBand.NumberOfNodes(), 0);
    }
    else
    {
      trimmed.Moving = FindMovingNodes(this->TheBand, trimmed.Kept, this->NodeStatus);
    }
    trimmed.NodeMoves = MoveNodes(this->TheBand, this->TheColumns, this->Mover, trimmed.Moving,
      this->Options.CorrectionType, set.Corrections);
    if (this->Options.CorrectionType != Correction::Eliminate)
    {
      trimmed.Treated = TreatPentahedra(this->TheBand, this->TheColumns, this->Mover, trimmed.Kept,
        this->Options.Treatment, set.Treatments, trimmed.NodeMoves);
      this->RelaxBad(set, trimmed);
    }
    return trimmed;
  }

  /// Relaxes round what is invalid or below the floor.
  void RelaxBad(const Choices& set, TrimmedBand& trimmed) const
  {
    const int count = this->TheBand.NumberOfElements();
    trimmed.Relaxed.assign(count, 0);
    for (const int e : this->Quality.FindInvalid(trimmed))
    {
      trimmed.Relaxed[e] = 1;
    }
    for (const int e : this->Quality.FindBelowFloor(trimmed))
    {
      trimmed.Relaxed[e] = 1;
    }
    if (std::none_of(trimmed.Relaxed.begin(), trimmed.Relaxed.end(), [](char c) { return c; }))
    {
      return;
    }
    std::vector<RelaxedElement> elements(count);
    for (int e = 0; e < count; ++e)
    {
      if (trimmed.Kept[e])
      {
        const FinalElement final = FinalShape(this->TheBand, trimmed, e);
        elements[e] = { final.Count, final.Node };
      }
    }
    std::vector<char> onCut = FindCutNodes(this->TheBand, trimmed.Kept);
    std::vector<char> fixed(this->TheBand.NumberOfNodes(), 0);
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      const bool corrected = trimmed.NodeMoves.Applied[n] != Correction::None;
      onCut[n] = onCut[n] || corrected;
      fixed[n] = (trimmed.Moving[n] && !corrected) ||
        set.Corrections[this->TheColumns.Pillar[n]] == CorrectionChoice::Leave;
    }
    Relax(this->TheBand, this->Mover, elements, trimmed.Relaxed, fixed, onCut,
      std::max(this->Options.QualityFloor, SmallestGoal), trimmed.NodeMoves);
  }

  /// Nodes of the new boundary that are not on the surface.
  int CountLeft(const TrimmedBand& trimmed) const
  {
    int left = 0;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      left += trimmed.Moving[n] && trimmed.NodeMoves.Applied[n] == Correction::None;
    }
    return left;
  }

  /// The other correction for columns that relaxation could not raise to the floor. It is kept
  /// only where it helps and spoils nothing: a low quality is no reason to leave the surface.
  void RaiseToFloor(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    std::vector<char> tried(this->TheBand.NumberOfElements(), 0);
    for (int trial = 0; trial < MostFloorTrials && !aborted(); ++trial)
    {
      const std::vector<int> below = this->Quality.FindBelowFloor(trimmed);
      const auto next = std::find_if(
        below.begin(), below.end(), [&](int e) { return !tried[this->TheColumns.Column[e]]; });
      if (next == below.end())
      {
        return;
      }
      const int column = this->TheColumns.Column[*next];
      tried[column] = 1;
      const Choices before = this->Set;
      this->ForMovingPillars(trimmed, column,
        [&](int pillar) { this->Set.Corrections[pillar] = CorrectionChoice::Other; });
      TrimmedBand other = this->Attempt();
      other.Invalid = this->Quality.FindInvalid(other);
      if (other.Invalid.size() <= trimmed.Invalid.size() &&
        this->CountLeft(other) <= this->CountLeft(trimmed) &&
        this->Quality.Deficit(other) < 0.999 * this->Quality.Deficit(trimmed))
      {
        this->Rungs[column] = Rung::Correction;
        trimmed = std::move(other);
      }
      else
      {
        this->Set = before;
      }
    }
  }

  /// The end of the ladder, which always holds: all nodes of what is still invalid stay where
  /// they were. The set of such nodes only grows, and an element that has only such is as it came.
  void LeaveInvalid(TrimmedBand& trimmed, const std::function<bool()>& aborted)
  {
    while (!aborted())
    {
      trimmed.Invalid = this->Quality.FindInvalid(trimmed);
      bool changed = false;
      for (const int e : trimmed.Invalid)
      {
        const auto& element = this->TheBand.Elements[e];
        this->Rungs[this->TheColumns.Column[e]] = Rung::Left;
        for (int i = 0; i < element.Count; ++i)
        {
          const int pillar = this->TheColumns.Pillar[element.Node[i]];
          changed |= this->Set.Corrections[pillar] != CorrectionChoice::Leave ||
            this->Set.Treatments[pillar] != TreatmentChoice::LeaveCorner;
          this->Set.Corrections[pillar] = CorrectionChoice::Leave;
          this->Set.Treatments[pillar] = TreatmentChoice::LeaveCorner;
        }
      }
      if (!changed)
      {
        return;
      }
      trimmed = this->Attempt();
    }
  }

  std::vector<int> FindBadColumns(const TrimmedBand& trimmed) const
  {
    std::vector<int> columns;
    for (const int e : this->Quality.FindInvalid(trimmed))
    {
      columns.push_back(this->TheColumns.Column[e]);
    }
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheBand.Elements[e];
      for (int i = 0; trimmed.Kept[e] && i < element.Count; ++i)
      {
        if (trimmed.NodeMoves.Failed[element.Node[i]])
        {
          columns.push_back(this->TheColumns.Column[e]);
          break;
        }
      }
    }
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
  }

  template <typename Action>
  void ForMovingPillars(const TrimmedBand& trimmed, int column, const Action& action)
  {
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      const auto& element = this->TheBand.Elements[e];
      for (int i = 0; this->TheColumns.Column[e] == column && i < element.Count; ++i)
      {
        if (trimmed.Moving[element.Node[i]])
        {
          action(this->TheColumns.Pillar[element.Node[i]]);
        }
      }
    }
  }

  /// Keeps the eliminated columns that share nodes with a column, or only those nodes that found
  /// no place; false if there are none.
  bool KeepAround(const TrimmedBand& trimmed, int column, bool failedOnly)
  {
    bool any = false;
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      for (int i = 0; this->TheColumns.Column[e] == column && i < this->TheBand.Elements[e].Count;
           ++i)
      {
        const int node = this->TheBand.Elements[e].Node[i];
        if (failedOnly && !trimmed.NodeMoves.Failed[node])
        {
          continue;
        }
        for (const int other : this->TheBand.ElementsOfNode(node))
        {
          const int around = this->TheColumns.Column[other];
          if (!trimmed.Kept[other] && this->Set.Fates[around] == Fate::ByVolume &&
            this->Shares.Column[around] <= 1.0 - SmallestShare)
          {
            this->Set.Fates[around] = Fate::Keep;
            any = true;
          }
        }
      }
    }
    return any;
  }

  /// Undoes the rung that did not help and takes the next one.
  void StepUp(const TrimmedBand& trimmed, int column)
  {
    switch (this->Rungs[column])
    {
      case Rung::None:
        // A border node without a place, mostly a corner that is kept: with the elements round
        // it kept it need not move.
        this->Rungs[column] = Rung::FateFirst;
        if (this->KeepAround(trimmed, column, true))
        {
          return;
        }
        [[fallthrough]];
      case Rung::FateFirst:
        this->Rungs[column] = Rung::Treatment;
        if (trimmed.Treated.Exposed.size() && trimmed.Treated.Exposed[column])
        {
          const auto other = this->Options.Treatment == Optimization::Degenerate
            ? TreatmentChoice::Distribute
            : TreatmentChoice::Degenerate;
          this->ForMovingPillars(
            trimmed, column, [&](int pillar) { this->Set.Treatments[pillar] = other; });
          return;
        }
        [[fallthrough]];
      case Rung::Treatment:
        this->Rungs[column] = Rung::Correction;
        this->ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            this->Set.Treatments[pillar] = TreatmentChoice::AsAsked;
            this->Set.Corrections[pillar] = CorrectionChoice::Other;
          });
        return;
      case Rung::Correction:
        this->ForMovingPillars(trimmed, column,
          [&](int pillar) { this->Set.Corrections[pillar] = CorrectionChoice::AsAsked; });
        this->Rungs[column] = Rung::Fate;
        if (this->Set.Fates[column] == Fate::ByVolume &&
          this->Shares.Column[column] >= SmallestShare)
        {
          this->Set.Fates[column] = Fate::Eliminate;
          return;
        }
        [[fallthrough]];
      case Rung::Fate:
        this->Set.Fates[column] = Fate::ByVolume;
        this->Rungs[column] = Rung::FateAround;
        if (this->KeepAround(trimmed, column, false))
        {
          return;
        }
        [[fallthrough]];
      default:
        this->Set.Fates[column] = Fate::ByVolume;
        this->Rungs[column] = Rung::Left;
        this->ForMovingPillars(trimmed, column,
          [&](int pillar)
          {
            this->Set.Corrections[pillar] = CorrectionChoice::Leave;
            this->Set.Treatments[pillar] = TreatmentChoice::LeaveCorner;
          });
        return;
    }
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const std::vector<unsigned char>& NodeStatus;
  const nurbs::TrimmingSurface& Surface;
  LadderOptions Options;
  BandQuality Quality;
  NodeMover Mover;
  Choices Set;
  std::vector<Rung> Rungs;
};

}

TrimmedBand ClimbLadder(const Band& band, const Columns& columns, const VolumeShares& shares,
  const std::vector<unsigned char>& nodeStatus, const nurbs::TrimmingSurface& surface,
  double precision, const LadderOptions& options, const std::function<bool()>& aborted)
{
  return Ladder(band, columns, shares, nodeStatus, surface, precision, options).Climb(aborted);
}

}
