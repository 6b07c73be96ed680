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
/**
 * The curve over a straight line in the parameters (s, t) of a patch, exact in degree p + q.
 *
 * @param[in,out] nets has the net of the patch; that of the curve is appended.
 */
BezierPatch CurveOnPatch(
  const BezierPatch& patch, const Vec2& from, const Vec2& to, UnsetVector<Vec4>& nets);

}

#endif
