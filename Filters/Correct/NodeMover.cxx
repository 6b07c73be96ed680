#include "NodeMover.h"

#include "BandPlace.h"
#include "Facet.h"
#include "Status.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// No node moves farther than this many of its longest edges, if the cut has not chosen the
/// columns.
constexpr double LongestMove = 3.0;
/// A corner nearer to the surface than this many of its shortest edges is right beside it.
constexpr double BesideCut = 0.5;

}

NodeMover::NodeMover(const Band& band, const Columns& columns,
  const nurbs::TrimmingSurface& surface, double precision, bool slidesBehind,
  std::shared_ptr<MoverMemory> memory, bool staysInside)
  : TheBand(band)
  , TheColumns(columns)
  , Surface(surface)
  , Precision(precision)
  , AllKept(slidesBehind ? band.NumberOfNodes() : 0, NodeKeep)
  , Memory(memory ? std::move(memory) : std::make_shared<MoverMemory>(band))
  , StaysInside(staysInside)
{
}

NodeMover NodeMover::Quiet() const
{
  NodeMover quiet = *this;
  quiet.TellsAsked = false;
  return quiet;
}

bool NodeMover::MayBeAt(int node, const Vec3& place) const
{
  return !this->StaysInside || !LiesOutside(this->TheBand, node, place);
}

double NodeMover::QualityBefore(int element) const
{
  return this->Memory->QualityBefore.At(element,
    [&]
    {
      const ElementShape before = ShapeBefore(this->TheBand, element);
      return ScaledJacobian(before.Points, before.Count);
    });
}

const EdgeSquares& NodeMover::EdgesBefore(int element) const
{
  return this->Memory->EdgesBefore.At(element,
    [&]
    {
      EdgeSquares squares = SquaresOfEdges(PointsOf(this->TheBand, element));
      if (this->TheBand.IsInserted(element))
      {
        // Its last axis goes across the layer.
        const auto& node = this->TheBand.Elements[element].Node;
        const auto across = [&](int i)
        { return SquaredLengthBefore(this->TheBand, node[i], node[i + 4]); };
        squares[0] << across(0), across(1), across(3), across(2);
      }
      return squares;
    });
}

double NodeMover::Reach(int node) const
{
  return (this->TheColumns.IsChosenByCut(node) ? LongestMoveByCut : LongestMove) *
    LongestEdgeAt(this->TheBand, node);
}

const NodeHold& NodeMover::HoldOf(int node, bool onCut) const
{
  const bool byStatus = onCut || this->AllKept.empty();
  if (!onCut && this->TellsAsked)
  {
    this->Memory->AskedOffCut[node].store(1, std::memory_order_relaxed);
  }
  return (byStatus ? this->Memory->HeldByStatus : this->Memory->HeldAsKept)
    .At(node,
      [&]
      {
        NodeHold hold;
        hold.Constraint = ConstrainNode(this->TheBand, this->TheColumns,
          byStatus ? this->TheBand.NodeStatus : this->AllKept, node);
        const auto& constraint = hold.Constraint;
        hold.Rings = std::make_shared<SkinRings>(this->TheBand, this->TheColumns, constraint.Faces);
        hold.Straight = this->TheColumns.IsOnBorder(this->TheBand, node) &&
          (constraint.Kind == ConstraintKind::Faces || constraint.Kind == ConstraintKind::Ridge) &&
          this->IsStraight(node, constraint);
        hold.Smooth = this->IsOnSmoothSkin(node, constraint);
        return hold;
      });
}

NodeFreedom NodeMover::FreedomOf(int node, bool onCut) const
{
  const NodeHold& hold = this->HoldOf(node, onCut);
  return { hold.Constraint, hold.Rings, {} };
}

const NodeMove& NodeMover::Project(int node) const
{
  return this->Memory->Projected.At(node, [&] { return this->FindProjection(node); });
}

NodeMove NodeMover::FindProjection(int node) const
{
  NodeFreedom freedom = this->FreedomOf(node);
  NodeMove move;
  switch (freedom.Constraint.Kind)
  {
    case ConstraintKind::Free:
    {
      const auto foot = this->Surface.ClosestPoint(this->TheBand.Point[node]);
      move.Found = foot.Kind == nurbs::FootKind::Interior && foot.Distance <= this->Reach(node) &&
        this->MayBeAt(node, foot.Point);
      move.Target = foot.Point;
      move.By = Correction::Project;
      return move;
    }
    case ConstraintKind::Faces:
      return this->ProjectOnFaces(node, freedom);
    case ConstraintKind::Ridge:
      return this->SlideAlongRidge(node, freedom.Constraint);
    default:
      return move;
  }
}

template <typename Visit>
void NodeMover::WalkRidge(int node, int firstEdge, const Visit& visit) const
{
  int edge = firstEdge;
  int from = node;
  double walked = 0.0;
  for (int step = 0; step < LongestRidgeWalk; ++step)
  {
    const int to = this->TheBand.OtherEnd(edge, from);
    if (visit(from, to, walked))
    {
      return;
    }
    walked += (this->TheBand.Point[to] - this->TheBand.Point[from]).norm();
    const NodeConstraint& next = this->ConstraintOf(to);
    // Where the ridge beyond the surface goes with what is cut off, the rest of it is one edge.
    const auto on = std::find_if(
      next.RidgeEdges.begin(), next.RidgeEdges.end(), [edge](int ridge) { return ridge != edge; });
    if (next.Kind != ConstraintKind::Ridge || next.SharpCorner || on == next.RidgeEdges.end())
    {
      return;
    }
    edge = *on;
    from = to;
  }
}

bool NodeMover::StaysAtCorner(int node, const NodeConstraint& constraint) const
{
  return this->TheBand.NodeStatus[node] == NodeKeep &&
    (constraint.Kind == ConstraintKind::Fixed || constraint.SharpCorner);
}

NodeMove NodeMover::SlideAlongRidge(int node, const NodeConstraint& constraint) const
{
  NodeMove move;
  if (this->StaysAtCorner(node, constraint))
  {
    return move;
  }
  double best = std::numeric_limits<double>::infinity();
  for (const int first : constraint.RidgeEdges)
  {
    this->WalkRidge(node, first,
      [&](int from, int to, double walked)
      {
        const Vec3& a = this->TheBand.Point[from];
        const Vec3& b = this->TheBand.Point[to];
        const auto hits = this->Surface.Intersect(a, b);
        const double distance =
          hits.empty() ? walked : walked + (b - a).norm() * std::clamp(hits.front().K, 0.0, 1.0);
        if (!hits.empty() && distance < best)
        {
          best = distance;
          move.Found = true;
          move.Target = hits.front().Point;
          move.By = Correction::Slide;
        }
        return !hits.empty() || walked + (b - a).norm() >= best;
      });
  }
  return move;
}

/// Whether a corner of the model is nearer to the surface than half its shortest edge on the
/// border.
bool NodeMover::IsBesideCut(int corner, const NodeConstraint& constraint) const
{
  const Vec3& p = this->TheBand.Point[corner];
  double shortest = std::numeric_limits<double>::infinity();
  for (const int edge : constraint.RidgeEdges)
  {
    const Vec3& end = this->TheBand.Point[this->TheBand.OtherEnd(edge, corner)];
    shortest = std::min(shortest, (end - p).norm());
  }
  return this->Surface.ClosestPoint(p).Distance < BesideCut * shortest;
}

NodeMove NodeMover::EndAtCorner(int node) const
{
  NodeMove move;
  move.By = Correction::Slide;
  move.OnSurface = false;
  const auto isCorner = [this](int n, const NodeConstraint& constraint)
  {
    return constraint.Kind == ConstraintKind::Ridge && constraint.SharpCorner &&
      this->IsBesideCut(n, constraint);
  };
  const NodeConstraint& constraint = this->ConstraintOf(node);
  const bool stays = this->StaysAtCorner(node, constraint);
  const bool isAtEnd = isCorner(node, constraint);
  if (stays || isAtEnd)
  {
    move.Found = stays && isAtEnd;
    move.Target = this->TheBand.Point[node];
    return move;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const int first : constraint.RidgeEdges)
  {
    this->WalkRidge(node, first,
      [&](int, int to, double)
      {
        const Vec3& corner = this->TheBand.Point[to];
        const double away = (corner - this->TheBand.Point[node]).norm();
        if (away < nearest && isCorner(to, this->ConstraintOf(to)))
        {
          nearest = away;
          move.Found = true;
          move.Target = corner;
        }
        return away >= nearest;
      });
  }
  return move;
}

bool NodeMover::IsInSheet(int node) const
{
  const auto elements = this->TheBand.ElementsOfNode(node);
  return !this->TheColumns.IsChosenByCut(node) &&
    std::all_of(
      elements.begin(), elements.end(), [this](int e) { return this->TheColumns.HasThickness(e); });
}

NodeMove NodeMover::ComeToCorner(int node, const Vec3& from) const
{
  NodeMove move = this->IsInSheet(node) ? this->EndAtCorner(node) : NodeMove();
  move.Found = move.Found &&
    this->Surface.ClosestPoint(move.Target).Distance < this->Surface.ClosestPoint(from).Distance;
  return move;
}

NodeMove NodeMover::ProjectOnFaces(int node, NodeFreedom& freedom) const
{
  NodeMove move;
  const Vec3& n = this->TheBand.Point[node];
  const auto foot = this->Surface.ClosestPoint(n);
  if (foot.Kind == nurbs::FootKind::None)
  {
    return move;
  }
  // P1 -> P2: of the facets round the node the one that the way to P2 leads into; on a bent
  // skin another one would leave it.
  double bestLead = -std::numeric_limits<double>::infinity();
  int bestFace = -1;
  Vec3 p2 = n;
  Vec3 planeNormal = Vec3::Zero();
  for (const int f : freedom.Constraint.Faces)
  {
    const auto& face = this->TheBand.Faces[f];
    const int corner = CornerOf(face, node);
    const Facet facet(this->TheBand, face);
    const Vec3 normal = facet.NormalAt(corner);
    const Vec3 along = foot.Normal - normal * normal.dot(foot.Normal);
    Vec3 way = foot.Point - n;
    way -= normal * normal.dot(way);
    if (along.norm() < SmallestSine)
    {
      continue;
    }
    if (way.norm() < 1e-6 * foot.Distance || foot.Distance < this->Precision)
    {
      way = foot.SignedDistance > 0.0 ? Vec3(-along) : along;
    }
    const double lead = facet.LeadsInto(corner, way);
    if (lead > bestLead)
    {
      bestLead = lead;
      bestFace = f;
      p2 = foot.Distance < this->Precision ? n : Vec3(n + way);
      planeNormal = normal.cross(way).normalized();
    }
  }
  if (bestFace < 0)
  {
    return move;
  }
  // P3, on the very facet it lies in.
  move.Target = p2;
  const auto from = this->Surface.ClosestPoint(p2, foot, std::numeric_limits<double>::infinity());
  move.Found = this->Meet(node, bestFace, freedom, from, n, planeNormal, move);
  move.By = Correction::Project;
  const auto& into = this->TheBand.Faces[bestFace];
  move.Elements = Facet(this->TheBand, into).LengthInEdges(CornerOf(into, node), move.Target - n);
  return move;
}

NodeMove NodeMover::Between(int node, const Vec3& through, const Vec3& planeNormal) const
{
  return this->Memory->Middles.At(
    node, { through, planeNormal }, [&] { return this->FindBetween(node, through, planeNormal); });
}

NodeMove NodeMover::FindBetween(int node, const Vec3& through, const Vec3& planeNormal) const
{
  NodeFreedom freedom = this->FreedomOf(node);
  return this->Between(node, freedom, through, this->Surface.ClosestPoint(through), planeNormal);
}

NodeMove NodeMover::Between(int node, NodeFreedom& freedom, const Vec3& through,
  const nurbs::Foot& foot, const Vec3& planeNormal) const
{
  NodeMove move;
  move.Target = through;
  move.By = Correction::Project;
  const auto& constraint = freedom.Constraint;
  if (constraint.Kind == ConstraintKind::Faces)
  {
    move.Found =
      this->Meet(node, constraint.Faces.front(), freedom, foot, through, planeNormal, move);
  }
  else if (constraint.Kind == ConstraintKind::Free)
  {
    move.Found = foot.Kind == nurbs::FootKind::Interior && this->MayBeAt(node, foot.Point);
    move.Target = foot.Point;
  }
  return move;
}

bool NodeMover::MeetFacet(int face, const Vec3& planePoint, const Vec3& planeNormal, Vec3& meeting,
  nurbs::Foot& foot, double& outside) const
{
  const Facet facet(this->TheBand, this->TheBand.Faces[face]);
  Vec3& x = meeting;
  double moved = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 40 && moved > 1e-3 * this->Precision; ++i)
  {
    const auto on = facet.Project(x);
    outside = on.Outside;
    Eigen::Matrix3d m;
    m.row(0) = foot.Normal;
    m.row(1) = on.Normal;
    m.row(2) = planeNormal;
    if (std::abs(m.determinant()) < SmallestSine * SmallestSine)
    {
      return false;
    }
    // Solved for the step, not the position, so that a grid far from the origin loses nothing.
    const Vec3 step = m.inverse() *
      Vec3(foot.Normal.dot(foot.Point - x), on.Normal.dot(on.Point - x),
        planeNormal.dot(planePoint - x));
    x += step;
    // The way leads to the surface, so nothing else is nearer in the end.
    foot = this->Surface.NearbyFoot(x, foot);
    moved = step.norm();
  }
  return foot.Distance <= 0.1 * this->Precision && moved <= 0.1 * this->Precision;
}

const SkinRing& NodeMover::RingOf(NodeFreedom& freedom, std::size_t ring) const
{
  if (!freedom.Rings)
  {
    freedom.Rings =
      std::make_shared<SkinRings>(this->TheBand, this->TheColumns, freedom.Constraint.Faces);
  }
  return freedom.Rings->At(ring);
}

bool NodeMover::Meet(int node, int first, NodeFreedom& freedom, nurbs::Foot foot,
  const Vec3& planePoint, const Vec3& planeNormal, NodeMove& move) const
{
  Vec3& meeting = move.Target;
  double outside = 0.0;
  if (!this->MeetFacet(first, planePoint, planeNormal, meeting, foot, outside))
  {
    return false;
  }
  std::vector<int> tried{ first };
  std::size_t ring = 0;
  while (outside > InsideSlack && tried.size() < 6)
  {
    // The point lies beyond this facet: go on with the one that holds it.
    Vec3 on;
    const int next = this->RingOf(freedom, ring).NearestFace(meeting, tried, on);
    if (next < 0 && ring + 1 < SkinRange)
    {
      ++ring;
      continue;
    }
    if (next < 0)
    {
      return false; // beyond the border of the skin
    }
    tried.push_back(next);
    if ((on - meeting).norm() <= 0.1 * this->Precision)
    {
      outside = 0.0; // it lies in that facet already
    }
    else if (!this->MeetFacet(next, planePoint, planeNormal, meeting, foot, outside))
    {
      return false;
    }
  }
  return outside <= InsideSlack &&
    (meeting - this->TheBand.Point[node]).norm() <= this->Reach(node);
}

const std::vector<int>& NodeMover::SlidingEdges(int node) const
{
  return this->Memory->SlidingEdges.At(node, [&] { return this->FindSlidingEdges(node); });
}

std::vector<int> NodeMover::FindSlidingEdges(int node) const
{
  const NodeConstraint& constraint = this->ConstraintOf(node);
  std::vector<int> edges;
  if (constraint.Kind == ConstraintKind::Ridge || constraint.Kind == ConstraintKind::Fixed)
  {
    return edges;
  }
  for (const int edge : this->TheBand.EdgesOfNode(node))
  {
    if (this->TheColumns.IsThicknessEdge(this->TheBand, edge))
    {
      continue;
    }
    bool onFaces = constraint.Faces.empty();
    const int other = this->TheBand.OtherEnd(edge, node);
    for (const int f : constraint.Faces)
    {
      const auto& face = this->TheBand.Faces[f];
      onFaces |= CornerOf(face, other) < face.Count;
    }
    if (onFaces)
    {
      edges.push_back(edge);
    }
  }
  return edges;
}

const NodeMove& NodeMover::SlideAlong(int node, int edge) const
{
  const std::size_t end = this->TheBand.Edges[edge].First == node ? 0 : 1;
  return this->Memory->Slid.At(2 * edge + end, [&] { return this->FindSlide(node, edge); });
}

NodeMove NodeMover::FindSlide(int node, int edge) const
{
  NodeMove move;
  const Vec3& a = this->TheBand.Point[node];
  const auto hits =
    this->Surface.Intersect(a, this->TheBand.Point[this->TheBand.OtherEnd(edge, node)]);
  if (!hits.empty())
  {
    move.Found = true;
    move.Target = hits.front().Point;
    move.By = Correction::Slide;
    move.Elements = hits.front().K;
  }
  return move;
}

}
