#include "PillarGraph.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// Adds the pillars of an element to `set`, ascending, each once; returns their number.
int PillarsOf(
  const NodeGraph& graph, const Pillars& pillars, std::size_t element, std::array<int, 8>& set)
{
  int count = 0;
  for (int i = graph.Offset[element]; i < graph.Offset[element + 1]; ++i)
  {
    const int p = pillars.Pillar[graph.Connectivity[i]];
    int at = count;
    while (at > 0 && set[at - 1] > p)
    {
      --at;
    }
    if (at > 0 && set[at - 1] == p)
    {
      continue;
    }
    std::copy_backward(set.begin() + at, set.begin() + count, set.begin() + count + 1);
    set[at] = p;
    ++count;
  }
  return count;
}

}

/// Elements above one another have the same pillars: only the first of them is linked.
PillarGraph::PillarGraph(const NodeGraph& graph, const Pillars& pillars)
  : ThePillars(pillars)
{
  PageVector<int> offset{ 0 }, member;
  PageVector<int> head(pillars.Count, -1), next;
  offset.reserve(pillars.Count + 1); // in a sheet there are fewer columns than pillars
  next.reserve(pillars.Count);
  member.reserve(4 * static_cast<std::size_t>(pillars.Count));
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
  this->Link(offset, member);
}

void PillarGraph::Link(const PageVector<int>& offset, const PageVector<int>& member)
{
  const int count = this->ThePillars.Count;
  PageVector<int> first(count + 1, 0);
  for (const int p : member)
  {
    ++first[p + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  PageVector<int> column(member.size());
  PageVector<int> fill(first.begin(), first.end() - 1);
  for (std::size_t c = 0; c + 1 < offset.size(); ++c)
  {
    for (int i = offset[c]; i < offset[c + 1]; ++i)
    {
      column[fill[member[i]]++] = static_cast<int>(c);
    }
  }
  this->Start.reserve(count + 1);
  this->Start.push_back(0);
  this->Neighbour.reserve(3 * member.size());
  PageVector<int> mark(count, -1);
  for (int p = 0; p < count; ++p)
  {
    mark[p] = p;
    for (int k = first[p]; k < first[p + 1]; ++k)
    {
      for (int i = offset[column[k]]; i < offset[column[k] + 1]; ++i)
      {
        if (mark[member[i]] != p)
        {
          mark[member[i]] = p;
          this->Neighbour.push_back(member[i]);
        }
      }
    }
    std::sort(this->Neighbour.begin() + this->Start.back(), this->Neighbour.end());
    this->Start.push_back(static_cast<int>(this->Neighbour.size()));
  }
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
  int widest = 0;
  for (std::size_t p = 0; p < order.size() && widest < enough; ++p)
  {
    for (int k = this->Start[p]; k < this->Start[p + 1]; ++k)
    {
      widest = std::max(widest, first[this->Neighbour[k]] - first[p]);
    }
  }
  return widest;
}

}
