#include "CADFaceConversion.h"

#include "CADSurfaceConversion.h"
#include "NURBSFieldData.h"
#include "TrimmedParameterGrid.h"

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <Precision.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
/// Chords of trim loops deviate by at most this share of the face's size.
constexpr double ChordTolerance = 1e-6;

/// A stretch of a wire in the parameters of the face's surface, run in the wire's direction.
struct BoundaryCurve
{
  Handle(Geom2d_Curve) Curve;
  double First, Last;        ///< First > Last where the wire runs against the curve
  Vec2 Shift = Vec2::Zero(); ///< whole periods that join it to the stretch before

  Vec2 operator()(double t) const
  {
    const gp_Pnt2d p = this->Curve->Value(t);
    return Vec2(p.X(), p.Y()) + this->Shift;
  }
};
using BoundaryWire = std::vector<BoundaryCurve>;

/// Parameters between which the curve is smooth, in the direction of the wire.
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

/// Whole periods that bring `to` closest to `from`.
Vec2 JoiningShift(const Handle(Geom_Surface) & surface, const Vec2& from, const Vec2& to)
{
  Vec2 shift = Vec2::Zero();
  if (surface->IsUPeriodic())
  {
    shift.x() = surface->UPeriod() * std::round((from.x() - to.x()) / surface->UPeriod());
  }
  if (surface->IsVPeriodic())
  {
    shift.y() = surface->VPeriod() * std::round((from.y() - to.y()) / surface->VPeriod());
  }
  return shift;
}

/// The wires of a face, which has to be oriented forward.
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
  return wires;
}

/**
 * The range of parameters that the wires enclose. Exact where its ends are corners of the
 * wires or straight stretches; where a curved stretch bounds it a little is added, which the
 * trim loops take away again.
 */
ParameterRange EnclosedRange(
  const std::vector<BoundaryWire>& wires, const Handle(Geom_Surface) & surface)
{
  const Vec2 all = Vec2::Constant(std::numeric_limits<double>::infinity());
  ParameterRange corners{ all, -all };
  ParameterRange curves{ all, -all };
  for (const BoundaryWire& wire : wires)
  {
    for (const BoundaryCurve& boundary : wire)
    {
      const std::vector<double> ends = SmoothPieces(boundary);
      for (double end : { ends.front(), ends.back() })
      {
        corners.First = corners.First.cwiseMin(boundary(end));
        corners.Last = corners.Last.cwiseMax(boundary(end));
      }
      for (size_t i = 0; ends.size() > 2 && i + 1 < ends.size(); ++i)
      {
        for (int k = 0; k < 16; ++k)
        {
          const Vec2 uv = boundary(ends[i] + k / 16.0 * (ends[i + 1] - ends[i]));
          curves.First = curves.First.cwiseMin(uv);
          curves.Last = curves.Last.cwiseMax(uv);
        }
      }
    }
  }
  double bounds[4];
  surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
  ParameterRange range = corners;
  for (int axis : { 0, 1 })
  {
    const double size = std::max(corners.Last[axis], curves.Last[axis]) -
      std::min(corners.First[axis], curves.First[axis]);
    if (curves.First[axis] < corners.First[axis] - 1e-7 * size)
    {
      range.First[axis] = curves.First[axis] - 0.01 * size;
    }
    if (curves.Last[axis] > corners.Last[axis] + 1e-7 * size)
    {
      range.Last[axis] = curves.Last[axis] + 0.01 * size;
    }
    const bool periodic = axis == 0 ? surface->IsUPeriodic() : surface->IsVPeriodic();
    const double slack = 1e-7 * size;
    if (!periodic)
    {
      const double low = bounds[2 * axis];
      const double high = bounds[2 * axis + 1];
      range.First[axis] = range.First[axis] < low + slack ? low : range.First[axis];
      range.Last[axis] = range.Last[axis] > high - slack ? high : range.Last[axis];
    }
    else
    {
      const double period = axis == 0 ? surface->UPeriod() : surface->VPeriod();
      if (range.Last[axis] - range.First[axis] > period - slack)
      {
        range.Last[axis] = range.First[axis] + period;
      }
    }
  }
  return range;
}

/// Divides stretches of wires until their chords lie close enough to the surface's own curve.
class LoopSampler
{
public:
  LoopSampler(const CADSurface& surface, double tolerance)
    : Surface(surface)
    , Tolerance(tolerance)
  {
  }

  std::vector<Vec2> Sample(const BoundaryWire& wire) const
  {
    std::vector<Vec2> loop;
    for (size_t k = 0; k < wire.size(); ++k)
    {
      const BoundaryCurve& boundary = wire[k];
      const std::vector<double> ends = SmoothPieces(boundary);
      for (size_t i = 0; i + 1 < ends.size(); ++i)
      {
        const Place first = this->At(boundary, ends[i]);
        loop.push_back(first.UV);
        this->Divide(boundary, first, this->At(boundary, ends[i + 1]), 0, loop);
      }
      const BoundaryCurve& next = wire[(k + 1) % wire.size()];
      const Vec2 end = this->At(boundary, boundary.Last).UV;
      if (this->AreApart(end, this->At(next, next.First).UV))
      {
        loop.push_back(end);
      }
    }
    return loop;
  }

private:
  struct Place
  {
    double T;
    Vec2 UV;
    Vec3 Point;
  };

  /// Where the edge at the apex of a cone is missing one stretch ends elsewhere than the next
  /// begins.
  bool AreApart(const Vec2& a, const Vec2& b) const
  {
    const NurbsSurface& surface = this->Surface.Converted.Surface;
    return std::abs(a.x() - b.x()) > 1e-3 * (surface.LastU() - surface.FirstU()) ||
      std::abs(a.y() - b.y()) > 1e-3 * (surface.LastV() - surface.FirstV());
  }

  Vec3 PointAt(const Vec2& uv) const
  {
    return Evaluate(this->Surface.Converted.Surface, uv.x(), uv.y());
  }

  Place At(const BoundaryCurve& boundary, double t) const
  {
    const NurbsSurface& surface = this->Surface.Converted.Surface;
    Vec2 uv = this->Surface(boundary(t));
    uv.x() = std::clamp(uv.x(), surface.FirstU(), surface.LastU());
    uv.y() = std::clamp(uv.y(), surface.FirstV(), surface.LastV());
    return Place{ t, uv, this->PointAt(uv) };
  }

  /// Adds the places strictly between two places.
  void Divide(const BoundaryCurve& boundary, const Place& a, const Place& b, int depth,
    std::vector<Vec2>& loop) const
  {
    if (depth > 12)
    {
      return;
    }
    const Place middle = this->At(boundary, 0.5 * (a.T + b.T));
    bool straight = true;
    for (const Place& place : { middle, this->At(boundary, a.T + 0.23 * (b.T - a.T)),
           this->At(boundary, a.T + 0.79 * (b.T - a.T)) })
    {
      straight = straight && this->IsOnChord(place, a, b);
    }
    if (!straight)
    {
      this->Divide(boundary, a, middle, depth + 1, loop);
      loop.push_back(middle.UV);
      this->Divide(boundary, middle, b, depth + 1, loop);
    }
  }

  /// Is the place, on the surface, within the tolerance of the line from a to b in (u, v)?
  bool IsOnChord(const Place& place, const Place& a, const Place& b) const
  {
    // The foot of the place on the chord, in space: twice corrected from the share in (u, v).
    const Vec2 chord = b.UV - a.UV;
    double s = chord.squaredNorm() > 0.0 ? (place.UV - a.UV).dot(chord) / chord.squaredNorm() : 0.0;
    double distance = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 foot = this->PointAt(a.UV + s * chord);
      const double step = s > 0.5 ? -1e-4 : 1e-4;
      const Vec3 tangent = (this->PointAt(a.UV + (s + step) * chord) - foot) / step;
      const Vec3 gap = place.Point - foot;
      distance = gap.norm();
      if (tangent.squaredNorm() <= 0.0)
      {
        break;
      }
      s = std::clamp(s + gap.dot(tangent) / tangent.squaredNorm(), 0.0, 1.0);
    }
    return distance <= this->Tolerance;
  }

  const CADSurface& Surface;
  double Tolerance;
};

/// Diagonal of the box of points of a surface.
double SizeOf(const NurbsSurface& surface)
{
  Eigen::AlignedBox3d box;
  for (const Vec4& point : surface.ControlPoints)
  {
    box.extend(Vec3(point.head<3>()));
  }
  return box.diagonal().norm();
}

double SignedArea(const std::vector<Vec2>& loop)
{
  double area = 0.0;
  for (size_t i = 0; i < loop.size(); ++i)
  {
    const Vec2& a = loop[i];
    const Vec2& b = loop[(i + 1) % loop.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

/// Does the loop run along the border of the parameter rectangle, round all of it?
bool IsRectangle(const std::vector<Vec2>& loop, const NurbsSurface& surface)
{
  const double sizeU = surface.LastU() - surface.FirstU();
  const double sizeV = surface.LastV() - surface.FirstV();
  for (const Vec2& uv : loop)
  {
    const double clearU = std::min(uv.x() - surface.FirstU(), surface.LastU() - uv.x());
    const double clearV = std::min(uv.y() - surface.FirstV(), surface.LastV() - uv.y());
    if (clearU > ChordTolerance * sizeU && clearV > ChordTolerance * sizeV)
    {
      return false;
    }
  }
  return std::abs(std::abs(SignedArea(loop)) - sizeU * sizeV) <
    4.0 * ChordTolerance * sizeU * sizeV;
}

/// Drops points that repeat the one before.
void RemoveRepeated(std::vector<Vec2>& loop)
{
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back())
  {
    loop.pop_back();
  }
}

/// The loops of the wires on the converted surface; none where they are just its border.
std::vector<std::vector<Vec2>> SampleLoops(
  const std::vector<BoundaryWire>& wires, const CADSurface& surface)
{
  const NurbsSurface& form = surface.Converted.Surface;
  const LoopSampler sampler(surface, ChordTolerance * SizeOf(form));
  std::vector<std::vector<Vec2>> loops;
  for (const BoundaryWire& wire : wires)
  {
    std::vector<Vec2> loop = sampler.Sample(wire);
    RemoveRepeated(loop);
    if (loop.size() > 2)
    {
      loops.push_back(loop);
    }
  }
  // Corners on straight stretches say nothing.
  loops = ThinLoops(loops, Vec2(form.LastU() - form.FirstU(), form.LastV() - form.FirstV()), 1e-10);
  if (loops.size() == 1 && IsRectangle(loops[0], form))
  {
    loops.clear();
  }
  return loops;
}

void Scale(NurbsSurface& surface, double scale)
{
  for (Vec4& point : surface.ControlPoints)
  {
    point.head<3>() *= scale;
  }
}
}

//------------------------------------------------------------------------------
std::string ConvertFace(
  const TopoDS_Face& face, const std::vector<double>& limits, double scale, NurbsSurface& surface)
{
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Handle(Geom_Surface) basis = BRep_Tool::Surface(forward);
  if (basis.IsNull())
  {
    return "it has no surface";
  }
  const std::vector<BoundaryWire> wires = CollectWires(forward, basis);
  ParameterRange range;
  if (wires.empty())
  {
    basis->Bounds(range.First.x(), range.Last.x(), range.First.y(), range.Last.y());
  }
  else
  {
    range = EnclosedRange(wires, basis);
  }
  if (limits.size() == 4)
  {
    range.First = range.First.cwiseMax(Vec2(limits[0], limits[2]));
    range.Last = range.Last.cwiseMin(Vec2(limits[1], limits[3]));
  }
  for (double bound : { range.First.x(), range.First.y(), range.Last.x(), range.Last.y() })
  {
    if (!std::isfinite(bound) || Precision::IsInfinite(bound))
    {
      return "it has no bounds";
    }
  }
  if (!((range.Last - range.First).minCoeff() > 0.0))
  {
    return "its parameter range is empty";
  }

  const CADSurface converted = ConvertSurface(basis, range);
  surface = converted.Converted.Surface;
  surface.TrimLoops = SampleLoops(wires, converted);
  if (face.Orientation() == TopAbs_REVERSED)
  {
    surface = ReverseU(surface);
  }
  Scale(surface, scale);
  const std::string defect = FindDefect(surface);
  return defect.empty() ? FindTrimLoopDefect(surface) : defect;
}
}
