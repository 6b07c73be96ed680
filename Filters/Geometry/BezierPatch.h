/**
 * @file BezierPatch.h
 * @brief Rational Bezier patches, the pieces of a NURBS surface between its knots.
 *
 * A patch has its own parameters s, t in [0, 1]. Its net is homogeneous (w x, w y, w z, w)
 * about the model's local origin, s running fastest; patches of constant weight are divided
 * by it, so w = 1. A trim curve is a patch of degree (n, 0).
 */
#ifndef BezierPatch_h
#define BezierPatch_h

#include "NurbsSurface.h"

namespace nurbs
{
/// A curve of degree (p + q) on a surface is kept as a patch of that degree.
constexpr int MaximumBezierDegree = 2 * MaximumDegree;

/// What lies beyond one side of a patch.
enum class SideKind : unsigned char
{
  Smooth, ///< the next patch of the face, with a continuous normal
  Crease, ///< the next patch of the face, joined without a continuous tangent plane
  Sharp,  ///< the same though the knots are smooth: the derivative across vanishes
  Border  ///< nothing of this face (its border, or a jump)
};

/// How near a sharp side, relative to the patch, a derivative is but rounding and a foot is not
/// found exactly.
constexpr double SharpRim = 1e-3;

struct BezierPatch
{
  int Face = -1;
  int DegreeU = 1, DegreeV = 1;
  bool Rational = false;
  bool Curve = false;                    ///< a piece of a trim loop: (U0, V0) to (U1, V1) over s
  std::size_t Net = 0;                   ///< index of the first control point in the pool of nets
  double U0 = 0, U1 = 1, V0 = 0, V1 = 1; ///< in (u, v) of the face
  SideKind Sides[4] = {};                ///< at s = 0, s = 1, t = 0, t = 1
  bool Collapsed[4] = {};                ///< the side is one point (a pole)
  int GridU = 1, GridV = 1;              ///< leaves along s and t
  int FirstLeaf = -1;                    ///< of these, by row; the others follow
  int Loop = -1, LoopEdge = -1;          ///< of a trim curve: which loop and which edge of it

  double U(double s, double) const { return this->U0 + (this->U1 - this->U0) * s; }
  double V(double s, double t) const
  {
    return this->V0 + (this->V1 - this->V0) * (this->Curve ? s : t);
  }
  /// Of parameters of the face, not for a curve: (s, t); within [0, 1] but for rounding if they lie
  /// in the patch.
  Vec2 Local(const Vec2& uv) const
  {
    return Vec2(
      (uv.x() - this->U0) / (this->U1 - this->U0), (uv.y() - this->V0) / (this->V1 - this->V0));
  }
};

/// The control points along a side of a patch, in the order of BezierPatch::Sides.
struct NetSide
{
  NetSide(const BezierPatch& patch, int side)
  {
    const int p = patch.DegreeU, q = patch.DegreeV, row = p + 1;
    const bool alongV = side < 2, atStart = side % 2 == 0;
    this->First = atStart ? 0 : (alongV ? p : q * row);
    this->Stride = alongV ? row : 1;
    this->Degree = alongV ? q : p;
    this->Inwards = (atStart ? 1 : -1) * (alongV ? 1 : row);
  }

  int At(int k) const { return this->First + k * this->Stride; } ///< of point k in the net

  int First, Stride;
  int Degree;  ///< of the side: it has one point more
  int Inwards; ///< from one of its points to the next one within the patch
};

/// The place of a homogeneous point.
inline Vec3 CartesianPoint(const Vec4& c)
{
  return c.w() == 1.0 ? Vec3(c.head<3>()) : Vec3(c.head<3>() / c.w());
}

/// Divides a net of constant weight by it; says whether weights differ.
bool NormaliseWeights(Vec4* net, int size);

}

#endif
