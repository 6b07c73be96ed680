/**
 * @file NodeMover.h
 * @brief New positions of single nodes: corrections of type II and III (paper, section 2.3).
 */
#ifndef NodeMover_h
#define NodeMover_h

#include "Band.h"
#include "Columns.h"
#include "MoverMemory.h"
#include "TrimmingSurface.h"

#include <memory>
#include <vector>

namespace trim
{

/// No node moves farther than this many of its longest edges: columns that the cut has chosen lean.
constexpr double LongestMoveByCut = 5.0;

/// How many ridge edges a node may slide along to either side.
constexpr int LongestRidgeWalk = 4;

/// Cosine of the angle between normals from which an edge of the surface counts as sharp: 20
/// degrees.
constexpr double CreaseCosine = 0.94;

/// Where a node may be while it is relaxed: what NodeMover finds out once for many places.
struct NodeFreedom
{
  NodeConstraint Constraint;
  std::shared_ptr<const SkinRings> Rings; ///< of its faces; null: not asked for yet
  nurbs::Foot Start;                      ///< where it is on the surface, if that is known
};

class NodeMover
{
public:
  /**
   * @param precision absolute distance to which a position is on the surface.
   * @param slidesBehind nodes behind the cut are held by the border beyond the surface, and slide
   * along it, as the elements there are kept; else that is as if it went with what is cut off.
   * @param memory of other movers of the same band, columns, surface and precision, with the same
   * staysInside; null: there are none.
   * @param staysInside nodes that no face holds go to no place of the surface outside of the mesh.
   */
  NodeMover(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface,
    double precision, bool slidesBehind = false, std::shared_ptr<MoverMemory> memory = nullptr,
    bool staysInside = false);

  /// The same that does not tell the memory what it was asked: for trials that may never be made.
  NodeMover Quiet() const;

  /// Type II: P1 on the surface, P2 on the skin facet, P3 = line(N, P2) with S (eqs. 16, 17).
  /// Nodes on a ridge slide along it, by type III.
  const NodeMove& Project(int node) const;

  /**
   * Type III: along the edge to another pillar (eq. 18).
   * @param edge a band edge at the node; the move is found if the surface crosses it.
   */
  const NodeMove& SlideAlong(int node, int edge) const;

  /**
   * The corner of the model, right beside the surface, that the border of a node leads to: a cut
   * that leans passes it on one side below and on the other above, so that the border ends before
   * it meets the surface. A corner that is kept ends at itself.
   */
  NodeMove EndAtCorner(int node) const;

  /// The same for a node of a sheet that is left off the surface, if it is nearer to it there.
  NodeMove ComeToCorner(int node, const Vec3& from) const;

  /// Edges that type III may use at a node: not through the thickness, not off the skin.
  const std::vector<int>& SlidingEdges(int node) const;

  /**
   * The point of the surface, on the faces that hold the node, in the plane through `through`
   * with this normal: for a node that is to lie in the middle of its neighbours.
   */
  NodeMove Between(int node, const Vec3& through, const Vec3& planeNormal) const;

  /// True for a node that may be relaxed: off the border, or where the border is straight, so
  /// that it keeps its shape; of a layer in a solid also where it bends little.
  bool MayRelax(int node, bool onCut) const;

  /// True unless the two nodes lie above each other in one pillar.
  bool IsLateral(int a, int b) const
  {
    return this->TheColumns.Pillar[a] != this->TheColumns.Pillar[b];
  }

  /// Whether all elements at a node are of sheets, in columns that the cut has not chosen.
  bool IsInSheet(int node) const;

  /// Of an element of eight nodes, as it came; see SquaredLengthBefore.
  const EdgeSquares& EdgesBefore(int element) const;

  /// Scaled Jacobian of an element as it came; of an inserted one that on which it stands.
  double QualityBefore(int element) const;

  /// The smallest node of a node's pillar.
  int PillarOf(int node) const { return this->TheColumns.Pillar[node]; }

  /// @param onCut false: a node with kept elements alone round it, or eliminated ones.
  NodeFreedom FreedomOf(int node, bool onCut = true) const;

  /// Tells where a node on the cut is: the feet of places near it are found from there.
  void StartFrom(int node, const Vec3& x, NodeFreedom& freedom) const;

  /// Unit directions in which a node at x may step: in its layer, on its ridge, or along the cut.
  std::vector<Vec3> Directions(
    int node, const NodeFreedom& freedom, const Vec3& x, bool onCut) const;

  /// Orthonormal directions that span the ways a node at x may go; on a bent skin those of the
  /// facet that it has come to.
  std::vector<Vec3> Tangents(int node, NodeFreedom& freedom, const Vec3& x, bool onCut) const;

  /// The place nearest to x where the node may be: on its faces, and on the surface if it is on
  /// the cut. False if there is none.
  bool Constrained(int node, NodeFreedom& freedom, const Vec3& x, bool onCut, Vec3& place) const;

  /**
   * The place of a node on a sharp edge of the surface: on both sides of it, and on the faces that
   * hold the node.
   *
   * @param a, b feet on either side of the edge, not far from it.
   * @param[in,out] place where the node is.
   * @return false if there is no sharp edge between them, or the node may not be there.
   */
  bool MeetCrease(int node, NodeFreedom& freedom, nurbs::Foot a, nurbs::Foot b, Vec3& place) const;

private:
  /// Below this sine of the angle between surface and facet their meeting line is not taken.
  static constexpr double SmallestSine = 0.05;

  /// @param onCut see FreedomOf.
  const NodeHold& HoldOf(int node, bool onCut) const;
  const NodeConstraint& ConstraintOf(int node, bool onCut = true) const
  {
    return this->HoldOf(node, onCut).Constraint;
  }
  NodeMove FindProjection(int node) const;
  NodeMove FindSlide(int node, int edge) const;
  NodeMove FindBetween(int node, const Vec3& through, const Vec3& planeNormal) const;
  std::vector<int> FindSlidingEdges(int node) const;
  nurbs::Foot FootOf(const Vec3& x, const NodeFreedom& freedom) const;
  /// Calls visit(from, to, walked) for the edges of a ridge from a node on, until that returns
  /// true or the ridge turns or ends; `walked` is the way to `from`.
  template <typename Visit>
  void WalkRidge(int node, int firstEdge, const Visit& visit) const;
  /// Whether a node is kept where ridges meet, turn or end: moving it would cut that corner off.
  bool StaysAtCorner(int node, const NodeConstraint& constraint) const;
  bool IsBesideCut(int corner, const NodeConstraint& constraint) const;
  NodeMove SlideAlongRidge(int node, const NodeConstraint& constraint) const;
  bool IsStraight(int node, const NodeConstraint& constraint) const;
  bool IsOnSmoothSkin(int node, const NodeConstraint& constraint) const;
  bool NearestFacet(NodeFreedom& freedom, const Vec3& x, Vec3& place, Vec3* normal) const;
  Vec3 AlongRidge(int node, const NodeConstraint& constraint) const;
  bool PlaceOnRidge(int node, const NodeConstraint& constraint, const Vec3& x, Vec3& place) const;
  NodeMove ProjectOnFaces(int node, NodeFreedom& freedom) const;
  /// The meeting point of the surface, a facet (the one it lies in, looked for from the first on)
  /// and a plane, found from the move's Target on, which becomes it; `foot` is that of the start.
  bool Meet(int node, int first, NodeFreedom& freedom, nurbs::Foot foot, const Vec3& planePoint,
    const Vec3& planeNormal, NodeMove& move) const;
  /// The same with one facet; tells how far outside of it the meeting lies.
  bool MeetFacet(int face, const Vec3& planePoint, const Vec3& planeNormal, Vec3& meeting,
    nurbs::Foot& foot, double& outside) const;
  NodeMove Between(int node, NodeFreedom& freedom, const Vec3& through, const nurbs::Foot& foot,
    const Vec3& planeNormal) const;
  const SkinRing& RingOf(NodeFreedom& freedom, std::size_t ring) const;
  /// Whether a node that no face holds may be at a place of the surface.
  bool MayBeAt(int node, const Vec3& place) const;
  /// Length of the longest edge at a node: no move is longer than a few of these.
  double Reach(int node) const;

  const Band& TheBand;
  const Columns& TheColumns;
  const nurbs::TrimmingSurface& Surface;
  double Precision;
  /// Status of the nodes as if there were no cut: it holds those that are not on it, if they slide
  /// behind it; else empty.
  std::vector<unsigned char> AllKept;
  std::shared_ptr<MoverMemory> Memory;
  bool StaysInside;
  bool TellsAsked = true;
};

}

#endif
