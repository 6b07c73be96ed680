/**
 * @file DirectionBehind.h
 * @brief The direction that leads farthest behind several planes through a point.
 */
#ifndef DirectionBehind_h
#define DirectionBehind_h

#include "Types.h"

#include <vector>

namespace trim
{

struct DirectionBehind
{
  Vec3 Direction = Vec3::Zero(); ///< unit; zero: none leads behind all of them
  double Sine = 0.0;             ///< of the smallest angle between it and a plane
};

/**
 * The unit direction d with the largest least -n . d over all planes: against the point of the
 * normals' convex hull that is nearest to the origin.
 *
 * @param normals of the planes, unit, pointing out of what the direction is to lead into.
 * @param held unit normals of planes in which it has to stay; those that turn by less than `turn`
 * (radians) from each other are one bent skin.
 */
DirectionBehind FindDirectionBehind(
  const std::vector<Vec3>& normals, const std::vector<Vec3>& held, double turn);

}

#endif
