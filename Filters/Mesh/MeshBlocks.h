/**
 * @file MeshBlocks.h
 * @brief Boxes round runs of consecutive cells, so that most of a mesh is answered by the run, the
 * volumes of the cells, and which pieces of it are joined.
 *
 * Depends on the mesh alone, so it is kept while only the surface changes.
 */
#ifndef MeshBlocks_h
#define MeshBlocks_h

#include "ElementMap.h"
#include "HexMesh.h"
#include "Runs.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace trim
{
using nurbs::Box3;

/// A box of which many are made at once: left as it is in memory, so that this is touched first by
/// the thread that fills it.
template <typename Scalar>
struct UnsetBox
{
  Eigen::Matrix<Scalar, 3, 1> Low, High;

  Box3 Box() const
  {
    return { this->Low.template cast<double>(), this->High.template cast<double>() };
  }
};

struct MeshBlocks
{
  static constexpr Id CellsPerBlock = 64;
  static constexpr Id CellsPerRun = 8;

  UnsetVector<UnsetBox<double>> Boxes;
  UnsetVector<UnsetBox<float>> RunBoxes; ///< of short runs of cells, rounded outwards
  UnsetVector<double> Volumes;           ///< of every cell, >= 0

  /// Clusters, whole pieces of the mesh: sequences of cells, each but the first of which shares a
  /// node with the one before. Each run of so many cells is two of them, the second one empty but
  /// where a row of elements ends. In a mesh in random order there are none.
  static constexpr Id CellsPerClusterRun = 16;
  std::vector<unsigned char> FirstLength; ///< cells of a run's first cluster; 0: it is no clusters
  /// Of each of these runs: whether it is hexahedra the nodes of each of which are those of the one
  /// before, plus one; the nodes of the first one, else nothing. For where these would be read here
  /// and there.
  std::vector<unsigned char> Counts;
  UnsetVector<std::array<int, 8>> FirstNodes;
  /// How far the first cluster of each node is before NoCluster; 0: it has none.
  PageVector<int> ClusterOfNode;
  /// Cluster and one before it with a common node. All clusters with a node are linked with one
  /// another, through others or through runs that are no clusters.
  using LinkList = std::vector<std::pair<int, int>>;
  std::vector<LinkList> Links; ///< by the stretch of the mesh in which they were found
  std::vector<Id> UnusedNodes; ///< ascending

  Box3 Bounds;                     ///< of all points used by cells
  double LargestDiagonal = 0;      ///< of the boxes of single cells
  Vec3 LargestCell = Vec3::Zero(); ///< largest sides of the boxes of single cells
  bool SomeInsideOut = false;      ///< hexahedra with a volume below zero

  Id NumberOfClusterRuns() const { return static_cast<Id>(this->FirstLength.size()); }
  Id NumberOfClusters() const { return 2 * this->NumberOfClusterRuns(); }
  bool AreClusters(Id run) const { return this->FirstLength[run] > 0; }
  /// The nodes of the first cell of a run that counts, else null.
  const std::array<int, 8>* CountedFrom(Id run) const
  {
    return this->Counts[run] ? &this->FirstNodes[run] : nullptr;
  }
  bool IsOneCluster(Id run) const { return this->FirstLength[run] == CellsPerClusterRun; }
  Id FirstCellOfCluster(Id cluster) const
  {
    const Id run = cluster / 2;
    return run * CellsPerClusterRun + (cluster % 2 == 0 ? 0 : this->FirstLength[run]);
  }
  Id ClusterOf(Id cell) const
  {
    const Id run = cell / CellsPerClusterRun;
    return 2 * run + (cell % CellsPerClusterRun >= this->FirstLength[run]);
  }
  /// The first cluster with a node, or with it in a run that is no clusters; NoCluster: no cell
  /// uses it.
  int FirstClusterOf(Id node) const { return NoCluster - this->ClusterOfNode[node]; }
  static constexpr int NoCluster = std::numeric_limits<int>::max();

  Id NumberOfBlocks() const { return static_cast<Id>(this->Boxes.size()); }
  static Id FirstCellOfRun(Id run) { return run * CellsPerRun; }
  static Id EndCellOfRun(Id run, Id numberOfCells)
  {
    return std::min(numberOfCells, (run + 1) * CellsPerRun);
  }
};

MeshBlocks BuildMeshBlocks(const HexMesh& mesh);

/// The same of a mesh that was not checked: false, and blocks that are not to be used, if it has a
/// defect, or if that is not certain. For each cell to be read from memory once.
bool ScanMesh(const HexMesh& mesh, MeshBlocks& blocks);

/// Places of the nodes of one cell; returns their number.
int PointsOfCell(const HexMesh& mesh, Id cell, ElementPoints& points);

/// The box of one cell.
Box3 CellBox(const HexMesh& mesh, Id cell);

/// A box with so much more on either side.
inline Box3 Grown(const Box3& box, const Vec3& margin)
{
  return { box.min() - margin, box.max() + margin };
}

/**
 * Short runs of cells whose boxes pass a test, ascending: asked of blocks first.
 *
 * @param test of a box; true for every box that holds one for which it is true. Thread-safe.
 */
template <typename Test>
std::vector<Id> FindRuns(const MeshBlocks& blocks, const Test& test)
{
  constexpr Id grain = 64;
  constexpr Id runsPerBlock = MeshBlocks::CellsPerBlock / MeshBlocks::CellsPerRun;
  const Id count = blocks.NumberOfBlocks();
  std::vector<std::vector<Id>> found(NumberOfRuns(count, grain));
  ForRuns(count, grain,
    [&](Id part, Id begin, Id end)
    {
      for (Id b = begin; b < end; ++b)
      {
        if (!test(blocks.Boxes[b].Box()))
        {
          continue;
        }
        const Id last = std::min(static_cast<Id>(blocks.RunBoxes.size()), (b + 1) * runsPerBlock);
        for (Id run = b * runsPerBlock; run < last; ++run)
        {
          if (test(blocks.RunBoxes[run].Box()))
          {
            found[part].push_back(run);
          }
        }
      }
    });
  return Joined(found);
}

/// All cells of some runs.
std::vector<Id> CellsOfRuns(const HexMesh& mesh, const std::vector<Id>& runs);

/// Cells of some runs whose boxes pass a test as that of FindRuns, ascending.
template <typename Test>
std::vector<Id> FindCells(
  const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& runs, const Test& test)
{
  constexpr Id grain = 64;
  const auto count = static_cast<Id>(runs.size());
  const Id lastCell = mesh.NumberOfCells - 1;
  std::vector<std::vector<Id>> found(NumberOfRuns(count, grain));
  const auto searchRun = [&](Id run, std::vector<Id>& cells)
  {
    if (!test(blocks.RunBoxes[run].Box()))
    {
      return;
    }
    const Id first = MeshBlocks::FirstCellOfRun(run);
    const Id last = MeshBlocks::EndCellOfRun(run, mesh.NumberOfCells);
    // All boxes come first, so that the processor waits for the points of several cells at once.
    std::array<Box3, MeshBlocks::CellsPerRun> boxes;
    for (Id c = first; c < last; ++c)
    {
      boxes[c - first] = CellBox(mesh, c);
    }
    for (Id c = first; c < last; ++c)
    {
      if (test(boxes[c - first]))
      {
        cells.push_back(c);
      }
    }
  };
  // The cells lie here and there, so that the processor does not foresee them.
  const auto prefetch = [&](Id i)
  {
    constexpr Id cellsAhead = 4, pointsAhead = 2;
    for (Id k = 0; k < MeshBlocks::CellsPerRun && i + cellsAhead < count; ++k)
    {
      mesh.PrefetchCell(std::min(MeshBlocks::FirstCellOfRun(runs[i + cellsAhead]) + k, lastCell));
    }
    // Neighbours have points in common.
    for (Id k = 0; k < MeshBlocks::CellsPerRun && i + pointsAhead < count; k += 2)
    {
      mesh.PrefetchPoints(
        std::min(MeshBlocks::FirstCellOfRun(runs[i + pointsAhead]) + k, lastCell));
    }
  };
  ForRuns(count, grain,
    [&](Id part, Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        prefetch(i);
        searchRun(runs[i], found[part]);
      }
    });
  return Joined(found);
}

}

#endif
