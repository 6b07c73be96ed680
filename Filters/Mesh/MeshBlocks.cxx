#include "MeshBlocks.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// In single precision, a little larger.
Eigen::AlignedBox3f RoundOutwards(const Box3& box)
{
  constexpr float unit = 2.0f * std::numeric_limits<float>::epsilon();
  constexpr float least = std::numeric_limits<float>::min();
  const Eigen::Vector3f low = box.min().cast<float>();
  const Eigen::Vector3f high = box.max().cast<float>();
  return { (low.array() - unit * low.array().abs() - least).matrix(),
    (high.array() + unit * high.array().abs() + least).matrix() };
}

}

Box3 CellBox(const HexMesh& mesh, Id cell)
{
  std::array<Id, 8> nodes;
  const int count = mesh.Cell(cell, nodes);
  Box3 box;
  for (int i = 0; i < count; ++i)
  {
    box.extend(mesh.Point(nodes[i]));
  }
  return box;
}

int PointsOfCell(const HexMesh& mesh, Id cell, ElementPoints& points)
{
  std::array<Id, 8> nodes;
  const int count = mesh.Cell(cell, nodes);
  for (int i = 0; i < count; ++i)
  {
    points[i] = mesh.Point(nodes[i]);
  }
  return count;
}

MeshBlocks BuildMeshBlocks(const HexMesh& mesh)
{
  MeshBlocks blocks;
  const Id count = (mesh.NumberOfCells + MeshBlocks::CellsPerBlock - 1) / MeshBlocks::CellsPerBlock;
  blocks.Boxes.resize(count);
  blocks.RunBoxes.resize(
    (mesh.NumberOfCells + MeshBlocks::CellsPerRun - 1) / MeshBlocks::CellsPerRun);
  blocks.Volumes.resize(mesh.NumberOfCells);
  std::vector<double> largest(count, 0.0);
  vtkSMPTools::For(0, count, 256,
    [&](Id begin, Id end)
    {
      for (Id b = begin; b < end; ++b)
      {
        const Id last = MeshBlocks::EndCell(b, mesh.NumberOfCells);
        Box3 run;
        for (Id c = MeshBlocks::FirstCell(b); c < last; ++c)
        {
          ElementPoints points;
          Box3 box;
          const int nodes = PointsOfCell(mesh, c, points);
          for (int i = 0; i < nodes; ++i)
          {
            box.extend(points[i]);
          }
          blocks.Volumes[c] = std::abs(VolumeOf(points, nodes));
          largest[b] = std::max(largest[b], box.diagonal().squaredNorm());
          run.extend(box);
          if ((c + 1) % MeshBlocks::CellsPerRun == 0 || c + 1 == last)
          {
            blocks.RunBoxes[c / MeshBlocks::CellsPerRun] = RoundOutwards(run);
            blocks.Boxes[b].extend(run);
            run.setEmpty();
          }
        }
      }
    });
  for (Id b = 0; b < count; ++b)
  {
    blocks.Bounds.extend(blocks.Boxes[b]);
    blocks.LargestDiagonal = std::max(blocks.LargestDiagonal, std::sqrt(largest[b]));
  }
  return blocks;
}

void ShareBounds(const Ranks& ranks, MeshBlocks& blocks)
{
  for (int k = 0; k < 3; ++k)
  {
    blocks.Bounds.min()[k] = -ranks.Largest(-blocks.Bounds.min()[k]);
    blocks.Bounds.max()[k] = ranks.Largest(blocks.Bounds.max()[k]);
  }
  blocks.LargestDiagonal = ranks.Largest(blocks.LargestDiagonal);
}

}
