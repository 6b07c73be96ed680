#include "CADSeams.h"

#include <cmath>

namespace nurbs
{
namespace
{
/// What counts as nothing, as a share of the range of a surface, and of its size.
constexpr double SeamShare = 1e-6;
constexpr double PoleShare = 1e-6;

/// Whether a wire is a line along all of one parameter, where the other one begins or ends.
bool IsLineAtBound(const BoundaryWire& wire, const ParameterRange& bounds)
{
  const ParameterRange range = RangeOf(wire);
  const Vec2 size = bounds.Last - bounds.First;
  const Vec2 shares = (range.Last - range.First).cwiseQuotient(size);
  for (int axis : { 0, 1 })
  {
    const double turns = (range.First[axis] - bounds.First[axis]) / size[axis];
    if (shares[axis] <= SeamShare && std::abs(turns - std::round(turns)) <= SeamShare &&
      shares[1 - axis] >= 1.0 - SeamShare)
    {
      return true;
    }
  }
  return false;
}

/// Whether all of a line of constant parameter is one point.
bool IsPole(const Handle(Geom_Surface) & surface, const ParameterRange& bounds, int axis, double at)
{
  const auto place = [&](double share)
  {
    Vec2 uv = bounds.First + share * (bounds.Last - bounds.First);
    uv[axis] = at;
    return surface->Value(uv.x(), uv.y());
  };
  const Vec2 middle = 0.5 * (bounds.First + bounds.Last);
  const double size = surface->Value(middle.x(), middle.y()).Distance(place(0.0));
  return place(0.0).Distance(place(0.3)) <= PoleShare * size &&
    place(0.0).Distance(place(0.7)) <= PoleShare * size;
}

/// Whether a surface of finite range ends in seams and poles only.
bool HasNoBorder(const Handle(Geom_Surface) & surface, const ParameterRange& bounds)
{
  const bool closed[] = { surface->IsUClosed() == true, surface->IsVClosed() == true };
  const auto ends = [&](int axis)
  {
    return !closed[axis] &&
      !(IsPole(surface, bounds, axis, bounds.First[axis]) &&
        IsPole(surface, bounds, axis, bounds.Last[axis]));
  };
  return (closed[0] || closed[1]) && !ends(0) && !ends(1);
}

/// The border of the whole range of a surface.
BoundaryWire BorderOf(const ParameterRange& bounds)
{
  const Vec2 corners[] = { bounds.First, Vec2(bounds.Last.x(), bounds.First.y()), bounds.Last,
    Vec2(bounds.First.x(), bounds.Last.y()) };
  BoundaryWire wire;
  for (int i = 0; i < 4; ++i)
  {
    wire.push_back(StraightBetween(corners[i], corners[(i + 1) % 4]));
  }
  return wire;
}

/// The stretches of a closed wire between those that run along two poles, in its order.
std::vector<BoundaryWire> WaysBetween(const BoundaryWire& wire, const Vec2& poles, double tolerance)
{
  const auto isAlong = [&](const BoundaryCurve& curve, double pole)
  {
    return std::abs(curve(curve.First).y() - pole) <= tolerance &&
      std::abs(curve(0.5 * (curve.First + curve.Last)).y() - pole) <= tolerance &&
      std::abs(curve(curve.Last).y() - pole) <= tolerance;
  };
  std::vector<BoundaryWire> ways(1);
  for (const BoundaryCurve& curve : wire)
  {
    if (!isAlong(curve, poles[0]) && !isAlong(curve, poles[1]))
    {
      ways.back().push_back(curve);
    }
    else if (!ways.back().empty())
    {
      ways.emplace_back();
    }
  }
  if (ways.size() == 3)
  {
    // It began in the midst of one.
    ways.back().insert(ways.back().end(), ways.front().begin(), ways.front().end());
    ways.erase(ways.begin());
  }
  if (ways.back().empty())
  {
    ways.pop_back();
  }
  return ways;
}
}

//------------------------------------------------------------------------------
void CompleteSeams(const Handle(Geom_Surface) & surface, std::vector<BoundaryWire>& wires)
{
  const ParameterRange bounds = BoundsOf(surface);
  if (!IsFinite(bounds))
  {
    return;
  }
  for (BoundaryWire& wire : wires)
  {
    if (IsLineAtBound(wire, bounds) && HasNoBorder(surface, bounds))
    {
      wire = BorderOf(bounds);
    }
  }
}

//------------------------------------------------------------------------------
bool TakeOtherPart(const Handle(Geom_Surface) & surface, std::vector<BoundaryWire>& wires)
{
  if (wires.size() != 1 || !surface->IsUPeriodic())
  {
    return false;
  }
  const ParameterRange bounds = BoundsOf(surface), range = RangeOf(wires[0]);
  const Vec2 poles(range.First.y(), range.Last.y());
  if (!IsPole(surface, bounds, 1, poles[0]) || !IsPole(surface, bounds, 1, poles[1]))
  {
    return false;
  }
  const double tolerance = SeamShare * (poles[1] - poles[0]);
  std::vector<BoundaryWire> ways = WaysBetween(wires[0], poles, tolerance);
  if (ways.size() != 2)
  {
    return false;
  }
  const auto middle = [](const BoundaryWire& way)
  {
    const ParameterRange own = RangeOf(way);
    return 0.5 * (own.First.x() + own.Last.x());
  };
  const bool firstIsRight = middle(ways[0]) > middle(ways[1]);
  const BoundaryWire& right = ways[firstIsRight ? 0 : 1];
  BoundaryWire left = ways[firstIsRight ? 1 : 0];
  for (BoundaryCurve& curve : left)
  {
    curve.Shift.x() += surface->UPeriod();
  }
  const auto begin = [](const BoundaryWire& way) { return way.front()(way.front().First); };
  const auto end = [](const BoundaryWire& way) { return way.back()(way.back().Last); };
  const Vec2 there = begin(left) - end(right), back = begin(right) - end(left);
  const double least = SeamShare * surface->UPeriod();
  if (std::abs(there.y()) > tolerance || std::abs(back.y()) > tolerance || there.x() < least ||
    -back.x() < least)
  {
    return false;
  }
  BoundaryWire other = right;
  other.push_back(StraightBetween(end(right), begin(left)));
  other.insert(other.end(), left.begin(), left.end());
  other.push_back(StraightBetween(end(left), begin(right)));
  wires[0] = other;
  return true;
}
}
