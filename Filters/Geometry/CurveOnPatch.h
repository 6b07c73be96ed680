/**
 * @file CurveOnPatch.h
 * @brief A straight line in the parameters of a Bezier patch as a curve in space.
 */
#ifndef CurveOnPatch_h
#define CurveOnPatch_h

#include "BezierPatch.h"
#include "PageVector.h"

namespace nurbs
{
/// Appends the curve over the straight line (s0, t0)-(s1, t1) of a patch, exact in degree p + q.
BezierPatch CurveOnPatch(const BezierPatch& patch, const PageVector<Vec4>& pool, const Vec2& from,
  const Vec2& to, PageVector<Vec4>& nets);

}

#endif
