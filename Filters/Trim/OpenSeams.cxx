#include "OpenSeams.h"

#include "SortUnique.h"

#include <algorithm>
#include <cstddef>

namespace trim
{
namespace
{

/// How far beside each other faces may lie, of their size: places are rounded.
constexpr double Closeness = 1e-6;

double Sqr(double x)
{
  return x * x;
}

/// A face that no other element shares.
struct Side
{
  Vec3 Corner[4];
  int Count;
  int Element;
  Vec3 Low, High;
};

bool IsOnSkin(const TrimBand& near, const BandFace& face)
{
  const int element = face.Element[0];
  const int axis = near.SheetAxis[element];
  return axis >= 0 && TopologyOf(near.Mesh.Elements[element].Count).FaceAxis[face.Slot[0]] == axis;
}

Side ToSide(const Band& band, const BandFace& face)
{
  Side side;
  side.Count = face.Count;
  side.Element = face.Element[0];
  side.Low = side.High = band.Point[face.Node[0]];
  for (int i = 0; i < face.Count; ++i)
  {
    side.Corner[i] = band.Point[face.Node[i]];
    side.Low = side.Low.cwiseMin(side.Corner[i]);
    side.High = side.High.cwiseMax(side.Corner[i]);
  }
  return side;
}

std::vector<Side> OpenSides(const TrimBand& near)
{
  const Band& band = near.Mesh;
  std::vector<Side> sides;
  for (const BandFace& face : band.Faces)
  {
    const int element = face.Element[0];
    // What lies on a face of ring 0 is no farther than in the next ring.
    if (face.Exterior && element >= 0 && band.Elements[element].Ring <= 1 && !IsOnSkin(near, face))
    {
      sides.push_back(ToSide(band, face));
    }
  }
  return sides;
}

Vec3 MiddleOf(const Side& side)
{
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < side.Count; ++i)
  {
    sum += side.Corner[i];
  }
  return sum / side.Count;
}

bool IsOnTriangle(const Vec3& p, const Side& side)
{
  const Vec3 *a = side.Corner, u = a[1] - a[0], v = a[2] - a[0], w = p - a[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), area = uu * vv - uv * uv;
  const double s = (vv * u.dot(w) - uv * v.dot(w)) / area;
  const double t = (uu * v.dot(w) - uv * u.dot(w)) / area;
  return s >= 0 && t >= 0 && s + t <= 1 && (w - s * u - t * v).squaredNorm() <= Sqr(Closeness) * uu;
}

/// The quadrilateral is bilinear: halved elements have their corners on it also where it is warped.
bool IsOnQuadrilateral(const Vec3& p, const Side& side)
{
  const Vec3* a = side.Corner;
  const Vec3 twist = a[0] - a[1] + a[2] - a[3];
  double s = 0.5, t = 0.5;
  Vec3 off;
  for (int step = 0; step < 8; ++step)
  {
    const Vec3 u = a[1] - a[0] + t * twist, v = a[3] - a[0] + s * twist;
    off = p - a[0] - s * (a[1] - a[0]) - t * (a[3] - a[0]) - s * t * twist;
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), area = uu * vv - uv * uv;
    s += (vv * u.dot(off) - uv * v.dot(off)) / area;
    t += (uu * v.dot(off) - uv * u.dot(off)) / area;
  }
  return s >= 0 && t >= 0 && s <= 1 && t <= 1 &&
    off.squaredNorm() <= Sqr(Closeness) * (a[2] - a[0]).squaredNorm();
}

/// Whether the middle of a face lies on another: faces that share nodes only meet at their borders.
bool LiesOn(const Side& side, const Side& other)
{
  const Vec3 middle = MiddleOf(side);
  return other.Count == 3 ? IsOnTriangle(middle, other) : IsOnQuadrilateral(middle, other);
}

bool MayTouch(const Side& a, const Side& b)
{
  const double close = Closeness * ((a.High - a.Low).norm() + (b.High - b.Low).norm());
  return ((a.Low - b.High).array() <= close).all() && ((b.Low - a.High).array() <= close).all();
}

/// The direction in which the sides reach farthest: along it most of them are apart.
int LongestAxis(const std::vector<Side>& sides)
{
  Vec3 low = sides[0].Low, high = sides[0].High;
  for (const Side& side : sides)
  {
    low = low.cwiseMin(side.Low);
    high = high.cwiseMax(side.High);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

}

std::vector<int> FindOpenSeams(const TrimBand& near)
{
  std::vector<Side> sides = OpenSides(near);
  std::vector<int> elements;
  const int axis = sides.empty() ? 0 : LongestAxis(sides);
  std::sort(sides.begin(), sides.end(),
    [axis](const Side& a, const Side& b) { return a.Low[axis] < b.Low[axis]; });
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const double end = sides[i].High[axis] + Closeness * (sides[i].High - sides[i].Low).norm();
    for (std::size_t j = i + 1; j < sides.size() && sides[j].Low[axis] <= end; ++j)
    {
      if (MayTouch(sides[i], sides[j]) &&
        (LiesOn(sides[i], sides[j]) || LiesOn(sides[j], sides[i])))
      {
        elements.insert(elements.end(), { sides[i].Element, sides[j].Element });
      }
    }
  }
  SortUnique(elements);
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                   [&near](int e) { return near.Mesh.Elements[e].Ring != 0; }),
    elements.end());
  return elements;
}

}
