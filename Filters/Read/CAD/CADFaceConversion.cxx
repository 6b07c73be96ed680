#include "CADFaceConversion.h"

#include "CADSeams.h"
#include "CADWires.h"
#include "LoopThinning.h"
#include "ParameterPolygon.h"

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
/// Chords of trim loops deviate by at most this share of the face's size.
constexpr double ChordTolerance = 1e-6;
/// What rounding leaves of a parameter.
constexpr double Rounding = 1e-13;

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

double SizeOf(const NurbsSurface& surface)
{
  return BoxOf(surface).diagonal().norm();
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

/// The loops of the wires on the converted surface.
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
  return ThinLoops(loops, Vec2(form.LastU() - form.FirstU(), form.LastV() - form.FirstV()), 1e-10);
}

/// No loops where they are just the border of the surface.
void DropBorderLoop(NurbsSurface& surface)
{
  auto& loops = surface.TrimLoops;
  if (loops.size() == 1 && IsWholeRectangle(loops[0], surface, ChordTolerance))
  {
    loops.clear();
  }
}

/// What wires leave of a turn where they only pass: ways along its border and back.
void RemoveSpurs(const NurbsSurface& surface, std::vector<Vec2>& loop)
{
  const auto onBorder = [&](const Vec2& a, const Vec2& b, const Vec2& c)
  {
    return a.x() == b.x() && b.x() == c.x()
      ? b.x() == surface.FirstU() || b.x() == surface.LastU()
      : a.y() == b.y() && b.y() == c.y() && (b.y() == surface.FirstV() || b.y() == surface.LastV());
  };
  for (size_t i = 0; loop.size() > 2 && i < loop.size();)
  {
    const size_t count = loop.size();
    if (onBorder(loop[(i + count - 1) % count], loop[i], loop[(i + 1) % count]))
    {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    }
    else
    {
      ++i;
    }
  }
}

/// The part of a winding face in one turn; false if there is none.
bool KeepTurn(NurbsSurface& surface)
{
  auto& loops = surface.TrimLoops;
  for (auto& loop : loops)
  {
    RemoveSpurs(surface, loop);
  }
  const double least =
    ChordTolerance * (surface.LastU() - surface.FirstU()) * (surface.LastV() - surface.FirstV());
  loops.erase(std::remove_if(loops.begin(), loops.end(),
                [&](const auto& loop) { return std::abs(SignedArea(loop)) < least; }),
    loops.end());
  return !loops.empty();
}

/// Makes a side one point where the digits of a file leave no more of it: at the tip of a cone or a
/// dome a ring would be a border.
void CloseTips(NurbsSurface& surface)
{
  const double tolerance = ChordTolerance * SizeOf(surface);
  const int nu = surface.CountU, nv = surface.CountV;
  const int first[] = { 0, nu - 1, 0, (nv - 1) * nu };
  for (int side = 0; side < 4; ++side)
  {
    const int step = side < 2 ? nu : 1, count = side < 2 ? nv : nu;
    const auto point = [&](int k) -> Vec4&
    { return surface.ControlPoints[first[side] + k * step]; };
    Vec3 mean = Vec3::Zero();
    double farthest = 0.0;
    for (int k = 0; k < count; ++k)
    {
      mean += point(k).head<3>() / count;
      farthest = std::max(farthest, (point(k) - point(0)).head<3>().norm());
    }
    for (int k = 0; k < count && farthest <= tolerance; ++k)
    {
      point(k).head<3>() = mean;
    }
  }
}

/// Wires of some files shrink to a point or a slit, and bound nothing.
void DropEmptyLoops(NurbsSurface& surface)
{
  auto& loops = surface.TrimLoops;
  loops.erase(std::remove_if(loops.begin(), loops.end(),
                [](const auto& loop) { return CountCorners(loop) < 3; }),
    loops.end());
}

/// The range of parameters of a face; returns why it has none, or nothing.
std::string FindRange(const std::vector<BoundaryWire>& wires, const Handle(Geom_Surface) & surface,
  const std::vector<double>& limits, ParameterRange& range)
{
  range = wires.empty() ? BoundsOf(surface) : EnclosedRange(wires, surface);
  if (limits.size() == 4)
  {
    range.First = range.First.cwiseMax(Vec2(limits[0], limits[2]));
    range.Last = range.Last.cwiseMin(Vec2(limits[1], limits[3]));
  }
  if (!IsFinite(range))
  {
    return "it has no bounds";
  }
  const double reach =
    std::max(range.First.cwiseAbs().maxCoeff(), range.Last.cwiseAbs().maxCoeff());
  return (range.Last - range.First).minCoeff() > Rounding * reach ? ""
                                                                  : "its parameter range is empty";
}

void Scale(NurbsSurface& surface, double scale)
{
  for (Vec4& point : surface.ControlPoints)
  {
    point.head<3>() *= scale;
  }
}

/// How far the borders of a face may lie from its edges; 0 where that is but rounding.
double ToleranceOf(const TopoDS_Face& face)
{
  double tolerance = 0.0;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next())
  {
    tolerance = std::max(tolerance, BRep_Tool::Tolerance(TopoDS::Edge(edges.Current())));
  }
  return tolerance > Precision::Confusion() ? tolerance : 0.0;
}
}

//------------------------------------------------------------------------------
std::string ConvertFace(const TopoDS_Face& face, const std::vector<double>& limits, double scale,
  std::vector<NurbsSurface>& surfaces, bool isOtherPart)
{
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Handle(Geom_Surface) basis = BRep_Tool::Surface(forward);
  if (basis.IsNull())
  {
    return "it has no surface";
  }
  std::vector<BoundaryWire> wires = CollectWires(forward, basis);
  if (isOtherPart)
  {
    TakeOtherPart(basis, wires);
  }
  ParameterRange range;
  const std::string reason = FindRange(wires, basis, limits, range);
  if (!reason.empty())
  {
    return reason;
  }
  const std::vector<ParameterRange> turns = Turns(range, basis);
  if (turns.empty())
  {
    return "it winds round its surface too many times";
  }
  const double tolerance = scale * ToleranceOf(face);
  for (const ParameterRange& turn : turns)
  {
    const CADSurface converted = ConvertSurface(basis, turn);
    NurbsSurface surface = converted.Converted.Surface;
    surface.TrimLoops = SampleLoops(wires, converted);
    surface.Tolerance = tolerance;
    if (turns.size() > 1 && !KeepTurn(surface))
    {
      continue;
    }
    DropBorderLoop(surface);
    if (face.Orientation() == TopAbs_REVERSED)
    {
      surface = ReverseU(surface);
    }
    DropEmptyLoops(surface);
    CloseTips(surface);
    Scale(surface, scale);
    const std::string defect = FindDefect(surface);
    if (!defect.empty())
    {
      return defect;
    }
    surfaces.push_back(std::move(surface));
  }
  return surfaces.empty() ? "its wires enclose nothing" : std::string();
}

//------------------------------------------------------------------------------
bool HasOtherPart(const TopoDS_Face& face)
{
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  const Handle(Geom_Surface) basis = BRep_Tool::Surface(forward);
  if (basis.IsNull())
  {
    return false;
  }
  std::vector<BoundaryWire> wires = CollectWires(forward, basis);
  return TakeOtherPart(basis, wires);
}
}
