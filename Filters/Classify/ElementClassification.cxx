#include "ElementClassification.h"

#include "Status.h"
#include "Team.h"

#include <algorithm>

namespace trim
{
namespace
{

ElementStatus StatusOfCell(const HexMesh& mesh, const NodeClassification& nodes, Id cell)
{
  std::array<Id, 8> node;
  std::array<unsigned char, 8> status;
  const int count = mesh.Cell(cell, node);
  for (int i = 0; i < count; ++i)
  {
    status[i] = nodes.Status[node[i]];
  }
  return StatusOfElement(status.data(), count);
}

/// Whether a cell whose nodes all are on the surface lies beyond it: in a slot of one element.
bool LiesBetween(const HexMesh& mesh, const nurbs::TrimmingSurface& surface, double rounding,
  const NodeClassification& nodes, Id cell)
{
  std::array<Id, 8> node;
  const int count = mesh.Cell(cell, node);
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < count; ++i)
  {
    if (nodes.Status[node[i]] != NodeOnSurface)
    {
      return false;
    }
    middle += mesh.Point(node[i]) / count;
  }
  const auto foot = surface.ClosestPoint(middle);
  return foot.Kind == nurbs::FootKind::Interior && foot.SignedDistance > rounding;
}

/// The first node of a cell; in a run that counts without a look at the cell.
Id FirstNodeOf(const HexMesh& mesh, const MeshBlocks& blocks, Id cell)
{
  const auto* const counted = blocks.CountedFrom(cell / MeshBlocks::CellsPerClusterRun);
  return counted ? (*counted)[0] + cell % MeshBlocks::CellsPerClusterRun : mesh.FirstNode(cell);
}

/// Sets the statuses of the cells of some clusters by a node of theirs, those of candidates for
/// now.
void ClassifyClusters(const HexMesh& mesh, const MeshBlocks& blocks,
  const NodeClassification& nodes, Id begin, Id end, UnsetVector<unsigned char>& status)
{
  const auto& sides = nodes.ClusterSide;
  for (Id cluster = begin, next; cluster < end; cluster = next)
  {
    const unsigned char side = sides[cluster];
    next = std::find_if(sides.begin() + cluster, sides.begin() + end,
             [side](unsigned char other) { return other != side; }) -
      sides.begin();
    const Id first = blocks.FirstCellOfCluster(cluster);
    const Id last = std::min(mesh.NumberOfCells, blocks.FirstCellOfCluster(next));
    if (side == NodeKeep || side == NodeEliminate)
    {
      std::fill(status.begin() + first, status.begin() + last,
        side == NodeKeep ? ElementKeep : ElementEliminate);
      continue;
    }
    for (Id c = first; c < last; ++c)
    {
      const unsigned char node = nodes.Status[FirstNodeOf(mesh, blocks, c)];
      status[c] = node == NodeKeep ? ElementKeep
        : node == NodeEliminate    ? ElementEliminate
                                   : StatusOfCell(mesh, nodes, c);
    }
  }
}

}

UnsetVector<unsigned char> ClassifyElements(const HexMesh& mesh, const MeshBlocks& blocks,
  const nurbs::TrimmingSurface& surface, double rounding, const NodeClassification& nodes)
{
  UnsetVector<unsigned char> status(mesh.NumberOfCells);
  ParallelFor(0, blocks.NumberOfClusters(), 6000,
    [&](Id begin, Id end) { ClassifyClusters(mesh, blocks, nodes, begin, end, status); });
  for (const Id c : nodes.CandidateCells)
  {
    status[c] = LiesBetween(mesh, surface, rounding, nodes, c) ? ElementEliminate
                                                               : StatusOfCell(mesh, nodes, c);
  }
  return status;
}

}
