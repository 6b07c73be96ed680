#include "ColumnChoices.h"

#include "AddUnique.h"
#include "SortUnique.h"

namespace trim
{

ColumnChoices::ColumnChoices(
  const TrimCase& given, const LadderOptions& options, LadderPosition& position)
  : TheBand(given.TheBand)
  , TheColumns(given.TheColumns)
  , Shares(given.Shares)
  , Options(options)
  , Aborted(AbortOf(given.Tell))
  , Quality(given.TheBand, options.Treatment, options.QualityFloor)
  , Aimed(this->Quality.With(options.AimedQuality(), Measure::Worth))
  , Trial(given, options)
  , PillarNodes(given.TheColumns.Nodes())
  , At(position)
{
  if (!this->At.Rungs.empty())
  {
    return;
  }
  this->At.Rungs.assign(this->TheBand.NumberOfElements(), Rung::None);
  this->At.Disturbed.assign(this->TheBand.NumberOfElements(), 0);
  this->At.Set.Fates.assign(this->TheBand.NumberOfElements(), Fate::ByVolume);
  this->At.Set.Corrections.assign(this->TheBand.NumberOfNodes(), PillarChoice());
  this->At.Set.Treatments.assign(this->TheBand.NumberOfNodes(), TreatmentChoice::AsAsked);
}

bool ColumnChoices::TakeInside(const TrimmedBand& trimmed, const std::vector<int>& columns)
{
  const std::vector<char> behind = this->Trial.FindPillarsBehind(trimmed);
  bool changed = false;
  const auto take = [&](int e)
  {
    const auto& element = this->TheBand.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      const int pillar = this->TheColumns.Pillar[element.Node[i]];
      auto& set = this->At.Set.Corrections[pillar];
      if (behind[pillar] && set.Correction < CorrectionChoice::Leave)
      {
        set = { CorrectionChoice::Inside, 0.0 };
        changed = true;
      }
    }
  };
  for (const int column : columns)
  {
    const auto& element = this->TheBand.Elements[column];
    for (int i = 0; i < element.Count; ++i)
    {
      for (const int e : this->TheBand.ElementsOfNode(element.Node[i]))
      {
        take(e);
      }
    }
  }
  return changed;
}

bool ColumnChoices::IsLeft(const TrimmedBand& trimmed, int node) const
{
  return trimmed.NodeMoves.Left[node] &&
    this->At.Set.Corrections[this->TheColumns.Pillar[node]].Correction != CorrectionChoice::Inside;
}

int ColumnChoices::CountLeft(const TrimmedBand& trimmed) const
{
  int left = 0;
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    left += this->IsLeft(trimmed, n);
  }
  return left;
}

std::vector<int> ColumnChoices::PillarsToLeave(const TrimmedBand& trimmed, int column)
{
  std::vector<int> pillars;
  this->ForMovingPillars(trimmed, column,
    [&](int pillar)
    {
      const auto& set = this->At.Set.Corrections[pillar];
      if (set.Correction != CorrectionChoice::Leave || set.Way > 0.0)
      {
        AddUnique(pillars, pillar);
      }
    });
  return pillars;
}

bool ColumnChoices::LeaveBest(
  const TrimmedBand& trimmed, int column, const std::vector<int>& pillars, double least)
{
  struct Choice
  {
    std::vector<int> Pillars, Nodes;
  };
  const auto choose = [this](const std::vector<int>& chosen)
  {
    Choice choice{ chosen, {} };
    for (const int pillar : chosen)
    {
      choice.Nodes.insert(
        choice.Nodes.end(), this->PillarNodes.begin(pillar), this->PillarNodes.end(pillar));
    }
    return choice;
  };
  std::vector<Choice> single;
  for (const int pillar : pillars)
  {
    single.push_back(choose({ pillar }));
  }
  for (const auto& choices : { single, { choose(pillars) } })
  {
    for (const double way : { 0.75, 0.5, 0.25, 0.0 })
    {
      const Choice* best = nullptr;
      double quality = least;
      for (const Choice& choice : choices)
      {
        const double found =
          this->Quality.LowestIfLeft(trimmed, this->TheColumns, column, choice.Nodes, way);
        if (found >= quality)
        {
          quality = found;
          best = &choice;
        }
      }
      if (best)
      {
        this->LeaveOnWay(best->Pillars, way);
        return true;
      }
    }
  }
  return false;
}

void ColumnChoices::LeaveOnWay(const std::vector<int>& pillars, double way)
{
  for (const int pillar : pillars)
  {
    auto& set = this->At.Set.Corrections[pillar];
    const double gone = set.Correction == CorrectionChoice::Leave ? set.Way : 1.0;
    set = { CorrectionChoice::Leave, gone * way };
  }
}

bool ColumnChoices::LeaveCorners(int e)
{
  bool changed = false;
  const auto& element = this->TheBand.Elements[e];
  for (int i = 0; i < element.Count; ++i)
  {
    auto& treatment = this->At.Set.Treatments[this->TheColumns.Pillar[element.Node[i]]];
    changed |= treatment != TreatmentChoice::LeaveCorner;
    treatment = TreatmentChoice::LeaveCorner;
  }
  return changed;
}

bool ColumnChoices::LeaveWhole(int e)
{
  this->At.Rungs[this->TheColumns.Column[e]] = Rung::Left;
  bool changed = this->LeaveCorners(e);
  const auto& element = this->TheBand.Elements[e];
  for (int i = 0; i < element.Count; ++i)
  {
    auto& set = this->At.Set.Corrections[this->TheColumns.Pillar[element.Node[i]]];
    changed |= set.Correction != CorrectionChoice::Leave || set.Way > 0.0;
    set = { CorrectionChoice::Leave, 0.0 };
  }
  return changed;
}

void ColumnChoices::LeaveInvalid(const BandQuality& goal, bool anew, TrimmedBand& trimmed)
{
  while (!this->Aborted())
  {
    bool changed = false;
    for (const int e : trimmed.Invalid)
    {
      changed |= this->LeaveWhole(e);
    }
    if (!changed)
    {
      return;
    }
    trimmed = this->Trial.Make(this->At.Set, goal, anew ? nullptr : &trimmed);
  }
}

std::vector<int> ColumnChoices::ColumnsOf(const std::vector<int>& elements) const
{
  std::vector<int> columns;
  for (const int e : elements)
  {
    columns.push_back(this->TheColumns.Column[e]);
  }
  SortUnique(columns);
  return columns;
}

bool ColumnChoices::KeepAround(const TrimmedBand& trimmed, int column, bool failedOnly)
{
  auto& kept = this->At.KeptFor[column];
  const double least =
    failedOnly && this->Options.KeepsCorners ? SmallestCornerShare : SmallestShare;
  const std::size_t before = kept.size();
  this->ForNodes(column,
    [&](int node)
    {
      if (failedOnly && !trimmed.NodeMoves.Failed[node])
      {
        return;
      }
      for (const int other : this->TheBand.ElementsOfNode(node))
      {
        const int around = this->TheColumns.Column[other];
        if (!trimmed.Kept[other] && this->At.Set.Fates[around] == Fate::ByVolume &&
          this->Shares.Column[around] <= 1.0 - least)
        {
          this->At.Set.Fates[around] = Fate::Keep;
          this->DisturbAround(around);
          kept.push_back(around);
        }
      }
    });
  return kept.size() > before;
}

void ColumnChoices::GiveBack(int column)
{
  for (const int around : this->At.KeptFor[column])
  {
    this->At.Set.Fates[around] = Fate::ByVolume;
  }
  this->At.KeptFor[column].clear();
}

void ColumnChoices::DisturbAround(int changed)
{
  this->ForNodes(changed,
    [this](int node)
    {
      for (const int other : this->TheBand.ElementsOfNode(node))
      {
        const int next = this->TheColumns.Column[other];
        this->At.Disturbed[next] |= this->At.Rungs[next] == Rung::None;
      }
    });
}

}
