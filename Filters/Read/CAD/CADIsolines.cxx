#include "CADIsolines.h"

#include <BRep_Tool.hxx>
#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Curve.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <iterator>

namespace nurbs
{
namespace
{
/// Distances from the edge, as shares of its size: of a curve that strays, and of one that is it.
constexpr double Straying = 1e-4;
constexpr double Fitting = 1e-6;
/// Curves stray near their ends, where a pole is.
constexpr double Shares[] = { 0.005, 0.01, 0.02, 0.04, 0.07, 0.12, 0.2, 0.35, 0.5, 0.65, 0.8, 0.88,
  0.93, 0.96, 0.98, 0.99, 0.995 };

gp_Pnt PointAt(const Handle(Geom_Surface) & surface, const Vec2& uv)
{
  return surface->Value(uv.x(), uv.y());
}

/// An edge in space, with the range of its parameter.
struct EdgeCurve
{
  Handle(Geom_Curve) Curve;
  double First = 0.0, Last = 0.0;

  gp_Pnt At(double share) const
  {
    return this->Curve->Value(this->First + share * (this->Last - this->First));
  }
  double Size() const
  {
    double size = 0.0;
    for (const double share : Shares)
    {
      size = std::max(size, this->At(share).Distance(this->At(0.0)));
    }
    return size;
  }
  double DistanceOf(const gp_Pnt& point) const
  {
    const GeomAPI_ProjectPointOnCurve foot(point, this->Curve, this->First, this->Last);
    const double ends = std::min(point.Distance(this->At(0.0)), point.Distance(this->At(1.0)));
    return foot.NbPoints() > 0 ? std::min(ends, foot.LowerDistance()) : ends;
  }
};

bool Strays(const EdgeCurve& edge, const Handle(Geom_Surface) & surface,
  const BoundaryCurve& boundary, double tolerance)
{
  return std::any_of(std::begin(Shares), std::end(Shares),
    [&](double share)
    {
      const double t = boundary.First + share * (boundary.Last - boundary.First);
      return PointAt(surface, boundary(t)).Distance(edge.At(share)) > tolerance;
    });
}

/// Whether the edge is what the surface has between two places along a straight line: as far, too,
/// as a closed edge ends where it begins.
bool IsAlong(const EdgeCurve& edge, const Handle(Geom_Surface) & surface, const Vec2& first,
  const Vec2& last, double tolerance)
{
  const auto at = [&](double share) { return PointAt(surface, first + share * (last - first)); };
  double reach = 0.0;
  for (const double share : Shares)
  {
    reach = std::max(reach, at(share).Distance(at(0.0)));
  }
  return reach > 0.5 * edge.Size() && at(0.0).Distance(edge.At(0.0)) <= tolerance &&
    at(1.0).Distance(edge.At(1.0)) <= tolerance &&
    std::all_of(std::begin(Shares), std::end(Shares),
      [&](double share) { return edge.DistanceOf(at(share)) <= tolerance; });
}
}

//------------------------------------------------------------------------------
BoundaryCurve WithoutStraying(
  const TopoDS_Edge& edge, const Handle(Geom_Surface) & surface, const BoundaryCurve& boundary)
{
  EdgeCurve own;
  own.Curve = BRep_Tool::Curve(edge, own.First, own.Last);
  const Geom2dAdaptor_Curve adaptor(boundary.Curve, boundary.First, boundary.Last);
  if (own.Curve.IsNull() || adaptor.GetType() == GeomAbs_Line)
  {
    return boundary;
  }
  const double size = own.Size();
  if (!Strays(own, surface, boundary, Straying * size))
  {
    return boundary;
  }
  const Vec2 ends[] = { boundary(boundary.First), boundary(boundary.Last) };
  for (const int axis : { 0, 1 })
  {
    for (const Vec2& fixed : ends)
    {
      Vec2 first = ends[0];
      Vec2 last = ends[1];
      first[axis] = last[axis] = fixed[axis];
      if (first != last && IsAlong(own, surface, first, last, Fitting * size))
      {
        return StraightBetween(first, last);
      }
    }
  }
  return boundary;
}
}
