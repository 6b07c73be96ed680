/**
 * @file Neighbourhood.h
 * @brief What meets at a point of the surface: normals, angles, free borders.
 *
 * Only feet on borders, creases and poles come here; everywhere else one normal is enough.
 */
#ifndef Neighbourhood_h
#define Neighbourhood_h

#include "SurfaceModel.h"

namespace nurbs
{

struct Neighbourhood
{
  Vec3 Normal = Vec3::Zero(); ///< angle-weighted, oriented, unit; zero if undefined
  bool Border = false;        ///< a free border runs through the point
  double Gap = 0;             ///< how far apart the pieces are that meet there
  /// At a cusp, where faces meet under no angle, all points to which it is the closest are on the
  /// same side: 1 beyond the surface, -1 before it. 0: it is none.
  double CuspSide = 0;
};

/// Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal".
/// A border is free only where nothing closes it within the widest gap.
Neighbourhood ExamineNeighbourhood(const SurfaceModel& model, const Vec3& x);

}

#endif
