#include "Profile.h"

#include "SplineData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace judge
{
namespace
{
constexpr int SampleCount = 4096;
constexpr int LeafSize = 16;

double Cross(const Vec2& a, const Vec2& b)
{
  return a[0] * b[1] - a[1] * b[0];
}
}

SplineProfile::SplineProfile(std::vector<double> knots, int degree, std::vector<Vec2> control)
  : Knots(std::move(knots))
  , Degree(degree)
  , Control(std::move(control))
{
  this->First = this->Knots[degree];
  this->Last = this->Knots[this->Control.size()];
  for (int i = 0; i <= SampleCount; ++i)
  {
    this->Samples.push_back(this->At(this->First + (this->Last - this->First) * i / SampleCount).C);
  }
  this->Boxes.resize(4 * (SampleCount / LeafSize + 2));
  this->BuildBoxes(0, SampleCount + 1, 1);
}

SplineProfile::Jet SplineProfile::At(double t) const
{
  Jet jet{ Vec2::Zero(), Vec2::Zero(), Vec2::Zero() };
  std::vector<double> knots = this->Knots;
  std::vector<Vec2> control = this->Control;
  Vec2* out[3] = { &jet.C, &jet.D1, &jet.D2 };
  for (int order = 0; order < 3 && order <= this->Degree; ++order)
  {
    const int degree = this->Degree - order;
    const auto basis = Basis(knots, degree, static_cast<int>(control.size()), t);
    for (std::size_t i = 0; i < control.size(); ++i)
    {
      *out[order] += basis[i] * control[i];
    }
    if (degree == 0)
    {
      break;
    }
    // The derivative is a spline of one degree less (NURBS Book, eq. 3.4).
    std::vector<Vec2> next;
    for (std::size_t i = 0; i + 1 < control.size(); ++i)
    {
      const double span = knots[i + degree + 1] - knots[i + 1];
      next.push_back(
        span > 0 ? Vec2(degree / span * (control[i + 1] - control[i])) : Vec2(Vec2::Zero()));
    }
    control = next;
    knots = std::vector<double>(knots.begin() + 1, knots.end() - 1);
  }
  return jet;
}

void SplineProfile::BuildBoxes(int first, int last, int node)
{
  Box& box = this->Boxes[node];
  box.Low = box.High = this->Samples[first];
  for (int i = first; i < last; ++i)
  {
    box.Low = box.Low.cwiseMin(this->Samples[i]);
    box.High = box.High.cwiseMax(this->Samples[i]);
  }
  if (last - first > LeafSize)
  {
    const int middle = (first + last) / 2;
    this->BuildBoxes(first, middle, 2 * node);
    this->BuildBoxes(middle, last, 2 * node + 1);
  }
}

void SplineProfile::Nearest(
  const Vec2& p, int first, int last, int node, double& best, int& where) const
{
  const Box& box = this->Boxes[node];
  const Vec2 gap = (box.Low - p).cwiseMax(p - box.High).cwiseMax(Vec2::Zero());
  if (gap.squaredNorm() >= best)
  {
    return;
  }
  if (last - first <= LeafSize)
  {
    for (int i = first; i < last; ++i)
    {
      const double d = (this->Samples[i] - p).squaredNorm();
      if (d < best)
      {
        best = d;
        where = i;
      }
    }
    return;
  }
  const int middle = (first + last) / 2;
  this->Nearest(p, first, middle, 2 * node, best, where);
  this->Nearest(p, middle, last, 2 * node + 1, best, where);
}

double SplineProfile::Roughly(const Vec2& p) const
{
  double best = std::numeric_limits<double>::infinity();
  int where = 0;
  this->Nearest(p, 0, SampleCount + 1, 1, best, where);
  double distance = std::numeric_limits<double>::infinity();
  // The last two: on a closed curve the segments round the seam are neighbours.
  for (int i :
    { where - 1, where, where == 0 ? SampleCount - 1 : -1, where == SampleCount ? 0 : -1 })
  {
    if (i < 0 || i >= SampleCount)
    {
      continue;
    }
    const Vec2 a = this->Samples[i], d = this->Samples[i + 1] - a;
    const double t = std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0);
    const double here = (p - a - t * d).norm();
    if (here < std::abs(distance))
    {
      distance = Cross(d, p - a) > 0 ? -here : here;
    }
  }
  return distance;
}

double SplineProfile::Signed(const Vec2& p) const
{
  double best = std::numeric_limits<double>::infinity();
  int where = 0;
  this->Nearest(p, 0, SampleCount + 1, 1, best, where);
  const double here = this->Refined(p, where);
  if (where != 0 && where != SampleCount)
  {
    return here;
  }
  // Closed curves: the foot may be beyond the seam.
  const double there = this->Refined(p, SampleCount - where);
  return std::abs(there) < std::abs(here) ? there : here;
}

double SplineProfile::Refined(const Vec2& p, int where) const
{
  const double step = (this->Last - this->First) / SampleCount;
  double low = std::max(this->First, this->First + (where - 1.5) * step);
  double high = std::min(this->Last, this->First + (where + 1.5) * step);
  double t = std::clamp(this->First + where * step, low, high);
  Jet jet = this->At(t);
  for (int it = 0; it < 60; ++it)
  {
    const double g = jet.D1.dot(jet.C - p);
    const double h = jet.D1.squaredNorm() + jet.D2.dot(jet.C - p);
    (g > 0 ? high : low) = t;
    double next = h > 0 ? t - g / h : 0.5 * (low + high);
    next = next <= low || next >= high ? 0.5 * (low + high) : next;
    const bool done = std::abs(next - t) <= 1e-16 * (this->Last - this->First);
    t = next;
    jet = this->At(t);
    if (done)
    {
      break;
    }
  }
  const double distance = (jet.C - p).norm();
  return Cross(jet.D1, p - jet.C) > 0 ? -distance : distance;
}

double SplineProfile::MinimumRadius() const
{
  double radius = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 512; ++i)
  {
    const Jet jet = this->At(this->First + (this->Last - this->First) * i / 512);
    const double bend = std::abs(Cross(jet.D1, jet.D2));
    radius = std::min(radius, bend > 0 ? std::pow(jet.D1.norm(), 3) / bend : radius);
  }
  return radius;
}

}
