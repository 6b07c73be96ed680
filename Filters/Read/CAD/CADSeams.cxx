#include "CADSeams.h"

#include <Geom2d_Line.hxx>
#include <Precision.hxx>
#include <gp_Dir2d.hxx>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
/// What counts as nothing, as a share of the range of a surface, and of its size.
constexpr double SeamShare = 1e-6;
constexpr double PoleShare = 1e-6;

ParameterRange RangeOf(const BoundaryWire& wire)
{
  const Vec2 start = wire.front()(wire.front().First);
  ParameterRange range{ start, start };
  for (const BoundaryCurve& boundary : wire)
  {
    const std::vector<double> ends = SmoothPieces(boundary);
    for (size_t i = 0; i + 1 < ends.size(); ++i)
    {
      for (double share : { 0.0, 0.25, 0.5, 0.75, 1.0 })
      {
        const Vec2 uv = boundary(ends[i] + share * (ends[i + 1] - ends[i]));
        range.First = range.First.cwiseMin(uv);
        range.Last = range.Last.cwiseMax(uv);
      }
    }
  }
  return range;
}

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
    const Vec2 way = corners[(i + 1) % 4] - corners[i];
    BoundaryCurve side;
    side.Curve =
      new Geom2d_Line(gp_Pnt2d(corners[i].x(), corners[i].y()), gp_Dir2d(way.x(), way.y()));
    side.First = 0.0;
    side.Last = way.norm();
    wire.push_back(side);
  }
  return wire;
}
}

//------------------------------------------------------------------------------
void CompleteSeams(const Handle(Geom_Surface) & surface, std::vector<BoundaryWire>& wires)
{
  const ParameterRange bounds = BoundsOf(surface);
  for (double bound : { bounds.First.x(), bounds.First.y(), bounds.Last.x(), bounds.Last.y() })
  {
    if (Precision::IsInfinite(bound))
    {
      return;
    }
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
