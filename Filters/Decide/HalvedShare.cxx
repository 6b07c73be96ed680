#include "HalvedShare.h"

#include "Jacobian.h"
#include "TetrahedronShare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{
using nurbs::Foot;

/// Normals within this angle of one direction turn by 30 degrees at most: of that tetrahedra lose
/// a fiftieth of the element.
constexpr double PlaneAngle = 0.2618;
/// Distances that are off those to a plane by this, in parts of how far the element reaches from
/// it, are those to a plane.
constexpr double Affine = 0.1;
/// An edge of the surface is left in parts of an eighth of the element's lengths.
constexpr int MostHalvings = 3;
/// Closer to the surface, in parts of the cell's size, the direction from it is rounding.
constexpr double NoDirection = 1e-3;

/// An element, or a part of it after some halvings: a trilinear hexahedron.
struct Cell
{
  ElementPoints Corner;
  Vec3 Middle;
  Foot Nearest; ///< of the middle
  int Halvings;
};

using Halves = std::array<Cell, 8>;

/// The signed distance from the plane that the surface is, seen from the middle of a cell.
struct Plane
{
  explicit Plane(const Cell& cell)
    : Middle(cell.Middle)
    , Distance(cell.Nearest.SignedDistance)
    , Normal(cell.Nearest.Normal)
  {
    const double size = (cell.Corner[6] - cell.Corner[0]).norm();
    if (std::abs(this->Distance) > NoDirection * size)
    {
      this->Normal = (cell.Middle - cell.Nearest.Point) / this->Distance;
    }
  }

  double At(const Vec3& p) const { return this->Distance + this->Normal.dot(p - this->Middle); }

  Vec3 Middle;
  double Distance;
  Vec3 Normal;
};

/// The edges of a cell by the distances of its corners from a plane.
struct EdgesAtPlane
{
  std::array<double, 8> Value;

  bool IsEliminated(int i) const { return this->Value[i] > 0.0; }
  double Beyond(int eliminated, int other) const
  {
    return this->Value[eliminated] / (this->Value[eliminated] - this->Value[other]);
  }
};

double ShareBeyondPlane(const Cell& cell, const Plane& plane)
{
  EdgesAtPlane edges;
  std::transform(cell.Corner.begin(), cell.Corner.end(), edges.Value.begin(),
    [&plane](const Vec3& p) { return plane.At(p); });
  double all = 0.0, beyond = 0.0;
  ForTetrahedra(cell.Corner, 8,
    [&](const Tetrahedron& tetrahedron, double volume)
    {
      all += volume;
      beyond += volume * ShareOfTetrahedron(tetrahedron, edges);
    });
  return all > 0.0 ? beyond / all : 0.0;
}

double RadiusOf(const Cell& cell)
{
  double squared = 0.0;
  for (const Vec3& corner : cell.Corner)
  {
    squared = std::max(squared, (corner - cell.Middle).squaredNorm());
  }
  return std::sqrt(squared);
}

/// By how much a distance may differ from that to the plane.
double ToleranceOf(const Cell& cell, const Plane& plane)
{
  double reach = 0.0;
  for (const Vec3& corner : cell.Corner)
  {
    reach = std::max(reach, std::abs(plane.Normal.dot(corner - cell.Middle)));
  }
  return Affine * reach;
}

class Halving
{
public:
  explicit Halving(const nurbs::TrimmingSurface& surface)
    : Surface(surface)
  {
  }

  double Share(const ElementPoints& element, double share);

  /// Whether the surface had a side everywhere.
  bool IsSure() const { return this->Sure; }

private:
  Foot FootOf(const Vec3& p, const Foot& guess);
  Cell MakeCell(const ElementPoints& corners, const Foot& guess, int halvings);
  Halves Halve(const Cell& cell);
  bool IsPlane(const Cell& cell, const Halves& halves, const Plane& plane);
  double ShareOf(const Cell& cell);
  template <typename ShareOfHalf>
  static double Mean(const Halves& halves, const ShareOfHalf& shareOf);

  const nurbs::TrimmingSurface& Surface;
  bool Sure = true;
};

Foot Halving::FootOf(const Vec3& p, const Foot& guess)
{
  const Foot foot = this->Surface.ClosestPoint(p, guess, std::numeric_limits<double>::infinity());
  this->Sure &= foot.Kind == nurbs::FootKind::Interior;
  return foot;
}

Cell Halving::MakeCell(const ElementPoints& corners, const Foot& guess, int halvings)
{
  const Vec3 middle = MapToSpace(corners, 8, Vec3::Constant(0.5));
  return { corners, middle, this->FootOf(middle, guess), halvings };
}

/// Each at one corner, with its nodes in the order of the cell's.
Halves Halving::Halve(const Cell& cell)
{
  const auto place = [](int corner)
  { return Vec3((corner + 1) / 2 % 2, corner / 2 % 2, corner / 4); };
  Halves halves;
  for (int half = 0; half < 8; ++half)
  {
    ElementPoints corners;
    for (int i = 0; i < 8; ++i)
    {
      corners[i] = MapToSpace(cell.Corner, 8, 0.5 * (place(half) + place(i)));
    }
    halves[half] = this->MakeCell(corners, cell.Nearest, cell.Halvings + 1);
  }
  return halves;
}

/// By the middles of the halves; and by the corners, of which those on the other side are enough
/// where much is known: from this one nothing is seen of what is behind the surface.
bool Halving::IsPlane(const Cell& cell, const Halves& halves, const Plane& plane)
{
  const double tolerance = ToleranceOf(cell, plane);
  const auto isAtPlane = [&](const Vec3& p, const Foot& foot)
  { return std::abs(foot.SignedDistance - plane.At(p)) <= tolerance; };
  return std::all_of(halves.begin(), halves.end(),
           [&](const Cell& half) { return isAtPlane(half.Middle, half.Nearest); }) &&
    std::all_of(cell.Corner.begin(), cell.Corner.end(),
      [&](const Vec3& p)
      {
        const bool isBehind = cell.Halvings == 0 || (plane.At(p) > 0.0) != (plane.Distance > 0.0);
        return !isBehind || isAtPlane(p, this->FootOf(p, cell.Nearest));
      });
}

/// Weighted with their volumes.
template <typename ShareOfHalf>
double Halving::Mean(const Halves& halves, const ShareOfHalf& shareOf)
{
  double all = 0.0, beyond = 0.0;
  for (const Cell& half : halves)
  {
    const double volume = std::abs(VolumeOf(half.Corner, 8));
    all += volume;
    beyond += volume * shareOf(half);
  }
  return all > 0.0 ? beyond / all : 0.0;
}

double Halving::ShareOf(const Cell& cell)
{
  const Plane plane(cell);
  if (std::abs(plane.Distance) >= RadiusOf(cell))
  {
    return plane.Distance > 0.0 ? 1.0 : 0.0;
  }
  if (cell.Halvings == MostHalvings)
  {
    return ShareBeyondPlane(cell, plane);
  }
  const Halves halves = this->Halve(cell);
  if (this->IsPlane(cell, halves, plane))
  {
    return Mean(halves, [](const Cell& half) { return ShareBeyondPlane(half, Plane(half)); });
  }
  return Mean(halves, [&](const Cell& half) { return this->ShareOf(half); });
}

double Halving::Share(const ElementPoints& element, double share)
{
  const Cell cell = this->MakeCell(element, {}, 0);
  const Halves halves = this->Halve(cell);
  if (this->IsPlane(cell, halves, Plane(cell)))
  {
    return share;
  }
  return Mean(halves, [&](const Cell& half) { return this->ShareOf(half); });
}

/// A wedge is a hexahedron two of whose edges have no length.
ElementPoints AsHexahedron(const ElementPoints& p, int count)
{
  return count == 8 ? p : ElementPoints{ p[0], p[1], p[2], p[2], p[3], p[4], p[5], p[5] };
}

}

bool IsNearlyPlane(
  const ElementPoints& points, int count, const nurbs::TrimmingSurface& surface, const Vec3& normal)
{
  nurbs::Box3 box;
  std::for_each(points.begin(), points.begin() + count, [&box](const Vec3& p) { box.extend(p); });
  return !normal.isZero() && surface.NormalsLieWithin(box, normal, PlaneAngle);
}

std::optional<double> HalveForShare(
  const ElementPoints& points, int count, const nurbs::TrimmingSurface& surface, double share)
{
  Halving halving(surface);
  const double halved = halving.Share(AsHexahedron(points, count), share);
  return halving.IsSure() ? std::optional<double>(halved) : std::nullopt;
}

}
