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
  ClusterJoiner(const HexMesh& mesh, MeshBlocks& blocks, int* clusters, bool alone)
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
    for (const CellRow::Line& line : row.Lines)
    {
      if (!(row.Counts && this->Alone && this->JoinPlain(this->Clusters + line[0], cluster)))
      {
        this->JoinLine(line, cluster);
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

  /// A number that other threads may be at: what std::atomic_ref is in later C++.
  static std::atomic<int>& Shared(int& number)
  {
    static_assert(sizeof(std::atomic<int>) == sizeof(int) && std::atomic<int>::is_always_lock_free,
      "an atomic number is like another one in memory");
    return reinterpret_cast<std::atomic<int>&>(number);
  }

  /// Joins a line of nodes one after the other, of which all that had clusters before had those of
  /// the first or the last node: as most have, and are joined without a question at each node.
  /// False if it is another one.
  /// @param clusters of its nodes.
  bool JoinPlain(int* clusters, int cluster)
  {
    constexpr int last = CellRow::Cells;
    const int own = MeshBlocks::NoCluster - cluster;
    const std::array<int, 2> ends{ clusters[0], clusters[last] };
    int others = 0;
    for (int i = 0; i <= last; ++i)
    {
      others |= (clusters[i] != ends[0]) & (clusters[i] != ends[1]);
    }
    for (const int end : ends)
    {
      others |= end != 0 && end < own;
    }
    if (others != 0)
    {
      return false;
    }
    if (ends[0] == 0 || ends[1] == 0)
    {
      int unknown = 0;
      for (int i = 0; i <= last; ++i)
      {
        unknown += clusters[i] == 0;
        clusters[i] = clusters[i] == 0 ? own : clusters[i];
      }
      this->NumberOfNodes += unknown;
    }
    for (const int end : ends)
    {
      if (end > own)
      {
        this->AddLink(cluster, MeshBlocks::NoCluster - end);
      }
    }
    return true;
  }

  void JoinLine(const CellRow::Line& line, int cluster)
  {
    const int own = MeshBlocks::NoCluster - cluster;
    int known = own; // earlier cluster at the node before: most are the same
    for (const Id node : line)
    {
      std::atomic<int>& first = Shared(this->Clusters[node]);
      const int seen = first.load(std::memory_order_relaxed);
      if (seen != own && seen != known)
      {
        known = this->JoinNode(first, seen, own);
        if (known != own)
        {
          this->AddLink(cluster, MeshBlocks::NoCluster - known);
        }
      }
    }
  }

  /// @param isCluster links to earlier clusters are to be added.
  void JoinCorners(const std::array<Id, 8>& nodes, const int* corners, int count, int cluster,
    bool isCluster, std::array<int, 8>& known)
  {
    int* const clusters = this->Clusters;
    const int own = MeshBlocks::NoCluster - cluster;
    for (int k = 0; k < count; ++k)
    {
      const int i = corners[k];
      std::atomic<int>& first = Shared(clusters[nodes[i]]);
      const int seen = first.load(std::memory_order_relaxed);
      if (seen != own && seen != known[i])
      {
        known[i] = this->JoinNode(first, seen, own);
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
    for (auto known = this->Links.rbegin(); known != this->Links.rend() && known->first == cluster;
         ++known)
    {
      if (known->second == earlier)
      {
        return;
      }
    }
    this->Links.emplace_back(cluster, earlier);
  }

  const HexMesh& Mesh;
  MeshBlocks& Blocks;
  int* Clusters;
  bool Alone;
  MeshBlocks::LinkList Later; ///< from runs that another thread came to first
};

}

#endif
