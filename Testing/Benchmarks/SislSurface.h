/**
 * @file SislSurface.h
 * @brief A surface of the benchmarks in SISL's representation.
 */
#ifndef SislSurface_h
#define SislSurface_h

#include "NurbsSurface.h"

#include <memory>
#include <sisl.h>

namespace benchmark
{
struct FreeSislSurface
{
  void operator()(SISLSurf* surface) const { freeSurf(surface); }
};
using SislSurface = std::unique_ptr<SISLSurf, FreeSislSurface>;

inline SislSurface MakeSislSurface(const nurbs::NurbsSurface& surface)
{
  constexpr int Polynomial = 1, Rational = 2, Copy = 1;
  bool rational = false;
  for (const nurbs::Vec4& point : surface.ControlPoints)
  {
    rational = rational || point.w() != 1.0;
  }
  std::vector<double> knotsU = surface.KnotsU, knotsV = surface.KnotsV, points;
  for (const nurbs::Vec4& point : surface.ControlPoints)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      points.push_back(point.w() * point[axis]);
    }
    if (rational)
    {
      points.push_back(point.w());
    }
  }
  return SislSurface(
    newSurf(surface.CountU, surface.CountV, surface.DegreeU + 1, surface.DegreeV + 1, knotsU.data(),
      knotsV.data(), points.data(), rational ? Rational : Polynomial, 3, Copy));
}
}

#endif
