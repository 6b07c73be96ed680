/**
 * @file NetBounds.h
 * @brief Bounds of the derivatives of a piece of surface by its control net, and what they prove.
 */
#ifndef NetBounds_h
#define NetBounds_h

#include "NurbsSurface.h"

#include <cmath>

namespace nurbs
{
/**
 * Greatest first and second derivatives over a piece, about a centre: of the homogeneous net
 * A = w (S - centre), with respect to parameters that run over the piece from 0 to 1.
 */
struct NetBounds
{
  Vec3 MeanU = Vec3::Zero(), MeanV = Vec3::Zero();
  double DeviationU = 0, DeviationV = 0; ///< of the first derivative from its mean
  double NormalU = 0, NormalV = 0;       ///< component of the first derivative along the normal
  double WeightU = 0, WeightV = 0;       ///< first derivative of the weight
  double SecondUU = 0, SecondUV = 0, SecondVV = 0;
  double NormalUU = 0, NormalUV = 0, NormalVV = 0; ///< second derivatives along the normal
  double WeightUU = 0, WeightUV = 0, WeightVV = 0;
  double Extent = 0, NormalExtent = 0, MaxWeight = 0;
  double Radius = 0; ///< of the Cartesian points
};

/// Moves a net so that the centre is its origin.
void CenterNet(const Vec3& center, int size, const Vec4* net, Vec4* centered);

/// @param net about the centre; the means are taken from the net.
NetBounds BoundNet(int p, int q, const Vec4* net);

/// The same of a net whose weights are 1, about anywhere, but only Mean and Second.
NetBounds BoundBend(int p, int q, const Vec4* net);

/// std::hypot guards against overflow at ten times the cost.
inline double Hypotenuse(double a, double b)
{
  return std::sqrt(a * a + b * b);
}

/**
 * Steps (s, t) = (Along y1 + Back y2, Across y2) with y of unit length reach every step of unit
 * length on the plane of the mean derivatives (Gram-Schmidt); Back is an absolute value.
 */
struct UnitSteps
{
  double Along = 0, Back = 0, Across = 0;

  /// Bound of a linear map whose columns have the lengths u and v.
  double Linear(double u, double v) const
  {
    return Hypotenuse(this->Along * u, this->Across * v + this->Back * u);
  }
  /// Bound of a quadratic form whose entries are at most uu, uv, vv.
  double Quadratic(double uu, double uv, double vv) const
  {
    const double a = this->Along * this->Along * uu;
    const double b = this->Along * (this->Across * uv + this->Back * uu);
    const double c = this->Across * this->Across * vv + 2 * this->Across * this->Back * uv +
      this->Back * this->Back * uu;
    return 0.5 * (a + c) + Hypotenuse(0.5 * (a - c), b);
  }
};

/// False if the mean derivatives have lost rank.
bool FindUnitSteps(const NetBounds& b, bool curve, UnitSteps& steps);

/**
 * When F(s, t) = |A - w P|^2 - d^2 w^2 is convex over the piece, for every d that occurs on it; A
 * is the homogeneous net about its centre. Then {S : |S - P| <= d} is a convex set of parameters,
 * so a point of the piece that fulfils the Kuhn-Tucker conditions is its closest point. With
 * subscripts for derivatives along a unit step, F_uu / 2 = |A_u|^2 - 2 w_u A_u.P + A.A_uu - w_uu
 * A.P - w A_uu.P + (w_u^2 + w w_uu)(P^2 - d^2) where |P^2 - d^2| <= 2 |P| R + R^2; each term is
 * bounded by the net and is linear in the components of P across (side) and along the normal
 * (height). F is convex where Side side + Height height < 1.
 */
struct ConvexReach
{
  float Side, Height; ///< infinite if nothing is certain
};
ConvexReach MeasureReach(const NetBounds& b, const UnitSteps& steps);

}

#endif
