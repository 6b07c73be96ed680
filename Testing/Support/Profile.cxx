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
  : Splines{ { std::move(knots), degree, std::move(control) } }
{
  while (this->Splines.size() < 3 && this->Splines.back().Degree > 0)
  {
    this->Splines.push_back(this->Splines.back().Derivative());
  }
  const Spline& curve = this->Splines.front();
  this->First = curve.Knots[degree];
  this->Last = curve.Knots[curve.Control.size()];
  for (int i = 0; i <= SampleCount; ++i)
  {
    this->Samples.push_back(curve.At(this->First + (this->Last - this->First) * i / SampleCount));
  }
  this->Boxes.resize(4 * (SampleCount / LeafSize + 2));
  this->BuildBoxes(0, SampleCount + 1, 1);
}

Vec2 SplineProfile::Spline::At(double t) const
{
  const auto basis = Basis(this->Knots, this->Degree, static_cast<int>(this->Control.size()), t);
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < this->Control.size(); ++i)
  {
    sum += basis[i] * this->Control[i];
  }
  return sum;
}

/// A spline of one degree less (NURBS Book, eq. 3.4).
SplineProfile::Spline SplineProfile::Spline::Derivative() const
{
  Spline next{ { this->Knots.begin() + 1, this->Knots.end() - 1 }, this->Degree - 1, {} };
  for (std::size_t i = 0; i + 1 < this->Control.size(); ++i)
  {
    const double span = this->Knots[i + this->Degree + 1] - this->Knots[i + 1];
    next.Control.push_back(span > 0
        ? Vec2(this->Degree / span * (this->Control[i + 1] - this->Control[i]))
        : Vec2(Vec2::Zero()));
  }
  return next;
}

SplineProfile::Jet SplineProfile::At(double t) const
{
  Vec2 jet[3] = { Vec2::Zero(), Vec2::Zero(), Vec2::Zero() };
  for (std::size_t order = 0; order < this->Splines.size(); ++order)
  {
    jet[order] = this->Splines[order].At(t);
  }
  return { jet[0], jet[1], jet[2] };
}

double SplineProfile::Box::SquaredDistance(const Vec2& p) const
{
  return (this->Low - p).cwiseMax(p - this->High).cwiseMax(Vec2::Zero()).squaredNorm();
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
  const double to[2] = { this->Boxes[2 * node].SquaredDistance(p),
    this->Boxes[2 * node + 1].SquaredDistance(p) };
  // The nearer half first: as a rule the other one then need not be looked into.
  for (int half : { to[1] < to[0], to[1] >= to[0] })
  {
    if (to[half] < best)
    {
      this->Nearest(p, half ? middle : first, half ? last : middle, 2 * node + half, best, where);
    }
  }
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
