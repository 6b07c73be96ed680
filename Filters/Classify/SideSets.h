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

#include "ConcurrentSets.h"
#include "MeshBlocks.h"
#include "Runs.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <vector>

namespace trim
{

/// A set is told by its root: a run of cells, or a node behind all runs. All threads may ask.
template <typename Index>
class SideSets
{
public:
  /// @param candidates cells that the surface may meet, ascending.
  SideSets(const HexMesh& mesh, const MeshBlocks& blocks, const std::vector<Id>& candidates)
    : Mesh(mesh)
    , Blocks(blocks)
    , IsFar(blocks.IsCluster)
    , Sets(this->Size())
  {
    for (const Id c : candidates)
    {
      this->IsFar[c / MeshBlocks::CellsPerCluster] = 0;
    }
    this->UniteCells(candidates);
    this->UniteClusters();
  }

  Index Size() const
  {
    return static_cast<Index>(this->NumberOfRuns() + this->Mesh.NumberOfPoints);
  }
  /// The set of a node; it changes as sets are united.
  Index Find(Id node) { return this->Sets.Find(this->SetOf(node)); }
  void Unite(Id a, Id b) { this->Sets.Unite(this->SetOf(a), this->SetOf(b)); }

  /// Whether all cells of a run lie on one side; its set.
  bool IsFarCluster(Id run) const { return this->IsFar[run] != 0; }
  Index FindCluster(Id run) { return this->Sets.Find(static_cast<Index>(run)); }
  Id NumberOfRuns() const { return static_cast<Id>(this->IsFar.size()); }

private:
  /// The set of a node before any are united: its first run of cells, if that is a far cluster, or
  /// one of its own.
  Index SetOf(Id node) const
  {
    const int run = this->Blocks.FirstRunOf(node);
    return run == MeshBlocks::NoRun || !this->IsFar[run]
      ? static_cast<Index>(this->NumberOfRuns() + node)
      : static_cast<Index>(run);
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
    vtkSMPTools::For(0, this->NumberOfRuns(), LightGrain,
      [&](Id begin, Id end)
      {
        auto next = std::lower_bound(
          candidates.begin(), candidates.end(), begin * MeshBlocks::CellsPerCluster);
        for (Id run = begin; run < end; ++run)
        {
          if (!this->IsFar[run])
          {
            this->UniteCellsOf(run, candidates, next);
          }
        }
      });
  }

  /// @param[in,out] next the first candidate not before the run.
  void UniteCellsOf(
    Id run, const std::vector<Id>& candidates, std::vector<Id>::const_iterator& next)
  {
    this->ForCells(run,
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
    const auto& links = this->Blocks.Links;
    vtkSMPTools::For(0, static_cast<Id>(links.size()), 20000,
      [&](Id begin, Id end)
      {
        int done = -1; // cluster whose nodes are joined
        for (Id i = begin; i < end; ++i)
        {
          const auto& link = links[i];
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
      });
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
  std::vector<char> IsFar; ///< of each run of cells
  ConcurrentSets<Index> Sets;
};

}

#endif
