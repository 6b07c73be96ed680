/// @file NodeRelaxing.cxx
/// @brief Where a node may go while it is relaxed: on the faces or the ridge that hold it, and on
/// the surface if it is on the cut.
#include "NodeMover.h"

#include "Status.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// Steps to a sharp edge of the surface, and how much nearer to it each looks for its sides.
constexpr int MostCreaseSteps = 8;
constexpr double CreaseApproach = 0.1;
/// Sine up to which a border counts as straight or level, where places are known as exactly: files
/// have places to six or seven digits, and a node that slides takes less from its edges than this.
constexpr double StraightSine = 1e-4;

/// Faces that turn by less are a smooth skin, on which nodes may slide without spoiling its shape.
constexpr double SmoothSine = 0.2;

/// Sine that the directions of the edges of a face, or their normals, are known to.
double SineRounding(const Band& band, int node)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const int edge : band.EdgesOfNode(node))
  {
    shortest =
      std::min(shortest, (band.Point[band.OtherEnd(edge, node)] - band.Point[node]).norm());
  }
  return 8.0 * SpacingAt(band, node) / shortest;
}

}

bool NodeMover::MayRelax(int node, bool onCut) const
{
  const NodeHold& hold = this->HoldOf(node, onCut);
  const NodeConstraint& constraint = hold.Constraint;
  // Asked of the faces themselves: the constraint forgets those that are cut off.
  if (!this->TheColumns.IsOnBorder(this->TheBand, node))
  {
    return constraint.Kind == ConstraintKind::Faces || constraint.Kind == ConstraintKind::Free;
  }
  // A layer in a solid has no shape of its own yet, and finds none with its border held.
  if (hold.Smooth && (onCut || this->TheBand.IsInsertedNode(node)))
  {
    return true;
  }
  const bool slides =
    (constraint.Kind == ConstraintKind::Faces && this->TheBand.NodeStatus[node] != NodeEliminate) ||
    (constraint.Kind == ConstraintKind::Ridge && !onCut);
  return slides && hold.Straight;
}

/// Whether the ridge of a node does not turn there, or its faces lie in one plane.
bool NodeMover::IsStraight(int node, const NodeConstraint& constraint) const
{
  const double straight = std::max(StraightSine, SineRounding(this->TheBand, node));
  if (constraint.Kind == ConstraintKind::Ridge)
  {
    const auto& ridges = constraint.RidgeEdges;
    const auto way = [&](int edge)
    {
      return Vec3(
        this->TheBand.Point[this->TheBand.OtherEnd(edge, node)] - this->TheBand.Point[node])
        .normalized();
    };
    return ridges.size() == 2 && way(ridges[0]).cross(way(ridges[1])).norm() < straight &&
      way(ridges[0]).dot(way(ridges[1])) < 0.0;
  }
  const Vec3 normal =
    Facet(this->TheBand, this->TheBand.Faces[constraint.Faces.front()]).NormalAt(0);
  return std::all_of(constraint.Faces.begin(), constraint.Faces.end(),
    [&](int f)
    {
      const auto& face = this->TheBand.Faces[f];
      for (int i = 0; i < face.Count; ++i)
      {
        if (Facet(this->TheBand, face).NormalAt(i).cross(normal).norm() > straight)
        {
          return false;
        }
      }
      return true;
    });
}

/// Whether a node of a layer, or at one, in a solid is on faces that bend little there.
bool NodeMover::IsOnSmoothSkin(int node, const NodeConstraint& constraint) const
{
  if (!HasLayerInSolid(this->TheBand, this->TheColumns) || constraint.Kind != ConstraintKind::Faces)
  {
    return false;
  }
  const auto normalOf = [&](int f)
  {
    const auto& face = this->TheBand.Faces[f];
    return Facet(this->TheBand, face).NormalAt(CornerOf(face, node));
  };
  const auto& faces = constraint.Faces;
  return std::all_of(faces.begin(), faces.end(),
    [&](int f) { return normalOf(f).cross(normalOf(faces.front())).norm() < SmoothSine; });
}

void NodeMover::StartFrom(int node, const Vec3& x, NodeFreedom& freedom) const
{
  // Most relaxations begin where one before has ended.
  const auto find = [&] { return this->FootOf(x, freedom); };
  freedom.Start =
    freedom.Start.Kind == nurbs::FootKind::None ? this->Memory->Starts.At(node, x, find) : find();
}

nurbs::Foot NodeMover::FootOf(const Vec3& x, const NodeFreedom& freedom) const
{
  return freedom.Start.Kind == nurbs::FootKind::None ? this->Surface.ClosestPoint(x)
                                                     : this->Surface.NearbyFoot(x, freedom.Start);
}

std::vector<Vec3> NodeMover::Directions(
  int node, const NodeFreedom& freedom, const Vec3& x, bool onCut) const
{
  const auto& constraint = freedom.Constraint;
  std::vector<Vec3> directions;
  const auto addRound = [&directions](const Vec3& u, const Vec3& v)
  {
    constexpr double half = 0.70710678118654752;
    for (const Vec3& d : { u, v, Vec3(half * (u + v)), Vec3(half * (u - v)) })
    {
      directions.push_back(d);
      directions.push_back(-d);
    }
  };
  if (constraint.Kind == ConstraintKind::Ridge)
  {
    const Vec3 along = this->AlongRidge(node, constraint);
    return { along, -along };
  }
  const Vec3 across = onCut ? this->FootOf(x, freedom).Normal : Vec3::Zero();
  if (constraint.Kind == ConstraintKind::Faces)
  {
    const auto& face = this->TheBand.Faces[constraint.Faces.front()];
    const Vec3 normal = Facet(this->TheBand, face).NormalAt(CornerOf(face, node));
    if (onCut)
    {
      const Vec3 along = across.cross(normal).normalized();
      return { along, -along };
    }
    const Vec3 u = normal.unitOrthogonal();
    addRound(u, normal.cross(u));
    return directions;
  }
  if (onCut)
  {
    const Vec3 u = across.unitOrthogonal();
    addRound(u, across.cross(u));
    return directions;
  }
  addRound(Vec3::UnitX(), Vec3::UnitY());
  directions.push_back(Vec3::UnitZ());
  directions.push_back(-Vec3::UnitZ());
  return directions;
}

Vec3 NodeMover::AlongRidge(int node, const NodeConstraint& constraint) const
{
  return (this->TheBand.Point[this->TheBand.OtherEnd(constraint.RidgeEdges.front(), node)] -
    this->TheBand.Point[node])
    .normalized();
}

/// Nearest point of the two ridge edges at the node.
bool NodeMover::PlaceOnRidge(
  int node, const NodeConstraint& constraint, const Vec3& x, Vec3& place) const
{
  const Vec3& p = this->TheBand.Point[node];
  double nearest = std::numeric_limits<double>::infinity();
  for (const int edge : constraint.RidgeEdges)
  {
    const Vec3 along = this->TheBand.Point[this->TheBand.OtherEnd(edge, node)] - p;
    const Vec3 on = p + std::clamp((x - p).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
    if ((on - x).norm() < nearest)
    {
      nearest = (on - x).norm();
      place = on;
    }
  }
  return std::isfinite(nearest);
}

bool NodeMover::Constrained(
  int node, NodeFreedom& freedom, const Vec3& x, bool onCut, Vec3& place) const
{
  const auto& constraint = freedom.Constraint;
  if (constraint.Kind == ConstraintKind::Free)
  {
    place = onCut ? this->FootOf(x, freedom).Point : x;
    return !onCut || this->MayBeAt(node, place);
  }
  if (constraint.Kind == ConstraintKind::Ridge)
  {
    return this->PlaceOnRidge(node, constraint, x, place);
  }
  if (constraint.Kind == ConstraintKind::Fixed)
  {
    return false; // a corner of the model may have no face to slide on at all
  }
  if (onCut)
  {
    const auto& face = this->TheBand.Faces[constraint.Faces.front()];
    const Vec3 normal = Facet(this->TheBand, face).NormalAt(CornerOf(face, node));
    const auto foot = this->FootOf(x, freedom);
    const Vec3 along = foot.Normal.cross(normal).normalized();
    const NodeMove move = this->Between(node, freedom, x, foot, along);
    place = move.Target;
    return move.Found;
  }
  return this->NearestFacet(freedom, x, place, nullptr);
}

bool NodeMover::MeetCrease(
  int node, NodeFreedom& freedom, nurbs::Foot a, nurbs::Foot b, Vec3& place) const
{
  const ConstraintKind kind = freedom.Constraint.Kind;
  if (kind != ConstraintKind::Free && kind != ConstraintKind::Faces)
  {
    return false;
  }
  Vec3& x = place;
  double moved = std::numeric_limits<double>::infinity();
  for (int i = 0; i < MostCreaseSteps && moved > 0.1 * this->Precision; ++i)
  {
    // Where the surface bends without an edge the normals come together, and at a gap that counts
    // as closed.
    Vec3 on = x, normal = a.Normal.cross(b.Normal).normalized();
    if (a.Normal.dot(b.Normal) > CreaseCosine)
    {
      break;
    }
    if (kind == ConstraintKind::Faces && !this->NearestFacet(freedom, x, on, &normal))
    {
      return false;
    }
    Eigen::Matrix3d m;
    m.row(0) = a.Normal;
    m.row(1) = b.Normal;
    m.row(2) = normal;
    if (std::abs(m.determinant()) < SmallestSine)
    {
      return false;
    }
    const Vec3 step =
      m.inverse() * Vec3(a.Normal.dot(a.Point - x), b.Normal.dot(b.Point - x), normal.dot(on - x));
    x += step;
    moved = step.norm();
    // The tangent planes are those of places nearer and nearer to the edge.
    a = this->Surface.ClosestPoint(x + CreaseApproach * (a.Point - x));
    b = this->Surface.ClosestPoint(x + CreaseApproach * (b.Point - x));
  }
  const double gap = this->Surface.WidestGap();
  if (moved > gap)
  {
    return false;
  }
  const nurbs::Foot foot = this->Surface.ClosestPoint(x);
  if (moved > 0.1 * this->Precision || foot.Distance > 0.1 * this->Precision)
  {
    Vec3 on = x = foot.Point;
    if (foot.Distance > gap ||
      (kind == ConstraintKind::Faces &&
        !(this->NearestFacet(freedom, x, on, nullptr) && (on - x).norm() <= this->Precision)))
    {
      return false;
    }
  }
  return (x - this->TheBand.Point[node]).norm() <= this->Reach(node) &&
    (kind != ConstraintKind::Free || this->MayBeAt(node, x));
}

/// The nearest place on the faces that a node may come to lie on, and, if asked for, their normal
/// there.
bool NodeMover::NearestFacet(NodeFreedom& freedom, const Vec3& x, Vec3& place, Vec3* normal) const
{
  const int face = this->RingOf(freedom, 0).NearestFace(x, {}, place);
  if (normal && face >= 0)
  {
    *normal = Facet(this->TheBand, this->TheBand.Faces[face]).Project(x).Normal;
  }
  return face >= 0;
}

std::vector<Vec3> NodeMover::Tangents(
  int node, NodeFreedom& freedom, const Vec3& x, bool onCut) const
{
  const auto& constraint = freedom.Constraint;
  if (constraint.Kind == ConstraintKind::Ridge)
  {
    return { this->AlongRidge(node, constraint) };
  }
  const auto plane = [](const Vec3& normal) -> std::vector<Vec3>
  {
    const Vec3 u = normal.unitOrthogonal();
    return { u, normal.cross(u) };
  };
  const Vec3 across = onCut ? this->FootOf(x, freedom).Normal : Vec3::Zero();
  if (constraint.Kind == ConstraintKind::Faces)
  {
    const auto& face = this->TheBand.Faces[constraint.Faces.front()];
    Vec3 place;
    Vec3 normal = Facet(this->TheBand, face).NormalAt(CornerOf(face, node));
    this->NearestFacet(freedom, x, place, &normal);
    return onCut ? std::vector<Vec3>{ across.cross(normal).normalized() } : plane(normal);
  }
  return onCut ? plane(across) : std::vector<Vec3>{ Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() };
}

}
