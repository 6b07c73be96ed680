#include "CADCurveConversion.h"

#include <GeomAdaptor_Curve.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_ConstructionError.hxx>

#include <sstream>

namespace nurbs
{
namespace
{
/// Shares of a curve's size: what an approximation aims at, and what is still taken.
constexpr double WantedShare = 1e-8;
constexpr double WorstShare = 1e-6;

/// A conic's position: centre and the vectors that its two functions multiply.
template <typename Conic>
Vec3 Centre(const Conic& conic)
{
  return ToVec3(conic->Position().Location().XYZ());
}
template <typename Conic>
Vec3 AlongX(const Conic& conic, double length)
{
  return length * ToVec3(conic->Position().XDirection().XYZ());
}
template <typename Conic>
Vec3 AlongY(const Conic& conic, double length)
{
  return length * ToVec3(conic->Position().YDirection().XYZ());
}

ConvertedCurve FromBSpline(Handle(Geom_BSplineCurve) spline, double first, double last)
{
  spline = Handle(Geom_BSplineCurve)::DownCast(spline->Copy());
  spline->SetNotPeriodic();
  // The cutting is left to Restrict, on a surface that is this curve swept.
  ConvertedCurve curve;
  curve.Degree = spline->Degree();
  for (int i = 1; i <= spline->NbPoles(); ++i)
  {
    const Vec3 pole = ToVec3(spline->Pole(i).XYZ());
    curve.Points.emplace_back(
      pole.x(), pole.y(), pole.z(), spline->IsRational() ? spline->Weight(i) : 1.0);
  }
  const TColStd_Array1OfReal& knots = spline->KnotSequence();
  curve.Knots.assign(knots.begin(), knots.end());
  const ConvertedSurface swept = Extrude(curve, Vec3::UnitZ(), 0.0, 1.0);
  const NurbsSurface cut = Restrict(swept.Surface, first, last, 0.0, 1.0);
  curve.Knots = cut.KnotsU;
  curve.Points.assign(cut.ControlPoints.begin(), cut.ControlPoints.begin() + cut.CountU);
  return curve;
}

/// Length of a curve's control polygon over a range, to scale tolerances.
double SizeOf(const Handle(Geom_Curve) & curve, double first, double last)
{
  double size = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    const double step = (last - first) / 8.0;
    size += curve->Value(first + i * step).Distance(curve->Value(first + (i + 1) * step));
  }
  return size;
}

/// An offset curve as closely as wanted. OpenCASCADE gives what it has when the segments are used
/// up, however far off that is.
Handle(Geom_BSplineCurve) Approximate(const Handle(Geom_TrimmedCurve) & curve)
{
  const double size = SizeOf(curve, curve->FirstParameter(), curve->LastParameter());
  // Each span of the basis takes a segment at least.
  const int segments = 200 + 16 * GeomAdaptor_Curve(curve).NbIntervals(GeomAbs_CN);
  // A fit that is smoother than the curve takes many times the segments.
  const GeomAbs_Shape smooth = curve->Continuity() < GeomAbs_C1 ? GeomAbs_C0 : GeomAbs_C1;
  const GeomConvert_ApproxCurve fit(curve, WantedShare * size, smooth, segments, 9);
  if (!fit.HasResult() || !(fit.MaxError() <= WorstShare * size))
  {
    std::ostringstream text;
    text << "the offset curve cannot be approximated to " << WorstShare << " of its size";
    throw Standard_ConstructionError(text.str().c_str());
  }
  return fit.Curve();
}
}

//------------------------------------------------------------------------------
ConvertedCurve ConvertCurve(Handle(Geom_Curve) curve, double first, double last)
{
  while (auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
  {
    curve = trimmed->BasisCurve();
  }
  if (auto line = Handle(Geom_Line)::DownCast(curve))
  {
    return MakeLine(ToVec3(line->Position().Location().XYZ()),
      ToVec3(line->Position().Direction().XYZ()), first, last);
  }
  if (auto circle = Handle(Geom_Circle)::DownCast(curve))
  {
    return MakeEllipse(Centre(circle), AlongX(circle, circle->Radius()),
      AlongY(circle, circle->Radius()), first, last);
  }
  if (auto ellipse = Handle(Geom_Ellipse)::DownCast(curve))
  {
    return MakeEllipse(Centre(ellipse), AlongX(ellipse, ellipse->MajorRadius()),
      AlongY(ellipse, ellipse->MinorRadius()), first, last);
  }
  if (auto hyperbola = Handle(Geom_Hyperbola)::DownCast(curve))
  {
    return MakeHyperbola(Centre(hyperbola), AlongX(hyperbola, hyperbola->MajorRadius()),
      AlongY(hyperbola, hyperbola->MinorRadius()), first, last);
  }
  if (auto parabola = Handle(Geom_Parabola)::DownCast(curve))
  {
    return MakeParabola(Centre(parabola), AlongX(parabola, 0.25 / parabola->Focal()),
      AlongY(parabola, 1.0), first, last);
  }
  if (auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
  {
    return FromBSpline(GeomConvert::CurveToBSplineCurve(bezier), first, last);
  }
  auto spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  if (spline && first >= spline->FirstParameter() - 1e-9 * (last - first) &&
    last <= spline->LastParameter() + 1e-9 * (last - first))
  {
    return FromBSpline(spline, first, last);
  }
  // Offset curves, and periodic splines across their seam.
  const Handle(Geom_TrimmedCurve) piece = new Geom_TrimmedCurve(curve, first, last);
  if (spline)
  {
    const Handle(Geom_BSplineCurve) cut = GeomConvert::CurveToBSplineCurve(piece);
    TColStd_Array1OfReal knots(1, cut->NbKnots());
    cut->Knots(knots);
    const double shift = first - knots.First();
    for (double& knot : knots)
    {
      knot += shift;
    }
    cut->SetKnots(knots);
    return FromBSpline(cut, first, last);
  }
  return FromBSpline(Approximate(piece), first, last);
}
}
