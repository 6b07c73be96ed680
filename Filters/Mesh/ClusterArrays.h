/**
 * @file ClusterArrays.h
 * @brief The first clusters of nodes, found by several threads: see MeshBlocks.h.
 */
#ifndef ClusterArrays_h
#define ClusterArrays_h

#include "MeshBlocks.h"
#include "Runs.h"
#include "Team.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

namespace trim
{

/// For a few threads an array each, as nodes of cells that two of them come to at the same time,
/// one above the other, would be in both their caches by turns, and each node a locked instruction.
/// What they found is joined afterwards.
class ClusterArrays
{
public:
  using Array = PageVector<int>;

  explicit ClusterArrays(MeshBlocks& blocks)
    : Blocks(blocks)
    , Apart(ThreadsForLoops() <= MostApart)
    , Free{ &blocks.ClusterOfNode }
  {
  }

  /// Whether each array is in use by one thread at a time.
  bool AreApart() const { return this->Apart; }

  /// One that no other thread is at, until it is given back.
  Array& Take()
  {
    const std::lock_guard<std::mutex> locked(this->Lock);
    if (!this->Apart)
    {
      return this->Blocks.ClusterOfNode;
    }
    if (this->Free.empty())
    {
      this->More.push_back(std::make_unique<Array>(this->Blocks.ClusterOfNode.size()));
      return *this->More.back();
    }
    Array* const array = this->Free.back();
    this->Free.pop_back();
    return *array;
  }
  void Give(Array& array)
  {
    const std::lock_guard<std::mutex> locked(this->Lock);
    this->Free.push_back(&array);
  }

  /// Joins all arrays and adds links between the clusters of their nodes; returns how many nodes
  /// were in one array more.
  Id Join()
  {
    constexpr Id grain = 50000;
    const auto count = static_cast<Id>(this->Blocks.ClusterOfNode.size());
    const Id runs = this->More.empty() ? 0 : NumberOfRuns(count, grain);
    std::vector<MeshBlocks::LinkList> links(runs);
    std::vector<Id> again(runs, 0);
    ForRuns(runs > 0 ? count : 0, grain,
      [&](Id run, Id begin, Id end)
      {
        for (const auto& array : this->More)
        {
          again[run] += this->JoinNodes(*array, begin, end, links[run]);
        }
      });
    std::move(links.begin(), links.end(), std::back_inserter(this->Blocks.Links));
    return std::accumulate(again.begin(), again.end(), Id(0));
  }

private:
  /// Each takes 4 bytes a node.
  static constexpr int MostApart = 4;

  Id JoinNodes(const Array& array, Id begin, Id end, MeshBlocks::LinkList& links)
  {
    Id again = 0;
    for (Id node = begin; node < end; ++node)
    {
      const int other = array[node];
      if (other == 0)
      {
        continue;
      }
      int& first = this->Blocks.ClusterOfNode[node];
      const int own = first;
      first = std::max(own, other);
      if (own == 0)
      {
        continue;
      }
      ++again;
      const std::pair<int, int> link(
        MeshBlocks::NoCluster - std::min(own, other), MeshBlocks::NoCluster - std::max(own, other));
      if (links.empty() || links.back() != link)
      {
        links.push_back(link);
      }
    }
    return again;
  }

  MeshBlocks& Blocks;
  bool Apart;
  std::mutex Lock;
  std::vector<Array*> Free;
  std::vector<std::unique_ptr<Array>> More;
};

}

#endif
