#include "Checks.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace judge
{

Id Bandwidth(const std::vector<Element>& elements)
{
  Id widest = 0;
  for (const Element& element : elements)
  {
    const auto ends =
      std::minmax_element(element.Node.begin(), element.Node.begin() + element.Size);
    widest = std::max(widest, *ends.second - *ends.first);
  }
  return widest;
}

namespace
{
/// @param order the nodes in the order of their new numbers.
template <typename Nodes>
std::vector<Element> Renumbered(std::vector<Element> elements, const Nodes& order)
{
  std::vector<Id> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    number[order[i]] = static_cast<Id>(i);
  }
  for (Element& element : elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] = number[element.Node[i]];
    }
  }
  return elements;
}
}

Id ReverseCuthillMcKeeBandwidth(const Model& model)
{
  using namespace boost;
  using Graph = adjacency_list<setS, vecS, undirectedS,
    property<vertex_color_t, default_color_type, property<vertex_degree_t, int>>>;
  Graph graph(model.Points.size());
  for (const Element& element : model.Elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        add_edge(element.Node[i], element.Node[j], graph);
      }
    }
  }
  std::vector<graph_traits<Graph>::vertex_descriptor> order(num_vertices(graph));
  cuthill_mckee_ordering(graph, order.rbegin(), get(vertex_color, graph), make_degree_map(graph));
  return Bandwidth(Renumbered(model.Elements, order));
}

void CheckNumbering(const Evidence& e, Report& report)
{
  // As it came: the kept nodes in the input's order, inserted ones behind those in whose places
  // they are.
  std::vector<Id> order(e.PointOf.size());
  std::iota(order.begin(), order.end(), Id(0));
  std::sort(order.begin(), order.end(),
    [&e](Id a, Id b)
    {
      return std::make_tuple(e.PointOf[a], e.InsertedPoint[a], a) <
        std::make_tuple(e.PointOf[b], e.InsertedPoint[b], b);
    });
  const std::vector<Element> elements = Renumbered(e.Out.Elements, order);
  const Id now = Bandwidth(e.Out.Elements), came = Bandwidth(elements);
  if (!e.Case.Options.RenumberNodes)
  {
    if (!std::is_sorted(e.PointOf.begin(), e.PointOf.end()))
    {
      report.Fail("numbering", "nodes are not in the input's order", 0, 0);
    }
    return;
  }
  if (now > came)
  {
    report.Fail("numbering", "bandwidth worse than as it came", now, came);
  }
  Model before = e.Out;
  before.Elements = elements;
  const Id rcm = ReverseCuthillMcKeeBandwidth(before);
  if (now > rcm)
  {
    report.Fail("numbering", "bandwidth worse than reverse Cuthill-McKee", now, rcm);
  }
  // Its ties fall by the numbering it starts from.
  if (now > ReverseCuthillMcKeeBandwidth(e.Out))
  {
    report.Note("bandwidth that reverse Cuthill-McKee of the result betters");
  }
}

}
