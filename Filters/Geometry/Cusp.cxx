#include "Cusp.h"

#include "BezierEvaluation.h"
#include "ModelEvaluation.h"

#include <algorithm>

namespace nurbs
{
namespace
{

/// Where faces meet under less than twice that in radians their normals cancel but for the
/// precision of a file.
constexpr double NormalsLeft = 0.02;

/// Faces whose angles are less than that, in all, end in a tip: no more is known of these angles.
constexpr double TipAngles = 0.05;

bool NormalsSayNothing(const std::vector<Sector>& sectors, const Vec3& sum)
{
  double lengths = 0;
  for (const Sector& sector : sectors)
  {
    lengths += sector.Weighted.norm();
  }
  return sum.norm() < NormalsLeft * lengths || lengths < TipAngles;
}

/// Into a piece of surface from the point, along the surface; of the rays that bound it.
Vec3 WayInto(const Sector& sector)
{
  Vec3 way = Vec3::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    way += InsideOf(sector, sector.Rays[k]);
  }
  return way.normalized();
}

/// Ways from the point in (u, v) of the face, in at least one of which it parts from what touches
/// it: between borders the one between them, else across each other.
std::vector<Vec2> WaysInParameters(const Sector& sector, const Vec2& size)
{
  if (sector.RayCount == 0)
  {
    return { Vec2(size.x(), 0), Vec2(0, size.y()) };
  }
  Vec2 way = Vec2::Zero();
  for (int k = 0; k < sector.RayCount; ++k)
  {
    const Vec2 ray = (sector.Rays[k].To - sector.Rays[k].From).cwiseQuotient(size).normalized();
    way += (sector.Rays[k].InsideIsLeft ? 1.0 : -1.0) * Vec2(-ray.y(), ray.x());
  }
  return { way.normalized().cwiseProduct(size) };
}

/// The point of a face that is closest to y within a radius, whatever its loops leave of it there;
/// false if there is none.
bool FindFootOnFace(const SurfaceModel& model, int face, const Vec3& y, double radius, Vec3& foot)
{
  double squared = radius * radius;
  bool found = false;
  model.ForLeavesNear(y, radius,
    [&](int index)
    {
      const BezierPatch& patch = model.Patches[model.Leaves[index].Patch];
      if (patch.Face != face || patch.Curve)
      {
        return;
      }
      const LocalFoot own = FootOnLeaf(model, index, y);
      if (own.Squared <= squared)
      {
        squared = own.Squared;
        foot = own.Point;
        found = true;
      }
    });
  return found;
}

/// How far the second face is beyond the first one where they begin to part; 0: they do not.
double HeightBeyond(const SurfaceModel& model, const Sector& one, const Sector& other, double gap)
{
  const Vec3 normal = model.Data[one.Face].Sign * one.Weighted.normalized();
  const FaceData& data = model.Data[one.Face];
  const Vec2 first = data.Low(), last = data.High();
  for (const Vec2& way : WaysInParameters(one, last - first))
  {
    Vec3 foot;
    for (double part = 1e-3; part < 0.3; part *= 3)
    {
      const Vec2 uv = (one.Parameters + part * way).cwiseMax(first).cwiseMin(last);
      const Vec3 y = FacePoint(model, one.Face, uv);
      // They part slowly.
      const double radius = 100 * gap + 0.05 * (y - one.Nearest).norm();
      if (!FindFootOnFace(model, other.Face, y, radius, foot))
      {
        break;
      }
      if ((foot - y).norm() > gap)
      {
        return normal.dot(foot - y);
      }
    }
  }
  return 0.0;
}

/// A piece of the line round a needle at some depth from its tip.
struct RingPiece
{
  Vec3 Middle, Normal; ///< oriented
  double Length;
};

/// The line round a needle, as deep as a part of the patches that meet at its tip.
std::vector<RingPiece> RingAt(
  const SurfaceModel& model, const std::vector<Sector>& sectors, double depth)
{
  constexpr int Pieces = 12;
  std::vector<RingPiece> ring;
  for (const Sector& sector : sectors)
  {
    const BezierPatch& patch = model.Patches[sector.Patch];
    const FaceData& data = model.Data[patch.Face];
    const double across = sector.Pole % 2 == 0 ? depth : 1 - depth;
    const auto place = [&](double along)
    { return sector.Pole < 2 ? Vec2(across, along) : Vec2(along, across); };
    const auto point = [&](double along)
    { return BezierPoint(patch, model.Net(patch), place(along).x(), place(along).y()); };
    for (int k = 0; k < Pieces; ++k)
    {
      const double from = k / double(Pieces), to = (k + 1) / double(Pieces);
      const Vec2 middle = place(0.5 * (from + to));
      if (data.Loops.Empty() ||
        data.Loops.Inside(patch.U(middle.x(), middle.y()), patch.V(middle.x(), middle.y())))
      {
        ring.push_back(
          { point(0.5 * (from + to)), data.Sign * UnitNormal(model, patch, middle.x(), middle.y()),
            (point(to) - point(from)).norm() });
      }
    }
  }
  return ring;
}

/// Where patches end in a tip under no angle, in a needle: 1 if their normals point out of it, -1
/// if into it; 0 if it is none.
double SideOfNeedle(const SurfaceModel& model, const std::vector<Sector>& sectors, double gap)
{
  constexpr double LeastShare = 0.01; // of the area in the square of the length; of a circle 0.08
  if (std::any_of(sectors.begin(), sectors.end(), [](const Sector& s) { return s.Pole < 0; }))
  {
    return 0.0;
  }
  // Of several faces each may end beside the others.
  const bool oneFace = std::all_of(sectors.begin(), sectors.end(),
    [&](const Sector& s) { return s.Face == sectors.front().Face; });
  const double shortest = oneFace ? 1e3 * model.Resolution : 6 * gap;
  for (double depth = 1e-3; depth < 0.5; depth *= 3)
  {
    const std::vector<RingPiece> ring = RingAt(model, sectors, depth);
    Vec3 centre = Vec3::Zero();
    double length = 0.0, area = 0.0;
    for (const RingPiece& piece : ring)
    {
      centre += piece.Length * piece.Middle;
      length += piece.Length;
    }
    for (const RingPiece& piece : ring)
    {
      area += 0.5 * piece.Length * piece.Normal.dot(piece.Middle - centre / length);
    }
    if (length > shortest && std::abs(area) > LeastShare * length * length)
    {
      return area > 0 ? 1.0 : -1.0;
    }
  }
  return 0.0;
}

}

Cusp ExamineCusp(
  const SurfaceModel& model, const std::vector<Sector>& sectors, const Vec3& sum, double gap)
{
  Cusp cusp;
  if (!NormalsSayNothing(sectors, sum))
  {
    return cusp;
  }
  Vec3 into = Vec3::Zero();
  for (const Sector& sector : sectors)
  {
    into += WayInto(sector);
  }
  for (const Sector& one : sectors)
  {
    for (const Sector& other : sectors)
    {
      const double cosine = one.Weighted.normalized().dot(other.Weighted.normalized()) *
        model.Data[one.Face].Sign * model.Data[other.Face].Sign;
      const double height =
        one.Face != other.Face && cosine < -0.5 ? HeightBeyond(model, one, other, gap) : 0.0;
      if (height != 0.0)
      {
        cusp.Side = height < 0.0 ? 1.0 : -1.0;
        cusp.Normal = -cusp.Side * into;
        return cusp;
      }
    }
  }
  cusp.Side = SideOfNeedle(model, sectors, gap);
  return cusp;
}

}
