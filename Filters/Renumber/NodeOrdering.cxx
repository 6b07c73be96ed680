#include "NodeOrdering.h"

#include "Band.h"

#include <Eigen/Eigenvalues>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

#include <array>
#include <deque>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// Coordinates nearer than this share of the extent are in one row.
constexpr double RowGap = 1e-6;

std::vector<int> Identity(int count)
{
  std::vector<int> number(count);
  std::iota(number.begin(), number.end(), 0);
  return number;
}

/// Row index of each value: values without a gap between them share one.
std::vector<int> Rows(const std::vector<double>& values)
{
  std::vector<int> order = Identity(static_cast<int>(values.size()));
  std::sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
  const double gap = RowGap * (values[order.back()] - values[order.front()]);
  std::vector<int> row(values.size());
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
std::vector<int> SortAlong(
  int count, const std::function<Vec3(int)>& position, const Eigen::Matrix3d& axes)
{
  std::array<std::vector<int>, 3> rows;
  std::vector<double> values(count);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < count; ++i)
    {
      values[i] = position(i).dot(axes.col(axis));
    }
    rows[axis] = Rows(values);
  }
  std::vector<int> order = Identity(count);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    for (const auto& row : rows)
    {
      if (row[a] != row[b])
      {
        return row[a] < row[b];
      }
    }
    return a < b;
  });
  std::vector<int> number(count);
  for (int i = 0; i < count; ++i)
  {
    number[order[i]] = i;
  }
  return number;
}

/// The columns of a frame in the order of the part's extent along them, longest first.
Eigen::Matrix3d ByExtent(
  const Eigen::Matrix3d& frame, int count, const std::function<Vec3(int)>& position)
{
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 p = frame.transpose() * position(i);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 extent = high - low;
  std::array<int, 3> order{ 0, 1, 2 };
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return extent[a] > extent[b]; });
  Eigen::Matrix3d sorted;
  for (int i = 0; i < 3; ++i)
  {
    sorted.col(i) = frame.col(order[i]);
  }
  return sorted;
}

Eigen::Matrix3d PrincipalAxes(int count, const std::function<Vec3(int)>& position)
{
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < count; ++i)
  {
    mean += position(i);
  }
  mean /= count;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i)
  {
    const Vec3 d = position(i) - mean;
    spread += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

/// The frame of the first element's edges: the rows of a regular mesh that lies askew.
Eigen::Matrix3d ElementAxes(const NodeGraph& graph, const std::function<Vec3(int)>& position)
{
  const int* nodes = graph.Connectivity.data() + graph.Offset[graph.Offset.size() / 2 - 1];
  const Vec3 u = (position(nodes[1]) - position(nodes[0])).normalized();
  Vec3 v = position(nodes[2]) - position(nodes[1]);
  v = (v - u * u.dot(v)).normalized();
  Eigen::Matrix3d frame;
  frame << u, v, u.cross(v);
  return frame;
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
  std::vector<int> front{ root };
  seen[root] = 1;
  levels.Reached = 1;
  while (true)
  {
    std::vector<int> next;
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
  levels.Last = *std::min_element(front.begin(), front.end(), [&](int a, int b) {
    return links.end(a) - links.begin(a) < links.end(b) - links.begin(b);
  });
  return levels;
}

using Csr = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property,
  boost::no_property, boost::no_property, int, int>;

/// Node graph with one more vertex, the last, joined to the nodes of `side`: a search from it
/// starts at the whole side at once.
Csr BuildGraph(const NodeGraph& graph, const Band::Lists& links, const std::vector<int>& side)
{
  std::vector<std::pair<int, int>> edges;
  std::vector<int> mark(graph.NumberOfNodes, -1);
  const int root = graph.NumberOfNodes;
  std::vector<char> onSide(graph.NumberOfNodes, 0);
  for (const int node : side)
  {
    onSide[node] = 1;
  }
  for (int n = 0; n < graph.NumberOfNodes; ++n)
  {
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
    if (onSide[n])
    {
      edges.emplace_back(n, root);
    }
  }
  for (const int node : side)
  {
    edges.emplace_back(root, node);
  }
  return Csr(boost::edges_are_sorted, edges.begin(), edges.end(), graph.NumberOfNodes + 1);
}

std::vector<int> ReverseCuthillMcKee(const Csr& csr, int root)
{
  const int count = static_cast<int>(boost::num_vertices(csr));
  std::vector<int> order;
  order.reserve(count);
  std::vector<boost::default_color_type> color(count, boost::white_color);
  std::vector<int> degree(count);
  for (int i = 0; i < count; ++i)
  {
    degree[i] = static_cast<int>(boost::out_degree(i, csr));
  }
  const auto index = boost::get(boost::vertex_index, csr);
  const auto colors = boost::make_iterator_property_map(color.begin(), index);
  const auto degrees = boost::make_iterator_property_map(degree.begin(), index);
  std::vector<char> done(count, 0);
  const auto search = [&](int start) {
    const std::size_t before = order.size();
    std::deque<Csr::vertex_descriptor> queue{ static_cast<Csr::vertex_descriptor>(start) };
    boost::cuthill_mckee_ordering(csr, queue, std::back_inserter(order), colors, degrees);
    for (std::size_t i = before; i < order.size(); ++i)
    {
      done[order[i]] = 1; // Boost clears the colours at each call
    }
  };
  search(root);
  // Parts that are not joined with the root follow, each from its node of least degree.
  std::vector<int> byDegree = Identity(count);
  std::stable_sort(
    byDegree.begin(), byDegree.end(), [&](int a, int b) { return degree[a] < degree[b]; });
  for (const int node : byDegree)
  {
    if (!done[node])
    {
      search(node);
    }
  }
  std::vector<int> number(count - 1);
  int next = 0;
  for (auto it = order.rbegin(); it != order.rend(); ++it)
  {
    if (*it != count - 1)
    {
      number[*it] = next++;
    }
  }
  return number;
}

/// The first node of least degree, where many implementations start.
int LeastDegree(const Csr& csr)
{
  int least = 0;
  for (int i = 1; i + 1 < static_cast<int>(boost::num_vertices(csr)); ++i)
  {
    least = boost::out_degree(i, csr) < boost::out_degree(least, csr) ? i : least;
  }
  return least;
}

/// Where Boost's own ordering starts.
int StartOfBoost(const Csr& csr)
{
  std::vector<boost::default_color_type> color(boost::num_vertices(csr), boost::white_color);
  const auto index = boost::get(boost::vertex_index, csr);
  const auto colors = boost::make_iterator_property_map(color.begin(), index);
  return static_cast<int>(
    boost::find_starting_node(csr, LeastDegree(csr), colors, boost::make_out_degree_map(csr)));
}

/// Nodes at one end of the longest axis.
std::vector<int> WholeSide(
  int count, const std::function<Vec3(int)>& position, const Vec3& axis, double width)
{
  double low = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i)
  {
    low = std::min(low, position(i).dot(axis));
  }
  std::vector<int> side;
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
  std::vector<int> Number;
  int Bandwidth;

  void Offer(const NodeGraph& graph, std::vector<int> number)
  {
    const int bandwidth = NodeBandwidth(graph, number);
    if (bandwidth < this->Bandwidth)
    {
      this->Bandwidth = bandwidth;
      this->Number = std::move(number);
    }
  }
};

}

int NodeBandwidth(const NodeGraph& graph, const std::vector<int>& number)
{
  int widest = 0;
  for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
  {
    int low = std::numeric_limits<int>::max();
    int high = 0;
    for (int i = graph.Offset[e]; i < graph.Offset[e + 1]; ++i)
    {
      low = std::min(low, number[graph.Connectivity[i]]);
      high = std::max(high, number[graph.Connectivity[i]]);
    }
    widest = std::max(widest, high - low);
  }
  return widest;
}

std::vector<int> OrderNodes(const NodeGraph& graph, const std::function<Vec3(int)>& position,
  const std::function<bool()>& aborted)
{
  const int count = graph.NumberOfNodes;
  Best best{ Identity(count), 0 };
  if (graph.Offset.size() < 2)
  {
    return best.Number;
  }
  best.Bandwidth = NodeBandwidth(graph, best.Number);

  const auto links = BuildLists(count, [&](auto&& add) {
    for (std::size_t e = 0; e + 1 < graph.Offset.size(); ++e)
    {
      for (int i = graph.Offset[e]; i < graph.Offset[e + 1]; ++i)
      {
        add(graph.Connectivity[i], static_cast<int>(e));
      }
    }
  });
  // A pseudo-peripheral node: the far end of the far end. Its depth gives the bound.
  LevelStructure levels = Levels(graph, links, 0);
  int start = levels.Last;
  levels = Levels(graph, links, start);
  const int bound = (levels.Reached - 1 + levels.Depth - 1) / std::max(1, levels.Depth);

  const Eigen::Matrix3d frames[3] = { Eigen::Matrix3d::Identity(),
    ElementAxes(graph, position), PrincipalAxes(count, position) };
  for (const auto& frame : frames)
  {
    if (best.Bandwidth <= bound || aborted())
    {
      return best.Number;
    }
    best.Offer(graph, SortAlong(count, position, ByExtent(frame, count, position)));
  }
  if (best.Bandwidth <= bound || aborted())
  {
    return best.Number;
  }
  const Csr single = BuildGraph(graph, links, {});
  for (const int root : { start, levels.Last, LeastDegree(single), StartOfBoost(single) })
  {
    best.Offer(graph, ReverseCuthillMcKee(single, root));
  }
  if (best.Bandwidth > bound && !aborted())
  {
    const Eigen::Matrix3d axes = ByExtent(PrincipalAxes(count, position), count, position);
    const int* nodes = graph.Connectivity.data();
    const double width = 0.5 * (position(nodes[1]) - position(nodes[0])).norm();
    const Csr rooted = BuildGraph(graph, links, WholeSide(count, position, axes.col(0), width));
    best.Offer(graph, ReverseCuthillMcKee(rooted, count));
  }
  return best.Number;
}

}
