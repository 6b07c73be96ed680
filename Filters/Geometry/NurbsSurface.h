/**
 * @file NurbsSurface.h
 * @brief A NURBS surface as plain data (paper, section 2.1, eq. 1), and its validity check.
 *
 * Terms, stated once for the whole kernel: the surface has degrees p, q and a net of
 * (n+1) x (m+1) control points. Its knot vectors hold n+p+2 and m+q+2 non-decreasing
 * values, clamped or not; the parameter domain is [u_p, u_{n+1}] x [v_q, v_{m+1}].
 * Control points are Cartesian (not multiplied by their weight), u running fastest:
 * point (i, j) is ControlPoints[i + j * (n + 1)].
 */
#ifndef NurbsSurface_h
#define NurbsSurface_h

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace nurbs
{
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec4 = Eigen::Matrix<double, 4, 1, Eigen::DontAlign>;
using Box3 = Eigen::AlignedBox3d;

/// Highest degree the kernel evaluates; fixed-size work arrays are bounded by it.
constexpr int MaximumDegree = 25;

/// Coordinates of surfaces and grids have to stay below: beyond, squares of lengths leave what the
/// float boxes of the tree can hold.
constexpr double LargestCoordinate = 1e15;

struct NurbsSurface
{
  int DegreeU = 1;
  int DegreeV = 1;
  int CountU = 0; ///< n+1 control points along u
  int CountV = 0; ///< m+1 control points along v
  std::vector<double> KnotsU;
  std::vector<double> KnotsV;
  std::vector<Vec4> ControlPoints; ///< x y z w

  /// Closed polygons in (u, v), first point not repeated. The surface is what lies inside
  /// them by the even-odd rule; empty: the whole parameter rectangle.
  std::vector<std::vector<Vec2>> TrimLoops;

  /// How far its borders may lie from the edges it shares with other faces, by the program that
  /// made it; 0: not known.
  double Tolerance = 0.0;

  double FirstU() const { return this->KnotsU[this->DegreeU]; }
  double LastU() const { return this->KnotsU[this->CountU]; }
  double FirstV() const { return this->KnotsV[this->DegreeV]; }
  double LastV() const { return this->KnotsV[this->CountV]; }
};

/**
 * Says what is wrong with a surface: sizes that do not match, knots that decrease, an empty domain,
 * values that are not finite, weights not positive, degrees out of 1..MaximumDegree, trim loops of
 * two points or beyond the domain, a tolerance below zero. The text names thing, place and what to
 * do; empty: valid.
 */
std::string FindDefect(const NurbsSurface& surface);

/// The box of its control points, which holds all of it.
Box3 BoxOf(const NurbsSurface& surface);

/// S and its partial derivatives up to second order at one (u, v) (eqs. 1-5).
struct SurfaceJet
{
  Vec3 S, Su, Sv, Suu, Suv, Svv;
};

/// S(u, v). Parameters outside the domain are clamped to it. (NURBS Book, A4.3)
Vec3 Evaluate(const NurbsSurface& surface, double u, double v);

/// S and all first and second derivatives. (NURBS Book, A3.6 and A4.4)
SurfaceJet EvaluateJet(const NurbsSurface& surface, double u, double v);

}

#endif
