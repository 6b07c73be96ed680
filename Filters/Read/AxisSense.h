/**
 * @file AxisSense.h
 * @brief Which of its two senses the direction of an axis has.
 */
#ifndef AxisSense_h
#define AxisSense_h

#include "NurbsSurface.h"

namespace nurbs
{

/// A unit vector along an axis, of which the largest coordinate is positive; rounding does not tilt
/// one that is along a coordinate axis.
inline Vec3 PositiveSense(const Vec3& axis)
{
  const Vec3 clean = (axis.array().abs() < 1e-12).select(0.0, axis).normalized();
  Eigen::Index largest = 0;
  clean.cwiseAbs().maxCoeff(&largest);
  return clean[largest] < 0.0 ? Vec3(-clean) : clean;
}

}

#endif
