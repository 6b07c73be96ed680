/**
 * @file Sectors.h
 * @brief The pieces of surface that meet at a point of it, and the borders between which each lies.
 */
#ifndef Sectors_h
#define Sectors_h

#include "SurfaceModel.h"

#include <vector>

namespace nurbs
{

/// A border line of a face that leaves a point, straight in (u, v).
struct BorderRay
{
  Vec2 From = Vec2::Zero(), To = Vec2::Zero(); ///< in (u, v) of the face
  Vec3 Direction = Vec3::Zero();               ///< unit tangent on the surface
  bool InsideIsLeft = false;                   ///< of the face, seen against S_u x S_v
};

/// One piece of surface at the point: an angle and a normal, bounded by borders or not.
struct Sector
{
  int Face = -1;
  Vec2 Parameters = Vec2::Zero();
  Vec3 Nearest = Vec3::Zero();  ///< of the piece to the point
  double Away = 0;              ///< of the piece from the point, up to the gap tolerance
  Vec3 Weighted = Vec3::Zero(); ///< integral of the unit normal over the angle (no face sign)
  int RayCount = 0;             ///< 0 in the interior, else 2; 1 where the loops end the other
  bool Straight = false;        ///< the two rays are opposite: the middle of an edge
  int Patch = -1, Pole = -1;    ///< at a pole: whose side of which patch is collapsed; else -1
  BorderRay Rays[2];
};

/// The direction across a border ray into its face.
inline Vec3 InsideOf(const Sector& sector, const BorderRay& ray)
{
  return (ray.InsideIsLeft ? 1.0 : -1.0) * sector.Weighted.cross(ray.Direction).normalized();
}

/// Everything that comes within `gap` of x (local coordinates).
std::vector<Sector> FindSectors(const SurfaceModel& model, const Vec3& x, double gap);

/// A border ray of another sector that runs along the given one; null if there is none.
const BorderRay* FindPartner(
  const std::vector<Sector>& sectors, const Sector& sector, const BorderRay& ray);

}

#endif
