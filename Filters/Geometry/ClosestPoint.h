/**
 * @file ClosestPoint.h
 * @brief Global closest point over all patches: branch and bound on the tree of boxes.
 */
#ifndef ClosestPoint_h
#define ClosestPoint_h

#include "SurfaceModel.h"

namespace nurbs
{
/// A point of the model: patch and patch parameters. Patch < 0: none.
struct SurfacePoint
{
  int Patch = -1;
  double S = 0, T = 0;
  Vec3 Point = Vec3::Zero();  ///< about the local origin
  double Squared = 0;         ///< squared distance to the point asked for
  Vec3 Normal = Vec3::Zero(); ///< along S_u x S_v, if it is known; else zero
};

/**
 * The closest point of the trimmed surface to p (local coordinates) among those within the
 * squared distance; guess, if it has a patch, only makes the search shorter.
 */
SurfacePoint FindClosestPoint(
  const SurfaceModel& model, const Vec3& p, double maximumSquared, const SurfacePoint& guess);

/// True if the point is not cut away by the trim loops of its face.
bool IsInsideTrim(const SurfaceModel& model, int patch, double s, double t);

}

#endif
