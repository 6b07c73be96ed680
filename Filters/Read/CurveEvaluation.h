/**
 * @file CurveEvaluation.h
 * @brief Points of a NURBS curve, the curve run backwards, and points along it.
 */
#ifndef CurveEvaluation_h
#define CurveEvaluation_h

#include "SurfaceConstruction.h"

namespace nurbs
{
/// C(u) and, if `derivative` is given, C'(u); u within the domain. (The NURBS Book, 4.1, by de
/// Boor's algorithm)
Vec3 EvaluateCurve(const ConvertedCurve& curve, double u, Vec3* derivative = nullptr);

/// The same curve over the same domain from its end to its beginning. The map is dropped.
ConvertedCurve ReverseCurve(const ConvertedCurve& curve);

/// A point of a curve and its parameter.
struct CurveSample
{
  double U;
  Vec3 Point;
};

/// Points along the curve, both ends among them: at every knot, and between two knots evenly where
/// the curve is not straight, close enough for the sense in which it turns.
std::vector<CurveSample> SampleCurve(const ConvertedCurve& curve);
}

#endif
