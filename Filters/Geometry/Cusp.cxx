#include "Cusp.h"

#include "ModelEvaluation.h"

#include <algorithm>

namespace nurbs
{
namespace
{

/// Where faces meet under less than twice that in radians their normals cancel but for the
/// precision of a file.
constexpr double NormalsLeft = 0.02;

/// Faces whose angles are less than that, in all, end in a tip: no more is known of these angles.
constexpr double TipAngles = 0.05;

bool NormalsSayNothing(const std::vector<Sector>& sectors, const Vec3& sum)
{
  double lengths = 0;
  for (const Sector& sector : sectors)
  {
    lengths += sector.Weighted.norm();
  }
  return sum.norm() < NormalsLeft * lengths || lengths < TipAngles;
}

/// Into a piece of surface from the point, along the surface; of the rays that bound it.
Vec3 WayInto(const Sector& sector)
{
  Vec3 way = Vec3::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    way += InsideOf(sector, sector.Rays[k]);
  }
  return way.normalized();
}

/// Ways from the point in (u, v) of the face, in at least one of which it parts from what touches
/// it: between borders the one between them, else across each other.
std::vector<Vec2> WaysInParameters(const Sector& sector, const Vec2& size)
{
  if (sector.RayCount == 0)
  {
    return { Vec2(size.x(), 0), Vec2(0, size.y()) };
  }
  Vec2 way = Vec2::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    const Vec2 ray = (sector.Rays[k].To - sector.Rays[k].From).normalized();
    way += (sector.Rays[k].InsideIsLeft ? 1.0 : -1.0) * Vec2(-ray.y(), ray.x());
  }
  return { way.normalized().cwiseProduct(size) };
}

/// The point of a face that is closest to y within a radius, whatever its loops leave of it there;
/// false if there is none.
bool FindFootOnFace(const SurfaceModel& model, int face, const Vec3& y, double radius, Vec3& foot)
{
  double squared = radius * radius;
  bool found = false;
  model.ForLeavesNear(y, radius,
    [&](int index)
    {
      const BezierPatch& patch = model.Patches[model.Leaves[index].Patch];
      if (patch.Face != face || patch.Curve)
      {
        return;
      }
      const LocalFoot own = FootOnLeaf(model, index, y);
      if (own.Squared <= squared)
      {
        squared = own.Squared;
        foot = own.Point;
        found = true;
      }
    });
  return found;
}

/// How far the second face is beyond the first one where they begin to part; 0: they do not.
double HeightBeyond(const SurfaceModel& model, const Sector& one, const Sector& other, double gap)
{
  const Vec3 normal = model.Data[one.Face].Sign * one.Weighted.normalized();
  const FaceData& data = model.Data[one.Face];
  const Vec2 first(data.SpansU.Breaks.front(), data.SpansV.Breaks.front());
  const Vec2 last(data.SpansU.Breaks.back(), data.SpansV.Breaks.back());
  for (const Vec2& way : WaysInParameters(one, last - first))
  {
    Vec3 foot;
    for (double part = 1e-3; part < 0.3; part *= 3)
    {
      const Vec2 uv = (one.Parameters + part * way).cwiseMax(first).cwiseMin(last);
      const Vec3 y = FacePoint(model, one.Face, uv);
      // They part slowly.
      const double radius = 100 * gap + 0.05 * (y - one.Nearest).norm();
      if (!FindFootOnFace(model, other.Face, y, radius, foot))
      {
        break;
      }
      if ((foot - y).norm() > gap)
      {
        return normal.dot(foot - y);
      }
    }
  }
  return 0.0;
}

}

Cusp ExamineCusp(
  const SurfaceModel& model, const std::vector<Sector>& sectors, const Vec3& sum, double gap)
{
  Cusp cusp;
  if (!NormalsSayNothing(sectors, sum))
  {
    return cusp;
  }
  Vec3 into = Vec3::Zero();
  for (const Sector& sector : sectors)
  {
    into += WayInto(sector);
  }
  for (const Sector& one : sectors)
  {
    for (const Sector& other : sectors)
    {
      const double cosine = one.Weighted.normalized().dot(other.Weighted.normalized()) *
        model.Data[one.Face].Sign * model.Data[other.Face].Sign;
      const double height =
        one.Face != other.Face && cosine < -0.5 ? HeightBeyond(model, one, other, gap) : 0.0;
      if (height != 0.0)
      {
        cusp.Side = height < 0.0 ? 1.0 : -1.0;
        cusp.Normal = -cusp.Side * into;
        return cusp;
      }
    }
  }
  return cusp;
}

}
