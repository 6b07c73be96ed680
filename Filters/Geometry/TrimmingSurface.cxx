#include "TrimmingSurface.h"

#include "ClosestPoint.h"
#include "LineIntersection.h"
#include "ModelEvaluation.h"
#include "Neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nurbs
{

struct TrimmingSurface::Implementation
{
  Implementation(std::vector<NurbsSurface> faces, double gapTolerance, double widestGap)
    : Model(std::move(faces), gapTolerance, widestGap)
  {
  }

  SurfaceModel Model;

  Vec2 FaceParameters(const BezierPatch& patch, double s, double t) const;
  SurfacePoint StartAt(const Foot& guess) const;
  Foot Finish(const Vec3& p, const SurfacePoint& found) const;
  bool IsPlain(const BezierPatch& patch, double s, double t) const;
  bool IsOnSharedLoop(const Vec3& point) const;
  Vec3 NormalAt(int patch, double s, double t, const Vec3& point, bool& border) const;
  std::vector<LineMeeting> MeetingsAlong(
    const Vec3& start, const Vec3& direction, double span) const;
  std::vector<LineMeeting> MeetingAt(const Vec3& point) const;
  void KeepDistinct(std::vector<LineMeeting>& meetings) const;
};

/// True if one normal tells all: off the borders, creases, poles and loops.
bool TrimmingSurface::Implementation::IsPlain(const BezierPatch& patch, double s, double t) const
{
  if (patch.Curve)
  {
    return false;
  }
  constexpr double Rim = 1e-9; // relative to the patch: seen from afar the point is on the side
  const bool on[4] = { s <= Rim, s >= 1 - Rim, t <= Rim, t >= 1 - Rim };
  for (int side = 0; side < 4; ++side)
  {
    if (on[side] && (patch.Sides[side] != SideKind::Smooth || patch.Collapsed[side]))
    {
      return false;
    }
  }
  const TrimLoops& loops = this->Model.Data[patch.Face].Loops;
  if (loops.Empty() || this->Model.TrimStates[this->Model.LeafAt(patch, s, t)] == TrimState::Inside)
  {
    return true;
  }
  const Vec2 uv(patch.U(s, t), patch.V(s, t));
  const Vec2 rim = Rim * Vec2(patch.U1 - patch.U0, patch.V1 - patch.V0);
  return loops.Classify(uv - rim, uv + rim) != TrimState::Crossed;
}

/// A point outside the loops still counts on the loop itself, where rounding decides nothing,
/// and between the loops of two faces, whose polygons are chords of the same edge.
bool TrimmingSurface::Implementation::IsOnSharedLoop(const Vec3& point) const
{
  const SurfaceModel& model = this->Model;
  const SurfacePoint near = FindClosestPoint(model, point, model.Gap * model.Gap, SurfacePoint());
  return near.Patch >= 0 &&
    (near.Squared <= 16 * model.Resolution * model.Resolution ||
      !ExamineNeighbourhood(model, near.Point).Border);
}

Vec3 TrimmingSurface::Implementation::NormalAt(
  int index, double s, double t, const Vec3& point, bool& border) const
{
  const BezierPatch& patch = this->Model.Patches[index];
  border = false;
  if (this->IsPlain(patch, s, t))
  {
    const Vec3 n = UnitNormal(this->Model, patch, s, t);
    if (n.squaredNorm() > 0)
    {
      return this->Model.Data[patch.Face].Sign * n;
    }
  }
  const Neighbourhood around = ExamineNeighbourhood(this->Model, point);
  border = around.Border;
  return around.Normal;
}

/// (u, v) of a patch point. Before a jump the last value that still belongs to the patch.
Vec2 TrimmingSurface::Implementation::FaceParameters(
  const BezierPatch& patch, double s, double t) const
{
  Vec2 uv(patch.U(s, t), patch.V(s, t));
  const NurbsSurface& face = this->Model.Faces[patch.Face];
  if (!patch.Curve && s == 1 && patch.Sides[1] == SideKind::Border && patch.U1 < face.LastU())
  {
    uv.x() = std::nextafter(patch.U1, patch.U0);
  }
  if (!patch.Curve && t == 1 && patch.Sides[3] == SideKind::Border && patch.V1 < face.LastV())
  {
    uv.y() = std::nextafter(patch.V1, patch.V0);
  }
  return uv;
}

/// The place of a foot on its patch; no patch without a foot.
SurfacePoint TrimmingSurface::Implementation::StartAt(const Foot& guess) const
{
  SurfacePoint start;
  if (guess.Kind != FootKind::None && guess.Face >= 0 &&
    guess.Face < static_cast<int>(this->Model.Faces.size()))
  {
    start.Patch = this->Model.PatchAt(guess.Face, guess.U, guess.V);
    const BezierPatch& patch = this->Model.Patches[start.Patch];
    const Vec2 local = patch.Local(Vec2(guess.U, guess.V));
    start.S = std::clamp(local.x(), 0.0, 1.0);
    start.T = std::clamp(local.y(), 0.0, 1.0);
  }
  return start;
}

Foot TrimmingSurface::Implementation::Finish(const Vec3& p, const SurfacePoint& found) const
{
  Foot foot;
  if (found.Patch < 0)
  {
    return foot;
  }
  const BezierPatch& patch = this->Model.Patches[found.Patch];
  bool border;
  if (found.Normal.squaredNorm() > 0 && this->IsPlain(patch, found.S, found.T))
  {
    border = false;
    foot.Normal = this->Model.Data[patch.Face].Sign * found.Normal.normalized();
  }
  else
  {
    foot.Normal = this->NormalAt(found.Patch, found.S, found.T, found.Point, border);
  }
  foot.Kind = border ? FootKind::Border : FootKind::Interior;
  foot.Face = patch.Face;
  const Vec2 uv = this->FaceParameters(patch, found.S, found.T);
  foot.U = uv.x();
  foot.V = uv.y();
  foot.Point = this->Model.Origin + found.Point;
  const Vec3 d = p - found.Point;
  foot.Distance = d.norm();
  foot.SignedDistance = d.dot(foot.Normal) < 0 ? -foot.Distance : foot.Distance;
  return foot;
}

TrimmingSurface::TrimmingSurface(
  std::vector<NurbsSurface> faces, double gapTolerance, double widestGap)
  : Impl(std::make_unique<Implementation>(std::move(faces), gapTolerance, widestGap))
{
}

TrimmingSurface::~TrimmingSurface() = default;

void TrimmingSurface::Flip()
{
  for (FaceData& data : this->Impl->Model.Data)
  {
    data.Sign = -data.Sign;
  }
}

Foot TrimmingSurface::ClosestPoint(const Vec3& p, double maxDistance) const
{
  return this->ClosestPoint(p, Foot(), maxDistance);
}

Foot TrimmingSurface::ClosestPoint(const Vec3& p, const Foot& guess, double maxDistance) const
{
  const SurfaceModel& model = this->Impl->Model;
  const Vec3 local = p - model.Origin;
  const SurfacePoint start = this->Impl->StartAt(guess);
  const double squared = maxDistance >= 0 ? maxDistance * maxDistance : 0;
  return this->Impl->Finish(local, FindClosestPoint(model, local, squared, start));
}

Foot TrimmingSurface::NearbyFoot(const Vec3& p, const Foot& guess) const
{
  const SurfaceModel& model = this->Impl->Model;
  const Vec3 local = p - model.Origin;
  SurfacePoint foot = this->Impl->StartAt(guess);
  if (foot.Patch >= 0 && SurfaceBlocks::FollowFoot(model, local, foot) &&
    IsInsideTrim(model, foot.Patch, foot.S, foot.T))
  {
    return this->Impl->Finish(local, foot);
  }
  return this->ClosestPoint(p, guess, std::numeric_limits<double>::infinity());
}

/// Where the line from the start, `span` long, meets the patches, from the start on.
std::vector<LineMeeting> TrimmingSurface::Implementation::MeetingsAlong(
  const Vec3& start, const Vec3& direction, double span) const
{
  const SurfaceModel& model = this->Model;
  const Box3 box = Box3(model.Bounds.min() - model.Origin, model.Bounds.max() - model.Origin);
  // Clipped to a ball about the model, single precision is enough for the tree.
  const double middle = direction.dot(box.center() - start);
  const double radius = 0.51 * box.diagonal().norm() + 8 * model.Resolution;
  const double low = std::max(0.0, middle - radius), high = std::min(span, middle + radius);
  const double slack = 4 * model.Resolution;
  std::vector<LineMeeting> meetings;
  if (high - low < -slack)
  {
    return meetings;
  }
  FindMeetings(model, start, direction, low, std::max(low, high), meetings);
  std::sort(meetings.begin(), meetings.end(),
    [](const LineMeeting& x, const LineMeeting& y)
    { return x.K != y.K ? x.K < y.K : (x.Patch != y.Patch ? x.Patch < y.Patch : x.S < y.S); });
  return meetings;
}

/// A point of the surface as the one meeting of a line without length, if it is one.
std::vector<LineMeeting> TrimmingSurface::Implementation::MeetingAt(const Vec3& point) const
{
  const SurfaceModel& model = this->Model;
  const SurfacePoint found =
    FindClosestPoint(model, point, 16 * model.Resolution * model.Resolution, SurfacePoint());
  std::vector<LineMeeting> meetings;
  if (found.Patch >= 0)
  {
    meetings.push_back({ 0.0, found.Patch, found.S, found.T, found.Point, false, 0.0 });
  }
  return meetings;
}

/// Drops meetings that the loops cut away, and of those at one place all but one.
void TrimmingSurface::Implementation::KeepDistinct(std::vector<LineMeeting>& meetings) const
{
  const SurfaceModel& model = this->Model;
  std::size_t kept = 0;
  for (const LineMeeting& meeting : meetings)
  {
    if (!IsInsideTrim(model, meeting.Patch, meeting.S, meeting.T) &&
      !this->IsOnSharedLoop(meeting.Point))
    {
      continue;
    }
    if (kept > 0)
    {
      const LineMeeting& last = meetings[kept - 1];
      const double same = std::max(
        (meeting.Touch || last.Touch) ? 1e-5 * model.Scale : 1e-9 * model.Scale, 2 * model.Gap);
      // Of meetings at one place the one on the line counts, not one that bridges a gap.
      const bool repeated = meeting.K - last.K <= same;
      if (repeated && (meeting.Away >= last.Away || last.Away <= 4 * model.Resolution))
      {
        continue;
      }
      kept -= repeated ? 1 : 0;
    }
    meetings[kept++] = meeting;
  }
  meetings.resize(kept);
}

std::vector<LineHit> TrimmingSurface::Intersect(
  const Vec3& a, const Vec3& b, double kMin, double kMax) const
{
  const SurfaceModel& model = this->Impl->Model;
  std::vector<LineHit> hits;
  const double length = (b - a).norm();
  if (!(kMax >= kMin) || !std::isfinite(length))
  {
    return hits;
  }
  const Vec3 start = a + kMin * (b - a) - model.Origin;
  std::vector<LineMeeting> meetings = length > 0
    ? this->Impl->MeetingsAlong(start, (b - a) / length, (kMax - kMin) * length)
    : this->Impl->MeetingAt(start);
  this->Impl->KeepDistinct(meetings);
  for (const LineMeeting& meeting : meetings)
  {
    const BezierPatch& patch = model.Patches[meeting.Patch];
    LineHit hit;
    bool border;
    hit.K = length > 0 ? std::clamp(kMin + meeting.K / length, kMin, kMax) : kMin;
    hit.Face = patch.Face;
    const Vec2 uv = this->Impl->FaceParameters(patch, meeting.S, meeting.T);
    hit.U = uv.x();
    hit.V = uv.y();
    hit.Point = model.Origin + meeting.Point;
    hit.Normal = this->Impl->NormalAt(meeting.Patch, meeting.S, meeting.T, meeting.Point, border);
    hits.push_back(hit);
  }
  return hits;
}

namespace
{

/**
 * Visits the leaves whose oriented boxes meet a box, until it is told to stop.
 *
 * @param gap how far from the box they count all the same.
 * @param visit takes the index of a leaf box and returns false to stop.
 * @return false if it was stopped.
 */
template <typename Visit>
bool ForLeavesMeeting(const SurfaceModel& model, const Box3& box, double gap, const Visit& visit)
{
  if (box.isEmpty())
  {
    return true;
  }
  const Vec3 center = box.center() - model.Origin, half = 0.5 * box.sizes();
  const double slack = 2e-7 * (center.cwiseAbs().maxCoeff() + half.maxCoeff()) + gap;
  float low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = static_cast<float>(center[axis] - half[axis] - slack);
    high[axis] = static_cast<float>(center[axis] + half[axis] + slack);
  }
  const auto meetsBoxes = [&](const TreeNode& node) -> Eigen::Array<bool, 4, 1>
  {
    return (node.Low[0] <= high[0]) && (node.High[0] >= low[0]) && (node.Low[1] <= high[1]) &&
      (node.High[1] >= low[1]) && (node.Low[2] <= high[2]) && (node.High[2] >= low[2]);
  };
  return ForItemsPassing(model.Nodes, meetsBoxes,
    [&](int index)
    {
      // Separating axes of the leaf's oriented box.
      const LeafBox& leaf = model.BoxAt(index);
      const Eigen::Vector3f d = (center - leaf.Center.cast<double>()).cast<float>();
      const Eigen::Vector3f h = half.cast<float>();
      const float rim = 1e-6f * (d.cwiseAbs().sum() + h.sum()) + static_cast<float>(slack);
      const auto apart = [&](const Eigen::Vector3f& axis, int k)
      {
        const float x = axis.dot(d), reach = axis.cwiseAbs().dot(h) + rim;
        return x - reach > leaf.High[k] || x + reach < leaf.Low[k];
      };
      return apart(leaf.X.cross(leaf.Y), 2) || apart(leaf.X, 0) || apart(leaf.Y, 1) || visit(index);
    });
}

}

bool TrimmingSurface::MayIntersect(const Box3& box) const
{
  const SurfaceModel& model = this->Impl->Model;
  return !ForLeavesMeeting(model, box, model.Resolution, [](int) { return false; });
}

bool TrimmingSurface::NormalsLieWithin(const Box3& box, const Vec3& direction, double angle) const
{
  const SurfaceModel& model = this->Impl->Model;
  return ForLeavesMeeting(model, box, model.Resolution + model.WidestGap,
    [&](int index)
    {
      const Leaf& leaf = model.Leaves[model.BoxAt(index).Leaf()];
      const BezierPatch& patch = model.Patches[leaf.Patch];
      if (patch.Curve)
      {
        return true; // along a loop; its face is visited too
      }
      // No tangent leaves the mean tangent plane by a greater sine than Deviation.
      constexpr double Rounding = 1e-6;
      const double turn = std::asin(std::min(1.0, double(leaf.Deviation)));
      const double cosine = model.Data[patch.Face].Sign * leaf.Z.cast<double>().dot(direction);
      return leaf.Deviation < 1 &&
        std::acos(std::clamp(cosine, -1.0, 1.0)) + turn < angle - Rounding;
    });
}

const Box3& TrimmingSurface::Bounds() const
{
  return this->Impl->Model.Bounds;
}

int TrimmingSurface::NumberOfFaces() const
{
  return static_cast<int>(this->Impl->Model.Faces.size());
}

const NurbsSurface& TrimmingSurface::Face(int i) const
{
  return this->Impl->Model.Faces[i];
}

namespace
{

/// Where a surface has a tangent plane.
struct Tangents
{
  SurfaceJet Jet;
  Vec3 Normal; ///< S_u x S_v
  double Area; ///< its square, > 0
};

/// @param map applied to the surface.
std::optional<Tangents> TangentsAt(const TrimmingSurface& surface, const Foot& foot,
  const Eigen::Matrix3d& map = Eigen::Matrix3d::Identity())
{
  if (foot.Face < 0 || foot.Face >= surface.NumberOfFaces())
  {
    return std::nullopt;
  }
  SurfaceJet jet = EvaluateJet(surface.Face(foot.Face), foot.U, foot.V);
  for (Vec3* derivative : { &jet.Su, &jet.Sv, &jet.Suu, &jet.Suv, &jet.Svv })
  {
    *derivative = map * *derivative;
  }
  const Vec3 normal = jet.Su.cross(jet.Sv);
  const double area = normal.squaredNorm();
  return area > 0 ? std::optional<Tangents>({ jet, normal, area }) : std::nullopt;
}

}

double TrimmingSurface::RadiusOfCurvature(const Foot& foot) const
{
  return this->MappedRadiusOfCurvature(foot, Eigen::Matrix3d::Identity());
}

double TrimmingSurface::MappedRadiusOfCurvature(const Foot& foot, const Eigen::Matrix3d& map) const
{
  const double infinity = std::numeric_limits<double>::infinity();
  const auto tangents = TangentsAt(*this, foot, map);
  if (!tangents)
  {
    return infinity;
  }
  const auto& [jet, n, area] = *tangents;
  // First and second fundamental forms; k^2 - 2 H k + K = 0.
  const double E = jet.Su.squaredNorm(), F = jet.Su.dot(jet.Sv), G = jet.Sv.squaredNorm();
  const Vec3 unit = n / std::sqrt(area);
  const double L = jet.Suu.dot(unit), M = jet.Suv.dot(unit), N = jet.Svv.dot(unit);
  const double H = 0.5 * (E * N - 2 * F * M + G * L) / area, K = (L * N - M * M) / area;
  const double k = std::abs(H) + std::sqrt(std::max(0.0, H * H - K));
  return k > 0 ? 1.0 / k : infinity;
}

double TrimmingSurface::RadiusOfCurvature(const Foot& foot, const Vec3& direction) const
{
  const double infinity = std::numeric_limits<double>::infinity();
  const auto tangents = TangentsAt(*this, foot);
  if (!tangents)
  {
    return infinity;
  }
  const auto& [jet, n, area] = *tangents;
  // The direction as a Su + b Sv; its curvature is the second over the first fundamental form.
  const double a = direction.cross(jet.Sv).dot(n) / area;
  const double b = jet.Su.cross(direction).dot(n) / area;
  const double bend =
    std::abs((a * a * jet.Suu + 2 * a * b * jet.Suv + b * b * jet.Svv).dot(n)) / std::sqrt(area);
  return bend > 0 ? (a * jet.Su + b * jet.Sv).squaredNorm() / bend : infinity;
}

}
