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
}
