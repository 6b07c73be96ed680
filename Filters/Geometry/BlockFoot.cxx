/// @file BlockFoot.cxx
/// @brief The foot of a point from the blocks near it, and whether it is the closest point.
#include "SurfaceBlocks.h"

#include "BezierEvaluation.h"
#include "ClosestPoint.h"
#include "SurfaceModel.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{

int SurfaceBlocks::BlockAt(int face, int spanU, int spanV, double s, double t) const
{
  const Grid& grid = this->Grids[face];
  const int nu = grid.DivisionsU[spanU], nv = grid.DivisionsV[spanV];
  const int i = grid.BlockU[spanU] + std::clamp(static_cast<int>(s * nu), 0, nu - 1);
  const int j = grid.BlockV[spanV] + std::clamp(static_cast<int>(t * nv), 0, nv - 1);
  return grid.ItemAt(i, j);
}

/// Down the tree to the nearest child each time: mostly the right block or one beside it.
int SurfaceBlocks::NearBlock(const Vec3& p) const
{
  const Eigen::Vector3f q = p.cast<float>();
  int index = 0;
  for (;;)
  {
    const TreeNode& node = this->Nodes[index];
    Eigen::Array4f distance = Eigen::Array4f::Zero(), toMiddle = Eigen::Array4f::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Array4f below = node.Low[axis] - q[axis], above = q[axis] - node.High[axis];
      const Eigen::Array4f e = below.max(above).max(0.0f);
      distance += e * e;
      toMiddle += (below - above) * (below - above);
    }
    distance += 0.05f * toMiddle;
    int best;
    distance.minCoeff(&best);
    // From beyond the place of empty children these are the nearest; the first is never empty.
    const int child = node.Child[best] == TreeNode::Empty ? node.Child[0] : node.Child[best];
    if (child < 0)
    {
      return ~child;
    }
    index = child;
  }
}

namespace
{

/// Two Newton steps on the quadratic model of a block; its parameters.
Eigen::Vector2f ModelFoot(const SurfaceBlock& b, const Vec3& p)
{
  const Eigen::Vector3f d = (p - b.Center).cast<float>();
  const Eigen::Vector3f x(b.X.dot(d), b.Y.dot(d), b.Z.dot(d));
  float t = x.y() / b.Yv, s = (x.x() - b.Xv * t) / b.Xu;
  constexpr float Far = 2;
  for (int k = 0; k < 2; ++k)
  {
    s = std::clamp(s, -Far, Far);
    t = std::clamp(t, -Far, Far);
    const Eigen::Vector3f su = s * b.UU + t * b.UV, sv = s * b.UV + t * b.VV;
    const Eigen::Vector3f u(b.Xu + su.x(), su.y(), su.z()), v(b.Xv + sv.x(), b.Yv + sv.y(), sv.z());
    Eigen::Vector3f r = 0.5f * (s * su + t * sv) - x;
    r.x() += b.Xu * s + b.Xv * t;
    r.y() += b.Yv * t;
    const float f = u.dot(r), g = v.dot(r);
    const float a = u.dot(u) + r.dot(b.UU), c = v.dot(v) + r.dot(b.VV);
    const float m = u.dot(v) + r.dot(b.UV), det = a * c - m * m;
    if (!(a > 0) || !(det > 0.01f * a * c))
    {
      break;
    }
    s += (m * g - c * f) / det;
    t += (m * f - a * g) / det;
  }
  return Eigen::Vector2f(std::clamp(s, -Far, Far), std::clamp(t, -Far, Far));
}

/// A place on a face: knot spans and the parameters of the patch there.
struct FacePlace
{
  int SpanU, SpanV;
  double S, T;
};

/// Moves a parameter that has left its span into the right one; false beyond the last.
bool EnterSpan(const KnotSpans& spans, int& span, double& x)
{
  const int last = spans.Count() - 1;
  if (!(std::abs(x) < 8))
  {
    return false;
  }
  while (x < 0 || x > 1)
  {
    const int next = span + (x < 0 ? -1 : 1);
    if (next < 0 || next > last)
    {
      return false;
    }
    const double* breaks = spans.Breaks.data();
    const double ratio = (breaks[span + 1] - breaks[span]) / (breaks[next + 1] - breaks[next]);
    x = x < 0 ? 1 + x * ratio : (x - 1) * ratio;
    span = next;
  }
  return true;
}

/// The span and the parameter in it of u, held to the face; the search starts from a guess.
void LocateSpan(const KnotSpans& spans, double u, int& span, double& x)
{
  const int last = spans.Count() - 1;
  const double* breaks = spans.Breaks.data();
  const double length = breaks[last + 1] - breaks[0];
  span = std::clamp(static_cast<int>((last + 1) * ((u - breaks[0]) / length)), 0, last);
  if (u < breaks[span] || u > breaks[span + 1])
  {
    span = spans.Find(u);
  }
  x = std::clamp((u - breaks[span]) / (breaks[span + 1] - breaks[span]), 0.0, 1.0);
}

/// Where a point of a patch lies on its face; returns the face.
int PlaceOf(const SurfaceModel& model, const SurfacePoint& point, FacePlace& place)
{
  const BezierPatch& patch = model.Patches[point.Patch];
  const FaceData& data = model.Data[patch.Face];
  LocateSpan(data.SpansU, patch.U(point.S, point.T), place.SpanU, place.S);
  LocateSpan(data.SpansV, patch.V(point.S, point.T), place.SpanV, place.T);
  return patch.Face;
}

/// Newton over the patches of a face; false if it leaves the face or does not converge.
bool FollowFace(
  const SurfaceModel& model, int face, const Vec3& p, FacePlace& x, SurfacePoint& foot)
{
  constexpr int MaximumSteps = 10;
  constexpr double Small = 2e-8; // the step after one this small is below rounding
  const FaceData& data = model.Data[face];
  double before = 0; // the last step, 0 where it tells nothing
  for (int step = 0; step < MaximumSteps; ++step)
  {
    const int index = data.PatchOf(x.SpanU, x.SpanV);
    const BezierPatch& patch = model.Patches[index];
    SurfaceJet jet;
    EvaluateBezier(patch, model.Net(patch), x.S, x.T, jet);
    const Vec3 r = jet.S - p;
    const double f = jet.Su.dot(r), g = jet.Sv.dot(r);
    const double e = jet.Su.squaredNorm(), h = jet.Sv.squaredNorm();
    const double a = e + r.dot(jet.Suu), c = h + r.dot(jet.Svv);
    const double b = jet.Su.dot(jet.Sv) + r.dot(jet.Suv), det = a * c - b * b;
    if (!(a > 0 && c > 0 && det > 1e-4 * a * c))
    {
      return false;
    }
    const double ds = (b * g - c * f) / det, dt = (b * f - a * g) / det;
    const double length = std::max(std::abs(ds), std::abs(dt));
    const double s = x.S + ds, t = x.T + dt;
    // Newton's error goes like the square, with a factor that the last two steps show.
    const bool last =
      length < Small || (length < 1e-6 && length * length * length < 1e-17 * before * before);
    const bool stays = s >= 0 && s <= 1 && t >= 0 && t <= 1;
    if (last && stays)
    {
      x.S = s;
      x.T = t;
      foot.Patch = index;
      foot.S = s;
      foot.T = t;
      foot.Point = jet.S + ds * jet.Su + dt * jet.Sv + (0.5 * ds * ds) * jet.Suu +
        (ds * dt) * jet.Suv + (0.5 * dt * dt) * jet.Svv;
      foot.Squared = (foot.Point - p).squaredNorm();
      foot.Normal =
        (jet.Su + ds * jet.Suu + dt * jet.Suv).cross(jet.Sv + ds * jet.Suv + dt * jet.Svv);
      return true;
    }
    x.S = s;
    x.T = t;
    before = stays ? length : 0;
    if (!EnterSpan(data.SpansU, x.SpanU, x.S) || !EnterSpan(data.SpansV, x.SpanV, x.T))
    {
      return false;
    }
  }
  return false;
}

/// Squared distance from p to the skew box of a block, never too large.
float SquaredDistanceToBlock(const SurfaceBlock& block, const Vec3& p)
{
  const Eigen::Vector3f d = (p - block.Center).cast<float>();
  const float slack = 4e-7f * d.cwiseAbs().sum();
  const Eigen::Vector3f x(block.AcrossV().dot(d), block.Y.dot(d), block.Z.dot(d));
  const Eigen::Array3f gap =
    ((block.Low - x).cwiseMax(x - block.High).array() - slack).cwiseMax(0.0f);
  // The first two axes are askew: only the longer of their gaps counts.
  const float across = std::max(gap[0], gap[1]);
  return (across * across + gap[2] * gap[2]) * (1 - 1e-6f);
}

}

/**
 * True if no other point of the surface is certainly nearer to p than a foot in a block: the blocks
 * that reach into the ball about p up to the foot lie in a rectangle over which the distance to p
 * is convex.
 */
bool SurfaceBlocks::IsClosest(
  const SurfaceModel& model, const Vec3& p, const SurfacePoint& foot, int index) const
{
  const int face = this->BlockOf(model, index).Face;
  const Grid& grid = this->Grids[face];
  const int column = grid.ColumnOf(index), row = grid.RowOf(index);
  BlockRange range{ column, column + 1, row, row + 1 };
  const auto add = [&](int block)
  {
    const SurfaceBlock& near = this->BlockOf(model, block);
    if (SquaredDistanceToBlock(near, p) > foot.Squared)
    {
      return true;
    }
    if (near.Face != face)
    {
      return false;
    }
    range.Add(grid.ColumnOf(block), grid.RowOf(block));
    return true;
  };
  return ForItemsNear(this->Nodes, p, foot.Squared, add) && this->IsSmooth(model, face, range) &&
    this->IsConvex(model, p, foot.Point, face, range);
}

/// Whether the distance to p is convex over the blocks, as BlockReach tells.
bool SurfaceBlocks::IsConvex(const SurfaceModel& model, const Vec3& p, const Vec3& foot, int face,
  const BlockRange& range) const
{
  constexpr float Most = 0.9999f; // the rest is for rounding
  const Grid& grid = this->Grids[face];
  for (int j = range.FirstV; j < range.EndV; ++j)
  {
    for (int i = range.FirstU; i < range.EndU; ++i)
    {
      const int index = grid.ItemAt(i, j);
      const SurfaceBlock& block = this->BlockOf(model, index);
      const BlockReach reach = this->ReachOf(model, index);
      const Eigen::Vector3f d = (p - block.Center).cast<float>();
      const Eigen::Vector3f x(block.X.dot(d), block.Y.dot(d), block.Z.dot(d));
      if (!(reach.Cost.dot(x.cwiseAbs()) < Most) ||
        !((foot - block.Center).norm() < Most * reach.Radius))
      {
        return false;
      }
    }
  }
  return true;
}

bool SurfaceBlocks::FollowFoot(const SurfaceModel& model, const Vec3& p, SurfacePoint& start)
{
  FacePlace place;
  const int face = PlaceOf(model, start, place);
  SurfacePoint foot;
  if (!FollowFace(model, face, p, place, foot))
  {
    return false;
  }
  start = foot;
  return true;
}

bool SurfaceBlocks::FindFoot(const SurfaceModel& model, const Vec3& p, SurfacePoint& start) const
{
  if (this->Grids.empty())
  {
    return false;
  }
  FacePlace place;
  int face;
  if (start.Patch >= 0)
  {
    face = PlaceOf(model, start, place);
  }
  else
  {
    const SurfaceBlock& block = this->BlockOf(model, this->NearBlock(p));
    face = block.Face;
    const Vec2 uv = block.Middle + block.Width.cwiseProduct(ModelFoot(block, p).cast<double>());
    if (!uv.allFinite())
    {
      return false; // from so far away that single precision overflows
    }
    LocateSpan(model.Data[face].SpansU, uv.x(), place.SpanU, place.S);
    LocateSpan(model.Data[face].SpansV, uv.y(), place.SpanV, place.T);
  }
  SurfacePoint foot;
  if (!FollowFace(model, face, p, place, foot))
  {
    return false;
  }
  start = foot;
  const int block = this->BlockAt(face, place.SpanU, place.SpanV, place.S, place.T);
  // Wide rings take as long as many points to measure, and few points need them.
  return this->IsClear(model, block, foot.Squared, Rings::Narrow) ||
    this->IsClosest(model, p, foot, block) ||
    this->IsClear(model, block, foot.Squared, Rings::Wide);
}

}
