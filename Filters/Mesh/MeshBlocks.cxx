#include "MeshBlocks.h"

#include "ClusterJoiner.h"
#include "RowMeasure.h"
#include "Runs.h"

#include <vtkSMPTools.h>

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

/// A coordinate of two cells.
using Two = Eigen::Array2d;

/// A point of each of two cells.
struct TwoPoints
{
  Two X, Y, Z;

  friend TwoPoints operator-(const TwoPoints& a, const TwoPoints& b)
  {
    return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
  }
  friend TwoPoints operator+(const TwoPoints& a, const TwoPoints& b)
  {
    return { a.X + b.X, a.Y + b.Y, a.Z + b.Z };
  }
};

EIGEN_ALWAYS_INLINE Two Determinant(const TwoPoints& a, const TwoPoints& b, const TwoPoints& c)
{
  return (a.Y * b.Z - a.Z * b.Y) * c.X + (a.Z * b.X - a.X * b.Z) * c.Y +
    (a.X * b.Y - a.Y * b.X) * c.Z;
}

/// What is found of the cells of a run.
struct RunSize
{
  Two Low[3], High[3]; ///< the boxes of the first and of the second cells of pairs
  Two Sides[3] = { { 0.0, 0.0 }, { 0.0, 0.0 }, { 0.0, 0.0 } };
  Two Diagonal{ 0.0, 0.0 }; ///< squared
  /// Of terms that each coordinate is in: finite only if all of these are.
  Two Sum{ 0.0, 0.0 };

  RunSize()
  {
    for (int k = 0; k < 3; ++k)
    {
      this->Low[k].setConstant(std::numeric_limits<double>::max());
      this->High[k].setConstant(std::numeric_limits<double>::lowest());
    }
  }
  void Add(const Two (&low)[3], const Two (&high)[3])
  {
    Two squared(0.0, 0.0);
    for (int k = 0; k < 3; ++k)
    {
      this->Low[k] = this->Low[k].min(low[k]);
      this->High[k] = this->High[k].max(high[k]);
      const Two side = high[k] - low[k];
      this->Sides[k] = this->Sides[k].max(side);
      squared += side.square();
    }
    this->Diagonal = this->Diagonal.max(squared);
  }
  Box3 Box() const
  {
    return { Vec3(this->Low[0].minCoeff(), this->Low[1].minCoeff(), this->Low[2].minCoeff()),
      Vec3(this->High[0].maxCoeff(), this->High[1].maxCoeff(), this->High[2].maxCoeff()) };
  }
};

/// Two hexahedra side by side, so that the processor computes both at once; returns the volumes.
template <typename Coordinate>
Two MeasureHexahedra(const Coordinate* points, const std::array<Id, 8>& nodesA,
  const std::array<Id, 8>& nodesB, RunSize& run)
{
  std::array<TwoPoints, 8> p;
  for (int i = 0; i < 8; ++i)
  {
    const Coordinate* a = points + 3 * nodesA[i];
    const Coordinate* b = points + 3 * nodesB[i];
    p[i] = { Two(a[0], b[0]), Two(a[1], b[1]), Two(a[2], b[2]) };
  }
  Two low[3] = { p[0].X, p[0].Y, p[0].Z };
  Two high[3] = { p[0].X, p[0].Y, p[0].Z };
  for (int i = 1; i < 8; ++i)
  {
    low[0] = low[0].min(p[i].X);
    low[1] = low[1].min(p[i].Y);
    low[2] = low[2].min(p[i].Z);
    high[0] = high[0].max(p[i].X);
    high[1] = high[1].max(p[i].Y);
    high[2] = high[2].max(p[i].Z);
  }
  run.Add(low, high);
  const Two volumes = HexahedronVolume(
    p, [](const auto& a, const auto& b, const auto& c) { return Determinant(a, b, c); });
  run.Sum += volumes;
  return volumes.abs();
}

double MeasureWedge(const HexMesh& mesh, Id cell, RunSize& run)
{
  ElementPoints points;
  const int count = PointsOfCell(mesh, cell, points);
  Box3 box;
  for (int i = 0; i < count; ++i)
  {
    box.extend(points[i]);
    run.Sum += points[i].sum();
  }
  Two low[3], high[3];
  for (int k = 0; k < 3; ++k)
  {
    low[k].setConstant(box.min()[k]);
    high[k].setConstant(box.max()[k]);
  }
  run.Add(low, high);
  return std::abs(VolumeOf(points, count));
}

/// What is found of the cells of several blocks.
struct BlockSizes
{
  double Diagonal = 0.0; ///< the largest
  Vec3 Sides = Vec3::Zero();
  bool Finite = true; ///< all coordinates certainly are
};

/// Measures the blocks of one stretch and joins their cells.
template <typename Coordinate>
class BlockScan
{
public:
  BlockScan(const HexMesh& mesh, const Coordinate* points, MeshBlocks& blocks, bool alone)
    : Mesh(mesh)
    , Points(points)
    , Blocks(blocks)
    , Joiner(mesh, blocks, alone)
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
    const auto largest = [](const RowSizes::Lanes& lanes)
    { return *std::max_element(lanes.begin(), lanes.end()); };
    BlockSizes sizes = this->OfEach;
    sizes.Diagonal = std::max(sizes.Diagonal, std::sqrt(largest(this->OfRows.Diagonal)));
    for (int k = 0; k < 3; ++k)
    {
      sizes.Sides[k] = std::max(sizes.Sides[k], largest(this->OfRows.Sides[k]));
    }
    sizes.Finite &= std::all_of(this->OfRows.Sum.begin(), this->OfRows.Sum.end(),
      [](double sum) { return std::isfinite(sum); });
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
    RowBox boxes[CellRow::Cells / CellsPerRowBox];
    this->PointsOfRow.Take(this->Row, this->Points);
    MeasureRow(
      this->PointsOfRow, this->Row.Axis, this->Blocks.Volumes.data() + first, boxes, this->OfRows);
    for (const RowBox& box : boxes)
    {
      this->AddBox(first, { Vec3(box.Low), Vec3(box.High) }, whole);
      first += CellsPerRowBox;
    }
  }

  void MeasureEach(Id first, Id end, Box3& whole)
  {
    RunSize run;
    for (Id c = first; c < end;)
    {
      std::array<Id, 8> a, b;
      if (this->Mesh.Cell(c, a) != 8)
      {
        this->Blocks.Volumes[c] = MeasureWedge(this->Mesh, c, run);
        ++c;
        continue;
      }
      const bool two = c + 1 < end && this->Mesh.Cell(c + 1, b) == 8;
      const Two volumes = MeasureHexahedra(this->Points, a, two ? b : a, run);
      this->Blocks.Volumes[c] = volumes[0];
      if (two)
      {
        this->Blocks.Volumes[c + 1] = volumes[1];
      }
      c += two ? 2 : 1;
    }
    this->AddBox(first, run.Box(), whole);
    BlockSizes& sizes = this->OfEach;
    sizes.Diagonal = std::max(sizes.Diagonal, std::sqrt(run.Diagonal.maxCoeff()));
    for (int k = 0; k < 3; ++k)
    {
      sizes.Sides[k] = std::max(sizes.Sides[k], run.Sides[k].maxCoeff());
    }
    sizes.Finite &= std::isfinite(run.Sum.sum());
  }

  const HexMesh& Mesh;
  const Coordinate* Points;
  MeshBlocks& Blocks;
  ClusterJoiner Joiner;
  CellRow Row; ///< the run at hand, if it is one
  RowPoints PointsOfRow;
  RowSizes OfRows;
  BlockSizes OfEach; ///< of cells in no row
};

/// What a stretch of blocks is found to have.
struct Stretch
{
  BlockSizes Sizes;
  MeshBlocks::LinkList Links;
  Id NumberOfNodes = 0; ///< that no stretch before it in time had used
};

/// Returns whether all coordinates certainly are finite.
bool Gather(const HexMesh& mesh, std::vector<Stretch>& stretches, MeshBlocks& blocks)
{
  Id usedNodes = 0;
  bool finite = true;
  for (Stretch& stretch : stretches)
  {
    blocks.LargestDiagonal = std::max(blocks.LargestDiagonal, stretch.Sizes.Diagonal);
    blocks.LargestCell = blocks.LargestCell.cwiseMax(stretch.Sizes.Sides);
    finite &= stretch.Sizes.Finite;
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
  const bool alone = vtkSMPTools::GetEstimatedNumberOfThreads() < 2;
  std::vector<Stretch> stretches(NumberOfRuns(blocks.NumberOfBlocks(), grain));
  std::atomic<bool> good{ true };
  ForRuns(blocks.NumberOfBlocks(), grain,
    [&](Id run, Id begin, Id end)
    {
      BlockScan<Coordinate> scan(mesh, points, blocks, alone);
      for (Id b = begin; b < end && good; ++b)
      {
        if (!scan.Scan(b))
        {
          good = false;
          return;
        }
      }
      ClusterJoiner& joiner = scan.Joined();
      joiner.Links.shrink_to_fit();
      stretches[run] = { scan.Sizes(), std::move(joiner.Links), joiner.NumberOfNodes };
    });
  return good && Gather(mesh, stretches, blocks);
}

}

bool ScanMesh(const HexMesh& mesh, MeshBlocks& blocks)
{
  static_assert(MeshBlocks::CellsPerBlock % MeshBlocks::CellsPerClusterRun == 0 &&
      MeshBlocks::CellsPerClusterRun == CellRow::Cells && MeshBlocks::CellsPerRun == CellsPerRowBox,
    "blocks are filled by several threads, clusters and boxes by rows");
  blocks = MeshBlocks();
  blocks.Boxes.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerBlock));
  blocks.RunBoxes.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerRun));
  blocks.Volumes.resize(mesh.NumberOfCells);
  blocks.FirstLength.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerClusterRun));
  blocks.ClusterOfNode = PageVector<std::atomic<int>>(mesh.NumberOfPoints);
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
