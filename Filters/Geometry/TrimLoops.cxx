#include "TrimLoops.h"

#include "ParameterPolygon.h"

#include <algorithm>

namespace nurbs
{

TrimLoops::TrimLoops(const NurbsSurface& surface)
{
  constexpr double Rounding = 1e-9;
  const auto& given = surface.TrimLoops;
  if (given.empty() || (given.size() == 1 && IsWholeRectangle(given[0], surface, Rounding)))
  {
    return;
  }
  for (std::size_t loop = 0; loop < surface.TrimLoops.size(); ++loop)
  {
    const auto& points = surface.TrimLoops[loop];
    this->FirstEdge.push_back(static_cast<int>(this->Edges.size()));
    int index = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
      if (a != b) // a repeated point makes no edge
      {
        this->Edges.push_back({ a, b, static_cast<int>(loop), index++ });
      }
    }
  }
  this->FirstEdge.push_back(static_cast<int>(this->Edges.size()));
  this->BuildBands();
  for (std::size_t loop = 0; loop < surface.TrimLoops.size(); ++loop)
  {
    // Inside is on the left of a counter-clockwise loop that lies in an even number of others.
    const int votes = this->VotesForLeft(static_cast<int>(loop));
    this->LeftInside.push_back(votes != 0 ? votes > 0 : SignedArea(surface.TrimLoops[loop]) > 0);
  }
}

int TrimLoops::VotesForLeft(int loop) const
{
  constexpr int most = 32;
  const int first = this->FirstEdge[loop], last = this->FirstEdge[loop + 1];
  const int stride = 1 + (last - first) / most;
  int votes = 0;
  for (int e = first; e < last; e += stride)
  {
    const Edge& edge = this->Edges[e];
    // Across it where both parameters reach equally far: one may go to a million and the other one
    // to a millionth.
    const Vec2 d = (edge.To - edge.From).cwiseQuotient(this->Size);
    const Vec2 middle = 0.5 * (edge.From + edge.To);
    const Vec2 normal = Vec2(-d.y(), d.x()).cwiseProduct(this->Size);
    for (double step : { 1e-7, 1e-5, 1e-3 })
    {
      const Vec2 a = middle + step * normal, b = middle - step * normal;
      const bool insideLeft = this->Inside(a.x(), a.y());
      if (insideLeft != this->Inside(b.x(), b.y()))
      {
        votes += insideLeft ? 1 : -1;
        break;
      }
    }
  }
  return votes;
}

void TrimLoops::BuildBands()
{
  if (this->Edges.empty())
  {
    return;
  }
  Vec2 low = this->Edges[0].From, high = low;
  for (const Edge& edge : this->Edges)
  {
    low = low.cwiseMin(edge.From);
    high = high.cwiseMax(edge.From);
  }
  this->Low = low.y();
  this->High = high.y();
  this->Size = (low.array() < high.array()).select(high - low, Vec2::Ones());
  const int bands = std::clamp(static_cast<int>(this->Edges.size()) / 2, 1, 4096);
  this->Scale = this->High > this->Low ? bands / (this->High - this->Low) : 0.0;
  this->BandStart.assign(bands + 1, 0);
  const auto forBands = [&](const Edge& edge, const auto& visit)
  {
    const int a = this->Band(edge.From.y()), b = this->Band(edge.To.y());
    for (int k = std::min(a, b); k <= std::max(a, b); ++k)
    {
      visit(k);
    }
  };
  for (const Edge& edge : this->Edges)
  {
    forBands(edge, [&](int k) { ++this->BandStart[k + 1]; });
  }
  for (int k = 0; k < bands; ++k)
  {
    this->BandStart[k + 1] += this->BandStart[k];
  }
  this->BandEdges.resize(this->BandStart.back());
  std::vector<int> next(this->BandStart.begin(), this->BandStart.end() - 1);
  for (std::size_t e = 0; e < this->Edges.size(); ++e)
  {
    forBands(this->Edges[e], [&](int k) { this->BandEdges[next[k]++] = static_cast<int>(e); });
  }
}

int TrimLoops::Band(double v) const
{
  // Far from small loops the number is larger than any int.
  const double last = static_cast<double>(this->BandStart.size()) - 2.0;
  return static_cast<int>(std::clamp((v - this->Low) * this->Scale, 0.0, last));
}

bool TrimLoops::Inside(double u, double v) const
{
  if (this->Edges.empty())
  {
    return true;
  }
  if (v < this->Low || v > this->High)
  {
    return false;
  }
  const int band = this->Band(v);
  bool inside = false;
  for (int k = this->BandStart[band]; k < this->BandStart[band + 1]; ++k)
  {
    const Edge& edge = this->Edges[this->BandEdges[k]];
    if ((edge.From.y() > v) != (edge.To.y() > v))
    {
      const double x = edge.From.x() +
        (v - edge.From.y()) / (edge.To.y() - edge.From.y()) * (edge.To.x() - edge.From.x());
      inside ^= u < x;
    }
  }
  return inside;
}

TrimState TrimLoops::Classify(const Vec2& low, const Vec2& high) const
{
  if (this->Edges.empty())
  {
    return TrimState::Inside;
  }
  if (low.y() > this->High || high.y() < this->Low)
  {
    return TrimState::Outside;
  }
  const int first = this->BandStart[this->Band(low.y())];
  const int last = this->BandStart[this->Band(high.y()) + 1];
  for (int k = first; k < last; ++k)
  {
    const Edge& edge = this->Edges[this->BandEdges[k]];
    double t0, t1;
    if (std::max(edge.From.x(), edge.To.x()) >= low.x() &&
      std::min(edge.From.x(), edge.To.x()) <= high.x() &&
      ClipToRectangle(edge.From, edge.To, low, high, t0, t1))
    {
      return TrimState::Crossed;
    }
  }
  const Vec2 middle = 0.5 * (low + high);
  return this->Inside(middle.x(), middle.y()) ? TrimState::Inside : TrimState::Outside;
}

const TrimLoops::Edge& TrimLoops::LoopEdge(int loop, int index) const
{
  const int first = this->FirstEdge[loop], count = this->FirstEdge[loop + 1] - first;
  return this->Edges[first + ((index % count) + count) % count];
}

bool ClipToRectangle(
  const Vec2& a, const Vec2& b, const Vec2& low, const Vec2& high, double& t0, double& t1)
{
  t0 = 0;
  t1 = 1;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double d = b[axis] - a[axis];
    if (d == 0)
    {
      if (a[axis] < low[axis] || a[axis] > high[axis])
      {
        return false;
      }
      continue;
    }
    double near = (low[axis] - a[axis]) / d, far = (high[axis] - a[axis]) / d;
    if (near > far)
    {
      std::swap(near, far);
    }
    t0 = std::max(t0, near);
    t1 = std::min(t1, far);
  }
  return t0 < t1;
}

}
