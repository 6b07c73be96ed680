/**
 * @file TestSurfaces.cxx
 * @brief The oracles against OpenCASCADE: both must know the same surface, the one by closed
 * form or search, the other from the NURBS data that the filter gets.
 */
#include "Surfaces.h"

#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include <vtkMultiBlockDataSet.h>

#include <cmath>
#include <cstdio>
#include <random>

using namespace judge;

namespace
{
void SetKnots(const std::vector<double>& flat, std::vector<double>& knots, std::vector<int>& times)
{
  for (double k : flat)
  {
    if (!knots.empty() && knots.back() == k)
    {
      ++times.back();
      continue;
    }
    knots.push_back(k);
    times.push_back(1);
  }
}

Handle(Geom_BSplineSurface) ToOpenCascade(const SplineSurface& s)
{
  TColgp_Array2OfPnt poles(1, s.CountU, 1, s.CountV);
  TColStd_Array2OfReal weights(1, s.CountU, 1, s.CountV);
  for (int j = 0; j < s.CountV; ++j)
  {
    for (int i = 0; i < s.CountU; ++i)
    {
      const Eigen::Vector4d& c = s.Control[i + j * s.CountU];
      poles.SetValue(i + 1, j + 1, gp_Pnt(c[0], c[1], c[2]));
      weights.SetValue(i + 1, j + 1, c[3]);
    }
  }
  std::vector<double> u, v;
  std::vector<int> nu, nv;
  SetKnots(s.KnotsU, u, nu);
  SetKnots(s.KnotsV, v, nv);
  TColStd_Array1OfReal ku(u[0], 1, static_cast<int>(u.size()));
  TColStd_Array1OfReal kv(v[0], 1, static_cast<int>(v.size()));
  TColStd_Array1OfInteger mu(nu[0], 1, static_cast<int>(nu.size()));
  TColStd_Array1OfInteger mv(nv[0], 1, static_cast<int>(nv.size()));
  return new Geom_BSplineSurface(poles, weights, ku, kv, mu, mv, s.DegreeU, s.DegreeV);
}

struct Seen
{
  double Distance = 1e300, Side = 0;
};

// The closest point over all faces, and the side of that face.
Seen Ask(const std::vector<Handle(Geom_BSplineSurface)>& faces, const Vec3& p)
{
  Seen best;
  for (const auto& face : faces)
  {
    GeomAPI_ProjectPointOnSurf project(gp_Pnt(p[0], p[1], p[2]), face);
    if (project.NbPoints() == 0 || project.LowerDistance() >= best.Distance)
    {
      continue;
    }
    double u, v;
    project.LowerDistanceParameters(u, v);
    gp_Pnt foot;
    gp_Vec du, dv;
    face->D1(u, v, foot, du, dv);
    best.Distance = project.LowerDistance();
    best.Side = gp_Vec(foot, gp_Pnt(p[0], p[1], p[2])).Dot(du.Crossed(dv));
  }
  return best;
}

int Compare(const std::string& kind, const Frame& frame, const Placement& at)
{
  const Surface surface = MakeSurface(kind, frame, at);
  std::vector<Handle(Geom_BSplineSurface)> faces;
  if (auto* single = vtkPolyData::SafeDownCast(surface.Data))
  {
    faces.push_back(ToOpenCascade(ReadSpline(single)));
  }
  else
  {
    auto* blocks = vtkMultiBlockDataSet::SafeDownCast(surface.Data);
    for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i)
    {
      faces.push_back(ToOpenCascade(ReadSpline(vtkPolyData::SafeDownCast(blocks->GetBlock(i)))));
    }
  }
  std::mt19937 random(at.Seed);
  std::uniform_real_distribution<double> any(-1, 1);
  int wrong = 0, compared = 0, sides = 0;
  for (int i = 0; i < 6000 && compared < 100; ++i)
  {
    const Vec3 p = frame.Centre +
      frame.Axes *
        Vec3(frame.HalfX * any(random), frame.HalfY * any(random), frame.HalfZ * any(random));
    const double signedDistance = surface.Signed(p);
    // Near: farther away the oracle's distance is not exact.
    if (std::abs(signedDistance) > 2 * frame.ElementSize)
    {
      continue;
    }
    ++compared;
    const Seen seen = Ask(faces, p);
    const double limit = 1e-7 * frame.ElementSize + 1e-9 * frame.Centre.norm();
    // The faces of a shell are turned at random.
    const bool side = faces.size() > 1 || std::abs(signedDistance) < limit ||
      (seen.Side > 0) == (signedDistance > 0);
    const bool rough = std::abs(signedDistance) < 1e-3 * frame.HalfX ||
      (surface.Roughly(p) > 0) == (signedDistance > 0);
    sides += signedDistance > 0;
    if (std::abs(seen.Distance - std::abs(signedDistance)) > limit || !side || !rough)
    {
      std::printf("FAIL %s: (%g %g %g) oracle %.12g, OpenCASCADE %.12g side %g, roughly %g\n",
        kind.c_str(), p[0], p[1], p[2], signedDistance, seen.Distance, seen.Side,
        surface.Roughly(p));
      ++wrong;
    }
  }
  if (compared < 50 || sides == 0 || sides == compared)
  {
    std::printf("FAIL %s: %d points near the surface, %d on its positive side\n", kind.c_str(),
      compared, sides);
    ++wrong;
  }
  return wrong;
}
}

int main()
{
  Frame frame;
  frame.Centre = Vec3(10, 8, 0);
  frame.HalfX = 10;
  frame.HalfY = 8;
  frame.HalfZ = 0.4;
  int wrong = 0;
  for (const std::string& kind : AllSurfaceKinds())
  {
    for (int variant = 0; variant < 4; ++variant)
    {
      Placement at;
      at.Seed = variant + 1;
      at.Angle = 0.3 + variant;
      at.Lean = variant * 0.2;
      at.Reversed = variant % 2 == 1;
      wrong += Compare(kind, frame, at);
    }
  }
  std::printf("%d wrong\n", wrong);
  return wrong > 0;
}
