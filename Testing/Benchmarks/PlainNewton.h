/**
 * @file PlainNewton.h
 * @brief The projection as the paper has it (eqs. 6-11): Newton from the nearest knot.
 *
 * The yardstick of the benchmarks, so it is written as a careful programmer would from the NURBS
 * Book: no allocation, nothing computed twice, but no hierarchy and no proof either.
 */
#ifndef PlainNewton_h
#define PlainNewton_h

#include "NurbsSurface.h"

namespace benchmark
{
using nurbs::Vec2;
using nurbs::Vec3;
using nurbs::Vec4;

/// Evaluation by the textbook recurrences (NURBS Book, A2.3, A3.6, A4.4), degrees up to 5.
class TextbookSurface
{
public:
  explicit TextbookSurface(const nurbs::NurbsSurface& surface);
  nurbs::SurfaceJet Evaluate(double u, double v) const;

  static constexpr int MaximumDegree = 5;

private:
  nurbs::NurbsSurface Surface;
  std::vector<Vec4> Weighted; ///< w x, w y, w z, w
  bool Rational = false;
};

class PlainNewton
{
public:
  explicit PlainNewton(const nurbs::NurbsSurface& surface);

  /// (u, v) of the knot whose point is nearest to p.
  Vec2 NearestKnot(const Vec3& p) const;

  /// Newton from a guess, held to the domain.
  struct Result
  {
    double U, V;
    Vec3 Point, Normal;
    double Distance;
  };
  Result Project(const Vec3& p, const Vec2& guess) const;

  /// Both.
  Result Project(const Vec3& p) const { return this->Project(p, this->NearestKnot(p)); }

private:
  TextbookSurface Textbook;
  Vec2 Low, High;
  double Scale;
  std::vector<Vec2> Knots;
  std::vector<Vec3> Points; ///< at the knots
};
}

#endif
