/**
 * @file BezierEvaluation.h
 * @brief Points and derivatives of a Bezier patch: what all queries spend their time on.
 */
#ifndef BezierEvaluation_h
#define BezierEvaluation_h

#include "BezierPatch.h"

namespace nurbs
{
/// S and its derivatives with respect to s and t, about the local origin.
void EvaluateBezier(const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet);

/// S alone.
Vec3 BezierPoint(const BezierPatch& patch, const Vec4* net, double s, double t);

/// The weight there, the denominator of S.
double BezierWeight(const BezierPatch& patch, const Vec4* net, double s, double t);

/// S half-way along a side of the patch, in the order of BezierPatch::Sides.
Vec3 MiddleOfSide(const BezierPatch& patch, const Vec4* net, int side);

}

#endif
