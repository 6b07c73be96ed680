#include "TrimmingSurface.h"

#include "ClosestPoint.h"
#include "DoubledShells.h"
#include "FaceOrder.h"
#include "LeafSearch.h"
#include "LineIntersection.h"
#include "ModelEvaluation.h"
#include "Neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbs
{

namespace
{

/// The model of the faces, each shell once.
std::unique_ptr<SurfaceModel> MakeModel(
  std::vector<NurbsSurface> faces, double gapTolerance, double widestGap)
{
  auto model = std::make_unique<SurfaceModel>(std::move(faces), gapTolerance, widestGap);
  const std::vector<int> doubled = FindDoubledFaces(*model);
  if (doubled.empty())
  {
    return model;
  }
  std::vector<NurbsSurface> once = std::move(model->Faces);
  for (auto face = doubled.rbegin(); face != doubled.rend(); ++face)
  {
    once.erase(once.begin() + *face);
  }
  return std::make_unique<SurfaceModel>(std::move(once), gapTolerance, widestGap);
}

}

struct TrimmingSurface::Implementation
{
  Implementation(std::vector<NurbsSurface> faces, double gapTolerance, double widestGap)
    : Own(MakeModel(InOwnOrder(std::move(faces)), gapTolerance, widestGap))
    , Model(*Own)
  {
  }

  const std::unique_ptr<SurfaceModel> Own;
  SurfaceModel& Model;

  Vec2 FaceParameters(const BezierPatch& patch, double s, double t) const;
  SurfacePoint StartAt(const Foot& guess) const;
  Foot Finish(const Vec3& p, const SurfacePoint& found) const;
  bool IsPlain(const BezierPatch& patch, double s, double t) const;
  bool IsOnSharedLoop(const Vec3& point) const;
  Neighbourhood NeighbourhoodAt(int patch, double s, double t, const Vec3& point) const;
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
  const double away[4] = { s, 1 - s, t, 1 - t };
  for (int side = 0; side < 4; ++side)
  {
    const SideKind kind = patch.Sides[side];
    if (away[side] <= (kind == SideKind::Sharp ? SharpRim : Rim) &&
      (kind != SideKind::Smooth || patch.Collapsed[side]))
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

Neighbourhood TrimmingSurface::Implementation::NeighbourhoodAt(
  int index, double s, double t, const Vec3& point) const
{
  const BezierPatch& patch = this->Model.Patches[index];
  if (this->IsPlain(patch, s, t))
  {
    const Vec3 n = UnitNormal(this->Model, patch, s, t);
    if (n.squaredNorm() > 0)
    {
      Neighbourhood around;
      around.Normal = this->Model.Data[patch.Face].Sign * n;
      return around;
    }
  }
  return ExamineNeighbourhood(this->Model, point);
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

namespace
{

/// Normal and sign of the distance; d leads from the foot to the point.
void SetSide(const Vec3& d, const Neighbourhood& around, Foot& foot)
{
  foot.Normal = around.Normal;
  if (around.CuspSide != 0.0 && foot.Distance > 0.0 && around.CuspSide * d.dot(foot.Normal) <= 0.0)
  {
    foot.Normal = around.CuspSide / foot.Distance * d; // one of many there
  }
  foot.SignedDistance = d.dot(foot.Normal) < 0 ? -foot.Distance : foot.Distance;
}

}

Foot TrimmingSurface::Implementation::Finish(const Vec3& p, const SurfacePoint& found) const
{
  Foot foot;
  if (found.Patch < 0)
  {
    return foot;
  }
  const BezierPatch& patch = this->Model.Patches[found.Patch];
  Neighbourhood around;
  if (found.Normal.squaredNorm() > 0 && this->IsPlain(patch, found.S, found.T))
  {
    around.Normal = this->Model.Data[patch.Face].Sign * found.Normal.normalized();
  }
  else
  {
    around = this->NeighbourhoodAt(found.Patch, found.S, found.T, found.Point);
  }
  foot.Kind = around.Border ? FootKind::Border : FootKind::Interior;
  foot.Face = patch.Face;
  const Vec2 uv = this->FaceParameters(patch, found.S, found.T);
  foot.U = uv.x();
  foot.V = uv.y();
  foot.Point = this->Model.Origin + found.Point;
  foot.Distance = (p - found.Point).norm();
  SetSide(p - found.Point, around, foot);
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

Foot TrimmingSurface::AmongTouching(const Vec3& p, const Foot& foot) const
{
  const SurfaceModel& model = this->Impl->Model;
  const Neighbourhood around = ExamineNeighbourhood(model, foot.Point - model.Origin);
  Foot looked = foot;
  if (around.CuspSide != 0.0)
  {
    SetSide(p - foot.Point, around, looked);
  }
  return looked;
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
    hit.K = length > 0 ? std::clamp(kMin + meeting.K / length, kMin, kMax) : kMin;
    hit.Face = patch.Face;
    const Vec2 uv = this->Impl->FaceParameters(patch, meeting.S, meeting.T);
    hit.U = uv.x();
    hit.V = uv.y();
    hit.Point = model.Origin + meeting.Point;
    hit.Normal =
      this->Impl->NeighbourhoodAt(meeting.Patch, meeting.S, meeting.T, meeting.Point).Normal;
    hits.push_back(hit);
  }
  return hits;
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

double TrimmingSurface::WidestGap() const
{
  return this->Impl->Model.WidestGap;
}

int TrimmingSurface::NumberOfFaces() const
{
  return static_cast<int>(this->Impl->Model.Faces.size());
}

const NurbsSurface& TrimmingSurface::Face(int i) const
{
  return this->Impl->Model.Faces[i];
}

}
