/**
 * @file PartAlong.h
 * @brief The control net of a part of a patch, seen along a line: whether the line can meet it, and
 * whether Newton's method is sure to find where.
 */
#ifndef PartAlong_h
#define PartAlong_h

#include "NurbsSurface.h"

#include <cmath>

namespace nurbs
{

/// The net of a part of a patch, and where it lies about the line.
struct PartAlong
{
  int P, Q;
  Vec4 Net[(MaximumDegree + 1) * (MaximumDegree + 1)];
  /// Distances from two planes through the line; homogeneous, and bounds of the affine ones.
  Vec2 Across[(MaximumDegree + 1) * (MaximumDegree + 1)];
  Vec2 Low = Vec2::Constant(HUGE_VAL), High = -Low;
  double First = HUGE_VAL, Last = -HUGE_VAL; ///< along the line

  /// Of the distances from the planes: between the first and the last row and column.
  Eigen::Matrix2d MeanGradients() const;

  /// Whether the line passes the part, seen along the inverse of the mean gradients.
  bool IsPassed(const Eigen::Matrix2d& inverse, double tolerance) const;

  /// How far the gradients are from their means, seen along the inverse of these.
  double MeasureDeviation(const Eigen::Matrix2d& inverse) const;
};

}

#endif
