/**
 * @file BezierPatch.h
 * @brief Rational Bezier patches: decomposition of a NURBS surface and fast evaluation.
 *
 * A patch has its own parameters s, t in [0, 1]. Its net is homogeneous (w x, w y, w z, w)
 * about the model's local origin, s running fastest; patches of constant weight are divided
 * by it, so w = 1. A trim curve is a patch of degree (n, 0).
 */
#ifndef BezierPatch_h
#define BezierPatch_h

#include "NurbsSurface.h"
#include "PageVector.h"

namespace nurbs
{
/// A curve of degree (p + q) on a surface is kept as a patch of that degree.
constexpr int MaximumBezierDegree = 2 * MaximumDegree;

/// What lies beyond one side of a patch.
enum class SideKind : unsigned char
{
  Smooth, ///< the next patch of the face, with a continuous normal
  Crease, ///< the next patch of the face, joined without a continuous tangent plane
  Border  ///< nothing of this face (its border, or a jump)
};

struct BezierPatch
{
  int Face = -1;
  int DegreeU = 1, DegreeV = 1;
  bool Rational = false;
  bool Curve = false;  ///< a piece of a trim loop: (U0, V0) to (U1, V1) over s
  std::size_t Net = 0; ///< index of the first control point in the pool of nets
  double U0 = 0, U1 = 1, V0 = 0, V1 = 1;
  SideKind Sides[4] = {}; ///< at s = 0, s = 1, t = 0, t = 1
  bool Collapsed[4] = {}; ///< the side is one point (a pole)
  int GridU = 1, GridV = 1, FirstLeaf = -1;
  int Loop = -1, LoopEdge = -1; ///< of a trim curve: which loop and which edge of it

  double U(double s, double t) const { return this->U0 + (this->U1 - this->U0) * s + 0 * t; }
  double V(double s, double t) const
  {
    return this->V0 + (this->V1 - this->V0) * (this->Curve ? s : t);
  }
};

/// Distinct knots of the domain and the side kinds at each of them.
struct KnotSpans
{
  std::vector<double> Breaks;  ///< n + 1 values that bound n spans
  std::vector<SideKind> Kinds; ///< one per break
  int Find(double u) const;    ///< the span that holds u
};

/**
 * Appends the Bezier patches of a surface (blossoming; NURBS Book, chapter 5.3), row by row,
 * u running fastest.
 */
void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, PageVector<BezierPatch>& patches, PageVector<Vec4>& nets);

/// The place of a homogeneous point.
inline Vec3 CartesianPoint(const Vec4& c)
{
  return c.w() == 1.0 ? Vec3(c.head<3>()) : Vec3(c.head<3>() / c.w());
}

/// S and its derivatives with respect to s and t, about the local origin.
void EvaluateBezier(const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet);

/// S alone.
Vec3 BezierPoint(const BezierPatch& patch, const Vec4* net, double s, double t);

/// The weight there, the denominator of S.
double BezierWeight(const BezierPatch& patch, const Vec4* net, double s, double t);

/// The net of the part [s0, s1] x [t0, t1] of a patch (de Casteljau).
void RestrictNet(const BezierPatch& patch, const Vec4* net, double s0, double s1, double t0,
  double t1, Vec4* part);

/// Appends the curve over the straight line (s0, t0)-(s1, t1) of a patch, exact in degree p + q.
BezierPatch CurveOnPatch(const BezierPatch& patch, const PageVector<Vec4>& pool, const Vec2& from,
  const Vec2& to, PageVector<Vec4>& nets);

}

#endif
