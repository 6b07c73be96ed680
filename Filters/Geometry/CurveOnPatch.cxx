#include "CurveOnPatch.h"

#include "Binomials.h"

namespace nurbs
{
namespace
{

/// Restricts one row of coefficients to [x0, x1], in any order and equal ones included, in place
/// (blossoms).
void BlossomRow(Vec4* c, int degree, std::size_t stride, double x0, double x1)
{
  Vec4 result[MaximumDegree + 1], d[MaximumDegree + 1];
  for (int m = 0; m <= degree; ++m)
  {
    for (int i = 0; i <= degree; ++i)
    {
      d[i] = c[i * stride];
    }
    for (int r = 1; r <= degree; ++r)
    {
      const double x = r <= m ? x1 : x0;
      for (int i = 0; i <= degree - r; ++i)
      {
        d[i] = (1.0 - x) * d[i] + x * d[i + 1];
      }
    }
    result[m] = d[0];
  }
  for (int m = 0; m <= degree; ++m)
  {
    c[m * stride] = result[m];
  }
}

}

BezierPatch CurveOnPatch(
  const BezierPatch& patch, const Vec2& from, const Vec2& to, UnsetVector<Vec4>& nets)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  // A copy: the nets may move as they grow.
  std::vector<Vec4> part(nets.begin() + patch.Net, nets.begin() + patch.Net + (p + 1) * (q + 1));
  for (int j = 0; j <= q; ++j)
  {
    BlossomRow(part.data() + j * (p + 1), p, 1, from.x(), to.x());
  }
  for (int i = 0; i <= p; ++i)
  {
    BlossomRow(part.data() + i, q, p + 1, from.y(), to.y());
  }
  // The diagonal of the part: products of Bernstein polynomials of degree p and q.
  BezierPatch curve;
  curve.Face = patch.Face;
  curve.Curve = true;
  curve.DegreeU = p + q;
  curve.DegreeV = 0;
  curve.U0 = patch.U(from.x(), 0);
  curve.U1 = patch.U(to.x(), 0);
  curve.V0 = patch.V(0, from.y());
  curve.V1 = patch.V(0, to.y());
  for (SideKind& side : curve.Sides)
  {
    side = SideKind::Border;
  }
  const double *ofU = Binomials(p), *ofV = Binomials(q), *ofBoth = Binomials(p + q);
  std::vector<Vec4> net(p + q + 1, Vec4::Zero());
  for (int l = 0; l <= q; ++l)
  {
    for (int k = 0; k <= p; ++k)
    {
      net[k + l] += (ofU[k] * ofV[l] / ofBoth[k + l]) * part[k + l * (p + 1)];
    }
  }
  curve.Rational = NormaliseWeights(net.data(), p + q + 1);
  curve.Net = nets.size();
  nets.insert(nets.end(), net.begin(), net.end());
  return curve;
}

}
