#include "BandQuality.h"

#include "BorderBridges.h"
#include "CoincidentNodes.h"
#include "ElementWorth.h"
#include "NodesOfElements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// Jacobians below this share of the element's mean count as zero.
constexpr double SmallestJacobian = 1e-6;
/// Rounding of a coefficient that is zero by construction (a straight corner).
constexpr double JacobianRounding = 1e-9;
/// An element with less of its volume left has collapsed.
constexpr double SmallestVolumeShare = 0.01;

/// Between any two nodes of an element.
double ShortestDistance(const ElementPoints& p, int count)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 1; i < count; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      shortest = std::min(shortest, (p[i] - p[j]).squaredNorm());
    }
  }
  return std::sqrt(shortest);
}

/// A wedge has no straight corner to be left one, whatever becomes of pentahedra.
Optimization StandardOf(int count, Optimization treatment)
{
  return count == 6 ? Optimization::Degenerate : treatment;
}

bool IsValid(const ElementPoints& points, int count, Optimization asked)
{
  const Optimization treatment = StandardOf(count, asked);
  const JacobianRange range = treatment == Optimization::None
    ? MeasureAtIntegrationPoints(points, count)
    : MeasureJacobian(points, count);
  if (!(range.IntegrationPoint > SmallestJacobian * std::abs(range.Mean)))
  {
    return false;
  }
  switch (treatment)
  {
    case Optimization::Degenerate:
      return range.Bezier > SmallestJacobian * range.Mean;
    case Optimization::Distribute:
      return range.Bezier >= -JacobianRounding * range.Mean;
    default:
      return true;
  }
}

/// What came inside out or without volume is not held to anything.
bool WasInvalid(const Band& band, int e)
{
  const ElementShape before = ShapeBefore(band, e);
  return !IsValid(before.Points, before.Count, Optimization::None);
}

}

bool StaysInvalid(const Band& band, int e, const ElementPoints& points, int count)
{
  return WasInvalid(band, e) && !(MeasureJacobian(points, count).Bezier > 0.0);
}

std::vector<int> FindStillInvalid(const Band& band, const TrimmedBand& trimmed)
{
  return FindElements(band, trimmed,
    [&](int e, const FinalElement& final)
    { return StaysInvalid(band, e, final.Points, final.Count); });
}

std::vector<int> FindShortEdged(const Band& band, const TrimmedBand& trimmed)
{
  return FindElements(band, trimmed,
    [&](int e, const FinalElement& final)
    {
      if (!band.IsInserted(e))
      {
        return ShortestEdgeShare(band, final.Node, final.Points, final.Count) < LeastEdgeShare;
      }
      const ElementShape before = ShapeBefore(band, e);
      return ShortestDistance(final.Points, final.Count) <
        LeastEdgeShare * ShortestDistance(before.Points, before.Count);
    });
}

const BandQuality::Size& BandQuality::SizeBefore(int e) const
{
  return this->Before->Sizes.At(e,
    [&]
    {
      const ElementShape before = ShapeBefore(this->TheBand, e);
      return Size{ VolumeOf(before.Points, before.Count),
        ShortestDistance(before.Points, before.Count),
        LongestEdgeOf(WithoutLayer(this->TheBand), ElementWithoutLayer(this->TheBand, e)) };
    });
}

const BandQuality::Standard& BandQuality::StandardBefore(int e) const
{
  return this->Before->Standards.At(e,
    [&]
    {
      const ElementShape before = ShapeBefore(this->TheBand, e);
      return Standard{ ScaledJacobian(before.Points, before.Count), WasInvalid(this->TheBand, e) };
    });
}

/// The straight corners that the treatment asked for makes.
bool BandQuality::IsExempt(const TrimmedBand& trimmed, int e) const
{
  return this->Treatment != Optimization::Degenerate && trimmed.Treated.FlatCorner[e];
}

std::vector<int> BandQuality::FindInvalid(const TrimmedBand& trimmed) const
{
  return this->FindInvalid(trimmed, [](int) { return true; });
}

std::vector<int> BandQuality::FindInvalid(
  const TrimmedBand& trimmed, const std::vector<char>& asked, const std::vector<int>& others) const
{
  // Two nodes that coincided may not any more.
  return this->FindInvalid(trimmed,
    [&](int e) { return asked[e] || std::binary_search(others.begin(), others.end(), e); });
}

/// @param isAsked of the others none is invalid but for nodes that coincide.
template <typename Asked>
std::vector<int> BandQuality::FindInvalid(const TrimmedBand& trimmed, const Asked& isAsked) const
{
  const std::vector<char> coincides = FindCoincidentNodes(this->TheBand, trimmed);
  const auto anyCoincides = [&coincides](const auto& element)
  { return std::any_of(element.begin(), element.end(), [&](int n) { return coincides[n]; }); };
  return FindElements(
    this->TheBand, trimmed,
    [&](int e) { return isAsked(e) || anyCoincides(this->TheBand.Elements[e]); },
    [&](int e, const FinalElement& final)
    { return anyCoincides(final) || (isAsked(e) && this->Spoils(e, final.Points, final.Count)); });
}

bool BandQuality::Spoils(int e, const ElementPoints& points, int count) const
{
  const Size& before = this->SizeBefore(e);
  const bool spoiled = VolumeOf(points, count) < SmallestVolumeShare * before.Volume ||
    !IsValid(points, count, this->Treatment) ||
    ShortestDistance(points, count) < SmallestDistanceShare * before.ShortestDistance;
  return spoiled && !this->StandardBefore(e).Invalid;
}

/// A higher floor must not let go what a lower one would hold.
double BandQuality::FloorOf(int e) const
{
  const double before = this->StandardBefore(e).ScaledJacobian;
  if (before >= this->Floor)
  {
    return this->Floor;
  }
  return this->Floor > PoorQuality && before >= PoorQuality ? PoorQuality : 0.0;
}

bool BandQuality::FallsBelowFloor(int e, const ElementPoints& points, int count) const
{
  return this->Floor > 0.0 && this->IsBelowFloor(e, ScaledJacobian(points, count));
}

bool BandQuality::LeavesBorder(
  int e, const std::array<int, 8>& node, const ElementPoints& points, int count) const
{
  return this->Surface &&
    HasBridge(
      this->TheBand, *this->Surface, e, this->SizeBefore(e).LongestEdge, node, points, count);
}

std::vector<int> BandQuality::FindLeavingBorder(
  const TrimmedBand& trimmed, const std::vector<char>& asked) const
{
  return FindElements(
    this->TheBand, trimmed, [&asked](int e) { return asked.empty() || asked[e]; },
    [&](int e, const FinalElement& final)
    { return this->LeavesBorder(e, final.Node, final.Points, final.Count); });
}

bool BandQuality::IsBelowFloor(int e, double measured) const
{
  return measured < this->Floor && measured < this->FloorOf(e) && !this->StandardBefore(e).Invalid;
}

double BandQuality::MeasureOf(const TrimmedBand& trimmed, int e, const FinalElement& final) const
{
  if (this->IsExempt(trimmed, e))
  {
    return this->By == Measure::Worth
      ? EdgeWorth * ShortestEdgeShare(this->TheBand, final.Node, final.Points, final.Count)
      : std::numeric_limits<double>::infinity();
  }
  return this->By == Measure::Worth ? WorthOf(this->TheBand, final.Node, final.Points, final.Count)
                                    : ScaledJacobian(final.Points, final.Count);
}

std::vector<int> BandQuality::FindBelowFloor(
  const TrimmedBand& trimmed, const std::vector<char>& asked) const
{
  if (this->Floor <= 0.0 || trimmed.Treated.FlatCorner.empty())
  {
    return {};
  }
  return FindElements(
    this->TheBand, trimmed, [&asked](int e) { return asked.empty() || asked[e]; },
    [&](int e, const FinalElement& final)
    { return this->IsBelowFloor(e, this->MeasureOf(trimmed, e, final)); });
}

std::vector<int> BandQuality::FindShortOf(const TrimmedBand& trimmed, double worth) const
{
  if (trimmed.Treated.FlatCorner.empty())
  {
    return {};
  }
  return FindElements(this->TheBand, trimmed,
    [&](int e, const FinalElement& final)
    {
      if (this->IsExempt(trimmed, e))
      {
        return false;
      }
      const double now = WorthOf(this->TheBand, final.Node, final.Points, final.Count);
      if (!(now < worth))
      {
        return false;
      }
      const Standard& before = this->StandardBefore(e);
      return now < (1.0 - QualitySlack) * before.ScaledJacobian && !before.Invalid;
    });
}

double BandQuality::LowestIfLeft(const TrimmedBand& trimmed, const Columns& columns, int column,
  const std::vector<int>& nodes, double way) const
{
  double lowest = std::numeric_limits<double>::infinity();
  const auto isLeft = [&](int node)
  { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); };
  for (const int e : ElementsAt(this->TheBand, nodes))
  {
    if (!trimmed.Kept[e] || this->IsExempt(trimmed, e))
    {
      continue;
    }
    FinalElement final = FinalShape(this->TheBand, trimmed, e);
    const double before = ScaledJacobian(final.Points, final.Count);
    for (int i = 0; i < final.Count; ++i)
    {
      if (isLeft(final.Node[i]))
      {
        final.Points[i] = (1.0 - way) * this->TheBand.Point[final.Node[i]] + way * final.Points[i];
      }
    }
    const double after = ScaledJacobian(final.Points, final.Count);
    if (columns.Column[e] == column)
    {
      lowest = std::min(lowest, after);
    }
    else if (after < std::min(before, this->Floor))
    {
      return -1.0;
    }
  }
  return lowest;
}

BandQuality::Shortage BandQuality::MeasureShortage(const TrimmedBand& trimmed) const
{
  Shortage shortage;
  for (const int e : this->FindBelowFloor(trimmed))
  {
    const FinalElement final = FinalShape(this->TheBand, trimmed, e);
    const double missing = this->FloorOf(e) - this->MeasureOf(trimmed, e, final);
    shortage.Sum += missing;
    shortage.Largest = std::max(shortage.Largest, missing);
  }
  return shortage;
}

}
