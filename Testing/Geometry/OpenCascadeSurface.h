/**
 * @file OpenCascadeSurface.h
 * @brief A surface of the tests in OpenCASCADE's representation, the independent kernel.
 */
#ifndef OpenCascadeSurface_h
#define OpenCascadeSurface_h

#include "NurbsSurface.h"

#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace occ
{
/// Distinct knots and their multiplicities.
inline void SplitKnots(
  const std::vector<double>& knots, std::vector<double>& values, std::vector<int>& multiplicities)
{
  for (double knot : knots)
  {
    if (values.empty() || knot != values.back())
    {
      values.push_back(knot);
      multiplicities.push_back(0);
    }
    ++multiplicities.back();
  }
}

inline Handle(Geom_BSplineSurface) Convert(const nurbs::NurbsSurface& surface)
{
  std::vector<double> u, v;
  std::vector<int> multiplicityU, multiplicityV;
  SplitKnots(surface.KnotsU, u, multiplicityU);
  SplitKnots(surface.KnotsV, v, multiplicityV);
  TColStd_Array1OfReal knotsU(1, u.size()), knotsV(1, v.size());
  TColStd_Array1OfInteger countsU(1, u.size()), countsV(1, v.size());
  for (std::size_t i = 0; i < u.size(); ++i)
  {
    knotsU(i + 1) = u[i];
    countsU(i + 1) = multiplicityU[i];
  }
  for (std::size_t i = 0; i < v.size(); ++i)
  {
    knotsV(i + 1) = v[i];
    countsV(i + 1) = multiplicityV[i];
  }
  TColgp_Array2OfPnt points(1, surface.CountU, 1, surface.CountV);
  TColStd_Array2OfReal weights(1, surface.CountU, 1, surface.CountV);
  for (int j = 0; j < surface.CountV; ++j)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      const nurbs::Vec4& x = surface.ControlPoints[i + j * surface.CountU];
      points(i + 1, j + 1) = gp_Pnt(x.x(), x.y(), x.z());
      weights(i + 1, j + 1) = x.w();
    }
  }
  return new Geom_BSplineSurface(
    points, weights, knotsU, knotsV, countsU, countsV, surface.DegreeU, surface.DegreeV);
}
}

#endif
