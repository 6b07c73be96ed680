/**
 * @file CADSurfaceConversion.h
 * @brief OpenCASCADE's surfaces in NURBS form, over a given range of their parameters.
 */
#ifndef CADSurfaceConversion_h
#define CADSurfaceConversion_h

#include "SurfaceConstruction.h"

#include <Standard_Handle.hxx>

class Geom_Surface;

namespace nurbs
{
/// Range of parameters of a surface.
struct ParameterRange
{
  Vec2 First, Last;
};

/**
 * The NURBS form of a surface and how its parameters map: (u, v) of the original is at
 * (MapU(u - ShiftU), MapV(v - ShiftV)). A shift is a whole number of periods.
 */
struct CADSurface
{
  ConvertedSurface Converted;
  double ShiftU = 0.0;
  double ShiftV = 0.0;

  Vec2 operator()(const Vec2& uv) const
  {
    return Vec2(
      this->Converted.MapU(uv.x() - this->ShiftU), this->Converted.MapV(uv.y() - this->ShiftV));
  }
};

/**
 * Planes, cylinders, cones, spheres, tori, extrusions and revolutions of lines, conics, Bezier
 * and B-spline curves, and Bezier and B-spline surfaces are converted exactly; anything else
 * (offset surfaces mostly) is approximated to 1e-7 of its size, at worst to 1e-6: what is farther
 * off is an exception, like OpenCASCADE's own, which pass through.
 */
CADSurface ConvertSurface(const opencascade::handle<Geom_Surface>& surface, ParameterRange range);
}

#endif
