/**
 * @file CADCurveConversion.h
 * @brief OpenCASCADE's curves in NURBS form, over a given range of their parameters.
 */
#ifndef CADCurveConversion_h
#define CADCurveConversion_h

#include "SurfaceConstruction.h"

#include <Standard_Handle.hxx>
#include <gp_XYZ.hxx>

class Geom_Curve;

namespace nurbs
{
inline Vec3 ToVec3(const gp_XYZ& p)
{
  return Vec3(p.X(), p.Y(), p.Z());
}

/**
 * The curve over its own parameters. Lines, conics, Bezier and B-spline curves are converted
 * exactly; anything else (offset curves) is approximated to 1e-8 of its size, at worst to 1e-6:
 * what is farther off is an exception, like OpenCASCADE's own, which pass through.
 */
ConvertedCurve ConvertCurve(opencascade::handle<Geom_Curve> curve, double first, double last);
}

#endif
