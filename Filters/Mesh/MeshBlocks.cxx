#include "MeshBlocks.h"

#include "Runs.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
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
  const int count = mesh.OrientedCell(cell, nodes);
  for (int i = 0; i < count; ++i)
  {
    points[i] = mesh.Point(nodes[i]);
  }
  return count;
}

namespace
{

void FindUnusedNodes(const HexMesh& mesh, MeshBlocks& blocks)
{
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (blocks.FirstClusterOf(p) == MeshBlocks::NoCluster)
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

/// Finds what joins the cells of one stretch of the mesh with the rest, while other threads do so
/// elsewhere: which sets of nodes the links join in the end does not depend on who came first.
class Joiner
{
public:
  Joiner(const HexMesh& mesh, MeshBlocks& blocks, bool alone)
    : Mesh(mesh)
    , Blocks(blocks)
    , Alone(alone)
  {
  }

  std::vector<std::pair<int, int>> Links;
  Id NumberOfNodes = 0; ///< that no cell had used before

  void JoinRun(int run)
  {
    const std::size_t first = this->Links.size();
    const Id begin = run * MeshBlocks::CellsPerClusterRun;
    const Id end = std::min(this->Mesh.NumberOfCells, begin + MeshBlocks::CellsPerClusterRun);
    Id firstLength = MeshBlocks::CellsPerClusterRun;
    int cluster = 2 * run;
    std::array<int, 8> known; // earlier cluster at corners of the cell before: most are the same
    known.fill(MeshBlocks::NoCluster - cluster);
    std::array<Id, 8> nodes{}, before{};
    int countBefore = 0;
    for (Id c = begin; c < end; ++c)
    {
      const int count = this->Mesh.Cell(c, nodes);
      if (c > begin && !ShareNode(nodes, count, before, countBefore))
      {
        firstLength = firstLength == MeshBlocks::CellsPerClusterRun ? c - begin : 0;
        cluster = 2 * run + 1;
        known.fill(MeshBlocks::NoCluster - cluster);
      }
      this->JoinCell(nodes, count, cluster, firstLength > 0, known);
      before = nodes;
      countBefore = count;
    }
    this->Blocks.FirstLength[run] = static_cast<unsigned char>(firstLength);
    if (firstLength == 0)
    {
      this->Links.resize(first);
    }
    this->Links.insert(this->Links.end(), this->Later.begin(), this->Later.end());
    this->Later.clear();
  }

private:
  /// @param isCluster links to earlier clusters are to be added.
  void JoinCell(const std::array<Id, 8>& nodes, int count, int cluster, bool isCluster,
    std::array<int, 8>& known)
  {
    std::atomic<int>* const clusters = this->Blocks.ClusterOfNode.data();
    const int own = MeshBlocks::NoCluster - cluster;
    for (int i = 0; i < count; ++i)
    {
      const int seen = clusters[nodes[i]].load(std::memory_order_relaxed);
      if (seen != own && seen != known[i])
      {
        known[i] = this->JoinNode(clusters[nodes[i]], seen, own);
        if (isCluster && known[i] != own)
        {
          this->AddLink(cluster, MeshBlocks::NoCluster - known[i]);
        }
      }
    }
  }

  /// Clusters are told by how far they are before NoCluster. Returns the first that the node has
  /// now.
  int JoinNode(std::atomic<int>& node, int seen, int own)
  {
    if (this->Alone && seen == 0)
    {
      node.store(own, std::memory_order_relaxed);
      ++this->NumberOfNodes;
      return own;
    }
    while (own > seen && !node.compare_exchange_weak(seen, own, std::memory_order_relaxed))
    {
    }
    this->NumberOfNodes += seen == 0;
    if (seen != 0 && seen < own)
    {
      this->Later.emplace_back(MeshBlocks::NoCluster - seen, MeshBlocks::NoCluster - own);
    }
    return std::max(seen, own);
  }

  void AddLink(int cluster, int earlier)
  {
    // Those of a cluster are the last ones.
    const std::pair<int, int> link(cluster, earlier);
    for (auto known = this->Links.rbegin(); known != this->Links.rend() && known->first == cluster;
         ++known)
    {
      if (*known == link)
      {
        return;
      }
    }
    this->Links.push_back(link);
  }

  const HexMesh& Mesh;
  MeshBlocks& Blocks;
  bool Alone;                             ///< no other thread is at work
  std::vector<std::pair<int, int>> Later; ///< from runs that another thread came to first
};

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
  return HexahedronVolume(
    p, [](const auto& a, const auto& b, const auto& c) { return Determinant(a, b, c); })
    .abs();
}

double MeasureWedge(const HexMesh& mesh, Id cell, RunSize& run)
{
  ElementPoints points;
  const int count = PointsOfCell(mesh, cell, points);
  Box3 box;
  for (int i = 0; i < count; ++i)
  {
    box.extend(points[i]);
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

/// The largest cells of a block.
struct LargestCells
{
  double Diagonal = 0.0;
  Vec3 Sides = Vec3::Zero();
};

/// Boxes and volumes of one block of cells.
template <typename Coordinate>
void MeasureBlock(const HexMesh& mesh, const Coordinate* points, Id block, MeshBlocks& blocks,
  LargestCells& largest)
{
  const Id last = MeshBlocks::EndCell(block, mesh.NumberOfCells);
  for (Id first = MeshBlocks::FirstCell(block); first < last; first += MeshBlocks::CellsPerRun)
  {
    const Id end = std::min(last, first + MeshBlocks::CellsPerRun);
    RunSize run;
    for (Id c = first; c < end;)
    {
      std::array<Id, 8> a, b;
      if (mesh.Cell(c, a) != 8)
      {
        blocks.Volumes[c] = MeasureWedge(mesh, c, run);
        ++c;
        continue;
      }
      const bool two = c + 1 < end && mesh.Cell(c + 1, b) == 8;
      const Two volumes = MeasureHexahedra(points, a, two ? b : a, run);
      blocks.Volumes[c] = volumes[0];
      if (two)
      {
        blocks.Volumes[c + 1] = volumes[1];
      }
      c += two ? 2 : 1;
    }
    const Box3 box = run.Box();
    blocks.RunBoxes[first / MeshBlocks::CellsPerRun] = RoundOutwards(box);
    blocks.Boxes[block].extend(box);
    largest.Diagonal = std::max(largest.Diagonal, std::sqrt(run.Diagonal.maxCoeff()));
    for (int k = 0; k < 3; ++k)
    {
      largest.Sides[k] = std::max(largest.Sides[k], run.Sides[k].maxCoeff());
    }
  }
}

void MeasureAndJoin(
  const HexMesh& mesh, Id block, MeshBlocks& blocks, Joiner& joiner, LargestCells& largest)
{
  constexpr Id runs = MeshBlocks::CellsPerBlock / MeshBlocks::CellsPerClusterRun;
  const Id end = std::min(blocks.NumberOfClusterRuns(), (block + 1) * runs);
  for (Id run = block * runs; run < end; ++run)
  {
    joiner.JoinRun(static_cast<int>(run));
  }
  if (mesh.PointsDouble)
  {
    MeasureBlock(mesh, mesh.PointsDouble, block, blocks, largest);
  }
  else
  {
    MeasureBlock(mesh, mesh.PointsFloat, block, blocks, largest);
  }
}

}

MeshBlocks BuildMeshBlocks(const HexMesh& mesh)
{
  static_assert(MeshBlocks::CellsPerBlock % MeshBlocks::CellsPerClusterRun == 0 &&
      MeshBlocks::CellsPerClusterRun % MeshBlocks::CellsPerRun == 0,
    "blocks are filled by several threads, clusters by runs");
  MeshBlocks blocks;
  const Id count = NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerBlock);
  blocks.Boxes.resize(count);
  blocks.RunBoxes.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerRun));
  blocks.Volumes.resize(mesh.NumberOfCells);
  blocks.FirstLength.resize(NumberOfRuns(mesh.NumberOfCells, MeshBlocks::CellsPerClusterRun));
  std::vector<LargestCells> largest(count);
  blocks.ClusterOfNode = PageVector<std::atomic<int>>(mesh.NumberOfPoints);
  constexpr Id grain = 256;
  const bool alone = vtkSMPTools::GetEstimatedNumberOfThreads() < 2;
  std::vector<Joiner> joiners(NumberOfRuns(count, grain), Joiner(mesh, blocks, alone));
  ForRuns(count, grain,
    [&](Id run, Id begin, Id end)
    {
      for (Id b = begin; b < end; ++b)
      {
        MeasureAndJoin(mesh, b, blocks, joiners[run], largest[b]);
      }
    });
  Id usedNodes = 0;
  for (const Joiner& joiner : joiners)
  {
    usedNodes += joiner.NumberOfNodes;
    blocks.Links.insert(blocks.Links.end(), joiner.Links.begin(), joiner.Links.end());
  }
  for (Id b = 0; b < count; ++b)
  {
    blocks.Bounds.extend(blocks.Boxes[b]);
    blocks.LargestDiagonal = std::max(blocks.LargestDiagonal, largest[b].Diagonal);
    blocks.LargestCell = blocks.LargestCell.cwiseMax(largest[b].Sides);
  }
  if (usedNodes < mesh.NumberOfPoints)
  {
    FindUnusedNodes(mesh, blocks);
  }
  return blocks;
}

}
