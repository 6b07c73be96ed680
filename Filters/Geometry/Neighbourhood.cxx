#include "Neighbourhood.h"

#include "Cusp.h"
#include "ModelEvaluation.h"
#include "Sectors.h"

#include <algorithm>
#include <vector>

namespace nurbs
{

namespace
{

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
  const Vec2 size = data.High() - data.Low();
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

/// How far apart the pieces are. Those farther on along the same border, where a knot or a corner
/// is near, are not: the way to them leads along it.
double MeasureGap(const std::vector<Sector>& sectors, const Vec3& x)
{
  const auto own = std::min_element(sectors.begin(), sectors.end(),
    [](const Sector& a, const Sector& b) { return a.Away < b.Away; });
  if (own == sectors.end() || own->RayCount == 0)
  {
    return 0.0;
  }
  // One ray: at a knot of the border, beyond which the next patch has the other.
  const bool isEdge = own->Straight || own->RayCount == 1;
  const Vec3 along = isEdge ? own->Rays[0].Direction : Vec3(Vec3::Zero());
  double gap = 0.0;
  for (const Sector& sector : sectors)
  {
    const Vec3 way = sector.Nearest - x;
    gap = std::max(gap, (way - along.dot(way) * along).norm());
  }
  return gap;
}

/// What meets where borders that lie within `gap` of each other are one edge.
Neighbourhood ExamineWithin(const SurfaceModel& model, const Vec3& x, double gap)
{
  Neighbourhood result;
  const std::vector<Sector> sectors = FindSectors(model, x, gap);
  result.Gap = MeasureGap(sectors, x);
  for (const Sector& sector : sectors)
  {
    result.Normal += model.Data[sector.Face].Sign * sector.Weighted;
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
  if (const Cusp cusp = ExamineCusp(model, sectors, result.Normal, gap); cusp.Side != 0)
  {
    result.CuspSide = cusp.Side;
    result.Normal = cusp.Normal;
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
