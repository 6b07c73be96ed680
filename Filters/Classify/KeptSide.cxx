#include "KeptSide.h"

#include "Place.h"
#include "SharedNodes.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// A node of an element nearest to some point.
struct NearestNode
{
  double Distance = std::numeric_limits<double>::infinity(); ///< squared
  Place At{};
  unsigned char Status = NodeUnknown;

  bool IsNearer(const NearestNode& other) const
  {
    return this->Distance != other.Distance ? this->Distance < other.Distance : this->At < other.At;
  }
};

NearestNode FindNearestNode(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const NodeClassification& nodes, const Vec3& point)
{
  NearestNode nearest;
  auto unused = blocks.UnusedNodes.begin();
  for (Id i = 0; i < mesh.NumberOfPoints; ++i)
  {
    if (unused != blocks.UnusedNodes.end() && *unused == i)
    {
      ++unused;
      continue;
    }
    const Vec3 p = mesh.Point(i);
    const double distance = (p - point).squaredNorm();
    if (distance <= nearest.Distance)
    {
      const NearestNode node{ distance, ToPlace(p), nodes.Status[i] };
      nearest = node.IsNearer(nearest) ? node : nearest;
    }
  }
  for (const auto& node : piece.All.Gather(std::vector<NearestNode>{ nearest }))
  {
    nearest = node.IsNearer(nearest) ? node : nearest;
  }
  return nearest;
}

template <typename Statuses>
void TurnSides(Statuses& statuses)
{
  for (auto& status : statuses)
  {
    if (status == NodeKeep || status == NodeEliminate)
    {
      status = static_cast<unsigned char>(status == NodeKeep ? NodeEliminate : NodeKeep);
    }
  }
}

}

bool LiesBeyond(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const NodeClassification& nodes, const Vec3& point)
{
  const auto foot = surface.ClosestPoint(point);
  const NearestNode node = FindNearestNode(mesh, blocks, piece, nodes, point);
  const bool near = foot.Distance < blocks.LargestDiagonal;
  if ((near && foot.Kind == nurbs::FootKind::Interior) || node.Status == NodeOnSurface)
  {
    return foot.SignedDistance > 0.0;
  }
  constexpr double leastSlope = 1e-6; // a crossing, no touch
  const Vec3 way = point - ToVec3(node.At);
  const auto hits = surface.Intersect(ToVec3(node.At), point, 0.0, 1.0);
  const auto last = std::find_if(hits.rbegin(), hits.rend(),
    [&way](const nurbs::LineHit& hit)
    { return std::abs(hit.Normal.dot(way)) > leastSlope * way.norm(); });
  return last == hits.rend() ? node.Status == NodeEliminate : last->Normal.dot(way) > 0.0;
}

void TurnStatuses(NodeClassification& nodes)
{
  TurnSides(nodes.Status);
  TurnSides(nodes.ClusterSide);
  for (auto& node : nodes.SignedDistances)
  {
    node.second = -node.second;
  }
  for (auto& foot : nodes.Near.Feet)
  {
    foot.Normal = -foot.Normal;
    foot.SignedDistance = -foot.SignedDistance;
  }
}

}
