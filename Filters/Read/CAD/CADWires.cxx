#include "CADWires.h"

#include "CADIsolines.h"
#include "CADSeams.h"

#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Dir2d.hxx>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs
{
namespace
{
/// More turns than any thread has.
constexpr double MostTurns = 1000;
/// A wire that is longer than so many periods winds on, as a thread's does.
constexpr double WindingShare = 1.0 + 1e-6;

/// The edges of a wire in the order they follow each other.
std::vector<TopoDS_Edge> OrderedEdges(const TopoDS_Wire& wire, const TopoDS_Face& face)
{
  std::vector<TopoDS_Edge> ordered;
  for (BRepTools_WireExplorer explorer(wire, face); explorer.More(); explorer.Next())
  {
    ordered.push_back(explorer.Current());
  }
  std::vector<TopoDS_Edge> stored;
  for (TopoDS_Iterator it(wire); it.More(); it.Next())
  {
    if (it.Value().Orientation() == TopAbs_FORWARD || it.Value().Orientation() == TopAbs_REVERSED)
    {
      stored.push_back(TopoDS::Edge(it.Value()));
    }
  }
  // The explorer stops where a wire does not close; the file's order is better then.
  return ordered.size() == stored.size() ? ordered : stored;
}

/// The period of a surface along a parameter, 0: it has none.
double PeriodOf(const Handle(Geom_Surface) & surface, int axis)
{
  const bool periodic = axis == 0 ? surface->IsUPeriodic() : surface->IsVPeriodic();
  return !periodic ? 0.0 : axis == 0 ? surface->UPeriod() : surface->VPeriod();
}

/// Whole periods that bring `to` closest to `from`; the fewer where two are as close, as where the
/// edge along a pole is missing in half a surface.
Vec2 JoiningShift(const Handle(Geom_Surface) & surface, const Vec2& from, const Vec2& to)
{
  Vec2 shift = Vec2::Zero();
  for (int axis : { 0, 1 })
  {
    if (const double period = PeriodOf(surface, axis); period > 0.0)
    {
      const double periods = (from[axis] - to[axis]) / period;
      shift[axis] = period * std::copysign(std::ceil(std::abs(periods) - 0.5 - 1e-6), periods);
    }
  }
  return shift;
}

/// A range that holds nothing.
ParameterRange NoRange()
{
  const Vec2 all = Vec2::Constant(std::numeric_limits<double>::infinity());
  return { all, -all };
}

void Extend(ParameterRange& range, const Vec2& uv)
{
  range.First = range.First.cwiseMin(uv);
  range.Last = range.Last.cwiseMax(uv);
}

ParameterRange Joined(const ParameterRange& a, const ParameterRange& b)
{
  return { a.First.cwiseMin(b.First), a.Last.cwiseMax(b.Last) };
}

/// How far wires reach with the ends of their stretches, and with the curved stretches.
struct WireExtent
{
  ParameterRange Corners = NoRange(), Curves = NoRange();

  WireExtent() = default;

  explicit WireExtent(const BoundaryWire& wire)
  {
    for (const BoundaryCurve& boundary : wire)
    {
      const std::vector<double> ends = SmoothPieces(boundary);
      for (double end : { ends.front(), ends.back() })
      {
        Extend(this->Corners, boundary(end));
      }
      for (size_t i = 0; ends.size() > 2 && i + 1 < ends.size(); ++i)
      {
        for (int k = 0; k < 16; ++k)
        {
          Extend(this->Curves, boundary(ends[i] + k / 16.0 * (ends[i + 1] - ends[i])));
        }
      }
    }
  }

  void Add(const WireExtent& other)
  {
    this->Corners = Joined(this->Corners, other.Corners);
    this->Curves = Joined(this->Curves, other.Curves);
  }

  double Length(int axis) const
  {
    return std::max(this->Corners.Last[axis], this->Curves.Last[axis]) -
      std::min(this->Corners.First[axis], this->Curves.First[axis]);
  }
};
}

//------------------------------------------------------------------------------
BoundaryCurve StraightBetween(const Vec2& first, const Vec2& last)
{
  const Vec2 way = last - first;
  return { new Geom2d_Line(gp_Pnt2d(first.x(), first.y()), gp_Dir2d(way.x(), way.y())), 0.0,
    way.norm() };
}

//------------------------------------------------------------------------------
ParameterRange RangeOf(const BoundaryWire& wire)
{
  const WireExtent extent(wire);
  return Joined(extent.Corners, extent.Curves);
}

//------------------------------------------------------------------------------
ParameterRange BoundsOf(const Handle(Geom_Surface) & surface)
{
  ParameterRange range;
  surface->Bounds(range.First.x(), range.Last.x(), range.First.y(), range.Last.y());
  return range;
}

//------------------------------------------------------------------------------
bool IsFinite(const ParameterRange& range)
{
  const auto isFinite = [](double bound)
  { return std::isfinite(bound) && !Precision::IsInfinite(bound); };
  return isFinite(range.First.x()) && isFinite(range.First.y()) && isFinite(range.Last.x()) &&
    isFinite(range.Last.y());
}

//------------------------------------------------------------------------------
std::vector<double> SmoothPieces(const BoundaryCurve& boundary)
{
  const double low = std::min(boundary.First, boundary.Last);
  const double high = std::max(boundary.First, boundary.Last);
  const Geom2dAdaptor_Curve adaptor(boundary.Curve, low, high);
  std::vector<double> ends;
  if (adaptor.GetType() == GeomAbs_Line)
  {
    ends = { low, high };
  }
  else
  {
    TColStd_Array1OfReal intervals(1, adaptor.NbIntervals(GeomAbs_C2) + 1);
    adaptor.Intervals(intervals, GeomAbs_C2);
    for (int i = intervals.Lower(); i < intervals.Upper(); ++i)
    {
      // Several to begin with: a symmetric curve can look straight at its middle.
      for (int k = 0; k < 4; ++k)
      {
        ends.push_back(intervals(i) + 0.25 * k * (intervals(i + 1) - intervals(i)));
      }
    }
    ends.push_back(intervals(intervals.Upper()));
    ends.front() = low;
    ends.back() = high;
  }
  if (boundary.First > boundary.Last)
  {
    std::reverse(ends.begin(), ends.end());
  }
  return ends;
}

//------------------------------------------------------------------------------
std::vector<BoundaryWire> CollectWires(
  const TopoDS_Face& face, const Handle(Geom_Surface) & surface)
{
  std::vector<BoundaryWire> wires;
  for (TopExp_Explorer explorer(face, TopAbs_WIRE); explorer.More(); explorer.Next())
  {
    BoundaryWire wire;
    for (const TopoDS_Edge& edge : OrderedEdges(TopoDS::Wire(explorer.Current()), face))
    {
      BoundaryCurve boundary;
      boundary.Curve = BRep_Tool::CurveOnSurface(edge, face, boundary.First, boundary.Last);
      if (boundary.Curve.IsNull())
      {
        continue;
      }
      boundary = WithoutStraying(edge, surface, boundary);
      if (edge.Orientation() == TopAbs_REVERSED)
      {
        std::swap(boundary.First, boundary.Last);
      }
      if (!wire.empty())
      {
        boundary.Shift =
          JoiningShift(surface, wire.back()(wire.back().Last), boundary(boundary.First));
      }
      wire.push_back(boundary);
    }
    if (!wire.empty())
    {
      wires.push_back(wire);
    }
  }
  CompleteSeams(surface, wires);
  return wires;
}

//------------------------------------------------------------------------------
ParameterRange EnclosedRange(
  const std::vector<BoundaryWire>& wires, const Handle(Geom_Surface) & surface)
{
  WireExtent extent;
  Vec2 longest = Vec2::Zero(); // of a single wire
  for (const BoundaryWire& wire : wires)
  {
    const WireExtent own(wire);
    longest = longest.cwiseMax(Vec2(own.Length(0), own.Length(1)));
    extent.Add(own);
  }
  const auto& [corners, curves] = extent;
  const ParameterRange bounds = BoundsOf(surface);
  ParameterRange range = corners;
  for (int axis : { 0, 1 })
  {
    const double size = extent.Length(axis);
    if (curves.First[axis] < corners.First[axis] - 1e-7 * size)
    {
      range.First[axis] = curves.First[axis] - 0.01 * size;
    }
    if (curves.Last[axis] > corners.Last[axis] + 1e-7 * size)
    {
      range.Last[axis] = curves.Last[axis] + 0.01 * size;
    }
    const double period = PeriodOf(surface, axis);
    const double slack = 1e-7 * size;
    if (period == 0.0)
    {
      const double low = bounds.First[axis];
      const double high = bounds.Last[axis];
      range.First[axis] = range.First[axis] < low + slack ? low : range.First[axis];
      range.Last[axis] = range.Last[axis] > high - slack ? high : range.Last[axis];
    }
    else if (range.Last[axis] - range.First[axis] > period - slack &&
      !(longest[axis] > WindingShare * period))
    {
      range.Last[axis] = range.First[axis] + period;
    }
  }
  return range;
}

//------------------------------------------------------------------------------
std::vector<ParameterRange> Turns(const ParameterRange& whole, const Handle(Geom_Surface) & surface)
{
  std::vector<ParameterRange> turns{ whole };
  for (int axis : { 0, 1 })
  {
    const double period = PeriodOf(surface, axis);
    const double length = whole.Last[axis] - whole.First[axis];
    const double periods = period > 0.0 ? std::ceil(length / period - 1e-7) : 1.0;
    if (!(periods * static_cast<double>(turns.size()) <= MostTurns))
    {
      return {};
    }
    const int count = std::max(1, static_cast<int>(periods));
    std::vector<ParameterRange> parts;
    for (const ParameterRange& turn : turns)
    {
      for (int i = 0; i < count; ++i)
      {
        ParameterRange part = turn;
        part.First[axis] = turn.First[axis] + i * period;
        part.Last[axis] = i + 1 < count ? part.First[axis] + period : turn.Last[axis];
        parts.push_back(part);
      }
    }
    turns = std::move(parts);
  }
  return turns;
}
}
