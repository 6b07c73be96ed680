/**
 * @file SurfaceConstruction.h
 * @brief Exact NURBS forms of the curves and surfaces of CAD files, without any CAD library.
 *
 * Conics are rational quadratics, split so that no piece exceeds a quarter turn (The NURBS Book,
 * 7.3 to 7.5); surfaces of revolution are built from them (algorithm A8.1). A conic's NURBS
 * parameter is not its angle: each curve carries the map from one to the other, because trim
 * loops are given in the original parameters.
 */
#ifndef SurfaceConstruction_h
#define SurfaceConstruction_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{
/// The parameter of a NURBS form that belongs to a parameter of the original curve.
class ParameterMap
{
public:
  enum class Law
  {
    Identity,
    Circular,  ///< rational quadratic pieces, original parameter an angle
    Hyperbolic ///< the same with hyperbolic functions
  };

  ParameterMap() = default;
  /// `ends`: where pieces begin and end, the same value in both parameters.
  ParameterMap(Law law, std::vector<double> ends)
    : Kind(law)
    , Ends(std::move(ends))
  {
  }

  double operator()(double t) const;

private:
  Law Kind = Law::Identity;
  std::vector<double> Ends;
};

/// A NURBS curve over the same range of parameters as its original.
struct ConvertedCurve
{
  int Degree = 1;
  std::vector<double> Knots;
  std::vector<Vec4> Points; ///< x y z w, Cartesian
  ParameterMap Map;
};

/// origin + t direction, first <= t <= last
ConvertedCurve MakeLine(const Vec3& origin, const Vec3& direction, double first, double last);

/// centre + a cos(t) + b sin(t): circles and ellipses, whole turns too
ConvertedCurve MakeEllipse(
  const Vec3& centre, const Vec3& a, const Vec3& b, double first, double last);

/// centre + a cosh(t) + b sinh(t)
ConvertedCurve MakeHyperbola(
  const Vec3& centre, const Vec3& a, const Vec3& b, double first, double last);

/// vertex + a t^2 + b t
ConvertedCurve MakeParabola(
  const Vec3& vertex, const Vec3& a, const Vec3& b, double first, double last);

/// The same curve over the same parameters in a higher degree: its knots become Bezier knots. (The
/// NURBS Book, 5.5) The map is kept.
ConvertedCurve ElevateDegree(const ConvertedCurve& curve, int degree);

/// The same with Bezier knots, each inner one as often as the degree, in any case; `degree` is the
/// curve's own or a higher one.
ConvertedCurve WithBezierKnots(const ConvertedCurve& curve, int degree);

/// A surface and the maps of its original's parameters.
struct ConvertedSurface
{
  NurbsSurface Surface;
  ParameterMap MapU, MapV;
};

/// curve(u) + v direction, firstV <= v <= lastV
ConvertedSurface Extrude(
  const ConvertedCurve& curve, const Vec3& direction, double firstV, double lastV);

/**
 * curve(v) turned by the angle u about the axis, firstU <= u <= lastU, right-handed about
 * `axis`, which is a unit vector.
 */
ConvertedSurface Revolve(
  const ConvertedCurve& curve, const Vec3& origin, const Vec3& axis, double firstU, double lastU);

/**
 * The part of a surface with u in [firstU, lastU] and v in [firstV, lastV], clamped there, by
 * knot insertion. Bounds within 1e-9 of the domain's size of a border or a knot are taken as
 * that border or knot; bounds beyond the domain as the domain's.
 */
NurbsSurface Restrict(
  const NurbsSurface& surface, double firstU, double lastU, double firstV, double lastV);

/// A clamped surface that is closed along u, run through twice: its domain is twice as long.
NurbsSurface RepeatU(const NurbsSurface& surface);

/// u and v exchanged: S'(u, v) = S(v, u); trim loops too. The normal turns round.
NurbsSurface Transpose(const NurbsSurface& surface);

/// u runs backwards over the same domain: S'(u, v) = S(first + last - u, v); trim loops too.
/// The normal turns round.
NurbsSurface ReverseU(const NurbsSurface& surface);
}

#endif
