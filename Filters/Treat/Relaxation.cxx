#include "Relaxation.h"

#include "Jacobian.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// Rings of nodes round the elements below the floor that may move.
constexpr int Rings = 3;
constexpr int MostSweeps = 40;
/// Steps of the search, in lengths of the shortest edge at the node.
constexpr std::array<double, 4> Steps{ 0.3, 0.1, 0.03, 0.01 };
/// Elements are raised to a little above the floor, so that rounding does not undo it.
constexpr double Margin = 1.02;
/// A gain below this is none.
constexpr double SmallestGain = 1e-4;

class Relaxer
{
public:
  Relaxer(const Band& band, const NodeMover& mover, const std::vector<RelaxedElement>& elements,
    const std::vector<char>& fixed, const std::vector<char>& onCut, double goal, Moves& moves)
    : TheBand(band)
    , Mover(mover)
    , Elements(elements)
    , Fixed(fixed)
    , OnCut(onCut)
    , Goal(goal)
    , TheMoves(moves)
  {
  }

  void Run(const std::vector<char>& active)
  {
    std::vector<int> nodes = this->NodesRound(active);
    for (int sweep = 0; sweep < MostSweeps; ++sweep)
    {
      bool gained = false;
      for (const int node : nodes)
      {
        gained |= this->Improve(node);
      }
      if (!gained || this->Reached(active))
      {
        return;
      }
    }
  }

private:
  double Quality(int element) const
  {
    const auto& e = this->Elements[element];
    ElementPoints points;
    for (int i = 0; i < e.Count; ++i)
    {
      points[i] = this->TheMoves.Position[e.Node[i]];
    }
    return ScaledJacobian(points, e.Count);
  }

  bool Uses(int element, int node) const
  {
    const auto& e = this->Elements[element];
    return std::find(e.Node.begin(), e.Node.begin() + e.Count, node) != e.Node.begin() + e.Count;
  }

  /// Smallest quality of the elements at a node, no more than the goal.
  double QualityAt(int node) const
  {
    double quality = this->Goal;
    for (const int e : this->TheBand.ElementsOfNode(node))
    {
      if (this->Elements[e].Count > 0 && this->Uses(e, node))
      {
        quality = std::min(quality, this->Quality(e));
      }
    }
    return quality;
  }

  bool Reached(const std::vector<char>& active) const
  {
    for (std::size_t e = 0; e < active.size(); ++e)
    {
      if (active[e] && this->Quality(static_cast<int>(e)) < this->Goal)
      {
        return false;
      }
    }
    return true;
  }

  /// Movable nodes near the elements below the goal, nearest first.
  std::vector<int> NodesRound(const std::vector<char>& active) const
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
    for (std::size_t e = 0; e < active.size(); ++e)
    {
      if (active[e])
      {
        add(static_cast<int>(e));
      }
    }
    for (int ring = 1; ring < Rings; ++ring)
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

  bool IsMovable(int node) const
  {
    if (this->Fixed[node])
    {
      return false;
    }
    const auto elements = this->TheBand.ElementsOfNode(node);
    return std::none_of(
             elements.begin(), elements.end(), [this](int e) { return this->TheBand.InHalo(e); }) &&
      this->Mover.MayRelax(node);
  }

  double ShortestEdge(int node) const
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

  /// Mean displacement of the neighbours within the layer, against the node's own.
  Vec3 WayOfNeighbours(int node) const
  {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      const int other = this->TheBand.OtherEnd(edge, node);
      if (this->Mover.IsLateral(node, other))
      {
        sum += this->TheMoves.Position[other] - this->TheBand.Point[other];
        ++count;
      }
    }
    const Vec3 own = this->TheMoves.Position[node] - this->TheBand.Point[node];
    return count > 0 ? Vec3(sum / count - own) : Vec3::Zero();
  }

  bool Improve(int node)
  {
    const double before = this->QualityAt(node);
    if (before >= this->Goal)
    {
      return false;
    }
    double best = before + SmallestGain;
    const Vec3 from = this->TheMoves.Position[node];
    Vec3 to = from;
    const auto attempt = [&](const Vec3& candidate)
    {
      Vec3 place;
      if (!this->Mover.Constrained(node, candidate, this->OnCut[node] != 0, place))
      {
        return;
      }
      this->TheMoves.Position[node] = AsStored(this->TheBand, place);
      const double quality = this->QualityAt(node);
      if (quality > best)
      {
        best = quality;
        to = this->TheMoves.Position[node];
      }
      this->TheMoves.Position[node] = from;
    };
    const Vec3 way = this->WayOfNeighbours(node);
    attempt(from + way);
    attempt(from + 0.5 * way);
    const double edge = this->ShortestEdge(node);
    const auto directions = this->Mover.Directions(node, from, this->OnCut[node] != 0);
    for (const double step : Steps)
    {
      const double found = best;
      for (const Vec3& direction : directions)
      {
        attempt(from + step * edge * direction);
      }
      if (best > found)
      {
        break;
      }
    }
    if (to == from)
    {
      return false;
    }
    this->TheMoves.Position[node] = to;
    this->TheMoves.Applied[node] =
      to != this->TheBand.Point[node] ? Correction::Relax : Correction::None;
    return true;
  }

  const Band& TheBand;
  const NodeMover& Mover;
  const std::vector<RelaxedElement>& Elements;
  const std::vector<char>& Fixed;
  const std::vector<char>& OnCut;
  double Goal;
  Moves& TheMoves;
};

}

void Relax(const Band& band, const NodeMover& mover, const std::vector<RelaxedElement>& elements,
  const std::vector<char>& active, const std::vector<char>& fixed, const std::vector<char>& onCut,
  double floor, Moves& moves)
{
  Relaxer(band, mover, elements, fixed, onCut, Margin * floor, moves).Run(active);
}

}
