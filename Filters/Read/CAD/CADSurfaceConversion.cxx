#include "CADSurfaceConversion.h"

#include "CADCurveConversion.h"

#include <Eigen/Geometry>

#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Standard_ConstructionError.hxx>

#include <cmath>
#include <sstream>

namespace nurbs
{
namespace
{
/// Shares of a surface's size: what an approximation aims at, and what any NURBS form has to keep.
constexpr double WantedShare = 1e-7;
constexpr double WorstShare = 1e-6;
/// What rounding leaves of a coordinate far from the origin.
constexpr double Rounding = 1e-12;

/// Origin and axes of an elementary surface; Z completes X and Y to a right-handed frame.
struct Frame
{
  explicit Frame(const gp_Ax3& position)
    : Origin(ToVec3(position.Location().XYZ()))
    , X(ToVec3(position.XDirection().XYZ()))
    , Axis(ToVec3(position.Direction().XYZ()))
    , Turn(X.cross(ToVec3(position.YDirection().XYZ())))
  {
  }
  Vec3 Origin, X, Axis;
  Vec3 Turn; ///< u turns right-handed about it; minus Axis in a left-handed frame
};

/// Moves a range that begins before or beyond a closed curve by whole periods.
double PeriodShift(bool periodic, double period, double start, double first)
{
  return periodic ? period * std::floor((first - start) / period + 1e-9) : 0.0;
}

NurbsSurface FromBSplineSurface(const Handle(Geom_BSplineSurface) & spline)
{
  NurbsSurface surface;
  // OpenCASCADE 7.6 gives weights of zero after a polynomial surface is made non-periodic.
  const bool rational = spline->IsURational() || spline->IsVRational();
  surface.DegreeU = spline->UDegree();
  surface.DegreeV = spline->VDegree();
  surface.CountU = spline->NbUPoles();
  surface.CountV = spline->NbVPoles();
  surface.KnotsU.assign(spline->UKnotSequence().begin(), spline->UKnotSequence().end());
  surface.KnotsV.assign(spline->VKnotSequence().begin(), spline->VKnotSequence().end());
  for (int j = 1; j <= surface.CountV; ++j)
  {
    for (int i = 1; i <= surface.CountU; ++i)
    {
      const gp_Pnt pole = spline->Pole(i, j);
      surface.ControlPoints.emplace_back(
        pole.X(), pole.Y(), pole.Z(), rational ? spline->Weight(i, j) : 1.0);
    }
  }
  return surface;
}

/// A B-spline surface cut to the range; across a seam it is run through twice first.
CADSurface CutBSpline(Handle(Geom_BSplineSurface) spline, ParameterRange range)
{
  spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  const bool closedU = spline->IsUPeriodic() || spline->IsUClosed();
  const bool closedV = spline->IsVPeriodic() || spline->IsVClosed();
  spline->SetUNotPeriodic();
  spline->SetVNotPeriodic();
  CADSurface result;
  NurbsSurface& surface = result.Converted.Surface;
  surface = FromBSplineSurface(spline);
  // Clamped at both ends, which surfaces that were periodic are not.
  surface = Restrict(surface, surface.FirstU(), surface.LastU(), surface.FirstV(), surface.LastV());
  double* shifts[2] = { &result.ShiftU, &result.ShiftV };
  for (int axis : { 0, 1 })
  {
    const double period = surface.LastU() - surface.FirstU();
    const double shift =
      PeriodShift(axis == 0 ? closedU : closedV, period, surface.FirstU(), range.First[axis]);
    *shifts[axis] = shift;
    range.First[axis] -= shift;
    range.Last[axis] -= shift;
    if ((axis == 0 ? closedU : closedV) && range.Last[axis] > surface.LastU() + 1e-9 * period)
    {
      surface = RepeatU(surface);
    }
    surface = Transpose(surface);
  }
  surface = Restrict(surface, range.First.x(), range.Last.x(), range.First.y(), range.Last.y());
  return result;
}

/// How far a NURBS form of a surface may be off: by the surface's own size, wherever it lies.
double WorstDeviation(const Handle(Geom_Surface) & surface, const ParameterRange& range)
{
  Eigen::AlignedBox3d box;
  for (double s : { 0.0, 0.2, 0.4, 0.6, 0.8, 1.0 })
  {
    for (double t : { 0.0, 0.2, 0.4, 0.6, 0.8, 1.0 })
    {
      const Vec2 uv = range.First + Vec2(s, t).cwiseProduct(range.Last - range.First);
      box.extend(ToVec3(surface->Value(uv.x(), uv.y()).XYZ()));
    }
  }
  const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return WorstShare * box.diagonal().norm() + Rounding * reach;
}

/// Largest distance between a surface and its NURBS form at all pairs of these parameters.
double Deviation(const Handle(Geom_Surface) & surface, const std::vector<double>& us,
  const std::vector<double>& vs, const CADSurface& converted)
{
  double deviation = 0.0;
  for (double u : us)
  {
    for (double v : vs)
    {
      const Vec2 place = converted(Vec2(u, v));
      const Vec3 point = Evaluate(converted.Converted.Surface, place.x(), place.y());
      const double distance = (point - ToVec3(surface->Value(u, v).XYZ())).norm();
      deviation = distance <= deviation ? deviation : distance; // NaN stays
    }
  }
  return deviation;
}

/// Three parameters within each span of a NURBS form, in the original's parameters.
std::vector<double> SpanPlaces(const std::vector<double>& knots, double shift)
{
  std::vector<double> places;
  for (size_t i = 1; i < knots.size(); ++i)
  {
    for (double share : { 0.05, 0.5, 0.95 })
    {
      if (knots[i - 1] < knots[i])
      {
        places.push_back(shift + knots[i - 1] + share * (knots[i] - knots[i - 1]));
      }
    }
  }
  return places;
}

/// An approximation of a piece of a surface, if it is close enough.
bool Fit(const Handle(Geom_RectangularTrimmedSurface) & piece, const ParameterRange& range,
  GeomAbs_Shape smooth, int patches, double worst, CADSurface& result)
{
  const GeomConvert_ApproxSurface fit(
    piece, WantedShare / WorstShare * worst, smooth, smooth, 9, 9, patches, 0);
  if (!fit.HasResult() || !(fit.MaxError() <= worst))
  {
    return false;
  }
  NurbsSurface& surface = result.Converted.Surface;
  surface = FromBSplineSurface(fit.Surface());
  // The trimmed surface may have moved a periodic range into its own period.
  double u1, u2, v1, v2;
  piece->Bounds(u1, u2, v1, v2);
  result.ShiftU = range.First.x() - u1;
  result.ShiftV = range.First.y() - v1;
  // MaxError is not always true.
  return Deviation(piece->BasisSurface(), SpanPlaces(surface.KnotsU, result.ShiftU),
           SpanPlaces(surface.KnotsV, result.ShiftV), result) <= worst;
}

CADSurface Approximate(const Handle(Geom_Surface) & surface, const ParameterRange& range)
{
  const Handle(Geom_RectangularTrimmedSurface) piece = new Geom_RectangularTrimmedSurface(
    surface, range.First.x(), range.Last.x(), range.First.y(), range.Last.y());
  const double worst = WorstDeviation(surface, range);
  const GeomAdaptor_Surface adaptor(piece);
  const int spans = adaptor.NbUIntervals(GeomAbs_CN) * adaptor.NbVIntervals(GeomAbs_CN);
  CADSurface result;
  // A smooth fit is the better one to trim with, and takes about a patch for each span of the
  // basis; where it takes many more it takes minutes, and one without continuous derivatives a
  // second. A fit that is smoother than the surface is wrong, whatever its MaxError.
  const bool smooth = surface->Continuity() >= GeomAbs_C1 &&
    Fit(piece, range, GeomAbs_C1, 100 + 2 * spans, worst, result);
  if (!smooth && !Fit(piece, range, GeomAbs_C0, 1000 + 8 * spans, worst, result))
  {
    std::ostringstream text;
    text << "the surface cannot be approximated to " << WorstShare << " of its size";
    throw Standard_ConstructionError(text.str().c_str());
  }
  return result;
}

/// The surfaces of revolution that OpenCASCADE has as such, all by their profile at u = 0.
bool ConvertElementary(
  const Handle(Geom_Surface) & surface, const ParameterRange& range, ConvertedSurface& result)
{
  const auto elementary = Handle(Geom_ElementarySurface)::DownCast(surface);
  if (!elementary)
  {
    return false;
  }
  const Frame frame(elementary->Position());
  const Vec3& origin = frame.Origin;
  const double firstV = range.First.y();
  const double lastV = range.Last.y();
  ConvertedCurve profile;
  if (Handle(Geom_Plane)::DownCast(surface))
  {
    const Vec3 y = frame.Turn.cross(frame.X);
    result = Extrude(MakeLine(origin, frame.X, range.First.x(), range.Last.x()), y, firstV, lastV);
    return true;
  }
  if (auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface))
  {
    profile = MakeLine(origin + cylinder->Radius() * frame.X, frame.Axis, firstV, lastV);
  }
  else if (auto cone = Handle(Geom_ConicalSurface)::DownCast(surface))
  {
    const double angle = cone->SemiAngle();
    profile = MakeLine(origin + cone->RefRadius() * frame.X,
      std::sin(angle) * frame.X + std::cos(angle) * frame.Axis, firstV, lastV);
  }
  else if (auto sphere = Handle(Geom_SphericalSurface)::DownCast(surface))
  {
    profile =
      MakeEllipse(origin, sphere->Radius() * frame.X, sphere->Radius() * frame.Axis, firstV, lastV);
  }
  else if (auto torus = Handle(Geom_ToroidalSurface)::DownCast(surface))
  {
    profile = MakeEllipse(origin + torus->MajorRadius() * frame.X, torus->MinorRadius() * frame.X,
      torus->MinorRadius() * frame.Axis, firstV, lastV);
  }
  else
  {
    return false;
  }
  result = Revolve(profile, origin, frame.Turn, range.First.x(), range.Last.x());
  return true;
}

CADSurface Convert(const Handle(Geom_Surface) & surface, const ParameterRange& range)
{
  CADSurface result;
  if (ConvertElementary(surface, range, result.Converted))
  {
    return result;
  }
  if (auto extrusion = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface))
  {
    result.Converted =
      Extrude(ConvertCurve(extrusion->BasisCurve(), range.First.x(), range.Last.x()),
        ToVec3(extrusion->Direction().XYZ()), range.First.y(), range.Last.y());
    return result;
  }
  if (auto revolution = Handle(Geom_SurfaceOfRevolution)::DownCast(surface))
  {
    result.Converted =
      Revolve(ConvertCurve(revolution->BasisCurve(), range.First.y(), range.Last.y()),
        ToVec3(revolution->Axis().Location().XYZ()), ToVec3(revolution->Axis().Direction().XYZ()),
        range.First.x(), range.Last.x());
    return result;
  }
  if (auto spline = Handle(Geom_BSplineSurface)::DownCast(surface))
  {
    return CutBSpline(spline, range);
  }
  if (Handle(Geom_BezierSurface)::DownCast(surface))
  {
    return CutBSpline(GeomConvert::SurfaceToBSplineSurface(surface), range);
  }
  if (auto offset = Handle(Geom_OffsetSurface)::DownCast(surface))
  {
    const Handle(Geom_Surface) analytic = offset->Surface();
    if (!analytic.IsNull() && !Handle(Geom_OffsetSurface)::DownCast(analytic))
    {
      return Convert(analytic, range);
    }
  }
  return Approximate(surface, range);
}

/// Is the NURBS form the surface itself? Guards the conventions on parameters against surprises
/// (equivalent surfaces of offsets).
bool IsClose(
  const Handle(Geom_Surface) & surface, const ParameterRange& range, const CADSurface& converted)
{
  std::vector<double> us, vs;
  for (double s : { 0.0, 0.17, 0.39, 0.5, 0.83, 1.0 })
  {
    us.push_back(range.First.x() + s * (range.Last.x() - range.First.x()));
  }
  for (double t : { 0.0, 0.21, 0.43, 0.5, 0.77, 1.0 })
  {
    vs.push_back(range.First.y() + t * (range.Last.y() - range.First.y()));
  }
  return Deviation(surface, us, vs, converted) <= WorstDeviation(surface, range);
}
}

//------------------------------------------------------------------------------
CADSurface ConvertSurface(const Handle(Geom_Surface) & surface, ParameterRange range)
{
  Handle(Geom_Surface) basis = surface;
  while (auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(basis))
  {
    basis = trimmed->BasisSurface();
  }
  CADSurface result = Convert(basis, range);
  if (!IsClose(basis, range, result))
  {
    result = Approximate(basis, range);
    if (!IsClose(basis, range, result))
    {
      throw Standard_ConstructionError("no NURBS form comes close enough to the surface");
    }
  }
  return result;
}
}
