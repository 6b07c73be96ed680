/**
 * @file ClusterJoiner.h
 * @brief Finds the clusters of a mesh and what links them: see MeshBlocks.h.
 */
#ifndef ClusterJoiner_h
#define ClusterJoiner_h

#include "CellRow.h"
#include "MeshBlocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>
#include <vector>

namespace trim
{

inline bool ShareNode(
  const std::array<Id, 8>& a, int countA, const std::array<Id, 8>& b, int countB)
{
  return std::find_first_of(a.begin(), a.begin() + countA, b.begin(), b.begin() + countB) !=
    a.begin() + countA;
}

/// Finds what joins the cells of one stretch of the mesh with the rest, while other threads do so
/// elsewhere: which sets of nodes the links join in the end does not depend on who came first.
class ClusterJoiner
{
public:
  /// @param clusters first ones of the nodes.
  /// @param alone whether no other thread is at these.
  ClusterJoiner(const HexMesh& mesh, MeshBlocks& blocks, std::atomic<int>* clusters, bool alone)
    : Mesh(mesh)
    , Blocks(blocks)
    , Clusters(clusters)
    , Alone(alone)
  {
  }

  MeshBlocks::LinkList Links;
  Id NumberOfNodes = 0; ///< that had no cluster before

  /// Finds the clusters of a run, and adds their nodes and links.
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
      const int row = count == 8 && countBefore == 8 ? AxisOfRow(before, nodes) : -1;
      if (row < 0 && c > begin && !ShareNode(nodes, count, before, countBefore))
      {
        firstLength = firstLength == MeshBlocks::CellsPerClusterRun ? c - begin : 0;
        cluster = 2 * run + 1;
        known.fill(MeshBlocks::NoCluster - cluster);
      }
      // Within a row the other nodes were joined with the cell before.
      const int* const corners = row >= 0 ? RowAxes[row].End.data() : AllCorners.data();
      this->JoinCorners(nodes, corners, row >= 0 ? 4 : count, cluster, firstLength > 0, known);
      before = nodes;
      countBefore = count;
    }
    this->Blocks.FirstLength[run] = static_cast<unsigned char>(firstLength);
    if (firstLength == 0)
    {
      this->Links.resize(first);
    }
    this->AddLater();
  }

  /// The same of a run whose cells are in a row.
  void JoinRun(int run, const CellRow& row)
  {
    const int cluster = 2 * run;
    const int own = MeshBlocks::NoCluster - cluster;
    std::atomic<int>* const clusters = this->Clusters;
    for (const CellRow::Line& line : row.Lines)
    {
      int known = own; // earlier cluster at the node before: most are the same
      for (const Id node : line)
      {
        const int seen = clusters[node].load(std::memory_order_relaxed);
        if (seen != own && seen != known)
        {
          known = this->JoinNode(clusters[node], seen, own);
          if (known != own)
          {
            this->AddLink(cluster, MeshBlocks::NoCluster - known);
          }
        }
      }
    }
    this->Blocks.FirstLength[run] = MeshBlocks::CellsPerClusterRun;
    this->AddLater();
  }

private:
  static constexpr std::array<int, 8> AllCorners{ 0, 1, 2, 3, 4, 5, 6, 7 };

  void AddLater()
  {
    this->Links.insert(this->Links.end(), this->Later.begin(), this->Later.end());
    this->Later.clear();
  }

  /// @param isCluster links to earlier clusters are to be added.
  void JoinCorners(const std::array<Id, 8>& nodes, const int* corners, int count, int cluster,
    bool isCluster, std::array<int, 8>& known)
  {
    std::atomic<int>* const clusters = this->Clusters;
    const int own = MeshBlocks::NoCluster - cluster;
    for (int k = 0; k < count; ++k)
    {
      const int i = corners[k];
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
  std::atomic<int>* Clusters;
  bool Alone;
  MeshBlocks::LinkList Later; ///< from runs that another thread came to first
};

}

#endif
