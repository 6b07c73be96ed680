/**
 * @file TrimmingSurface.h
 * @brief One trimming surface made of one or many NURBS faces, with a hierarchy for queries.
 *
 * Each face is decomposed into rational Bezier patches, each of which lies in the convex hull
 * of its control points; a tree of their boxes makes every query global. All queries are
 * const and thread-safe.
 */
#ifndef TrimmingSurface_h
#define TrimmingSurface_h

#include "NurbsSurface.h"

#include <Eigen/Geometry>

#include <limits>
#include <memory>
#include <vector>

namespace nurbs
{

/// Where on the trimming surface a closest point lies; decides whether it has a side.
enum class FootKind : unsigned char
{
  None,     ///< nothing within the distance asked for
  Interior, ///< inside a face, or on a seam or an edge shared by faces: the sign is certain
  Border    ///< on the border of the whole surface: there is no side
};

/// Result of a closest-point query.
struct Foot
{
  FootKind Kind = FootKind::None;
  int Face = -1;             ///< see TrimmingSurface::Face
  double U = 0, V = 0;       ///< in the face's domain
  Vec3 Point = Vec3::Zero(); ///< S(U, V)
  /// Unit normal S_u x S_v, oriented alike over all faces (eq. 15); on a shared edge or
  /// corner the angle-weighted mean of the normals that meet there. Points to the side that
  /// is eliminated.
  Vec3 Normal = Vec3::Zero();
  double Distance = std::numeric_limits<double>::infinity();
  /// Distance with the sign of (p - Point) . Normal: negative on the kept side.
  double SignedDistance = std::numeric_limits<double>::infinity();
};

/// One point where a line meets the surface.
struct LineHit
{
  double K = 0;               ///< A + K (B - A)
  int Face = -1;              ///< see TrimmingSurface::Face
  double U = 0, V = 0;        ///< in the face's domain
  Vec3 Point = Vec3::Zero();  ///< S(U, V)
  Vec3 Normal = Vec3::Zero(); ///< as in Foot
};

class TrimmingSurface
{
public:
  /**
   * @param faces valid surfaces (FindDefect empty), at least one; their order does not matter, nor
   * is it that of Face.
   * @param gapTolerance absolute distance up to which two face borders count as one edge.
   * @param widestGap the same where a border would be free otherwise; less than the gap tolerance:
   * that.
   * Face normals are made alike across shared edges; where they disagree the largest face
   * of each connected shell decides, or most of those that are as large.
   */
  TrimmingSurface(std::vector<NurbsSurface> faces, double gapTolerance, double widestGap = 0.0);
  ~TrimmingSurface();
  TrimmingSurface(const TrimmingSurface&) = delete;
  TrimmingSurface& operator=(const TrimmingSurface&) = delete;

  /// Turns the whole surface round (InvertSide). Call before sharing between threads.
  void Flip();

  /// The global closest point (eqs. 6-11) within maxDistance of p.
  Foot ClosestPoint(
    const Vec3& p, double maxDistance = std::numeric_limits<double>::infinity()) const;

  /// The same, with a foot of a nearby point as first guess: same result, sooner.
  Foot ClosestPoint(const Vec3& p, const Foot& guess, double maxDistance) const;

  /**
   * A foot near that of a nearby point, without asking whether another one is nearer, as long as
   * it stays inside the face of the guess; else the closest point.
   */
  Foot NearbyFoot(const Vec3& p, const Foot& guess) const;

  /**
   * A foot with the side that all faces have which come to the same place: where they touch under
   * no angle it is a matter of rounding which of them has the foot, and what its normal says.
   */
  Foot AmongTouching(const Vec3& p, const Foot& foot) const;

  /**
   * All points where the line A + K (B - A), kMin <= K <= kMax, meets the surface (eqs. 12-14),
   * by rising K, coincident ones on shared edges once. A line that touches without crossing
   * counts as a meeting. A line that lies within the surface gives at least one.
   */
  std::vector<LineHit> Intersect(
    const Vec3& a, const Vec3& b, double kMin = 0.0, double kMax = 1.0) const;

  /// False only if the surface certainly does not meet the box.
  bool MayIntersect(const Box3& box) const;

  /**
   * True only if all normals of the surface within a box, or within the widest gap of it,
   * certainly are within an angle of a direction.
   *
   * @param direction of unit length.
   * @param angle in radians, up to pi.
   */
  bool NormalsLieWithin(const Box3& box, const Vec3& direction, double angle) const;

  /// Of all that the loops leave, a little larger: of boxes round it.
  const Box3& Bounds() const;

  /// How wide a gap between faces may be where a border would be free otherwise.
  double WidestGap() const;
  int NumberOfFaces() const;
  /// In an order of their own; of shells that are there twice one.
  const NurbsSurface& Face(int i) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

}

#endif
