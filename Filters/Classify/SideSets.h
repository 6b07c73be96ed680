/**
 * @file SideSets.h
 * @brief Sets of nodes that lie on one side, because cells that the surface does not meet join
 * them.
 *
 * A cluster of the mesh that the surface does not meet is in one set as a whole, so only nodes of
 * other runs of cells are looked at one by one.
 */
#ifndef SideSets_h
#define SideSets_h

#include "DisjointSets.h"
#include "MeshBlocks.h"

#include <algorithm>
#include <vector>

namespace trim
{

template <typename Index>
class SideSets
{
public:
  /// @param candidates cells that the surface may meet, ascending.
  SideSets(const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& candidates)
    : Mesh(mesh)
    , Blocks(blocks)
    , IsFar(blocks.IsCluster)
    , Number(mesh.NumberOfPoints)
    , Sets(static_cast<Index>(blocks.IsCluster.size()))
  {
    for (const Id c : candidates)
    {
      this->IsFar[c / MeshBlocks::CellsPerCluster] = 0;
    }
    this->UniteCells(candidates);
    this->UniteClusters();
    this->NumberOtherNodes(candidates);
  }

  Index Size() const { return this->Sets.Size(); }
  /// The set of a node; it changes as sets are united.
  Index Find(Id node) { return this->Sets.Find(this->SetOf(node)); }
  void Unite(Id a, Id b) { this->Sets.Unite(this->SetOf(a), this->SetOf(b)); }

  /// Whether all cells of a run lie on one side; its set.
  bool IsFarCluster(Id run) const { return this->IsFar[run] != 0; }
  Index FindCluster(Id run) { return this->Sets.Find(static_cast<Index>(run)); }
  Id NumberOfRuns() const { return static_cast<Id>(this->IsFar.size()); }

private:
  /// Node that has a number of its own: its first run of cells is no far cluster.
  bool IsSingle(Id node) const
  {
    const int run = this->Blocks.FirstRunOf(node);
    return run == MeshBlocks::NoRun || !this->IsFar[run];
  }
  /// The set of a node before any are united: its cluster, or one of its own.
  Index SetOf(Id node)
  {
    if (!this->IsSingle(node))
    {
      return Index(this->Blocks.FirstRunOf(node));
    }
    // Zero is a run's number, or there is no run: so no node of its own has it.
    Index& number = this->Number[node];
    if (number == 0)
    {
      number = this->Sets.Append();
    }
    return number;
  }

  template <typename Action>
  void ForCells(Id run, const Action& action) const
  {
    std::array<Id, 8> nodes;
    const Id end = std::min(this->Mesh.NumberOfCells, (run + 1) * MeshBlocks::CellsPerCluster);
    for (Id c = run * MeshBlocks::CellsPerCluster; c < end; ++c)
    {
      action(c, nodes, this->Mesh.Cell(c, nodes));
    }
  }

  /// Joins the nodes of each cell that the surface does not meet, outside of clusters.
  void UniteCells(const std::vector<Id>& candidates)
  {
    auto next = candidates.begin();
    Index root = -1;
    for (Id run = 0; run < this->NumberOfRuns(); ++run)
    {
      if (this->IsFar[run])
      {
        continue;
      }
      this->ForCells(run,
        [&](Id c, const std::array<Id, 8>& nodes, int count)
        {
          if (next != candidates.end() && *next == c)
          {
            ++next;
            return;
          }
          // Cells that follow one another are neighbours as a rule, so their root is known.
          const Index first = this->SetOf(nodes[0]);
          if (root < 0 || !this->Sets.HangsOn(first, root))
          {
            root = this->Sets.Find(first);
          }
          for (int i = 1; i < count; ++i)
          {
            root = this->Sets.Attach(this->SetOf(nodes[i]), root);
          }
        });
    }
  }

  /// Joins far clusters with one another, and with the sets of their nodes.
  void UniteClusters()
  {
    int done = -1; // cluster whose nodes are joined
    for (const auto& link : this->Blocks.Links)
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
    Index root = this->Sets.Find(cluster);
    Index before = cluster; // what most nodes after it belong to
    this->ForCells(cluster,
      [&](Id, const std::array<Id, 8>& nodes, int count)
      {
        for (int i = 0; i < count; ++i)
        {
          const Index set = this->SetOf(nodes[i]);
          root = set == before ? root : this->Sets.Attach(set, root);
          before = set;
        }
      });
  }

  /// Numbers nodes that no other cell has.
  void NumberOtherNodes(const std::vector<Id>& candidates)
  {
    for (const Id node : this->Blocks.UnusedNodes)
    {
      this->SetOf(node);
    }
    std::array<Id, 8> nodes;
    for (const Id c : candidates)
    {
      const int count = this->Mesh.Cell(c, nodes);
      for (int i = 0; i < count; ++i)
      {
        this->SetOf(nodes[i]);
      }
    }
  }

  const HexMesh& Mesh;
  const MeshBlocks& Blocks;
  std::vector<char> IsFar;  ///< of each run of cells
  PageVector<Index> Number; ///< of single nodes, 0: none yet
  DisjointSets<Index> Sets;
};

}

#endif
