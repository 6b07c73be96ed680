#include "MeshBlocks.h"

#include "CellMeasure.h"
#include "ClusterArrays.h"
#include "ClusterJoiner.h"
#include "Jacobian.h"
#include "Runs.h"
#include "WideLanes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// In single precision, a little larger.
UnsetBox<float> RoundOutwards(const Box3& box)
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
  const int count = mesh.OrientedCell(cell, nodes);
  for (int i = 0; i < count; ++i)
  {
    points[i] = mesh.Point(nodes[i]);
  }
  return count;
}

namespace
{

/// Returns whether their places are finite.
bool FindUnusedNodes(const HexMesh& mesh, MeshBlocks& blocks)
{
  bool finite = true;
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (blocks.FirstClusterOf(p) == MeshBlocks::NoCluster)
    {
      blocks.UnusedNodes.push_back(p);
      finite &= mesh.Point(p).allFinite();
    }
  }
  return finite;
}

/// The volume of a wedge, which the sizes and the box are to take in, too.
double MeasureWedge(const HexMesh& mesh, Id cell, CellSizes& sizes, Box3& box)
{
  ElementPoints points;
  const int count = PointsOfCell(mesh, cell, points);
  Box3 own;
  for (int i = 0; i < count; ++i)
  {
    own.extend(points[i]);
    sizes.Sum[0] += points[i].sum();
  }
  const Vec3 sides = own.sizes();
  for (int k = 0; k < 3; ++k)
  {
    sizes.Sides[k][0] = std::max(sizes.Sides[k][0], sides[k]);
  }
  const double squared = sides[0] * sides[0] + sides[1] * sides[1] + sides[2] * sides[2];
  sizes.Diagonal[0] = std::max(sizes.Diagonal[0], squared);
  box.extend(own);
  return std::abs(VolumeOf(points, count));
}

/// What is found of the cells of several blocks.
struct BlockSizes
{
  double Diagonal = 0.0; ///< the largest
  Vec3 Sides = Vec3::Zero();
  bool Finite = true; ///< all coordinates certainly are
  bool SomeInsideOut = false;
};

/// Measures the blocks of one stretch and joins their cells.
template <typename Coordinate>
class BlockScan
{
public:
  BlockScan(
    const HexMesh& mesh, const Coordinate* points, MeshBlocks& blocks, int* clusters, bool alone)
    : Mesh(mesh)
    , Points(points)
    , Blocks(blocks)
    , Joiner(mesh, blocks, clusters, alone)
  {
  }

  /// False if it has a defect, or if that is not certain.
  bool Scan(Id block)
  {
    constexpr Id runs = MeshBlocks::CellsPerBlock / MeshBlocks::CellsPerClusterRun;
    const Id end = std::min(this->Blocks.NumberOfClusterRuns(), (block + 1) * runs);
    Box3 whole;
    for (Id run = block * runs; run < end; ++run)
    {
      const Id first = run * CellRow::Cells;
      for (Id c = first; c < first + CellRow::Cells; ++c)
      {
        this->Mesh.Prefetch(c + MeshBlocks::CellsPerBlock);
      }
      // Nothing is done with the nodes of a run before all of its cells were looked at.
      if (this->Row.Take(this->Mesh, first))
      {
        this->Blocks.Counts[run] = this->Row.Counts;
        if (this->Row.Counts)
        {
          this->Row.ForCorners(
            0, [&](int k, Id node) { this->Blocks.FirstNodes[run][k] = static_cast<int>(node); });
        }
        this->Joiner.JoinRun(static_cast<int>(run), this->Row);
        this->MeasureInRow(first, whole);
        continue;
      }
      const Id last = std::min(this->Mesh.NumberOfCells, first + CellRow::Cells);
      if (!this->Mesh.AreGood(first, last))
      {
        return false;
      }
      this->Joiner.JoinRun(static_cast<int>(run));
      for (Id c = first; c < last; c += MeshBlocks::CellsPerRun)
      {
        this->MeasureEach(c, std::min(last, c + MeshBlocks::CellsPerRun), whole);
      }
    }
    this->Blocks.Boxes[block] = { whole.min(), whole.max() };
    return true;
  }

  ClusterJoiner& Joined() { return this->Joiner; }
  BlockSizes Sizes() const
  {
    const auto largest = [](const CellSizes::Lanes& lanes)
    { return *std::max_element(lanes.begin(), lanes.end()); };
    BlockSizes sizes;
    sizes.Diagonal = std::sqrt(largest(this->OfCells.Diagonal));
    for (int k = 0; k < 3; ++k)
    {
      sizes.Sides[k] = largest(this->OfCells.Sides[k]);
    }
    sizes.Finite = std::all_of(this->OfCells.Sum.begin(), this->OfCells.Sum.end(),
      [](double sum) { return std::isfinite(sum); });
    sizes.SomeInsideOut = std::any_of(this->OfCells.LeastVolume.begin(),
      this->OfCells.LeastVolume.end(), [](double volume) { return volume < 0.0; });
    return sizes;
  }

private:
  void AddBox(Id first, const Box3& box, Box3& whole)
  {
    this->Blocks.RunBoxes[first / MeshBlocks::CellsPerRun] = RoundOutwards(box);
    whole.extend(box);
  }

  void MeasureInRow(Id first, Box3& whole)
  {
    CellBounds boxes[CellRow::Cells / CellsPerBox];
    this->PointsOfRow.Take(this->Row, this->Points);
    MeasureRow(
      this->PointsOfRow, this->Row.Axis, this->Blocks.Volumes.data() + first, boxes, this->OfCells);
    for (const CellBounds& box : boxes)
    {
      this->AddBox(first, { Vec3(box.Low), Vec3(box.High) }, whole);
      first += CellsPerBox;
    }
  }

  /// Of cells in no row.
  void MeasureEach(Id first, Id end, Box3& whole)
  {
    std::array<Id, CellsPerBox> hexahedra;
    int count = 0;
    Box3 box;
    for (Id c = first; c < end; ++c)
    {
      std::array<Id, 8> nodes;
      if (this->Mesh.Cell(c, nodes) == 8)
      {
        this->Corners.Set(count, this->Points, nodes);
        hexahedra[count++] = c;
      }
      else
      {
        this->Blocks.Volumes[c] = MeasureWedge(this->Mesh, c, this->OfCells, box);
      }
    }
    if (count > 0)
    {
      double volumes[CellsPerBox];
      CellBounds own;
      this->Corners.FillFrom(count);
      MeasureCells(this->Corners, volumes, own, this->OfCells);
      for (int i = 0; i < count; ++i)
      {
        this->Blocks.Volumes[hexahedra[i]] = volumes[i];
      }
      box.extend(Box3(Vec3(own.Low), Vec3(own.High)));
    }
    this->AddBox(first, box, whole);
  }

  const HexMesh& Mesh;
  const Coordinate* Points;
  MeshBlocks& Blocks;
  ClusterJoiner Joiner;
  CellRow Row; ///< the run at hand, if it is one
  RowPoints PointsOfRow;
  CellCorners Corners; ///< of cells in no row
  CellSizes OfCells;
};

/// What a stretch of blocks is found to have.
struct Stretch
{
  BlockSizes Sizes;
  MeshBlocks::LinkList Links;
  Id NumberOfNodes = 0; ///< that no stretch before it in time had used, in the same array
};

/// Returns whether all coordinates certainly are finite.
bool Gather(
  const HexMesh& mesh, std::vector<Stretch>& stretches, ClusterArrays& clusters, MeshBlocks& blocks)
{
  Id usedNodes = -clusters.Join();
  bool finite = true;
  for (Stretch& stretch : stretches)
  {
    blocks.LargestDiagonal = std::max(blocks.LargestDiagonal, stretch.Sizes.Diagonal);
    blocks.LargestCell = blocks.LargestCell.cwiseMax(stretch.Sizes.Sides);
    finite &= stretch.Sizes.Finite;
    blocks.SomeInsideOut |= stretch.Sizes.SomeInsideOut;
    usedNodes += stretch.NumberOfNodes;
    blocks.Links.push_back(std::move(stretch.Links));
  }
  for (const auto& box : blocks.Boxes)
  {
    blocks.Bounds.extend(box.Box());
  }
  return (usedNodes == mesh.NumberOfPoints || FindUnusedNodes(mesh, blocks)) && finite;
}

template <typename Coordinate>
bool Scan(const HexMesh& mesh, const Coordinate* points, MeshBlocks& blocks)
{
  constexpr Id grain = 256;
  ClusterArrays clusters(blocks);
  std::vector<Stretch> stretches(NumberOfRuns(blocks.NumberOfBlocks(), grain));
  std::atomic<bool> good{ true };
  ForRuns(blocks.NumberOfBlocks(), grain,
    [&](Id run, Id begin, Id end)
    {
      ClusterArrays::Array& array = clusters.Take();
      BlockScan<Coordinate> scan(mesh, points, blocks, array.data(), clusters.AreApart());
      nurbs::WithWideLanes( // of nodes and boxes several are looked at at once
        [&](auto)
        {
          for (Id b = begin; b < end && good; ++b)
          {
            if (!scan.Scan(b))
            {
              good = false;
            }
          }
        });
      clusters.Give(array);
      ClusterJoiner& joiner = scan.Joined();
      joiner.Links.shrink_to_fit();
      stretches[run] = { scan.Sizes(), std::move(joiner.Links), joiner.NumberOfNodes };
    });
  return good && Gather(mesh, stretches, clusters, blocks);
}

}

bool ScanMesh(const HexMesh& mesh, MeshBlocks& blocks)
{
  static_assert(MeshBlocks::CellsPerBlock % MeshBlocks::CellsPerClusterRun == 0 &&
      MeshBlocks::CellsPerClusterRun == CellRow::Cells && MeshBlocks::CellsPerRun == CellsPerBox,
    "blocks are filled by several threads, clusters and boxes by rows");
  blocks = MeshBlocks();
  blocks.Boxes.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerBlock));
  blocks.RunBoxes.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerRun));
  blocks.Volumes.resize(mesh.NumberOfCells);
  blocks.FirstLength.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerClusterRun));
  blocks.Counts.resize(blocks.FirstLength.size());
  blocks.FirstNodes.resize(blocks.FirstLength.size());
  blocks.ClusterOfNode = PageVector<int>(mesh.NumberOfPoints);
  return mesh.PointsDouble ? Scan(mesh, mesh.PointsDouble, blocks)
                           : Scan(mesh, mesh.PointsFloat, blocks);
}

MeshBlocks BuildMeshBlocks(const HexMesh& mesh)
{
  MeshBlocks blocks;
  ScanMesh(mesh, blocks);
  return blocks;
}

std::vector<Id> CellsOfRuns(const HexMesh& mesh, const std::vector<Id>& runs)
{
  std::vector<Id> cells;
  cells.reserve(runs.size() * MeshBlocks::CellsPerRun);
  for (const Id run : runs)
  {
    const Id last = MeshBlocks::EndCellOfRun(run, mesh.NumberOfCells);
    for (Id c = MeshBlocks::FirstCellOfRun(run); c < last; ++c)
    {
      cells.push_back(c);
    }
  }
  return cells;
}

}
