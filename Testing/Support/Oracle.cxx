#include "Oracle.h"

#include <algorithm>
#include <cmath>

namespace judge
{
namespace
{
// Derivatives of the basis functions (NURBS Book, eq. 2.7).
std::vector<double> BasisSlopes(const std::vector<double>& knots, int degree, int count, double t)
{
  const auto lower = Basis(knots, degree - 1, count + 1, t);
  std::vector<double> slopes(count);
  for (int i = 0; i < count; ++i)
  {
    const double a = knots[i + degree] - knots[i], b = knots[i + degree + 1] - knots[i + 1];
    slopes[i] = (a > 0 ? degree / a * lower[i] : 0) - (b > 0 ? degree / b * lower[i + 1] : 0);
  }
  return slopes;
}
}

SweptOracle::SweptOracle(
  const Vec3& origin, const Vec3& e1, const Vec3& e2, std::shared_ptr<Profile> profile)
  : Origin(origin)
  , E1(e1)
  , E2(e2)
  , Curve(std::move(profile))
{
}

Vec2 SweptOracle::Flat(const Vec3& p) const
{
  return Vec2(this->E1.dot(p - this->Origin), this->E2.dot(p - this->Origin));
}

double ConeOracle::Signed(const Vec3& p) const
{
  const Vec3 d = p - this->Apex;
  const double z = d.dot(this->Axis), r = (d - z * this->Axis).norm();
  return r * std::cos(this->HalfAngle) - z * std::sin(this->HalfAngle);
}

double TorusOracle::Signed(const Vec3& p) const
{
  const Vec3 d = p - this->Centre;
  const double z = d.dot(this->Axis), r = (d - z * this->Axis).norm();
  return std::hypot(r - this->Ring, z) - this->Tube;
}

GraphOracle::GraphOracle(const Vec3& origin, const Eigen::Matrix3d& axes,
  const SplineSurface& heights, double halfY, double halfZ)
  : Origin(origin)
  , Axes(axes)
  , Heights(heights)
  , HalfY(halfY)
  , HalfZ(halfZ)
{
}

GraphOracle::Jet GraphOracle::At(double y, double z) const
{
  const SplineSurface& s = this->Heights;
  const double u = std::clamp((y / this->HalfY + 1) / 2, 0.0, 1.0);
  const double v = std::clamp((z / this->HalfZ + 1) / 2, 0.0, 1.0);
  const auto a = Basis(s.KnotsU, s.DegreeU, s.CountU, u);
  const auto b = Basis(s.KnotsV, s.DegreeV, s.CountV, v);
  const auto da = BasisSlopes(s.KnotsU, s.DegreeU, s.CountU, u);
  const auto db = BasisSlopes(s.KnotsV, s.DegreeV, s.CountV, v);
  Jet jet{ 0, 0, 0 };
  for (int j = 0; j < s.CountV; ++j)
  {
    for (int i = 0; i < s.CountU; ++i)
    {
      const double f = s.Control[i + j * s.CountU][0];
      jet.F += f * a[i] * b[j];
      jet.Fy += f * da[i] * b[j] / (2 * this->HalfY);
      jet.Fz += f * a[i] * db[j] / (2 * this->HalfZ);
    }
  }
  return jet;
}

double GraphOracle::Roughly(const Vec3& p) const
{
  const Vec3 q = this->Axes.transpose() * (p - this->Origin);
  return q[0] - this->At(q[1], q[2]).F;
}

double GraphOracle::Signed(const Vec3& p) const
{
  const Vec3 q = this->Axes.transpose() * (p - this->Origin);
  double y = q[1], z = q[2];
  Jet jet = this->At(y, z);
  const double side = q[0] - jet.F;
  // Repeated projection on the tangent plane; the step is halved when the distance grows.
  const auto distance2 = [&](double a, double b, const Jet& j)
  { return (j.F - q[0]) * (j.F - q[0]) + (a - q[1]) * (a - q[1]) + (b - q[2]) * (b - q[2]); };
  double best = distance2(y, z, jet);
  for (int it = 0; it < 200; ++it)
  {
    const double r = jet.F - q[0], ry = y - q[1], rz = z - q[2];
    const double gy = r * jet.Fy + ry, gz = r * jet.Fz + rz;
    const double hyy = 1 + jet.Fy * jet.Fy, hzz = 1 + jet.Fz * jet.Fz, hyz = jet.Fy * jet.Fz;
    const double det = hyy * hzz - hyz * hyz;
    double sy = -(hzz * gy - hyz * gz) / det, sz = -(hyy * gz - hyz * gy) / det;
    bool better = false;
    for (int half = 0; half < 30 && !better; ++half, sy /= 2, sz /= 2)
    {
      const Jet next = this->At(y + sy, z + sz);
      const double d = distance2(y + sy, z + sz, next);
      if (d < best)
      {
        better = true;
        y += sy;
        z += sz;
        jet = next;
        best = d;
        break;
      }
    }
    if (!better || std::hypot(sy, sz) < 1e-16 * this->HalfY)
    {
      break;
    }
  }
  return std::copysign(std::sqrt(best), side);
}

}
