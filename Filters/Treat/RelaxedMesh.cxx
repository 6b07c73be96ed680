#include "RelaxedMesh.h"

#include "DisjointSets.h"
#include "SortUnique.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace trim
{
namespace
{

/// Of so many nodes the elements are marked, which takes a list as long as the band.
constexpr std::size_t FewNodes = 30;

}

ElementPoints RelaxedMesh::PointsOf(int element) const
{
  return PointsAt(this->TheMoves.Position, this->Elements[element]);
}

double RelaxedMesh::Quality(int element) const
{
  return ScaledJacobian(this->PointsOf(element), this->Elements[element].Count);
}

double RelaxedMesh::Worth(int element, double limit) const
{
  const auto& e = this->Elements[element];
  const EdgeSquares* before = e.Count == 8 ? &this->Mover.EdgesBefore(element) : nullptr;
  return WorthOf(
    this->TheBand, e.Node, this->PointsOf(element), e.Count, &this->Fixed, limit, before);
}

double RelaxedMesh::EnoughFor(int element, double goal) const
{
  const double before = this->Mover.QualityBefore(element);
  return before < std::min(goal, PoorQuality) ? before - QualitySlack * std::abs(before)
                                              : std::numeric_limits<double>::infinity();
}

double RelaxedMesh::ShortestEdgeShare(int element) const
{
  const auto& e = this->Elements[element];
  return trim::ShortestEdgeShare(this->TheBand, e.Node, this->PointsOf(element), e.Count);
}

bool RelaxedMesh::Uses(int element, int node) const
{
  const auto& e = this->Elements[element];
  return std::find(e.begin(), e.end(), node) != e.end();
}

std::vector<int> RelaxedMesh::ElementsAt(const std::vector<int>& nodes) const
{
  std::vector<int> elements;
  elements.reserve(std::min<std::size_t>(8 * nodes.size(), this->TheBand.NumberOfElements()));
  if (nodes.size() >= FewNodes)
  {
    // Each of many once: sorting them as often as they come would take longer.
    std::vector<char> listed(this->TheBand.NumberOfElements(), 0);
    for (const int node : nodes)
    {
      for (const int e : this->TheBand.ElementsOfNode(node))
      {
        if (!listed[e] && this->Elements[e].Count > 0 && this->Uses(e, node))
        {
          listed[e] = 1;
          elements.push_back(e);
        }
      }
    }
    std::sort(elements.begin(), elements.end());
    return elements;
  }
  for (const int node : nodes)
  {
    for (const int e : this->TheBand.ElementsOfNode(node))
    {
      if (this->Elements[e].Count > 0 && this->Uses(e, node))
      {
        elements.push_back(e);
      }
    }
  }
  if (nodes.size() > 1) // those of one are in order
  {
    SortUnique(elements);
  }
  return elements;
}

std::vector<int> RelaxedMesh::NodesRound(const std::vector<int>& elements, int rings) const
{
  std::vector<char> seen(this->TheBand.NumberOfNodes(), 0);
  std::vector<int> nodes;
  const auto add = [&](int element)
  {
    const auto& e = this->Elements[element];
    for (int i = 0; i < e.Count; ++i)
    {
      if (!seen[e.Node[i]])
      {
        seen[e.Node[i]] = 1;
        nodes.push_back(e.Node[i]);
      }
    }
  };
  for (const int e : elements)
  {
    add(e);
  }
  for (int ring = 1; ring < rings; ++ring)
  {
    const std::size_t end = nodes.size();
    for (std::size_t i = 0; i < end; ++i)
    {
      for (const int e : this->TheBand.ElementsOfNode(nodes[i]))
      {
        add(e);
      }
    }
  }
  nodes.erase(
    std::remove_if(nodes.begin(), nodes.end(), [&](int n) { return !this->IsMovable(n); }),
    nodes.end());
  return nodes;
}

std::vector<std::vector<int>> RelaxedMesh::PartsOf(const std::vector<int>& nodes) const
{
  nurbs::DisjointSets<int> sets(this->TheBand.NumberOfNodes());
  for (const int e : this->ElementsAt(nodes))
  {
    const auto& element = this->Elements[e];
    for (int i = 1; i < element.Count; ++i)
    {
      sets.Unite(element.Node[0], element.Node[i]);
    }
  }
  std::vector<char> isListed(this->TheBand.NumberOfNodes(), 0);
  for (const int node : nodes)
  {
    isListed[node] = 1;
    sets.Unite(node, this->Mover.PillarOf(node));
  }
  for (const int node : nodes)
  {
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      const int other = this->TheBand.OtherEnd(edge, node);
      if (isListed[other])
      {
        sets.Unite(node, other);
      }
    }
  }
  std::map<int, std::vector<int>> parts;
  for (const int node : nodes)
  {
    parts[sets.Find(node)].push_back(node);
  }
  std::vector<std::vector<int>> list;
  for (auto& part : parts)
  {
    list.push_back(std::move(part.second));
  }
  return list;
}

bool RelaxedMesh::IsMovable(int node) const
{
  if (this->Fixed[node])
  {
    return false;
  }
  const auto elements = this->TheBand.ElementsOfNode(node);
  return std::none_of(
           elements.begin(), elements.end(), [this](int e) { return this->TheBand.InHalo(e); }) &&
    this->Mover.MayRelax(node, this->OnCut[node] != 0);
}

NodeFreedom& RelaxedMesh::FreedomOf(int node)
{
  auto& known = this->Freedoms[node];
  if (!known)
  {
    known = std::make_unique<NodeFreedom>(this->Mover.FreedomOf(node, this->OnCut[node] != 0));
    this->TellStart(node);
  }
  return *known;
}

double RelaxedMesh::ShortestEdge(int node) const
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const int e : this->TheBand.ElementsOfNode(node))
  {
    for (int i = 0; i < this->Elements[e].Count; ++i)
    {
      const int other = this->Elements[e].Node[i];
      if (other != node && this->Mover.IsLateral(node, other))
      {
        shortest = std::min(
          shortest, (this->TheMoves.Position[other] - this->TheMoves.Position[node]).norm());
      }
    }
  }
  return shortest;
}

Eigen::Matrix3d RelaxedMesh::EdgeMetric(int node) const
{
  Eigen::Matrix3d metric = Eigen::Matrix3d::Zero();
  for (const int edge : this->TheBand.EdgesOfNode(node))
  {
    const Vec3 way =
      this->TheBand.Point[this->TheBand.OtherEnd(edge, node)] - this->TheBand.Point[node];
    metric += way * way.transpose() / (way.squaredNorm() * way.squaredNorm());
  }
  return 0.5 * metric;
}

std::vector<Vec3> RelaxedMesh::PositionsOf(const std::vector<int>& nodes) const
{
  std::vector<Vec3> positions;
  positions.reserve(nodes.size());
  for (const int node : nodes)
  {
    positions.push_back(this->TheMoves.Position[node]);
  }
  return positions;
}

void RelaxedMesh::Place(const std::vector<int>& nodes, const std::vector<Vec3>& positions)
{
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    this->TheMoves.Position[nodes[i]] = positions[i];
  }
}

bool RelaxedMesh::Settle(const std::vector<int>& nodes)
{
  for (const int node : nodes)
  {
    Vec3 place;
    if (!this->Mover.Constrained(node, this->FreedomOf(node), this->TheMoves.Position[node],
          this->OnCut[node] != 0, place))
    {
      return false;
    }
    this->TheMoves.Position[node] = AsStored(this->TheBand, place);
  }
  return true;
}

void RelaxedMesh::TellStart(int node)
{
  if (this->OnCut[node] && this->Freedoms[node])
  {
    this->Mover.StartFrom(node, this->TheMoves.Position[node], *this->Freedoms[node]);
  }
}

void RelaxedMesh::TellMoved(const std::vector<int>& nodes)
{
  for (const int node : nodes)
  {
    const bool moved = this->TheMoves.Position[node] != this->TheBand.Point[node];
    this->TheMoves.Applied[node] = moved ? Correction::Relax : Correction::None;
    this->TellStart(node);
  }
}

}
