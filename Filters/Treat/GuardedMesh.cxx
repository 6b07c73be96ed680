#include "GuardedMesh.h"

#include "CoincidentNodes.h"

#include <algorithm>

namespace trim
{

GuardedMesh::GuardedMesh(const GuardedCase& given)
  : RelaxedMesh(given.ToRelax, given.NodeMoves)
  , Given(given)
  , Used(MakeNodeGrid(given.ToRelax.TheBand))
{
  for (const auto& element : this->Elements)
  {
    for (int i = 0; i < element.Count; ++i)
    {
      this->Used.Put(element.Node[i], this->TheMoves.Position[element.Node[i]]);
    }
  }
}

GuardedMesh::GuardedMesh(const GuardedCase& given, const GuardedMesh& same)
  : RelaxedMesh(given.ToRelax, given.NodeMoves)
  , Given(given)
  , Used(same.Used)
{
}

std::vector<GuardedMesh::Standard> GuardedMesh::StandardsOf(
  const std::vector<int>& elements, double limit) const
{
  std::vector<Standard> list;
  for (const int e : elements)
  {
    list.push_back(this->StandardOf(e, std::min(limit, this->Quality(e))));
  }
  return list;
}

double GuardedMesh::LowestOf(
  const std::vector<int>& elements, const std::vector<Standard>& standards) const
{
  double lowest = 2.0;
  for (std::size_t i = 0; i < elements.size(); ++i)
  {
    const int e = elements[i];
    const double now = this->Quality(e);
    if (now < standards[i].Quality || this->ShortestEdgeShare(e) < standards[i].EdgeShare ||
      this->Given.Quality.Spoils(e, this->PointsOf(e), this->Elements[e].Count) ||
      (!standards[i].LeavesBorder && this->LeavesBorder(e)))
    {
      return -1.0;
    }
    lowest = std::min(lowest, now);
  }
  return lowest;
}

bool GuardedMesh::LeavesBorder(int e) const
{
  const auto& element = this->Elements[e];
  return this->Given.Quality.LeavesBorder(e, element.Node, this->PointsOf(e), element.Count);
}

bool GuardedMesh::IsCoincident(int node) const
{
  return trim::IsCoincident(this->TheBand, this->TheMoves, this->Used, node);
}

void GuardedMesh::TellPlaced(const std::vector<int>& nodes)
{
  for (const int n : nodes)
  {
    this->Used.Move(n, this->TheMoves.Position[n]);
  }
}

GuardedMesh::State GuardedMesh::StateOf(const std::vector<int>& nodes) const
{
  State state{ nodes, this->PositionsOf(nodes), {} };
  for (const int n : nodes)
  {
    state.Applied.push_back(this->TheMoves.Applied[n]);
  }
  return state;
}

void GuardedMesh::Restore(const State& state)
{
  this->Place(state.Nodes, state.Position);
  this->TellPlaced(state.Nodes);
  for (std::size_t i = 0; i < state.Nodes.size(); ++i)
  {
    this->TheMoves.Applied[state.Nodes[i]] = state.Applied[i];
  }
}

bool GuardedMesh::HasCoincident(const State& before)
{
  this->TellPlaced(before.Nodes);
  for (std::size_t i = 0; i < before.Nodes.size(); ++i)
  {
    const int n = before.Nodes[i];
    if (this->TheMoves.Position[n] != before.Position[i] && this->IsCoincident(n))
    {
      return true;
    }
  }
  return false;
}

}
