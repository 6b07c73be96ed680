/**
 * @file Cusp.h
 * @brief Places where faces meet or touch each other under no angle, so that their normals cancel
 * and say nothing of the side.
 */
#ifndef Cusp_h
#define Cusp_h

#include "Sectors.h"

#include <vector>

namespace nurbs
{

struct Cusp
{
  /// Of all points to which the place is the closest: 1 beyond the surface, as what it bounds ends
  /// there, -1 before it, as what it bounds goes all round but for a crack. 0: it is no cusp.
  double Side = 0;
  Vec3 Normal = Vec3::Zero(); ///< out of the faces, or into them; zero where they go on both ways
};

/// By which of the faces lies beyond the other where they begin to part.
/// @param sum of the sectors' normals, weighted and oriented.
/// @param gap what is nearer to each other is one (local coordinates, as all).
Cusp ExamineCusp(
  const SurfaceModel& model, const std::vector<Sector>& sectors, const Vec3& sum, double gap);

}

#endif
