/**
 * @file BezierRestriction.h
 * @brief A part of a Bezier patch as a patch.
 */
#ifndef BezierRestriction_h
#define BezierRestriction_h

#include "BezierPatch.h"

namespace nurbs
{
/// The net of the part [s0, s1] x [t0, t1] of a patch (de Casteljau).
void RestrictNet(const BezierPatch& patch, const Vec4* net, double s0, double s1, double t0,
  double t1, Vec4* part);

}

#endif
