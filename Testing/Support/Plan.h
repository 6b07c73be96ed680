/**
 * @file Plan.h
 * @brief Plane meshes of quadrilaterals and triangles, and how they become sheets: extruded and
 * folded along a profile.
 */
#ifndef Plan_h
#define Plan_h

#include "Meshes.h"

#include <functional>
#include <utility>
#include <vector>

namespace judge
{
struct Plan
{
  std::vector<Vec2> Points;
  std::vector<std::vector<Id>> Faces; ///< counter-clockwise, 3 or 4 nodes

  /// Drops the faces whose centre does not satisfy the condition, and unused points.
  void Keep(const std::function<bool(const Vec2& centre)>& condition);
  /// Moves inner points by up to `size` in each direction.
  void Perturb(double size, unsigned seed);
  /// Splits a share of the quadrilaterals into triangles.
  void SplitSome(double share, unsigned seed);
  /// Merges points closer than the tolerance.
  void Merge(double tolerance);
  double Radius() const;
};

/// Rectangles of dx x dy, in the first quadrant.
Plan GridPlan(int nx, int ny, double dx, double dy);
/// n x n core of elements of size about 1 with rings round it, out to a circle of 4 n sides.
Plan BlankPlan(int n, int rings);
/// n x n squares of 2 x 2, perturbed, each of two triangles and these of three quadrilaterals each.
Plan TriangleQuadPlan(int n, unsigned seed);

/// From a plan position and a height (measured from the middle surface) to space.
using Fold = std::function<Vec3(const Vec2& p, double z)>;
Fold Flat();
/// nz layers, `thickness` in all, half of it to either side of the plan.
RawMesh Extrude(const Plan& plan, int nz, double thickness, const Fold& fold);

/// A plane profile of straight and circular pieces, starting at the origin along x.
class Walk
{
public:
  struct Piece
  {
    double Length, Curvature;
  };
  explicit Walk(std::vector<Piece> pieces)
    : Pieces(std::move(pieces))
  {
  }
  double Length() const;
  /// Position (x, 0, z) at arc length s, offset by `height` along the normal.
  Vec3 At(double s, double height) const;

private:
  std::vector<Piece> Pieces;
};

}

#endif
