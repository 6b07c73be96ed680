#include "NodeOrdering.h"

#include "Band.h"
#include "PillarOrdering.h"
#include "PointFrame.h"
#include "Team.h"

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <limits>
#include <numeric>
#include <utility>

namespace trim
{
namespace
{

/// Coordinates nearer than this share of the extent are in one row.
constexpr double RowGap = 1e-6;
/// Cuthill-McKee is applied to its own result up to this often.
constexpr int MostRounds = 6;
/// From here on the search runs on pillars alone, or from there on where each node is one by
/// itself.
constexpr int ManyNodes = 20000;
constexpr int ManyWithoutPillars = 200000;

PageVector<int> Identity(int count)
{
  PageVector<int> number(count);
  std::iota(number.begin(), number.end(), 0);
  return number;
}

/// Row index of each value: values without a gap between them share one.
PageVector<int> Rows(const std::vector<double>& values)
{
  PageVector<int> order = Identity(static_cast<int>(values.size()));
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  const double gap = RowGap * (values[order.back()] - values[order.front()]);
  PageVector<int> row(values.size());
  int current = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if (i > 0 && values[order[i]] - values[order[i - 1]] > gap)
    {
      ++current;
    }
    row[order[i]] = current;
  }
  return row;
}

/// Numbers by rows along the columns of `axes`, the first outermost.
PageVector<int> SortAlong(int count, const NodePlaces& position, const Eigen::Matrix3d& axes)
{
  std::array<PageVector<int>, 3> rows;
  std::vector<double> values(count);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < count; ++i)
    {
      values[i] = position(i).dot(axes.col(axis));
    }
    rows[axis] = Rows(values);
  }
  PageVector<int> order = Identity(count);
  std::sort(order.begin(), order.end(),
    [&](int a, int b)
    {
      for (const auto& row : rows)
      {
        if (row[a] != row[b])
        {
          return row[a] < row[b];
        }
      }
      return a < b;
    });
  PageVector<int> number(count);
  for (int i = 0; i < count; ++i)
  {
    number[order[i]] = i;
  }
  return number;
}

/// Levels of a breadth-first search from a node over elements.
struct LevelStructure
{
  int Depth = 0;
  int Last = 0;    ///< a node of the last level with the fewest neighbours
  int Reached = 0; ///< nodes
};

LevelStructure Levels(const NodeGraph& graph, const Band::Lists& links, int root)
{
  LevelStructure levels;
  std::vector<char> seen(graph.NumberOfNodes, 0);
  std::vector<char> elementSeen(graph.Offset.size() - 1, 0);
  PageVector<int> front{ root };
  seen[root] = 1;
  levels.Reached = 1;
  while (true)
  {
    PageVector<int> next;
    for (const int node : front)
    {
      for (auto* e = links.begin(node); e != links.end(node); ++e)
      {
        if (elementSeen[*e])
        {
          continue;
        }
        elementSeen[*e] = 1;
        for (int i = graph.Offset[*e]; i < graph.Offset[*e + 1]; ++i)
        {
          const int other = graph.Connectivity[i];
          if (!seen[other])
          {
            seen[other] = 1;
            next.push_back(other);
          }
        }
      }
    }
    if (next.empty())
    {
      break;
    }
    levels.Reached += static_cast<int>(next.size());
    ++levels.Depth;
    front = std::move(next);
  }
  levels.Last = *std::min_element(front.begin(), front.end(),
    [&](int a, int b) { return links.end(a) - links.begin(a) < links.end(b) - links.begin(b); });
  return levels;
}

using Csr = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property,
  boost::no_property, boost::no_property, int, int>;

/// Node graph, neighbours ascending. Unless `side` is empty there is one more vertex, the last,
/// joined to its nodes: a search from it starts at the whole side at once.
Csr BuildGraph(const NodeGraph& graph, const Band::Lists& links, const PageVector<int>& side)
{
  std::vector<std::pair<int, int>> edges;
  PageVector<int> mark(graph.NumberOfNodes, -1);
  const int root = graph.NumberOfNodes;
  std::vector<char> onSide(graph.NumberOfNodes, 0);
  for (const int node : side)
  {
    onSide[node] = 1;
  }
  for (int n = 0; n < graph.NumberOfNodes; ++n)
  {
    const std::size_t first = edges.size();
    for (auto* e = links.begin(n); e != links.end(n); ++e)
    {
      for (int i = graph.Offset[*e]; i < graph.Offset[*e + 1]; ++i)
      {
        const int other = graph.Connectivity[i];
        if (other != n && mark[other] != n)
        {
          mark[other] = n;
          edges.emplace_back(n, other);
        }
      }
    }
    std::sort(edges.begin() + first, edges.end());
    if (onSide[n])
    {
      edges.emplace_back(n, root);
    }
  }
  for (const int node : side)
  {
    edges.emplace_back(root, node);
  }
  return Csr(boost::edges_are_sorted, edges.begin(), edges.end(),
    graph.NumberOfNodes + (side.empty() ? 0 : 1));
}

/// Maps that Boost's orderings work with.
struct OrderingMaps
{
  explicit OrderingMaps(const Csr& csr)
    : Color(boost::num_vertices(csr), boost::white_color)
    , Degree(boost::num_vertices(csr))
    , Index(boost::get(boost::vertex_index, csr))
  {
    for (std::size_t i = 0; i < this->Degree.size(); ++i)
    {
      this->Degree[i] = static_cast<int>(boost::out_degree(static_cast<int>(i), csr));
    }
  }
  auto Colors() { return boost::make_iterator_property_map(this->Color.begin(), this->Index); }
  auto Degrees() { return boost::make_iterator_property_map(this->Degree.begin(), this->Index); }

  std::vector<boost::default_color_type> Color;
  PageVector<int> Degree;
  decltype(boost::get(boost::vertex_index, std::declval<const Csr&>())) Index;
};

/// Numbers from a Cuthill-McKee order, reversed, without the extra vertex.
PageVector<int> Reversed(const PageVector<int>& order, int count)
{
  PageVector<int> number(count);
  int next = 0;
  for (auto it = order.rbegin(); it != order.rend(); ++it)
  {
    if (*it < count)
    {
      number[*it] = next++;
    }
  }
  return number;
}

/// Boost's ordering with the starts it finds itself.
PageVector<int> ReverseCuthillMcKee(const Csr& csr)
{
  OrderingMaps maps(csr);
  PageVector<int> order;
  boost::cuthill_mckee_ordering(csr, std::back_inserter(order), maps.Colors(), maps.Degrees());
  return Reversed(order, static_cast<int>(boost::num_vertices(csr)));
}

/// The same from a given root; parts that are not joined with it follow, each from its node of
/// least degree.
PageVector<int> ReverseCuthillMcKee(const Csr& csr, int count, int root)
{
  OrderingMaps maps(csr);
  PageVector<int> order;
  std::vector<char> done(boost::num_vertices(csr), 0);
  const auto search = [&](int start)
  {
    const std::size_t before = order.size();
    std::deque<Csr::vertex_descriptor> queue{ static_cast<Csr::vertex_descriptor>(start) };
    boost::cuthill_mckee_ordering(
      csr, queue, std::back_inserter(order), maps.Colors(), maps.Degrees());
    for (std::size_t i = before; i < order.size(); ++i)
    {
      done[order[i]] = 1; // Boost clears the colours at each call
    }
  };
  search(root);
  PageVector<int> byDegree = Identity(count);
  std::stable_sort(byDegree.begin(), byDegree.end(),
    [&](int a, int b) { return maps.Degree[a] < maps.Degree[b]; });
  for (const int node : byDegree)
  {
    if (!done[node])
    {
      search(node);
    }
  }
  return Reversed(order, count);
}

/// The first node of least degree, where many implementations start.
int LeastDegree(const Csr& csr)
{
  int least = 0;
  for (int i = 1; i < static_cast<int>(boost::num_vertices(csr)); ++i)
  {
    least = boost::out_degree(i, csr) < boost::out_degree(least, csr) ? i : least;
  }
  return least;
}

/// Nodes at one end of the longest axis.
PageVector<int> WholeSide(int count, const NodePlaces& position, const Vec3& axis, double width)
{
  double low = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i)
  {
    low = std::min(low, position(i).dot(axis));
  }
  PageVector<int> side;
  for (int i = 0; i < count; ++i)
  {
    if (position(i).dot(axis) <= low + width)
    {
      side.push_back(i);
    }
  }
  return side;
}

/// The best of the orderings seen so far.
struct Best
{
  PageVector<int> Number;
  int Bandwidth;

  void Offer(const NodeGraph& graph, PageVector<int> number)
  {
    const int bandwidth = NodeBandwidth(graph, number);
    if (bandwidth < this->Bandwidth)
    {
      this->Bandwidth = bandwidth;
      this->Number = std::move(number);
    }
  }
};

/// Links from nodes to elements.
Band::Lists LinkElements(const NodeGraph& graph)
{
  return BuildLists(graph.NumberOfNodes,
    [&](auto&& add)
    {
      for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
      {
        for (int i = graph.Offset[e]; i < graph.Offset[e + 1]; ++i)
        {
          add(graph.Connectivity[i], static_cast<int>(e));
        }
      }
    });
}

/// Offers Cuthill-McKee orderings, from several starts, of the graph numbered by `number`.
void OfferCuthillMcKee(const NodeGraph& graph, const PageVector<int>& number, Best& best)
{
  NodeGraph renumbered = graph;
  for (int& node : renumbered.Connectivity)
  {
    node = number[node];
  }
  const auto links = LinkElements(renumbered);
  const Csr csr = BuildGraph(renumbered, links, {});
  const auto offer = [&](const PageVector<int>& next)
  {
    PageVector<int> chained(number.size());
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      chained[i] = next[number[i]];
    }
    best.Offer(graph, std::move(chained));
  };
  offer(ReverseCuthillMcKee(csr));
  const int farEnd = Levels(renumbered, links, 0).Last;
  for (const int root : { farEnd, Levels(renumbered, links, farEnd).Last, LeastDegree(csr) })
  {
    offer(ReverseCuthillMcKee(csr, graph.NumberOfNodes, root));
  }
}

}

int NodeBandwidth(const NodeGraph& graph, const PageVector<int>& number)
{
  std::atomic<int> widest{ 0 };
  ParallelFor(0, std::max<Id>(1, graph.Offset.size()) - 1, 30000,
    [&](Id begin, Id end)
    {
      int own = 0;
      for (Id e = begin; e < end; ++e)
      {
        int low = std::numeric_limits<int>::max();
        int high = 0;
        for (int i = graph.Offset[e]; i < graph.Offset[e + 1]; ++i)
        {
          const int n = number[graph.Connectivity[i]];
          low = std::min(low, n);
          high = std::max(high, n);
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

Eigen::Matrix3d ElementAxes(const NodeGraph& graph, const NodePlaces& position)
{
  const int* nodes = graph.Connectivity.data() + graph.Offset[graph.Offset.size() / 2 - 1];
  const Vec3 u = (position(nodes[1]) - position(nodes[0])).normalized();
  Vec3 v = position(nodes[2]) - position(nodes[1]);
  v = (v - u * u.dot(v)).normalized();
  Eigen::Matrix3d frame;
  frame << u, v, u.cross(v);
  return frame;
}

namespace
{

/// Along the axes of space, of an element and of the whole; until nothing is to be gained.
void OfferAlongAxes(const NodeGraph& graph, const NodePlaces& position,
  const std::function<bool()>& mayGain, Best& best)
{
  const int count = graph.NumberOfNodes;
  const Eigen::Matrix3d frames[3] = { Eigen::Matrix3d::Identity(), ElementAxes(graph, position),
    PrincipalAxes(count, position) };
  for (const auto& frame : frames)
  {
    if (!mayGain())
    {
      return;
    }
    best.Offer(graph, SortAlong(count, position, ByExtent(frame, count, position)));
  }
}

/// Cuthill-McKee breaks ties by the numbers it is given, so it may gain from its own result.
void OfferCuthillMcKeeAgain(
  const NodeGraph& graph, const std::function<bool()>& mayGain, Best& best)
{
  for (int round = 0; round < MostRounds && mayGain(); ++round)
  {
    const int before = best.Bandwidth;
    OfferCuthillMcKee(graph, round == 0 ? Identity(graph.NumberOfNodes) : best.Number, best);
    if (round > 0 && best.Bandwidth == before)
    {
      return;
    }
  }
}

/// Cuthill-McKee from a whole side on.
void OfferFromSide(
  const NodeGraph& graph, const Band::Lists& links, const NodePlaces& position, Best& best)
{
  const int count = graph.NumberOfNodes;
  const Eigen::Matrix3d axes = ByExtent(PrincipalAxes(count, position), count, position);
  const int* nodes = graph.Connectivity.data();
  const double width = 0.5 * (position(nodes[1]) - position(nodes[0])).norm();
  const Csr rooted = BuildGraph(graph, links, WholeSide(count, position, axes.col(0), width));
  best.Offer(graph, ReverseCuthillMcKee(rooted, count, count));
}

}

PageVector<int> OrderNodes(
  const NodeGraph& graph, const NodePlaces& position, const std::function<bool()>& aborted)
{
  const int count = graph.NumberOfNodes;
  Best best{ Identity(count), 0 };
  if (graph.Offset.size() < 2)
  {
    return best.Number;
  }
  if (count >= ManyNodes)
  {
    const Pillars pillars = FindPillars(graph, position);
    if (pillars.Count < count || count >= ManyWithoutPillars)
    {
      return OrderByPillars(graph, pillars, position, aborted);
    }
  }
  best.Bandwidth = graph.Bandwidth;

  const auto links = LinkElements(graph);
  // A pseudo-peripheral node: the far end of the far end. Its depth gives the bound.
  LevelStructure levels = Levels(graph, links, 0);
  int start = levels.Last;
  levels = Levels(graph, links, start);
  const int bound = (levels.Reached - 1 + levels.Depth - 1) / std::max(1, levels.Depth);

  const std::function<bool()> mayGain = [&] { return best.Bandwidth > bound && !aborted(); };
  OfferAlongAxes(graph, position, mayGain, best);
  OfferCuthillMcKeeAgain(graph, mayGain, best);
  if (mayGain())
  {
    OfferFromSide(graph, links, position, best);
  }
  if (mayGain())
  {
    best.Offer(graph, OrderByPillars(graph, FindPillars(graph, position), position, aborted));
  }
  return best.Number;
}

}
