#include "MeshBlocks.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

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

namespace
{

void Lower(std::atomic<int>& value, int other)
{
  int seen = value.load(std::memory_order_relaxed);
  while (other < seen && !value.compare_exchange_weak(seen, other, std::memory_order_relaxed))
  {
  }
}

void PrepareNodes(const HexMesh& mesh, MeshBlocks& blocks)
{
  blocks.RunOfNode.reset(new std::atomic<int>[mesh.NumberOfPoints]);
  vtkSMPTools::For(0, mesh.NumberOfPoints, 100000,
    [&blocks](Id begin, Id end)
    {
      for (Id p = begin; p < end; ++p)
      {
        blocks.RunOfNode[p].store(MeshBlocks::NoRun, std::memory_order_relaxed);
      }
    });
}

/// The earlier runs that a patch shares nodes with.
void LinkPatch(
  const HexMesh& mesh, const MeshBlocks& blocks, int run, std::vector<std::pair<int, int>>& links)
{
  const std::size_t own = links.size();
  int seen = run; // the last one linked, which most nodes after it belong to
  std::array<Id, 8> nodes;
  const Id last = std::min(mesh.NumberOfCells, (run + 1) * MeshBlocks::CellsPerPatch);
  for (Id c = run * MeshBlocks::CellsPerPatch; c < last; ++c)
  {
    const int count = mesh.Cell(c, nodes);
    for (int i = 0; i < count; ++i)
    {
      const int first = blocks.FirstRunOf(nodes[i]);
      if (first == run || first == seen)
      {
        continue;
      }
      seen = first;
      const std::pair<int, int> link(run, first);
      if (std::find(links.begin() + own, links.end(), link) == links.end())
      {
        links.push_back(link);
      }
    }
  }
}

void LinkPatches(const HexMesh& mesh, MeshBlocks& blocks)
{
  constexpr Id grain = 1024;
  const auto runs = static_cast<Id>(blocks.IsPatch.size());
  std::vector<std::vector<std::pair<int, int>>> links((runs + grain - 1) / grain);
  vtkSMPTools::For(0, static_cast<Id>(links.size()), 1,
    [&](Id begin, Id end)
    {
      for (Id run = begin * grain; run < std::min(runs, end * grain); ++run)
      {
        if (blocks.IsPatch[run])
        {
          LinkPatch(mesh, blocks, static_cast<int>(run), links[run / grain]);
        }
      }
    });
  for (const auto& list : links)
  {
    blocks.Links.insert(blocks.Links.end(), list.begin(), list.end());
  }
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (blocks.FirstRunOf(p) == MeshBlocks::NoRun)
    {
      blocks.UnusedNodes.push_back(p);
    }
  }
}

bool ShareNode(const std::array<Id, 8>& a, int countA, const std::array<Id, 8>& b, int countB)
{
  return std::find_first_of(a.begin(), a.begin() + countA, b.begin(), b.begin() + countB) !=
    a.begin() + countA;
}

/// A short run of cells. All of it is read before anything is computed: places that were stored a
/// moment ago are slow to be read in pairs.
struct CellRun
{
  std::array<std::array<Id, 8>, MeshBlocks::CellsPerRun> Nodes;
  std::array<ElementPoints, MeshBlocks::CellsPerRun> Points;
  std::array<int, MeshBlocks::CellsPerRun> Count;
  Id First = 0;
  int Size = 0;

  void Read(const HexMesh& mesh, Id first, Id end)
  {
    this->First = first;
    this->Size = static_cast<int>(std::min(end - first, MeshBlocks::CellsPerRun));
    for (int k = 0; k < this->Size; ++k)
    {
      this->Count[k] = mesh.Cell(first + k, this->Nodes[k]);
      for (int i = 0; i < this->Count[k]; ++i)
      {
        this->Points[k][i] = mesh.Point(this->Nodes[k][i]);
      }
    }
  }
};

/// Whether a run's cells continue a patch, and the first patch of their nodes.
void JoinRun(const CellRun& cells, std::array<Id, 8>& before, int& countBefore, MeshBlocks& blocks)
{
  const Id patch = cells.First / MeshBlocks::CellsPerPatch;
  for (int k = 0; k < cells.Size; ++k)
  {
    const auto& nodes = cells.Nodes[k];
    const int count = cells.Count[k];
    for (int i = 0; i < count; ++i)
    {
      Lower(blocks.RunOfNode[nodes[i]], static_cast<int>(patch));
    }
    blocks.IsPatch[patch] &= (cells.First + k) % MeshBlocks::CellsPerPatch == 0 ||
      ShareNode(nodes, count, before, countBefore);
    before = nodes;
    countBefore = count;
  }
}

/// Volumes of a run's cells; returns the box of all.
Box3 MeasureRun(const CellRun& cells, MeshBlocks& blocks, double& largest)
{
  Box3 run;
  for (int k = 0; k < cells.Size; ++k)
  {
    Box3 box;
    for (int i = 0; i < cells.Count[k]; ++i)
    {
      box.extend(cells.Points[k][i]);
    }
    blocks.Volumes[cells.First + k] = std::abs(VolumeOf(cells.Points[k], cells.Count[k]));
    largest = std::max(largest, box.diagonal().squaredNorm());
    run.extend(box);
  }
  return run;
}

/// What one block of cells tells.
void MeasureBlock(const HexMesh& mesh, Id block, MeshBlocks& blocks, double& largest)
{
  const Id last = MeshBlocks::EndCell(block, mesh.NumberOfCells);
  CellRun cells;
  std::array<Id, 8> before{};
  int countBefore = 0;
  for (Id c = MeshBlocks::FirstCell(block); c < last; c += MeshBlocks::CellsPerRun)
  {
    cells.Read(mesh, c, last);
    JoinRun(cells, before, countBefore, blocks);
    const Box3 run = MeasureRun(cells, blocks, largest);
    blocks.RunBoxes[c / MeshBlocks::CellsPerRun] = RoundOutwards(run);
    blocks.Boxes[block].extend(run);
  }
}

Id Divide(Id count, Id size)
{
  return (count + size - 1) / size;
}

}

MeshBlocks BuildMeshBlocks(const HexMesh& mesh)
{
  static_assert(MeshBlocks::CellsPerBlock % MeshBlocks::CellsPerPatch == 0 &&
      MeshBlocks::CellsPerPatch % MeshBlocks::CellsPerRun == 0,
    "blocks are filled by several threads, patches by runs");
  MeshBlocks blocks;
  const Id count = Divide(mesh.NumberOfCells, MeshBlocks::CellsPerBlock);
  blocks.Boxes.resize(count);
  blocks.RunBoxes.resize(Divide(mesh.NumberOfCells, MeshBlocks::CellsPerRun));
  blocks.Volumes.reset(new double[mesh.NumberOfCells]); // filled by all threads
  blocks.IsPatch.assign(Divide(mesh.NumberOfCells, MeshBlocks::CellsPerPatch), 1);
  std::vector<double> largest(count, 0.0);
  PrepareNodes(mesh, blocks);
  vtkSMPTools::For(0, count, 256,
    [&](Id begin, Id end)
    {
      for (Id b = begin; b < end; ++b)
      {
        MeasureBlock(mesh, b, blocks, largest[b]);
      }
    });
  for (Id b = 0; b < count; ++b)
  {
    blocks.Bounds.extend(blocks.Boxes[b]);
    blocks.LargestDiagonal = std::max(blocks.LargestDiagonal, std::sqrt(largest[b]));
  }
  LinkPatches(mesh, blocks);
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
