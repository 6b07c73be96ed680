#include "NodeClassification.h"

#include "ElementTopology.h"
#include "EndInside.h"
#include "MixedSides.h"
#include "PieceSides.h"
#include "Runs.h"
#include "SetSides.h"
#include "SideSets.h"
#include "SortUnique.h"
#include "SurfaceEnds.h"
#include "Team.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

namespace trim
{
namespace
{
using nurbs::Foot;
using nurbs::FootKind;

NodeFeet ProjectNearNodes(const HexMesh& mesh, const std::vector<Id>& cells,
  const nurbs::TrimmingSurface& surface, const std::function<bool()>& aborted)
{
  NodeFeet near;
  std::array<Id, 8> nodes;
  for (const Id c : cells)
  {
    const int count = mesh.Cell(c, nodes);
    near.Ids.insert(near.Ids.end(), nodes.begin(), nodes.begin() + count);
  }
  SortUnique(near.Ids);
  near.Feet.resize(near.Ids.size());
  ParallelFor(0, static_cast<Id>(near.Ids.size()), 256,
    [&](Id begin, Id end)
    {
      if (aborted())
      {
        return;
      }
      for (Id i = begin; i < end; ++i)
      {
        near.Feet[i] = surface.ClosestPoint(mesh.Point(near.Ids[i]));
      }
    });
  return near;
}

unsigned char StatusFromFoot(const Foot& foot, double tolerance)
{
  if (foot.Distance <= tolerance)
  {
    return NodeOnSurface;
  }
  if (foot.Kind != FootKind::Interior || foot.SignedDistance == 0.0)
  {
    return NodeUnknown;
  }
  return foot.SignedDistance < 0.0 ? NodeKeep : NodeEliminate;
}

/// A vote for x by its edge to y, if the surface crosses it; else the two share a side.
template <typename Index>
void AskEdge(const HexMesh& mesh, const nurbs::TrimmingSurface& surface, Id x, Id y,
  std::vector<NodeVote>& votes, SideSets<Index>& sets)
{
  const Vec3 a = mesh.Point(x);
  const Vec3 b = mesh.Point(y);
  const auto hits = surface.Intersect(a, b);
  if (hits.empty())
  {
    sets.Unite(x, y);
    return;
  }
  const unsigned char side = hits.front().Normal.dot(b - a) > 0.0 ? NodeKeep : NodeEliminate;
  votes.push_back({ x, { (hits.front().Point - a).norm(), ToPlace(b), side } });
}

/**
 * Nodes whose closest point lies on the border of the surface have no side of their own: they
 * take it from the edges of their cells. An edge that the surface does not meet joins its ends;
 * on one that it does, the first hit's normal tells the side.
 */
template <typename Index>
void ResolveBorderNodes(const HexMesh& mesh, const Piece& piece, const std::vector<Id>& candidates,
  const nurbs::TrimmingSurface& surface, const NodeFeet& near, NodeClassification& result,
  SideSets<Index>& sets)
{
  const bool any = std::any_of(near.Feet.begin(), near.Feet.end(),
    [](const Foot& foot) { return foot.Kind != FootKind::Interior; });
  std::vector<NodeVote> votes;
  std::array<Id, 8> nodes;
  for (std::size_t i = 0; any && i < candidates.size(); ++i)
  {
    const int count = mesh.Cell(candidates[i], nodes);
    const auto& topology = TopologyOf(count);
    for (int e = 0; e < topology.NumberOfEdges; ++e)
    {
      const Id ends[2] = { nodes[topology.Edges[e].First], nodes[topology.Edges[e].Second] };
      for (int side = 0; side < 2; ++side)
      {
        const Id x = ends[side];
        const Id y = ends[1 - side];
        if (near.Feet[near.Find(x)].Kind != FootKind::Interior &&
          result.Status[x] != NodeOnSurface && result.Status[y] != NodeOnSurface)
        {
          AskEdge(mesh, surface, x, y, votes, sets);
        }
      }
    }
  }
  ShareVotes(piece, votes);
  std::unordered_map<Id, SideVote> decisive;
  for (const auto& vote : votes)
  {
    auto& best = decisive[vote.Node];
    if (vote.Vote.Outvotes(best))
    {
      best = vote.Vote;
      result.Status[vote.Node] = vote.Vote.Side;
    }
  }
}

/// A free border of the surface, and how near a node is to it.
struct SurfaceBorder
{
  double Distance = std::numeric_limits<double>::infinity();
  Place At{};
};

/// What is wrong with a surface that leaves nodes on both sides of it joined: it ends within the
/// grid, or else contradicts itself. Collective.
std::string TextOfMixed(const HexMesh& mesh, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const NodeClassification& nodes, const Vec3& mixed)
{
  if (const auto end = FindEndInside(mesh, piece, nodes, surface))
  {
    return EndsInsideText(*end);
  }
  const auto isNearer = [](const SurfaceBorder& a, const SurfaceBorder& b)
  { return std::tie(a.Distance, a.At) < std::tie(b.Distance, b.At); };
  SurfaceBorder nearest;
  for (const auto& foot : nodes.Near.Feet)
  {
    const SurfaceBorder border{ foot.Distance, ToPlace(foot.Point) };
    if (foot.Kind == FootKind::Border && isNearer(border, nearest))
    {
      nearest = border;
    }
  }
  const auto all = piece.All.Gather(std::vector<SurfaceBorder>{ nearest });
  nearest = *std::min_element(all.begin(), all.end(), isNearer);
  return std::isfinite(nearest.Distance) ? EndsInsideText(ToVec3(nearest.At))
                                         : SidesMixedUpText(mixed);
}

struct FarPart
{
  unsigned char Side = NodeKeep;
  bool BesideEnd = false; ///< sees but the border of the surface, and from both sides
};

/// A part that the surface does not meet, by the most decisive of its outermost nodes.
FarPart ClassifyFarPart(const OutermostNodes& nodes, const nurbs::TrimmingSurface& surface)
{
  constexpr double leastCosine = 0.05; // to the normal, of a side that is one
  FarPart part;
  double best = -1.0;
  bool interior = false;
  std::array<bool, 2> sides{};
  const auto& places = nodes.Places();
  for (auto place = places.begin(); place != places.end(); ++place)
  {
    if (std::find(places.begin(), place, *place) != place)
    {
      continue; // of a part of few nodes most are the same
    }
    const Vec3 node = ToVec3(*place);
    const Foot foot = surface.ClosestPoint(node);
    const double cosine = foot.Distance > 0.0 ? std::abs(foot.SignedDistance) / foot.Distance : 0.0;
    const double weight = cosine + (foot.Kind == FootKind::Interior ? 1.0 : 0.0);
    // On the border the signed distance may be zero: the normal decides what it can.
    const double side = (node - foot.Point).dot(foot.Normal);
    interior |= foot.Kind == FootKind::Interior;
    if (std::abs(side) > leastCosine * foot.Distance)
    {
      sides[side > 0.0 ? 1 : 0] = true;
    }
    if (weight > best)
    {
      best = weight;
      part.Side = side > 0.0 ? NodeEliminate : NodeKeep;
    }
  }
  part.BesideEnd = !interior && sides[0] && sides[1];
  return part;
}

/// Gives parts that the surface does not meet their sides.
/// @param parts the outermost nodes of each, by its root. Collective.
void ClassifyFarParts(const Piece& piece, const nurbs::TrimmingSurface& surface,
  const std::vector<std::pair<Id, OutermostNodes>>& parts, SetSides& ofRoot,
  NodeClassification& result)
{
  // Points that no cell uses are parts, too, and there may be many.
  std::vector<char> besideEnd(parts.size());
  ParallelFor(0, static_cast<Id>(parts.size()), 256,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        const FarPart part = ClassifyFarPart(parts[i].second, surface);
        ofRoot.Set(parts[i].first, part.Side);
        besideEnd[i] = part.BesideEnd ? 1 : 0;
      }
    });
  std::vector<Place> own;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (besideEnd[i])
    {
      own.push_back(parts[i].second.Places().front());
    }
  }
  result.PartsBesideEnd = piece.All.Gather(own);
  SortUnique(result.PartsBesideEnd);
}

/// Sides by the root of each set of nodes, from those that were projected or voted for.
/// @return whether no set has both.
template <typename Index>
bool FindSidesOfSets(
  const NodeFeet& near, const NodeClassification& result, SideSets<Index>& sets, SetSides& ofRoot)
{
  bool parted = true;
  for (const Id node : near.Ids)
  {
    const unsigned char status = result.Status[node];
    if (status != NodeKeep && status != NodeEliminate)
    {
      continue;
    }
    const Index root = sets.Find(node);
    const unsigned char side = JoinedSide(ofRoot.Of(root), status);
    ofRoot.Set(root, side);
    parted = parted && side != NodeOnBothSides;
  }
  return parted;
}

/// The nodes of this piece that tell the sides of sets which have both.
template <typename Index>
std::vector<MixedNode> ListMixedNodes(const HexMesh& mesh, const Piece& piece, const NodeFeet& near,
  const NodeClassification& result, const JoinedSets& joined, const SetSides& ofRoot,
  SideSets<Index>& sets)
{
  std::vector<MixedNode> mixed;
  for (const Id node : near.Ids)
  {
    const unsigned char status = result.Status[node];
    const Index root = sets.Find(node);
    if ((status == NodeKeep || status == NodeEliminate) && ofRoot.Of(root) == NodeOnBothSides)
    {
      // What is no other rank's has no number but on its rank.
      const Id part = joined.PartOf(root);
      const Id rank = part < 0 ? piece.All.Rank() : -1;
      mixed.push_back({ { rank, part < 0 ? root : part }, ToPlace(mesh.Point(node)), status });
    }
  }
  return mixed;
}

/// So many nodes are looked at at once: as many as a run of cells in a row adds to those before.
constexpr Id ManyNodes = MeshBlocks::CellsPerClusterRun;

/// Whether so many nodes have the same first cluster and no side yet.
/// @param status of the first of them.
bool AreAlike(const MeshBlocks& blocks, Id first, const unsigned char* status)
{
  const int* const clusters = &blocks.ClusterOfNode[first];
  if (clusters[0] != clusters[ManyNodes - 1])
  {
    return false;
  }
  int differ = 0;
  unsigned char known = 0;
  for (Id k = 0; k < ManyNodes; ++k)
  {
    differ |= clusters[k] ^ clusters[0];
    known |= status[k] ^ NodeUnknown;
  }
  return differ == 0 && known == 0;
}

/// Gives nodes the side of their set; returns, ascending, those that still have none.
template <typename Index>
std::vector<Id> AssignSidesOfNodes(const HexMesh& mesh, const MeshBlocks& blocks,
  const SetSides& ofRoot, SideSets<Index>& sets, NodeClassification& result)
{
  constexpr Id grain = 50000;
  constexpr unsigned char unknown = NodeUnknown;
  std::vector<std::vector<Id>> left(NumberOfRuns(mesh.NumberOfPoints, grain));
  ForRuns(mesh.NumberOfPoints, grain,
    [&](Id part, Id begin, Id end)
    {
      unsigned char* const status = result.Status.data();
      const unsigned char* const sides = result.ClusterSide.data();
      for (Id i = begin; i < end; ++i)
      {
        if (status[i] != NodeUnknown)
        {
          continue;
        }
        const int cluster = blocks.FirstClusterOf(i);
        const unsigned char side = cluster == MeshBlocks::NoCluster ? unknown : sides[cluster];
        if (side != NodeUnknown && i + ManyNodes <= end && AreAlike(blocks, i, status + i))
        {
          std::fill_n(status + i, ManyNodes, side);
          i += ManyNodes - 1;
          continue;
        }
        status[i] = side == NodeUnknown ? ofRoot.Of(sets.Find(i)) : side;
        if (status[i] == NodeUnknown)
        {
          left[part].push_back(i);
        }
      }
    });
  return Joined(left);
}

template <typename Index>
void AssignSidesOfClusters(const MeshBlocks& blocks, const SetSides& ofRoot, SideSets<Index>& sets,
  NodeClassification& result)
{
  constexpr unsigned char unknown = NodeUnknown;
  const auto sideOf = [&](Id cluster)
  { return sets.IsFarCluster(cluster) ? ofRoot.Of(sets.FindCluster(cluster)) : unknown; };
  result.ClusterSide.resize(blocks.NumberOfClusters());
  ParallelFor(0, blocks.NumberOfClusterRuns(), 10000,
    [&](Id begin, Id end)
    {
      for (Id run = begin; run < end; ++run)
      {
        unsigned char* const sides = &result.ClusterSide[2 * run];
        sides[0] = sideOf(2 * run);
        sides[1] = blocks.IsOneCluster(run) ? sides[0] : sideOf(2 * run + 1);
      }
    });
}

/// Gives nodes the side of their set, and far clusters theirs. Returns, by root, the sets that have
/// none: parts of the mesh that the surface does not meet.
template <typename Index>
std::vector<std::pair<Id, OutermostNodes>> AssignSides(const HexMesh& mesh,
  const MeshBlocks& blocks, const SetSides& ofRoot, SideSets<Index>& sets,
  NodeClassification& result)
{
  AssignSidesOfClusters(blocks, ofRoot, sets, result);
  std::vector<std::pair<Id, OutermostNodes>> farParts;
  std::unordered_map<Index, std::size_t> partOfRoot;
  for (const Id i : AssignSidesOfNodes(mesh, blocks, ofRoot, sets, result))
  {
    const Index root = sets.Find(i);
    const auto part = partOfRoot.emplace(root, farParts.size());
    if (part.second)
    {
      farParts.emplace_back(root, OutermostNodes());
    }
    farParts[part.first->second].second.Add(ToPlace(mesh.Point(i)));
  }
  return farParts;
}

template <typename Index>
bool CarryStatus(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const NodeFeet& near, NodeClassification& result,
  SideSets<Index>& sets, std::string& error)
{
  SetSides ofRoot(sets.Size());
  const bool parted = FindSidesOfSets(near, result, sets, ofRoot);
  JoinedSets joined;
  const bool partedAll = joined.Join(
    piece, [&sets](Id node) { return sets.Find(node); }, ofRoot);
  if (piece.All.Any(!parted || !partedAll))
  {
    const Vec3 mixed =
      FindMixedPlace(piece.All, ListMixedNodes(mesh, piece, near, result, joined, ofRoot, sets));
    error = TextOfMixed(mesh, piece, surface, result, mixed);
    return false;
  }
  auto farParts = AssignSides(mesh, blocks, ofRoot, sets, result);
  joined.ShareOutermost(piece, farParts);
  ClassifyFarParts(piece, surface, farParts, ofRoot, result);
  if (!farParts.empty())
  {
    AssignSides(mesh, blocks, ofRoot, sets, result);
  }
  return true;
}

template <typename Index>
bool Classify(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const NodeFeet& near, NodeClassification& result,
  std::string& error)
{
  SideSets<Index> sets(mesh, blocks, result.CandidateCells);
  ResolveBorderNodes(mesh, piece, result.CandidateCells, surface, near, result, sets);
  if (!CarryStatus(mesh, blocks, piece, surface, near, result, sets, error))
  {
    return false;
  }
  // What has all nodes on one side contradicts nothing, but may end in the middle of an element.
  const auto has = [&](unsigned char side)
  {
    return std::any_of(
      near.Ids.begin(), near.Ids.end(), [&](Id node) { return result.Status[node] == side; });
  };
  const auto [keeps, eliminates] =
    piece.All.Any(std::array<bool, 2>{ has(NodeKeep), has(NodeEliminate) });
  if (keeps && eliminates)
  {
    return true;
  }
  const auto end = FindEndInside(mesh, piece, result, surface);
  error = end ? EndsInsideText(*end) : "";
  return !end;
}

/// By the feet of the nodes near the surface.
bool ClassifyByFeet(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, double tolerance, NodeClassification& result,
  std::string& error)
{
  std::fill(result.Status.begin(), result.Status.end(), static_cast<unsigned char>(NodeUnknown));
  result.SignedDistances.clear();
  const NodeFeet& near = result.Near;
  for (std::size_t i = 0; i < near.Ids.size(); ++i)
  {
    const Foot& foot = near.Feet[i];
    result.Status[near.Ids[i]] = StatusFromFoot(foot, tolerance);
    if (foot.Kind == FootKind::Interior)
    {
      result.SignedDistances.emplace_back(near.Ids[i], static_cast<float>(foot.SignedDistance));
    }
  }
  ShareProjections(piece, result);
  return mesh.NumberOfPoints + mesh.NumberOfCells < std::numeric_limits<vtkTypeInt32>::max()
    ? Classify<vtkTypeInt32>(mesh, blocks, piece, surface, near, result, error)
    : Classify<vtkTypeInt64>(mesh, blocks, piece, surface, near, result, error);
}

/// Asks all faces that come to the same place where one has a foot; returns whether one was on the
/// other side.
bool LookAmongTouching(const HexMesh& mesh, const nurbs::TrimmingSurface& surface, NodeFeet& near)
{
  std::atomic<bool> turned{ false };
  ParallelFor(0, static_cast<Id>(near.Ids.size()), 256,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        Foot& foot = near.Feet[i];
        const double before = foot.SignedDistance;
        if (foot.Kind == FootKind::Interior)
        {
          foot = surface.AmongTouching(mesh.Point(near.Ids[i]), foot);
        }
        if (foot.SignedDistance != before)
        {
          turned = true;
        }
      }
    });
  return turned;
}

}

bool ClassifyNodes(const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& nearRuns,
  const Piece& piece, const nurbs::TrimmingSurface& surface, double tolerance,
  const std::function<bool()>& aborted, NodeClassification& result, std::string& error)
{
  result = NodeClassification{};
  result.Status.resize(mesh.NumberOfPoints);
  const Vec3 margin = Vec3::Constant(tolerance);
  const auto mayHaveNodesOn = [&surface, &margin](const Box3& box)
  { return surface.MayIntersect(Grown(box, margin)); };
  result.CandidateCells = FindCells(mesh, blocks, nearRuns, mayHaveNodesOn);

  result.Near = ProjectNearNodes(mesh, result.CandidateCells, surface, aborted);
  if (piece.All.Any(aborted()))
  {
    return false;
  }
  if (ClassifyByFeet(mesh, blocks, piece, surface, tolerance, result, error))
  {
    return true;
  }
  // Seldom, so that it is not worth to be asked before.
  if (!piece.All.Any(LookAmongTouching(mesh, surface, result.Near)))
  {
    return false;
  }
  error.clear();
  return ClassifyByFeet(mesh, blocks, piece, surface, tolerance, result, error);
}

}
