/**
 * @file PointInversion.h
 * @brief Newton's method for the closest point on a part of one patch (eqs. 6-11).
 */
#ifndef PointInversion_h
#define PointInversion_h

#include "PatchTree.h"

namespace nurbs
{
struct LocalFoot
{
  double S = 0, T = 0;       ///< parameters of the patch
  Vec3 Point = Vec3::Zero(); ///< about the local origin
  double Squared = 0;        ///< squared distance
};

/**
 * A local minimum of the distance over the rectangle, reached from (s, t) by Newton steps with
 * the active bounds held, halved where the distance would grow. Fulfils the Kuhn-Tucker
 * conditions to rounding; never farther than the start.
 */
LocalFoot InvertPoint(const BezierPatch& patch, const Vec4* net, const Vec3& p, double s, double t,
  const PartDomain& domain);

}

#endif
