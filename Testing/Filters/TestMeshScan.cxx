/**
 * @file TestMeshScan.cxx
 * @brief What is found of a mesh in one go, row by row where its cells are in rows: volumes, boxes,
 * clusters and what links them, and that no defect is overlooked. The same mesh with its cells in
 * random order, where there are no rows, says what is right.
 */
#include "Expect.h"
#include "MeshBlocks.h"

#include <vtkCellType.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace judge;
using namespace trim;

namespace
{
constexpr int Length = 45, Width = 4, Layers = 2; // no multiple of the cells of a row
constexpr int Nodes = (Length + 1) * (Width + 1) * (Layers + 1);

struct Given
{
  std::string Name;
  int Axis = 0;         ///< of the elements, that their rows go along
  bool Counting = true; ///< node numbers go up by one along the rows
  bool Wedges = false;  ///< here and there one instead of a hexahedron
  bool Apart = false;   ///< a row in the middle is left out
  bool Single = false;  ///< coordinates
  bool Short = false;   ///< ids
};

/// Arrays of a mesh, and the view of them.
struct Arrays
{
  std::vector<double> Doubles;
  std::vector<float> Floats;
  std::vector<vtkTypeInt64> Connectivity, Offsets{ 0 };
  std::vector<vtkTypeInt32> Connectivity32, Offsets32;
  std::vector<unsigned char> Types;
  bool Single = false, Short = false;

  HexMesh View()
  {
    this->Floats.assign(this->Doubles.begin(), this->Doubles.end());
    this->Connectivity32.assign(this->Connectivity.begin(), this->Connectivity.end());
    this->Offsets32.assign(this->Offsets.begin(), this->Offsets.end());
    HexMesh mesh;
    mesh.NumberOfPoints = static_cast<Id>(this->Doubles.size() / 3);
    mesh.NumberOfCells = static_cast<Id>(this->Types.size());
    (this->Single ? void(mesh.PointsFloat = this->Floats.data())
                  : void(mesh.PointsDouble = this->Doubles.data()));
    if (this->Short)
    {
      mesh.Connectivity32 = this->Connectivity32.data();
      mesh.Offsets32 = this->Offsets32.data();
    }
    else
    {
      mesh.Connectivity64 = this->Connectivity.data();
      mesh.Offsets64 = this->Offsets.data();
    }
    mesh.ConnectivitySize = static_cast<Id>(this->Connectivity.size());
    mesh.Types = this->Types.data();
    return mesh;
  }
};

/// Corners of a hexahedron, so turned that its axis goes along the first direction.
constexpr std::array<std::array<int, 8>, 3> Turns{ { { 0, 1, 2, 3, 4, 5, 6, 7 },
  { 3, 0, 1, 2, 7, 4, 5, 6 }, { 4, 0, 3, 7, 5, 1, 2, 6 } } };

/// Cells by row, or in another order.
Arrays MakeArrays(const Given& given, bool shuffled)
{
  Arrays arrays;
  arrays.Single = given.Single;
  arrays.Short = given.Short;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  std::vector<int> number(Nodes);
  std::iota(number.begin(), number.end(), 0);
  if (!given.Counting)
  {
    std::shuffle(number.begin(), number.end(), random);
  }
  arrays.Doubles.resize(3 * Nodes);
  for (int n = 0; n < Nodes; ++n)
  {
    const int place[3] = { n % (Length + 1), n / (Length + 1) % (Width + 1),
      n / (Length + 1) / (Width + 1) };
    for (int k = 0; k < 3; ++k)
    {
      arrays.Doubles[3 * number[n] + k] = place[k] + shift(random);
    }
  }
  std::vector<std::vector<int>> cells;
  for (int c = 0; c < Length * Width * Layers; ++c)
  {
    const int i = c % Length, j = c / Length % Width, k = c / Length / Width;
    const int first = i + (Length + 1) * (j + (Width + 1) * k);
    const int up = (Length + 1) * (Width + 1);
    const int corners[8] = { first, first + 1, first + 2 + Length, first + 1 + Length, first + up,
      first + 1 + up, first + 2 + Length + up, first + 1 + Length + up };
    if (given.Apart && j == Width / 2)
    {
      continue;
    }
    std::vector<int> nodes;
    for (const int corner : Turns[given.Axis])
    {
      nodes.push_back(number[corners[corner]]);
    }
    if (given.Wedges && c % 61 == 7)
    {
      nodes = { number[corners[0]], number[corners[1]], number[corners[3]], number[corners[4]],
        number[corners[5]], number[corners[7]] };
    }
    cells.push_back(nodes);
  }
  if (shuffled)
  {
    std::shuffle(cells.begin(), cells.end(), random);
  }
  for (const auto& nodes : cells)
  {
    arrays.Connectivity.insert(arrays.Connectivity.end(), nodes.begin(), nodes.end());
    arrays.Offsets.push_back(static_cast<vtkTypeInt64>(arrays.Connectivity.size()));
    arrays.Types.push_back(nodes.size() == 8 ? VTK_HEXAHEDRON : VTK_WEDGE);
  }
  return arrays;
}

/// Volumes of all cells, ascending.
std::vector<double> Volumes(const MeshBlocks& blocks)
{
  std::vector<double> volumes(blocks.Volumes.begin(), blocks.Volumes.end());
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

/// Boxes are those of their cells.
void CheckBoxes(const Given& given, const HexMesh& mesh, const MeshBlocks& blocks)
{
  for (Id b = 0; b < blocks.NumberOfBlocks(); ++b)
  {
    Box3 box;
    const Id end = std::min(mesh.NumberOfCells, (b + 1) * MeshBlocks::CellsPerBlock);
    for (Id c = b * MeshBlocks::CellsPerBlock; c < end; ++c)
    {
      const Box3 own = CellBox(mesh, c);
      box.extend(own);
      const Box3 ofRun = blocks.RunBoxes[c / MeshBlocks::CellsPerRun].Box();
      Expect(ofRun.contains(own), given.Name + ": box of run");
    }
    const Box3 found = blocks.Boxes[b].Box();
    Expect(found.min() == box.min() && found.max() == box.max(), given.Name + ": box of block");
  }
}

/// How many pieces the mesh has by its clusters and links; each node has the first of its clusters.
int CountPieces(const Given& given, const HexMesh& mesh, const MeshBlocks& blocks)
{
  std::vector<int> set(blocks.NumberOfClusters() + mesh.NumberOfPoints);
  std::iota(set.begin(), set.end(), 0);
  const std::function<int(int)> find = [&](int i) { return set[i] == i ? i : find(set[i]); };
  std::vector<int> first(mesh.NumberOfPoints, MeshBlocks::NoCluster);
  std::array<Id, 8> nodes;
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    const int count = mesh.Cell(c, nodes);
    const auto cluster = static_cast<int>(blocks.ClusterOf(c));
    const bool isCluster = blocks.AreClusters(cluster / 2);
    for (int i = 0; i < count; ++i)
    {
      first[nodes[i]] = std::min(first[nodes[i]], cluster);
      if (!isCluster)
      {
        set[find(static_cast<int>(blocks.NumberOfClusters() + nodes[i]))] =
          find(static_cast<int>(blocks.NumberOfClusters() + nodes[0]));
      }
    }
  }
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    const bool known = first[p] == MeshBlocks::NoCluster || blocks.AreClusters(first[p] / 2);
    Expect(!known || blocks.FirstClusterOf(p) == first[p], given.Name + ": first cluster of node");
    if (first[p] != MeshBlocks::NoCluster && known)
    {
      set[find(static_cast<int>(blocks.NumberOfClusters() + p))] = find(first[p]);
    }
  }
  for (const auto& links : blocks.Links)
  {
    for (const auto& link : links)
    {
      if (blocks.AreClusters(link.second / 2))
      {
        set[find(link.first)] = find(link.second);
      }
    }
  }
  std::vector<int> roots;
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (first[p] != MeshBlocks::NoCluster)
    {
      roots.push_back(find(static_cast<int>(blocks.NumberOfClusters() + p)));
    }
  }
  std::sort(roots.begin(), roots.end());
  return static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
}

/// Runs that count give the nodes of their cells.
void CheckCounting(const Given& given, const HexMesh& mesh, const MeshBlocks& blocks)
{
  bool some = false;
  std::array<Id, 8> nodes;
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    const Id run = c / MeshBlocks::CellsPerClusterRun;
    if (blocks.Counts[run])
    {
      some = true;
      Expect(mesh.Cell(c, nodes) == 8, given.Name + ": hexahedra count");
      for (int i = 0; i < 8; ++i)
      {
        Expect(nodes[i] == blocks.FirstNodes[run][i] + c % MeshBlocks::CellsPerClusterRun,
          given.Name + ": node of a run that counts");
      }
    }
  }
  Expect(given.Wedges || some == given.Counting, given.Name + ": whether some count");
}

void CheckScan(const Given& given)
{
  Arrays rows = MakeArrays(given, false);
  Arrays mixed = MakeArrays(given, true);
  const HexMesh mesh = rows.View();
  MeshBlocks found, right;
  Expect(ScanMesh(mesh, found) && ScanMesh(mixed.View(), right), given.Name + ": no defect");
  Expect(Volumes(found) == Volumes(right), given.Name + ": volumes to the last bit");
  Expect(found.LargestDiagonal == right.LargestDiagonal && found.LargestCell == right.LargestCell,
    given.Name + ": largest cell");
  Expect(found.Bounds.min() == right.Bounds.min() && found.Bounds.max() == right.Bounds.max(),
    given.Name + ": bounds");
  Expect(found.UnusedNodes == right.UnusedNodes, given.Name + ": unused nodes");
  CheckBoxes(given, mesh, found);
  CheckCounting(given, mesh, found);
  Expect(CountPieces(given, mesh, found) == (given.Apart ? 2 : 1), given.Name + ": pieces");
}

/// Each is found wherever it is in a row.
void CheckDefects(const Given& given)
{
  const std::vector<std::pair<std::string, std::function<void(Arrays&, Id)>>> defects = {
    { "negative id", [](Arrays& a, Id c) { a.Connectivity[8 * c + 3] = -1; } },
    { "id too large", [](Arrays& a, Id c) { a.Connectivity[8 * c + 6] = Nodes; } },
    { "node twice", [](Arrays& a, Id c) { a.Connectivity[8 * c] = a.Connectivity[8 * c + 7]; } },
    { "type", [](Arrays& a, Id c) { a.Types[c] = VTK_VOXEL; } },
    { "number of nodes", [](Arrays& a, Id c) { a.Offsets[c + 1] += 1; } },
    { "infinite coordinate",
      [](Arrays& a, Id c)
      { a.Doubles[3 * a.Connectivity[8 * c + 5]] = std::numeric_limits<double>::infinity(); } },
  };
  for (const auto& [name, damage] : defects)
  {
    for (Id c = 0; c < 40; ++c)
    {
      Arrays arrays = MakeArrays(given, false);
      damage(arrays, c);
      MeshBlocks blocks;
      Expect(!ScanMesh(arrays.View(), blocks),
        given.Name + ": " + name + " in cell " + std::to_string(c) + " is found");
    }
  }
}

}

int main()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool counting : { true, false })
    {
      const std::string name =
        "axis " + std::to_string(axis) + (counting ? ", counting" : ", in random order");
      for (const bool narrow : { false, true })
      {
        const std::string own = name + (narrow ? ", narrow" : "");
        CheckScan({ own, axis, counting, false, false, narrow, narrow });
        CheckScan({ own + ", wedges", axis, counting, true, false, narrow, narrow });
        CheckScan({ own + ", apart", axis, counting, false, true, narrow, narrow });
      }
      CheckDefects({ name, axis, counting });
    }
  }
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
