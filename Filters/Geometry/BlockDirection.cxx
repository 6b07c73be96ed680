#include "BlockDirection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nurbs
{

BlockDirection::BlockDirection(const KnotSpans& spans)
  : Bend(spans.Breaks.size() - 1, 0.0)
  , Length(spans.Breaks.size() - 1, 0.0)
  , Spans(spans)
{
}

void BlockDirection::Divide(const BlockLimits& limits)
{
  const std::vector<double>& knots = this->Spans.Breaks;
  const double length = knots.back() - knots.front();
  int blocks = 0;
  double open = 0; // bend of the block that the last span has left open
  double start = knots.front();
  int joined = 0; // spans of that block; none of one that is closed
  this->First.clear();
  this->Divisions.clear();
  this->Breaks.assign(1, start);
  for (int k = 0; k < this->NumberOfSpans(); ++k)
  {
    const double low = knots[k], high = knots[k + 1], bend = this->Bend[k];
    const double parts = std::max(
      std::ceil(bend / limits.Flatness), std::floor(limits.Least * (high - low) / length + 1e-9));
    const int n = static_cast<int>(std::clamp(parts, 1.0, 64.0));
    const bool joins = joined > 0 && joined < limits.MostSpans && n == 1 &&
      open + bend <= limits.Flatness && (high - start) * limits.Least <= length * (1 + 1e-9) &&
      this->Spans.Kinds[k] == SideKind::Smooth;
    if (joins)
    {
      open += bend;
      this->Breaks.back() = high;
    }
    else
    {
      start = low;
      open = bend;
      blocks += n;
      for (int i = 1; i <= n; ++i)
      {
        this->Breaks.push_back(i == n ? high : low + (high - low) * i / n);
      }
    }
    joined = n > 1 ? 0 : joins ? joined + 1 : 1;
    this->First.push_back(blocks - n);
    this->Divisions.push_back(n);
  }
}

void BlockDirection::BendSlender(const BlockLimits& limits, double width)
{
  for (std::size_t k = 0; k < this->Bend.size(); ++k)
  {
    this->Bend[k] =
      std::max(this->Bend[k], limits.Flatness * this->Length[k] / (limits.Slender * width));
  }
}

double BlockDirection::LengthOfBlocks() const
{
  return std::accumulate(this->Length.begin(), this->Length.end(), 0.0) / this->NumberOfBlocks();
}

}
