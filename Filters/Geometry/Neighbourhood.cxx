#include "Neighbourhood.h"

#include "ModelEvaluation.h"
#include "Sectors.h"

#include <algorithm>
#include <vector>

namespace nurbs
{

namespace
{

/// Where faces meet under less than twice that in radians their normals cancel but for the
/// precision of a file.
constexpr double CuspShare = 0.02;

/// True if nothing else has a border along the ray a little way from the point.
bool IsFree(
  const SurfaceModel& model, const Sector& sector, const BorderRay& ray, const Vec3& x, double gap)
{
  double part = 1e-3;
  Vec2 uv = ray.From + part * (ray.To - ray.From);
  Vec3 y = FacePoint(model, sector.Face, uv);
  while (part < 0.5 && (y - x).norm() < 20 * gap)
  {
    part = std::min(0.5, 4 * part);
    uv = ray.From + part * (ray.To - ray.From);
    y = FacePoint(model, sector.Face, uv);
  }
  const std::vector<Sector> sectors = FindSectors(model, y, gap);
  const FaceData& data = model.Data[sector.Face];
  const Vec2 size(data.SpansU.Breaks.back() - data.SpansU.Breaks.front(),
    data.SpansV.Breaks.back() - data.SpansV.Breaks.front());
  for (const Sector& self : sectors)
  {
    if (self.Face == sector.Face &&
      (self.Parameters - uv).cwiseQuotient(size).cwiseAbs().maxCoeff() < 0.1)
    {
      for (int k = 0; k < self.RayCount; ++k)
      {
        if (FindPartner(sectors, self, self.Rays[k]))
        {
          return false;
        }
      }
    }
  }
  return true;
}

/// Into a piece of surface from the point, along the surface; of the rays that bound it.
Vec3 WayInto(const Sector& sector)
{
  const Vec3 normal = sector.Weighted.normalized();
  Vec3 way = Vec3::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    way += (sector.Rays[k].InsideIsLeft ? 1.0 : -1.0) * normal.cross(sector.Rays[k].Direction);
  }
  return way;
}

/// The same in (u, v) of its face.
Vec2 WayIntoParameters(const Sector& sector)
{
  Vec2 way = Vec2::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    const Vec2 ray = (sector.Rays[k].To - sector.Rays[k].From).normalized();
    way += (sector.Rays[k].InsideIsLeft ? 1.0 : -1.0) * Vec2(-ray.y(), ray.x());
  }
  return way;
}

/// The point of a face that is closest to y within a radius; false if there is none.
bool FindFootOnFace(const SurfaceModel& model, int face, const Vec3& y, double radius, Vec3& foot)
{
  double squared = radius * radius;
  bool found = false;
  for (const Sector& sector : FindSectors(model, y, radius))
  {
    if (sector.Face == face && (sector.Nearest - y).squaredNorm() <= squared)
    {
      squared = (sector.Nearest - y).squaredNorm();
      foot = sector.Nearest;
      found = true;
    }
  }
  return found;
}

/// How far the second face is beyond the first one where they begin to part; 0: they do not.
double HeightBeyond(const SurfaceModel& model, const Sector& one, const Sector& other, double gap)
{
  const Vec3 normal = model.Data[one.Face].Sign * one.Weighted.normalized();
  const FaceData& data = model.Data[one.Face];
  const Vec2 size(data.SpansU.Breaks.back() - data.SpansU.Breaks.front(),
    data.SpansV.Breaks.back() - data.SpansV.Breaks.front());
  const Vec2 way = WayIntoParameters(one).cwiseProduct(size);
  for (double part = 1e-3; part < 0.3; part *= 3)
  {
    const Vec3 y = FacePoint(model, one.Face, one.Parameters + part * way);
    Vec3 foot;
    if (!FindFootOnFace(model, other.Face, y, (y - one.Nearest).norm(), foot))
    {
      return 0.0;
    }
    if ((foot - y).norm() > 10 * gap)
    {
      return normal.dot(foot - y);
    }
  }
  return 0.0;
}

/// Where faces meet under hardly an angle, so that their normals say nothing: what they bound ends
/// there, or goes all round but for a crack.
void ExamineCusp(
  const SurfaceModel& model, const std::vector<Sector>& sectors, double gap, Neighbourhood& result)
{
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
        result.CuspSide = height < 0.0 ? 1.0 : -1.0;
        result.Normal = -result.CuspSide * into;
        return;
      }
    }
  }
}

/// What meets where borders that lie within `gap` of each other are one edge.
Neighbourhood ExamineWithin(const SurfaceModel& model, const Vec3& x, double gap)
{
  Neighbourhood result;
  const std::vector<Sector> sectors = FindSectors(model, x, gap);
  for (const Sector& sector : sectors)
  {
    result.Normal += model.Data[sector.Face].Sign * sector.Weighted;
    result.Gap = std::max(result.Gap, sector.Away);
    if (sector.Straight && sector.RayCount == 2)
    {
      const bool matched = FindPartner(sectors, sector, sector.Rays[0]) ||
        FindPartner(sectors, sector, sector.Rays[1]);
      result.Border = result.Border || !matched;
      continue;
    }
    for (int k = 0; k < sector.RayCount && !result.Border; ++k)
    {
      result.Border = !FindPartner(sectors, sector, sector.Rays[k]) &&
        IsFree(model, sector, sector.Rays[k], x, gap);
    }
  }
  double sum = 0;
  for (const Sector& sector : sectors)
  {
    sum += sector.Weighted.norm();
  }
  if (result.Normal.norm() < CuspShare * sum)
  {
    ExamineCusp(model, sectors, gap, result);
  }
  const double length = result.Normal.norm();
  if (length > 0)
  {
    result.Normal /= length;
  }
  return result;
}

}

Neighbourhood ExamineNeighbourhood(const SurfaceModel& model, const Vec3& x)
{
  // The narrowest gap that closes the border: a wide one covers small features elsewhere.
  Neighbourhood result = ExamineWithin(model, x, model.Gap);
  for (double gap = model.NextGap(model.Gap); result.Border && gap > 0; gap = model.NextGap(gap))
  {
    const Neighbourhood wider = ExamineWithin(model, x, gap);
    result = wider.Border ? result : wider;
  }
  return result;
}

}
