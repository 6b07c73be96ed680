#include "PillarGraph.h"

#include "ElementTopology.h"

#include <vtkSMPThreadLocal.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// Adds a pillar to `set`, ascending, each once; returns their number.
int AddPillar(int pillar, int count, std::array<int, 8>& set)
{
  int at = count;
  while (at > 0 && set[at - 1] > pillar)
  {
    --at;
  }
  if (at > 0 && set[at - 1] == pillar)
  {
    return count;
  }
  std::copy_backward(set.begin() + at, set.begin() + count, set.begin() + count + 1);
  set[at] = pillar;
  return count + 1;
}

/// The pillars of an element, ascending, each once; returns their number.
int PillarsOf(
  const NodeGraph& graph, const Pillars& pillars, std::size_t element, std::array<int, 8>& set)
{
  std::array<int, 8> own;
  const int size = graph.Offset[element + 1] - graph.Offset[element];
  for (int i = 0; i < size; ++i)
  {
    own[i] = pillars.Pillar[graph.Connectivity[graph.Offset[element] + i]];
  }
  int count = 0;
  // The third direction first, the one that meshers extrude along.
  for (const int axis : { 2, 1, 0 })
  {
    const auto& [lower, upper] = AxisEnds[axis];
    if (size == 8 && own[lower[0]] == own[upper[0]] && own[lower[1]] == own[upper[1]] &&
      own[lower[2]] == own[upper[2]] && own[lower[3]] == own[upper[3]])
    {
      for (const int i : lower)
      {
        count = AddPillar(own[i], count, set);
      }
      return count;
    }
  }
  for (int i = 0; i < size; ++i)
  {
    count = AddPillar(own[i], count, set);
  }
  return count;
}

/// The columns of each pillar, in flat arrays.
struct ColumnsOfPillars
{
  PageVector<int> Start, Column;

  ColumnsOfPillars(const PillarColumns& columns, int pillars)
    : Start(pillars + 1)
    , Column(columns.Member.size())
  {
    for (const int p : columns.Member)
    {
      ++this->Start[p + 1];
    }
    std::partial_sum(this->Start.begin(), this->Start.end(), this->Start.begin());
    PageVector<int> fill(this->Start.begin(), this->Start.end() - 1);
    for (std::size_t c = 0; c + 1 < columns.Offset.size(); ++c)
    {
      for (int i = columns.Offset[c]; i < columns.Offset[c + 1]; ++i)
      {
        this->Column[fill[columns.Member[i]]++] = static_cast<int>(c);
      }
    }
  }
};

/// Appends the neighbours of pillars to a list, those of each ascending, and tells how many.
/// @param mark of each pillar, -1 at first.
void ListNeighbours(const PillarColumns& columns, const ColumnsOfPillars& of, int begin, int end,
  PageVector<int>& mark, PageVector<int>& list, int* degree)
{
  for (int p = begin; p < end; ++p)
  {
    const std::size_t first = list.size();
    mark[p] = p;
    for (int k = of.Start[p]; k < of.Start[p + 1]; ++k)
    {
      const int c = of.Column[k];
      for (int i = columns.Offset[c]; i < columns.Offset[c + 1]; ++i)
      {
        const int other = columns.Member[i];
        if (mark[other] != p)
        {
          mark[other] = p;
          list.push_back(other);
        }
      }
    }
    std::sort(list.begin() + first, list.end());
    degree[p] = static_cast<int>(list.size() - first);
  }
}

}

PillarColumns FindPillarColumns(const NodeGraph& graph, const Pillars& pillars)
{
  PillarColumns columns;
  auto& [offset, member] = columns;
  PageVector<int> head(pillars.Count, -1), next;
  offset.reserve(pillars.Count + 1); // in a sheet there are fewer columns than pillars
  next.reserve(pillars.Count);
  member.reserve(4 * static_cast<std::size_t>(pillars.Count));
  offset.push_back(0);
  std::array<int, 8> set;
  for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
  {
    const int count = PillarsOf(graph, pillars, e, set);
    int twin = head[set[0]];
    while (twin >= 0 &&
      !(offset[twin + 1] - offset[twin] == count &&
        std::equal(set.begin(), set.begin() + count, member.begin() + offset[twin])))
    {
      twin = next[twin];
    }
    if (twin < 0)
    {
      next.push_back(head[set[0]]);
      head[set[0]] = static_cast<int>(next.size()) - 1;
      member.insert(member.end(), set.begin(), set.begin() + count);
      offset.push_back(static_cast<int>(member.size()));
    }
  }
  return columns;
}

PillarGraph::PillarGraph(const PillarColumns& columns, const Pillars& pillars)
  : ThePillars(pillars)
  , Start(pillars.Count + 1)
{
  const ColumnsOfPillars of(columns, pillars.Count);
  // One after the other in one list, or in several that are put together then.
  const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  const int parts = threads > 1 ? 4 * threads : 1;
  const auto beginOf = [&](int part)
  { return static_cast<int>(static_cast<Id>(pillars.Count) * part / parts); };
  std::vector<PageVector<int>> lists(parts);
  vtkSMPThreadLocal<PageVector<int>> marks;
  vtkSMPTools::For(0, parts, 1,
    [&](Id first, Id last)
    {
      PageVector<int>& mark = marks.Local();
      mark.resize(pillars.Count, -1);
      for (Id part = first; part < last; ++part)
      {
        const int begin = beginOf(static_cast<int>(part));
        const int end = beginOf(static_cast<int>(part) + 1);
        lists[part].reserve(3 * static_cast<std::size_t>(of.Start[end] - of.Start[begin]));
        ListNeighbours(columns, of, begin, end, mark, lists[part], this->Start.data() + 1);
      }
    });
  std::partial_sum(this->Start.begin(), this->Start.end(), this->Start.begin());
  if (parts == 1)
  {
    this->Neighbour = std::move(lists.front());
    return;
  }
  this->Neighbour.resize(this->Start.back());
  vtkSMPTools::For(0, parts, 1,
    [&](Id first, Id last)
    {
      for (Id part = first; part < last; ++part)
      {
        std::copy(lists[part].begin(), lists[part].end(),
          this->Neighbour.begin() + this->Start[beginOf(static_cast<int>(part))]);
      }
    });
}

PillarGraph::Levels PillarGraph::FindLevels(int root) const
{
  Levels levels;
  std::vector<char> seen(this->Count(), 0);
  PageVector<int> queue{ root };
  queue.reserve(this->Count());
  seen[root] = 1;
  std::size_t begin = 0;
  while (true)
  {
    const std::size_t end = queue.size();
    for (std::size_t i = begin; i < end; ++i)
    {
      for (int k = this->Start[queue[i]]; k < this->Start[queue[i] + 1]; ++k)
      {
        if (!seen[this->Neighbour[k]])
        {
          seen[this->Neighbour[k]] = 1;
          queue.push_back(this->Neighbour[k]);
        }
      }
    }
    if (queue.size() == end)
    {
      break;
    }
    ++levels.Depth;
    begin = end;
  }
  levels.Last = *std::min_element(queue.begin() + begin, queue.end(),
    [this](int a, int b) { return this->Degree(a) < this->Degree(b); });
  for (const int p : queue)
  {
    levels.Reached += this->ThePillars.Start[p + 1] - this->ThePillars.Start[p];
  }
  return levels;
}

PageVector<int> PillarGraph::ReverseCuthillMcKee(
  const PageVector<int>& roots, const PageVector<int>& rank) const
{
  const int count = this->Count();
  std::vector<char> seen(count, 0);
  PageVector<int> order;
  order.reserve(count);
  const auto before = [this, &rank](int a, int b)
  {
    const int da = this->Degree(a);
    const int db = this->Degree(b);
    return da != db ? da < db : rank[a] < rank[b];
  };
  const auto search = [&](std::size_t from)
  {
    for (std::size_t i = from; i < order.size(); ++i)
    {
      const std::size_t first = order.size();
      for (int k = this->Start[order[i]]; k < this->Start[order[i] + 1]; ++k)
      {
        const int p = this->Neighbour[k];
        if (!seen[p])
        {
          seen[p] = 1;
          order.push_back(p);
        }
      }
      std::sort(order.begin() + first, order.end(), before);
    }
  };
  for (const int root : roots)
  {
    seen[root] = 1;
    order.push_back(root);
  }
  std::sort(order.begin(), order.end(), before);
  search(0);
  if (static_cast<int>(order.size()) < count)
  {
    PageVector<int> rest;
    for (int p = 0; p < count; ++p)
    {
      if (!seen[p])
      {
        rest.push_back(p);
      }
    }
    std::sort(rest.begin(), rest.end(), before);
    for (const int p : rest)
    {
      if (!seen[p])
      {
        seen[p] = 1;
        order.push_back(p);
        search(order.size() - 1);
      }
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

int PillarGraph::Bandwidth(const PageVector<int>& order, int enough) const
{
  PageVector<int> first(order.size());
  int next = 0;
  for (const int p : order)
  {
    first[p] = next;
    next += this->ThePillars.Start[p + 1] - this->ThePillars.Start[p];
  }
  std::atomic<int> widest{ 0 };
  vtkSMPTools::For(0, static_cast<Id>(order.size()), 20000,
    [&](Id begin, Id end)
    {
      int own = 0;
      for (Id p = begin; p < end && std::max(own, widest.load()) < enough; ++p)
      {
        for (int k = this->Start[p]; k < this->Start[p + 1]; ++k)
        {
          own = std::max(own, first[this->Neighbour[k]] - first[p]);
        }
      }
      int seen = widest.load();
      while (own > seen && !widest.compare_exchange_weak(seen, own))
      {
      }
    });
  return widest.load();
}

}
