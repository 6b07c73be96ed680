/**
 * @file SideSets.h
 * @brief Sets of nodes that lie on one side, because cells that the surface does not meet join
 * them.
 *
 * A cluster of the mesh that the surface does not meet is in one set as a whole, so only nodes of
 * other cells are looked at one by one.
 */
#ifndef SideSets_h
#define SideSets_h

#include "ConcurrentSets.h"
#include "MeshBlocks.h"
#include "Runs.h"
#include "Team.h"

#include <algorithm>
#include <array>
#include <vector>

namespace trim
{

/// A set is told by its root: a cluster, or a node behind all clusters. All threads may ask.
template <typename Index>
class SideSets
{
public:
  /// @param candidates cells that the surface may meet, ascending.
  SideSets(const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& candidates)
    : Mesh(mesh)
    , Blocks(blocks)
    , IsFar(blocks.NumberOfClusters())
    , Sets(this->Size())
  {
    for (Id cluster = 0; cluster < blocks.NumberOfClusters(); ++cluster)
    {
      this->IsFar[cluster] = blocks.AreClusters(cluster / 2);
    }
    for (const Id c : candidates)
    {
      this->IsFar[blocks.ClusterOf(c)] = 0;
    }
    this->UniteCells(candidates);
    this->UniteClusters();
  }

  Index Size() const
  {
    return static_cast<Index>(this->Blocks.NumberOfClusters() + this->Mesh.NumberOfPoints);
  }
  /// The set of a node; it changes as sets are united.
  Index Find(Id node) { return this->Sets.Find(this->SetOf(node)); }
  void Unite(Id a, Id b) { this->Sets.Unite(this->SetOf(a), this->SetOf(b)); }

  /// Whether all cells of a cluster lie on one side; its set.
  bool IsFarCluster(Id cluster) const { return this->IsFar[cluster] != 0; }
  Index FindCluster(Id cluster) { return this->Sets.Find(static_cast<Index>(cluster)); }

private:
  /// The set of a node before any are united: its first cluster, if that is far, or one of its own.
  Index SetOf(Id node) const
  {
    const int cluster = this->Blocks.FirstClusterOf(node);
    return cluster == MeshBlocks::NoCluster || !this->IsFar[cluster]
      ? static_cast<Index>(this->Blocks.NumberOfClusters() + node)
      : static_cast<Index>(cluster);
  }

  template <typename Action>
  void ForCells(Id cluster, const Action& action) const
  {
    std::array<Id, 8> nodes;
    // A run that counts is one cluster, and is not read from memory again.
    const auto* const counted = this->Blocks.CountedFrom(cluster / 2);
    const Id begin = this->Blocks.FirstCellOfCluster(cluster);
    const Id end = std::min(this->Mesh.NumberOfCells, this->Blocks.FirstCellOfCluster(cluster + 1));
    if (begin < end && counted)
    {
      std::copy(counted->begin(), counted->end(), nodes.begin());
      for (Id c = begin; c < end; ++c)
      {
        action(c, nodes, 8);
        std::for_each(nodes.begin(), nodes.end(), [](Id& node) { ++node; });
      }
      return;
    }
    for (Id c = begin; c < end; ++c)
    {
      action(c, nodes, this->Mesh.Cell(c, nodes));
    }
  }

  /// Joins the nodes of each cell that the surface does not meet, outside of far clusters.
  void UniteCells(const std::vector<Id>& candidates)
  {
    ParallelFor(0, this->Blocks.NumberOfClusters(), LightGrain,
      [&](Id begin, Id end)
      {
        auto next = std::lower_bound(
          candidates.begin(), candidates.end(), this->Blocks.FirstCellOfCluster(begin));
        for (Id cluster = begin; cluster < end; ++cluster)
        {
          if (!this->IsFar[cluster])
          {
            this->UniteCellsOf(cluster, candidates, next);
          }
        }
      });
  }

  /// @param[in,out] next the first candidate not before the cluster.
  void UniteCellsOf(
    Id cluster, const std::vector<Id>& candidates, std::vector<Id>::const_iterator& next)
  {
    this->ForCells(cluster,
      [&](Id c, const std::array<Id, 8>& nodes, int count)
      {
        if (next != candidates.end() && *next == c)
        {
          ++next;
          return;
        }
        const Index first = this->SetOf(nodes[0]);
        for (int i = 1; i < count; ++i)
        {
          this->Sets.Unite(this->SetOf(nodes[i]), first);
        }
      });
  }

  /// Joins far clusters with one another, and with the sets of their nodes.
  void UniteClusters()
  {
    const auto& lists = this->Blocks.Links;
    ForAll(
      static_cast<int>(lists.size()), [&](int i) { this->UniteLinked(lists[i]); }, 2);
  }

  void UniteLinked(const MeshBlocks::LinkList& links)
  {
    int done = -1; // cluster whose nodes are joined
    for (const auto& link : links)
    {
      if (!this->IsFar[link.first])
      {
        continue;
      }
      if (this->IsFar[link.second])
      {
        this->Sets.Unite(Index(link.first), Index(link.second));
      }
      else if (done != link.first)
      {
        done = link.first;
        this->UniteNodes(done);
      }
    }
  }

  void UniteNodes(Index cluster)
  {
    this->ForCells(cluster,
      [&](Id, const std::array<Id, 8>& nodes, int count)
      {
        for (int i = 0; i < count; ++i)
        {
          const Index set = this->SetOf(nodes[i]);
          if (set != cluster)
          {
            this->Sets.Unite(set, cluster);
          }
        }
      });
  }

  const HexMesh& Mesh;
  const MeshBlocks& Blocks;
  std::vector<char> IsFar; ///< of each cluster
  ConcurrentSets<Index> Sets;
};

}

#endif
