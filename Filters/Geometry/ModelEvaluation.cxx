#include "ModelEvaluation.h"

#include "BezierEvaluation.h"

namespace nurbs
{

Vec3 FacePoint(const SurfaceModel& model, int face, const Vec2& uv)
{
  const BezierPatch& patch = model.Patches[model.PatchAt(face, uv.x(), uv.y())];
  const Vec2 local = patch.Local(uv);
  return BezierPoint(patch, model.Net(patch), local.x(), local.y());
}

LocalFoot FootOnLeaf(const SurfaceModel& model, int index, const Vec3& p)
{
  const Leaf& leaf = model.Leaves[index];
  const BezierPatch& patch = model.Patches[leaf.Patch];
  const PartDomain domain = DomainOf(patch, index);
  const Vec3 d = p - leaf.Center;
  const Vec2 start =
    leaf.ParametersAt(leaf.X.cast<double>().dot(d), leaf.Y.cast<double>().dot(d), domain);
  return InvertPoint(patch, model.Net(patch), p, start.x(), start.y(), domain);
}

namespace
{

/// Whether a place is on a side of the patch where the derivative across vanishes but for rounding.
bool IsOnSharpSide(const BezierPatch& patch, double s, double t)
{
  const double away[4] = { s, 1 - s, t, 1 - t };
  bool is = false;
  for (int side = 0; side < 4; ++side)
  {
    is = is || (patch.Sides[side] == SideKind::Sharp && away[side] < SharpRim);
  }
  return is;
}

/// The normal of a patch beside a place where rounding is all of a derivative.
Vec3 NormalBeside(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  SurfaceJet jet;
  EvaluateBezier(patch, net, 0.5, 0.5, jet);
  const double least = 1e-8 * jet.Su.norm(), leastV = 1e-8 * jet.Sv.norm();
  for (const double step : { 1e-3, 1e-2, 1e-1, 0.5 })
  {
    EvaluateBezier(patch, net, s + step * (0.5 - s), t + step * (0.5 - t), jet);
    if (jet.Su.norm() > least && jet.Sv.norm() > leastV)
    {
      break;
    }
  }
  return jet.Su.cross(jet.Sv).normalized();
}

}

Vec3 UnitNormal(const SurfaceModel& model, const BezierPatch& patch, double s, double t)
{
  const Vec4* net = model.Net(patch);
  if (IsOnSharpSide(patch, s, t))
  {
    return NormalBeside(patch, net, s, t);
  }
  SurfaceJet jet;
  EvaluateBezier(patch, net, s, t, jet);
  constexpr double Small = 1e-8;
  const double twist = jet.Suv.norm();
  const double size = (jet.Su.norm() + twist) * (jet.Sv.norm() + twist);
  Vec3 n = jet.Su.cross(jet.Sv);
  if (n.norm() > Small * size)
  {
    return n.normalized();
  }
  // Collapsed edge: the first derivative of S_u x S_v on the way inside (de l'Hospital).
  const double ds = 0.5 - s, dt = 0.5 - t;
  n = ds * (jet.Suu.cross(jet.Sv) + jet.Su.cross(jet.Suv)) +
    dt * (jet.Suv.cross(jet.Sv) + jet.Su.cross(jet.Svv));
  if (n.norm() > Small * size)
  {
    return n.normalized();
  }
  for (double step : { 1e-4, 1e-3, 1e-2, 1e-1 })
  {
    EvaluateBezier(patch, net, s + step * ds, t + step * dt, jet);
    n = jet.Su.cross(jet.Sv);
    if (n.norm() > 1e-12 * jet.Su.norm() * jet.Sv.norm() && n.norm() > 0)
    {
      return n.normalized();
    }
  }
  return Vec3::Zero();
}

}
