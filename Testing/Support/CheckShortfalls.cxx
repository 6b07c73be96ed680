#include "Checks.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace judge
{
namespace
{
enum Shortfall
{
  None = 0,
  LeftOff = 2,
  ShortEdge = 5,
  LoosePart = 6
};

/// Of an edge's length: what has less left is told of.
constexpr double LeastShare = 0.05;

/// How much of its length that edge of an element has left which lost most; NaN with a node that
/// the mesh did not have.
double ShortestEdgeShare(const Evidence& e, Id c)
{
  double share = std::numeric_limits<double>::infinity();
  vtkCell* const cell = e.Case.Trimmed->GetCell(c);
  for (int i = 0; i < cell->GetNumberOfEdges(); ++i)
  {
    const Id a = cell->GetEdge(i)->GetPointId(0);
    const Id b = cell->GetEdge(i)->GetPointId(1);
    if (e.InsertedPoint[a] || e.InsertedPoint[b])
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    share = std::min(share,
      (e.Out.Points[a] - e.Out.Points[b]).norm() /
        (e.In.Points[e.PointOf[a]] - e.In.Points[e.PointOf[b]]).norm());
  }
  return share;
}

/// The part of each element, joined by facets.
std::vector<int> PartOfElements(const Model& model)
{
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(model.Elements.size());
  std::map<std::array<Id, 4>, Id> owners;
  for (Id c = 0; c < static_cast<Id>(model.Elements.size()); ++c)
  {
    for (const Facet& facet : FacetsOf(model.Elements[c], c))
    {
      const auto [owner, isNew] = owners.emplace(FacetKey(facet), c);
      if (!isNew)
      {
        boost::add_edge(owner->second, c, graph);
      }
    }
  }
  std::vector<int> part(model.Elements.size());
  boost::connected_components(graph, part.data());
  return part;
}

enum class Loose : char
{
  No,
  Yes,
  Either ///< the largest, or one of them
};

/// The parts all of whose elements are at the new boundary, or have an inserted layer between it
/// and them, but for the largest where there is no other; by element.
std::vector<Loose> FindLooseElements(const Evidence& e)
{
  const std::vector<int> part = PartOfElements(e.Out);
  std::map<int, int> sizes;
  std::map<int, Loose> loose;
  for (std::size_t c = 0; c < part.size(); ++c)
  {
    const Element& element = e.Out.Elements[c];
    const bool atCut = std::any_of(element.Node.begin(), element.Node.begin() + element.Size,
      [&e](Id p) { return e.OnNewBoundary[p] || e.InsertedPoint[p]; });
    ++sizes[part[c]];
    Loose& own = loose.emplace(part[c], Loose::Yes).first->second;
    own = atCut ? own : Loose::No;
  }
  if (std::none_of(
        loose.begin(), loose.end(), [](const auto& own) { return own.second == Loose::No; }))
  {
    int largest = 0;
    for (const auto& own : sizes)
    {
      largest = std::max(largest, own.second);
    }
    for (auto& own : loose)
    {
      own.second = sizes[own.first] < largest ? Loose::Yes : Loose::Either;
    }
  }
  std::vector<Loose> found;
  for (const int own : part)
  {
    found.push_back(loose[own]);
  }
  return found;
}

/// Whether an element is as asked but for what is less grave than a loose part.
bool IsLessThanLoose(int value)
{
  return value == None || value == ShortEdge || value == LeftOff;
}

void CheckLeftOff(const Evidence& e, Id c, vtkDataArray* left, int value, Report& report)
{
  const auto& element = e.Out.Elements[c];
  const bool hasLeft = std::any_of(element.Node.begin(), element.Node.begin() + element.Size,
    [left](Id p) { return left->GetComponent(p, 0) > 0; });
  if (hasLeft ? value == None : value == LeftOff)
  {
    report.Fail("Shortfall", Cell(c), value, hasLeft ? LeftOff : None);
  }
}
}

void CheckShortfalls(const Evidence& e, Report& report)
{
  vtkDataArray* shortfall = e.Case.Trimmed->GetCellData()->GetArray("Shortfall");
  vtkDataArray* left = e.Case.Trimmed->GetPointData()->GetArray("DistanceLeft");
  if (!shortfall || !left)
  {
    return;
  }
  const bool hasFloor = e.Case.Options.MinimumScaledJacobian > 0;
  const std::vector<Loose> loose = FindLooseElements(e);
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const int value = static_cast<int>(shortfall->GetComponent(c, 0));
    CheckLeftOff(e, c, left, value, report);
    // What follows is told of elements that are as asked otherwise.
    if (loose[c] == Loose::Yes ? IsLessThanLoose(value)
                               : loose[c] == Loose::No && value == LoosePart)
    {
      report.Fail("Shortfall, loose part", Cell(c), value, LoosePart);
    }
    const double share = ShortestEdgeShare(e, c);
    const bool isShort = share < LeastShare && hasFloor && e.Touched(c);
    if (IsLessThanLoose(value) && std::abs(share - LeastShare) > 1e-6 * LeastShare &&
      isShort != (value == ShortEdge))
    {
      report.Fail("Shortfall, short edge", Cell(c), value, isShort ? ShortEdge : None);
    }
  }
}
}
