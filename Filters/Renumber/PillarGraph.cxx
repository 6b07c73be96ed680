#include "PillarGraph.h"

#include "ElementTopology.h"
#include "Team.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <vector>

namespace trim
{
namespace
{

/// The pillars of an element, from `column` on; returns their end.
int* ListPillars(const NodeGraph& graph, const Pillars& pillars, std::size_t element, int* column)
{
  const int size = graph.Offset[element + 1] - graph.Offset[element];
  const int* nodes = graph.Connectivity.data() + graph.Offset[element];
  std::array<int, 8> own;
  for (int i = 0; i < size; ++i)
  {
    own[i] = pillars.Pillar[nodes[i]];
  }
  // The third direction first, the one that meshers extrude along.
  for (const int axis : { 2, 1, 0 })
  {
    const auto& [lower, upper] = AxisEnds[axis];
    if (size == 8 && own[lower[0]] == own[upper[0]] && own[lower[1]] == own[upper[1]] &&
      own[lower[2]] == own[upper[2]] && own[lower[3]] == own[upper[3]])
    {
      for (const int i : lower)
      {
        *column++ = own[i];
      }
      return column;
    }
  }
  return std::copy_n(own.begin(), size, column);
}

/**
 * The pillars of each column. Elements above one another that have their nodes in the same order
 * are one column; others may be several with the same pillars, which changes nothing for a search.
 */
IndexGroups FindPillarColumns(const NodeGraph& graph, const Pillars& pillars)
{
  IndexGroups columns;
  // As if there were none above one another: what is not written to takes no memory.
  columns.Offset.resize(graph.Offset.size());
  columns.Member.resize(graph.Connectivity.size());
  PageVector<int> next(graph.Offset.size());
  PageVector<int> head(pillars.Count, -1); // columns by their first pillar
  int* end = columns.Member.data();
  int count = 0;
  for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
  {
    int* const begin = end;
    end = ListPillars(graph, pillars, e, begin);
    int twin = head[*begin];
    while (twin >= 0 && !std::equal(begin, end, columns.begin(twin), columns.end(twin)))
    {
      twin = next[twin];
    }
    if (twin >= 0)
    {
      end = begin;
      continue;
    }
    next[count] = head[*begin];
    head[*begin] = count;
    columns.Offset[++count] = static_cast<int>(end - columns.Member.data());
  }
  columns.Offset.resize(count + 1);
  columns.Member.resize(columns.Offset.back());
  return columns;
}

/// For each of so many members the groups that it is in.
IndexGroups Inverse(const IndexGroups& groups, int members)
{
  IndexGroups inverse;
  inverse.Offset.resize(members + 1);
  for (const int m : groups.Member)
  {
    ++inverse.Offset[m];
  }
  std::partial_sum(inverse.Offset.begin(), inverse.Offset.end(), inverse.Offset.begin());
  inverse.Member.resize(groups.Member.size());
  for (int g = groups.Count() - 1; g >= 0; --g) // from the ends, so that they come ascending
  {
    for (const int* m = groups.begin(g); m != groups.end(g); ++m)
    {
      inverse.Member[--inverse.Offset[*m]] = g;
    }
  }
  return inverse;
}

}

/// Lists the pillars in the order in which a search comes to them.
class PillarGraph::BreadthFirst
{
public:
  explicit BreadthFirst(const PillarGraph& graph)
    : Graph(graph)
    , Seen(graph.Count(), 0)
    , ColumnSeen(graph.PillarsOf.Count(), 0)
  {
    this->Order.reserve(graph.Count());
  }

  bool IsSeen(int pillar) const { return this->Seen[pillar] != 0; }

  void Add(int pillar)
  {
    this->Seen[pillar] = 1;
    this->Order.push_back(pillar);
  }

  /// Adds the neighbours of a pillar that were not seen before, in any order.
  void AddNeighbours(int pillar)
  {
    const IndexGroups &columnsOf = this->Graph.ColumnsOf, &pillarsOf = this->Graph.PillarsOf;
    for (const int* c = columnsOf.begin(pillar); c != columnsOf.end(pillar); ++c)
    {
      if (this->ColumnSeen[*c])
      {
        continue;
      }
      this->ColumnSeen[*c] = 1;
      for (const int* p = pillarsOf.begin(*c); p != pillarsOf.end(*c); ++p)
      {
        if (!this->Seen[*p])
        {
          this->Add(*p);
        }
      }
    }
  }

  PageVector<int> Order;

private:
  const PillarGraph& Graph;
  std::vector<char> Seen, ColumnSeen;
};

/// Counts the neighbours of pillars.
class PillarGraph::Degrees
{
public:
  explicit Degrees(const PillarGraph& graph)
    : Graph(graph)
    , Mark(graph.Count())
  {
  }

  int operator()(int pillar)
  {
    const IndexGroups &columnsOf = this->Graph.ColumnsOf, &pillarsOf = this->Graph.PillarsOf;
    this->Mark[pillar] = ++this->Asked;
    int degree = 0;
    for (const int* c = columnsOf.begin(pillar); c != columnsOf.end(pillar); ++c)
    {
      for (const int* p = pillarsOf.begin(*c); p != pillarsOf.end(*c); ++p)
      {
        degree += this->Mark[*p] != this->Asked;
        this->Mark[*p] = this->Asked;
      }
    }
    return degree;
  }

private:
  const PillarGraph& Graph;
  PageVector<int> Mark; ///< the question for which a pillar was counted last
  int Asked = 0;        ///< questions
};

/// The search of Cuthill and McKee.
class PillarGraph::CuthillMcKee : public BreadthFirst
{
public:
  /// @param rank, enough see ReverseCuthillMcKee.
  CuthillMcKee(const PillarGraph& graph, const PageVector<int>& rank, int enough)
    : BreadthFirst(graph)
    , ThePillars(graph.ThePillars)
    , Rank(rank)
    , Enough(enough)
    , Degree(graph)
  {
  }

  /// Searches from roots that were not seen before. False once the bandwidth is no less than
  /// enough.
  bool Run(const PageVector<int>& roots)
  {
    const std::size_t begin = this->Order.size();
    std::for_each(roots.begin(), roots.end(), [this](int root) { this->Add(root); });
    this->Sort(this->Order, begin);
    int behind = this->NodesFrom(begin); // those of the pillars behind the one that is looked at
    for (std::size_t i = begin; i < this->Order.size(); ++i)
    {
      const std::size_t first = this->Order.size();
      this->AddNeighbours(this->Order[i]);
      this->Sort(this->Order, first);
      behind += this->NodesFrom(first) - this->ThePillars.Size(this->Order[i]);
      // They are numbered from the end: this is the difference to the last neighbour.
      if (first < this->Order.size() && behind >= this->Enough)
      {
        return false;
      }
    }
    return true;
  }

  /// Sorts pillars, from one in the list on, by rising degree and among equals by rank.
  void Sort(PageVector<int>& pillars, std::size_t begin)
  {
    if (pillars.size() < begin + 2)
    {
      return;
    }
    this->Keys.clear();
    std::transform(pillars.begin() + begin, pillars.end(), std::back_inserter(this->Keys),
      [this](int p) {
        return Key{ this->Degree(p), this->Rank[p], p };
      });
    std::sort(this->Keys.begin(), this->Keys.end());
    std::transform(this->Keys.begin(), this->Keys.end(), pillars.begin() + begin,
      [](const Key& key) { return key.back(); });
  }

private:
  using Key = std::array<int, 3>; ///< degree, rank, pillar

  int NodesFrom(std::size_t begin) const
  {
    return std::accumulate(this->Order.begin() + begin, this->Order.end(), 0,
      [this](int sum, int p) { return sum + this->ThePillars.Size(p); });
  }

  const Pillars& ThePillars;
  const PageVector<int>& Rank;
  const int Enough;
  Degrees Degree;
  std::vector<Key> Keys;
};

PillarGraph::PillarGraph(const NodeGraph& graph, const Pillars& pillars)
  : ThePillars(pillars)
  , PillarsOf(FindPillarColumns(graph, pillars))
  , ColumnsOf(Inverse(this->PillarsOf, pillars.Count))
{
}

PillarGraph::Levels PillarGraph::FindLevels(int root) const
{
  Levels levels;
  BreadthFirst search(*this);
  PageVector<int>& queue = search.Order;
  search.Add(root);
  std::size_t begin = 0;
  while (true)
  {
    const std::size_t end = queue.size();
    for (std::size_t i = begin; i < end; ++i)
    {
      const std::size_t first = queue.size();
      search.AddNeighbours(queue[i]);
      if (queue.size() > first + 1) // mostly there is one
      {
        std::sort(queue.begin() + first, queue.end());
      }
    }
    if (queue.size() == end)
    {
      break;
    }
    ++levels.Depth;
    begin = end;
  }
  Degrees degree(*this);
  levels.Last = *std::min_element(
    queue.begin() + begin, queue.end(), [&degree](int a, int b) { return degree(a) < degree(b); });
  for (const int p : queue)
  {
    levels.Reached += this->ThePillars.Size(p);
  }
  return levels;
}

PageVector<int> PillarGraph::ReverseCuthillMcKee(
  const PageVector<int>& roots, const PageVector<int>& rank, int enough) const
{
  CuthillMcKee search(*this, rank, enough);
  bool isLess = search.Run(roots);
  PageVector<int> rest;
  for (int p = 0; isLess && p < this->Count(); ++p)
  {
    if (!search.IsSeen(p))
    {
      rest.push_back(p);
    }
  }
  search.Sort(rest, 0);
  for (const int p : rest)
  {
    isLess = isLess && (search.IsSeen(p) || search.Run({ p }));
  }
  if (!isLess)
  {
    return {};
  }
  std::reverse(search.Order.begin(), search.Order.end());
  return FirstNumbers(this->ThePillars, search.Order);
}

int PillarGraph::Bandwidth(const PageVector<int>& first, int enough) const
{
  std::atomic<int> widest{ 0 };
  ParallelFor(0, this->PillarsOf.Count(), 20000,
    [&](Id begin, Id end)
    {
      int own = 0;
      for (Id c = begin; c < end && std::max(own, widest.load()) < enough; ++c)
      {
        int low = std::numeric_limits<int>::max();
        int high = 0;
        for (const int* p = this->PillarsOf.begin(c); p != this->PillarsOf.end(c); ++p)
        {
          low = std::min(low, first[*p]);
          high = std::max(high, first[*p]);
        }
        own = std::max(own, high - low);
      }
      int seen = widest.load();
      while (own > seen && !widest.compare_exchange_weak(seen, own))
      {
      }
    });
  return widest.load();
}

}
