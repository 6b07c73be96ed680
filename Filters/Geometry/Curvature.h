/**
 * @file Curvature.h
 * @brief Radii of curvature of the trimming surface at a foot; for warnings.
 */
#ifndef Curvature_h
#define Curvature_h

#include "TrimmingSurface.h"

namespace nurbs
{

/**
 * Smallest radius of curvature at a foot, from both fundamental forms; infinity where the surface
 * is flat or has no tangent plane.
 *
 * @param map the radius is that of the surface as this linear map shows it, as the one from space
 * to elements.
 */
double RadiusOfCurvature(const TrimmingSurface& surface, const Foot& foot,
  const Eigen::Matrix3d& map = Eigen::Matrix3d::Identity());

/**
 * Radius of normal curvature at a foot along a direction, of which only the part in the tangent
 * plane counts; infinity where the surface is flat, or where there is no such part.
 */
double RadiusOfCurvatureAlong(
  const TrimmingSurface& surface, const Foot& foot, const Vec3& direction);

}

#endif
