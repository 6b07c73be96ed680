#include "ShapeDescent.h"

#include "CornerShape.h"
#include "StepDirections.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// Rings of nodes round the elements below the goal that may move.
constexpr int DescentRings = 4;
/// After so many sweeps it is asked whether all is well; so many stages, and so many in vain.
constexpr int SweepsOfStage = 5;
constexpr int MostStages = 12, MostVain = 3;
/// What is added to determinants: this share of the most inverted one, and never less than that.
constexpr double ShareOfInverted = 0.2;
constexpr double LeastRegularisation = 0.03;
/// What a step gains for each corner at a node, at least, to be worth another one.
constexpr double LeastGain = 5e-3;
constexpr int MostHalvings = 4;
/// Layers come thinner than they are to be: their elements' way through them counts as so much.
constexpr double LayerGrowth = 2.0;
/// Elements that stay below what they are to have count for more and more.
constexpr double FactorGrowth = 2.0, MostFactor = 8.0;
/// Newton's matrix is shifted by so much of its norm, and by more where it is not definite.
constexpr double LeastShift = 1e-9, MostShift = 10.0, ShiftGrowth = 100.0;

/// Which of an element's directions an edge has: a hexahedron's three, a wedge's triangle's (0) and
/// its axis (2).
int DirectionOf(int count, int a, int b)
{
  const int half = count / 2;
  if ((a < half) != (b < half))
  {
    return 2;
  }
  return count == 8 && (std::min(a, b) % half + std::max(a, b) % half) % 4 == 3 ? 1 : 0;
}

/// In the free directions, of which there may be fewer than three.
Vec3 NewtonStep(const Derivatives& at, const Eigen::Matrix3Xd& directions)
{
  Eigen::Matrix3d free = Eigen::Matrix3d::Zero();
  free.leftCols(directions.cols()) = directions;
  Eigen::Matrix3d hessian = free.transpose() * at.Hessian * free;
  const double norm = hessian.norm();
  hessian.diagonal().tail(3 - directions.cols()).setConstant(norm);
  for (double shift = LeastShift; shift < MostShift; shift *= ShiftGrowth)
  {
    const Eigen::LLT<Eigen::Matrix3d> solver(hessian + shift * norm * Eigen::Matrix3d::Identity());
    if (solver.info() == Eigen::Success)
    {
      return -(free * solver.solve(free.transpose() * at.Gradient));
    }
  }
  return Vec3::Zero();
}

class ShapeDescent : private RelaxedMesh
{
public:
  ShapeDescent(
    const RelaxationCase& given, const std::vector<int>& active, double goal, Moves& moves)
    : RelaxedMesh(given, moves)
    , Goal(goal)
    , Directions(*this)
    , Nodes(this->NodesRound(active, DescentRings))
    , Around(this->ElementsAt(this->Nodes))
    , Slot(given.TheBand.NumberOfNodes(), -1)
    , WorthTrying(this->Nodes.size(), 1)
    , Factor(given.TheBand.NumberOfElements(), 1.0)
  {
    for (std::size_t i = 0; i < this->Nodes.size(); ++i)
    {
      this->Slot[this->Nodes[i]] = static_cast<int>(i);
    }
    for (const int e : this->Around)
    {
      this->AddCorners(e);
    }
    this->CornersAt = BuildLists(static_cast<int>(this->Nodes.size()),
      [this](auto&& add)
      {
        for (std::size_t c = 0; c < this->Corners.size(); ++c)
        {
          this->ForSlots(this->Corners[c].Node, [&](int slot) { add(slot, static_cast<int>(c)); });
        }
      });
  }

  /// Sweeps as long as elements are raised by it.
  std::vector<int> Run()
  {
    std::vector<Vec3> best = this->PositionsOf(this->Nodes);
    std::vector<int> low = this->FindLow();
    bool moved = false;
    for (int stage = 0, vain = 0;
         stage < MostStages && vain < MostVain && !low.empty() && !this->Aborted(); ++stage)
    {
      this->Regularise();
      for (int sweep = 0; sweep < SweepsOfStage; ++sweep)
      {
        this->Sweep();
      }
      std::vector<int> now = this->FindLow();
      this->Emphasise(now);
      ++vain;
      if (now.size() < low.size())
      {
        low = std::move(now);
        best = this->PositionsOf(this->Nodes);
        moved = true;
        vain = 0;
      }
    }
    this->Place(this->Nodes, best);
    if (moved)
    {
      this->TellMoved(this->Nodes);
    }
    return low;
  }

private:
  template <typename List, typename Visit>
  void ForSlots(const List& nodes, const Visit& visit) const
  {
    for (const int node : nodes)
    {
      if (this->Slot[node] >= 0)
      {
        visit(this->Slot[node]);
      }
    }
  }

  void AddCorners(int e)
  {
    const RelaxedElement& element = this->Elements[e];
    const Vec3 wanted = this->LengthsOf(e);
    for (int i = 0; i < element.Count; ++i)
    {
      const int* ends = CornerEnds(i, element.Count);
      Corner corner;
      corner.Element = e;
      corner.Node[0] = element.Node[i];
      Vec3 lengths;
      for (int k = 0; k < 3; ++k)
      {
        corner.Node[k + 1] = element.Node[ends[k]];
        lengths[k] = wanted[DirectionOf(element.Count, i, ends[k])];
      }
      corner.Scale = ScaleOfCorner(lengths, element.Count);
      this->Corners.push_back(corner);
    }
  }

  /// The mean length that the edges of an element in each of its directions are to have.
  Vec3 LengthsOf(int e) const
  {
    const RelaxedElement& element = this->Elements[e];
    const auto& topology = TopologyOf(element.Count);
    Vec3 sum = Vec3::Zero();
    std::array<int, 3> count{};
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const auto& edge = topology.Edges[i];
      const int direction = DirectionOf(element.Count, edge.First, edge.Second);
      sum[direction] += std::sqrt(
        SquaredLengthBefore(this->TheBand, element.Node[edge.First], element.Node[edge.Second]));
      ++count[direction];
    }
    for (int direction = 0; direction < 3; ++direction)
    {
      sum[direction] /= std::max(count[direction], 1); // a wedge has but two
    }
    sum[2] *= this->TheBand.IsInserted(e) ? LayerGrowth : 1.0;
    return sum;
  }

  /// Elements that have less than they are to have.
  std::vector<int> FindLow() const
  {
    std::vector<int> low;
    for (const int e : this->Around)
    {
      if (this->Worth(e) < std::min(this->Goal, this->EnoughFor(e, this->Goal)))
      {
        low.push_back(e);
      }
    }
    return low;
  }

  /// Nothing is added to determinants where all are positive.
  void Regularise()
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Corner& corner : this->Corners)
    {
      const double determinant = EdgesOf(corner, this->TheMoves.Position).determinant();
      least = std::min(least, determinant);
      if (determinant < this->Positive.GetEpsilon())
      {
        this->TryAgain(corner.Node);
      }
    }
    this->Positive = PositiveDeterminant(
      least > 0.0 ? 0.0 : std::max(LeastRegularisation, -ShareOfInverted * least));
  }

  /// What is valid, but low, counts for more; inverted elements that stay so would spoil others.
  void Emphasise(const std::vector<int>& low)
  {
    for (const int e : low)
    {
      if (this->Worth(e) > 0.0)
      {
        this->Factor[e] = std::min(MostFactor, FactorGrowth * this->Factor[e]);
        this->TryAgain(this->Elements[e]);
      }
    }
  }

  template <typename List>
  void TryAgain(const List& nodes)
  {
    this->ForSlots(nodes, [this](int slot) { this->WorthTrying[slot] = 1; });
  }

  /// What hardly gains is not tried again before something moves round it.
  void Sweep()
  {
    for (int slot = 0; slot < static_cast<int>(this->Nodes.size()); ++slot)
    {
      if (!this->WorthTrying[slot])
      {
        continue;
      }
      const auto* begin = this->CornersAt.begin(slot);
      const auto* end = this->CornersAt.end(slot);
      if (this->StepNode(slot) > LeastGain * static_cast<double>(end - begin))
      {
        std::for_each(begin, end, [this](int c) { this->TryAgain(this->Corners[c].Node); });
      }
      else
      {
        this->WorthTrying[slot] = 0;
      }
    }
  }

  /// @return by how much the energy is less.
  double StepNode(int slot)
  {
    const int node = this->Nodes[slot];
    const Eigen::Matrix3Xd& directions = this->Directions.At(node);
    if (directions.cols() == 0)
    {
      return 0.0;
    }
    this->Energies.clear();
    Derivatives at;
    for (const int* c = this->CornersAt.begin(slot); c != this->CornersAt.end(slot); ++c)
    {
      const Corner& corner = this->Corners[*c];
      this->Energies.emplace_back(
        corner, EdgesOf(corner, this->TheMoves.Position), node, this->Factor[corner.Element]);
      this->Energies.back().AddDerivatives(this->Positive, at);
    }
    return this->StepOn(node, NewtonStep(at, directions));
  }

  /// Goes along a way as far as the energy becomes less.
  double StepOn(int node, const Vec3& way)
  {
    Vec3& position = this->TheMoves.Position[node];
    const Vec3 from = position;
    const double before = this->EnergyAfter(Vec3::Zero());
    double share = 1.0;
    for (int halvings = 0; halvings <= MostHalvings; ++halvings, share *= 0.5)
    {
      if (!(this->EnergyAfter(share * way) < before))
      {
        continue;
      }
      position = from + share * way;
      const double gained =
        this->Settle({ node }) ? before - this->EnergyAfter(position - from) : 0.0;
      if (gained > 0.0)
      {
        return gained;
      }
      position = from;
    }
    return 0.0;
  }

  double EnergyAfter(const Vec3& step) const
  {
    double energy = 0.0;
    for (const CornerEnergy& corner : this->Energies)
    {
      energy += corner.After(step, this->Positive);
    }
    return energy;
  }

  double Goal;
  StepDirections Directions;
  std::vector<int> Nodes, Around; ///< that move, and elements at them
  std::vector<int> Slot;          ///< by node: its place in Nodes, or -1
  std::vector<char> WorthTrying;  ///< by slot
  std::vector<double> Factor;     ///< of the energy, by element
  std::vector<Corner> Corners;    ///< of the elements around
  Band::Lists CornersAt;          ///< by slot
  PositiveDeterminant Positive;
  std::vector<CornerEnergy> Energies; ///< of the corners at the node that steps
};

}

std::vector<int> DescendToShape(
  const RelaxationCase& given, const std::vector<int>& active, double goal, Moves& moves)
{
  return ShapeDescent(given, active, goal, moves).Run();
}

}
