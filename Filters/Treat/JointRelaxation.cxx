#include "JointRelaxation.h"

#include "LeastSquaresStep.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace trim
{
namespace
{

/// Elements count as raised a little before they are at the margin above the goal.
constexpr double Reached = 1.01;
/// Steps of one part, at most.
constexpr int MostSteps = 60;
/// Passes over all parts, and what an element has to gain for another one.
constexpr int MostPasses = 4;
constexpr double PassGain = 0.01;
/// How far above the lowest a step aims, at first and at most, and at least before it gives up.
constexpr double FirstRise = 0.05;
constexpr double MostRise = 0.2;
constexpr double LeastRise = 1e-3;
/// What a step has to gain.
constexpr double LeastGain = 1e-4;
/// Determinants that are this much above what a step aims at are left out of it.
constexpr double Window = 0.3;
/// Weight of a step's length, in edges, against what it misses.
constexpr double FirstDamping = 1e-3;
constexpr double LeastDamping = 1e-7;
constexpr int MostTrials = 4;
/// A longer step, in edges, is the rounding of equations without a solution: nodes that coincide.
constexpr double LongestStep = 1e3;
/// Elements this near to the lowest of a part cannot be raised when it cannot.
constexpr double SameLevel = 5e-3;
/// How much an element that is held may lose.
constexpr double HoldSlack = 1e-3;
constexpr double Rounding = 1e-9;
/// An edge with less of its length left has no direction.
constexpr double NoEdge = 1e-6;
/// How far above the floor an element aims that has reached it.
constexpr double FloorSlack = 1e-3;
/// Steps times free directions after which the relaxation ends.
constexpr std::size_t MostWork = 30000;
/// A larger part is divided: one for each element.
constexpr std::size_t MostNodes = 250;

class JointRelaxation : private RelaxedMesh
{
public:
  JointRelaxation(const RelaxationCase& given, const RelaxationGoal& goal, Moves& moves)
    : RelaxedMesh(given, moves)
    , Floor(goal.Floor)
    , Goal(GoalMargin * goal.Quality)
    , EndsEarly(goal.Effort.EndsEarly)
    , Slot(given.TheBand.NumberOfNodes(), -1)
  {
  }

  void Run(const std::vector<int>& active)
  {
    // What was held may be free to go on when the rest has come along.
    double gained = PassGain;
    for (int pass = 0; pass < MostPasses && gained >= PassGain; ++pass)
    {
      std::vector<int> low;
      std::copy_if(active.begin(), active.end(), std::back_inserter(low),
        [this](int e) { return this->Worth(e) < this->Goal / GoalMargin; });
      gained = 0.0;
      // Nodes that do not share elements are relaxed apart.
      for (const auto& part : this->PartsOf(this->NodesRound(low, RelaxedRings)))
      {
        gained = std::max(gained, this->RaisePart(part, low));
      }
    }
  }

private:
  /// Nodes that are moved together, the elements at them, and what those need not exceed: for
  /// elements that are to reach the goal the goal, for others what they had, or have when held.
  struct Part
  {
    std::vector<int> Nodes, Elements;
    std::vector<double> Cap; // by element
    Band::Lists Slots;       // of each element: its nodes, by their places in the part
    std::vector<int> Order;  // of elements: those that spoiled a step first
  };

  struct Variables
  {
    std::vector<int> First;      // by node of the part
    std::vector<Vec3> Direction; // as long as an edge
  };

  /// A determinant of an element, or an edge's worth, and how it changes.
  struct Row
  {
    double Value;
    std::size_t Element;    // of the part
    std::size_t Begin, End; // of its gradient
  };
  /// All there is to know of a part before a step.
  struct Linearisation
  {
    Variables Free;
    std::vector<Vec3> From;    // by node
    std::vector<double> Worth; // by element
    std::vector<Row> Rows;
    std::vector<Slope> Gradients;
  };

  /// Raises the elements of a part, one after the other where it is large; see Raise.
  double RaisePart(const std::vector<int>& nodes, const std::vector<int>& low)
  {
    if (nodes.size() <= MostNodes)
    {
      return this->Raise(nodes, low);
    }
    double gained = 0.0;
    for (const int e : this->ElementsAt(nodes))
    {
      if (std::binary_search(low.begin(), low.end(), e) && this->Worth(e) < this->Goal / GoalMargin)
      {
        std::vector<int> round = this->NodesRound({ e }, RelaxedRings);
        for (int rings = RelaxedRings - 1; round.size() > MostNodes && rings > 0; --rings)
        {
          round = this->NodesRound({ e }, rings);
        }
        gained = std::max(gained, this->Raise(round, low));
      }
    }
    return gained;
  }

  /// Returns by how much an element gained that is still short of the goal.
  double Raise(const std::vector<int>& nodes, const std::vector<int>& low)
  {
    this->TellSlots(nodes);
    Part part = this->PartOf(nodes);
    const std::vector<double> before = this->WorthOf(part.Elements);
    std::vector<char> wanted;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      wanted.push_back(std::binary_search(low.begin(), low.end(), part.Elements[i]));
      part.Cap.push_back(wanted[i] ? this->Goal : std::min(this->Goal, before[i]));
    }
    if (this->StepOn(part))
    {
      this->TellMoved(nodes);
    }
    double gained = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      const double worth = this->Worth(part.Elements[i]);
      if (wanted[i] && worth < this->Goal / GoalMargin)
      {
        gained = std::max(gained, worth - before[i]);
      }
    }
    this->ForgetSlots(nodes);
    return gained;
  }

  void TellSlots(const std::vector<int>& nodes)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      this->Slot[nodes[i]] = static_cast<int>(i);
    }
  }

  void ForgetSlots(const std::vector<int>& nodes)
  {
    for (const int node : nodes)
    {
      this->Slot[node] = -1;
    }
  }

  /// Without caps.
  Part PartOf(const std::vector<int>& nodes) const
  {
    Part part;
    part.Nodes = nodes;
    part.Elements = this->ElementsAt(nodes);
    part.Order.resize(part.Elements.size());
    std::iota(part.Order.begin(), part.Order.end(), 0);
    part.Slots = BuildLists(static_cast<int>(part.Elements.size()),
      [&](auto&& add)
      {
        for (const int index : part.Order)
        {
          const auto& element = this->Elements[part.Elements[index]];
          for (int i = 0; i < element.Count; ++i)
          {
            if (this->Slot[element.Node[i]] >= 0)
            {
              add(index, this->Slot[element.Node[i]]);
            }
          }
        }
      });
    return part;
  }

  /// Steps until the goal is reached or nothing more can be raised; false: no node moved.
  bool StepOn(Part& part)
  {
    bool moved = false;
    double rise = FirstRise;
    double damping = FirstDamping;
    Linearisation now;
    now.Worth = this->WorthOf(part.Elements);
    for (int step = 0; step < MostSteps && this->Work < MostWork; ++step)
    {
      const double lowest = this->LowestWanted(part, now.Worth);
      if (lowest >= this->Goal * Reached / GoalMargin)
      {
        break;
      }
      if (now.From.empty())
      {
        this->Linearise(part, now);
      }
      this->Work += now.Free.Direction.size();
      if (this->Step(part, now, lowest, std::min(lowest + rise, this->Goal), damping))
      {
        moved = true;
        rise = std::min(2.0 * rise, MostRise);
        now = {};
        now.Worth = this->WorthOf(part.Elements);
        continue;
      }
      rise *= 0.25;
      damping = FirstDamping;
      if (rise < LeastRise && this->EndsEarly)
      {
        this->Work = MostWork; // no other part is worth any more
      }
      else if (rise < LeastRise)
      {
        this->Hold(lowest, now.Worth, part);
        rise = FirstRise;
      }
    }
    return moved;
  }

  std::vector<double> WorthOf(const std::vector<int>& elements) const
  {
    std::vector<double> worth;
    for (const int e : elements)
    {
      worth.push_back(this->Worth(e));
    }
    return worth;
  }

  /// The lowest element that is to reach the goal.
  double LowestWanted(const Part& part, const std::vector<double>& worth) const
  {
    double lowest = this->Goal;
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      if (part.Cap[i] >= this->Goal)
      {
        lowest = std::min(lowest, worth[i]);
      }
    }
    return lowest;
  }

  /// The lowest ones are as good as they can be.
  void Hold(double lowest, const std::vector<double>& worth, Part& part) const
  {
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      if (part.Cap[i] >= this->Goal && worth[i] < lowest + SameLevel)
      {
        part.Cap[i] = worth[i] - HoldSlack;
      }
    }
  }

  /// Moves all nodes so that the lowest elements come nearer to the target; false if that fails.
  bool Step(Part& part, const Linearisation& now, double lowest, double target, double& damping)
  {
    const std::vector<StepDemand> demands = this->DemandsFor(part, now, target);
    for (int trial = 0; trial < MostTrials; ++trial, damping *= 8.0)
    {
      const Eigen::VectorXd way = FindLeastSquaresStep(demands, now.Free.Direction.size(), damping);
      if (!(way.norm() < LongestStep))
      {
        continue;
      }
      for (const double share : { 1.0, 0.5 })
      {
        this->Shift(part.Nodes, now, share * way);
        if (this->SettleBetter(part, now, lowest))
        {
          damping = std::max(LeastDamping, 0.25 * damping);
          return true;
        }
        this->Place(part.Nodes, now.From);
      }
    }
    return false;
  }

  /// Each node settles by itself; false, with some that did not, if an element is no better for it.
  bool SettleBetter(Part& part, const Linearisation& now, double lowest)
  {
    std::vector<char> isSettled(part.Nodes.size(), 0);
    const auto settle = [&](int slot)
    {
      if (!isSettled[slot])
      {
        isSettled[slot] = 1;
        this->SettleFrom(part.Nodes[slot], now.From[slot]);
      }
    };
    // What a step spoils another one is likely to spoil: it comes first then.
    for (std::size_t i = 0; i < part.Order.size(); ++i)
    {
      const int index = part.Order[i];
      std::for_each(part.Slots.begin(index), part.Slots.end(index), settle);
      if (!this->IsBetter(part, index, now.Worth[index], lowest))
      {
        std::rotate(part.Order.begin(), part.Order.begin() + i, part.Order.begin() + i + 1);
        return false;
      }
    }
    return true;
  }

  bool IsBetter(const Part& part, int index, double before, double lowest) const
  {
    const double least = part.Cap[index] < this->Goal
      ? part.Cap[index] - Rounding
      : std::max(lowest + LeastGain, before >= this->Floor ? this->Floor : 0.0);
    return this->Worth(part.Elements[index]) >= least;
  }

  Variables VariablesOf(const std::vector<int>& nodes)
  {
    Variables variables;
    for (const int node : nodes)
    {
      variables.First.push_back(static_cast<int>(variables.Direction.size()));
      const Eigen::Matrix3Xd directions = this->DirectionsAt(node);
      for (int i = 0; i < directions.cols(); ++i)
      {
        variables.Direction.push_back(directions.col(i));
      }
    }
    variables.First.push_back(static_cast<int>(variables.Direction.size()));
    return variables;
  }

  /// Tangents in which the edges at a node are of length one, so that a step is as easy along long
  /// edges as across.
  Eigen::Matrix3Xd DirectionsAt(int node)
  {
    const std::vector<Vec3> tangents = this->Mover.Tangents(
      node, this->FreedomOf(node), this->TheMoves.Position[node], this->OnCut[node] != 0);
    Eigen::Matrix3Xd t(3, tangents.size());
    for (std::size_t i = 0; i < tangents.size(); ++i)
    {
      t.col(static_cast<int>(i)) = tangents[i];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> metric(
      t.transpose() * this->EdgeMetric(node) * t);
    if (!(metric.eigenvalues().minCoeff() > 0.0))
    {
      return Eigen::Matrix3Xd(3, 0); // the surface touches the skin there
    }
    return t * metric.operatorInverseSqrt();
  }

  /// What has reached the floor stays there; what is held stays where it is.
  double AimOf(double worth, double cap, double target) const
  {
    if (cap < this->Goal)
    {
      return std::min(cap + HoldSlack, this->Goal);
    }
    return worth >= this->Floor ? std::max(target, this->Floor + FloorSlack) : target;
  }

  /// The rows that a step to a target may need.
  std::vector<StepDemand> DemandsFor(
    const Part& part, const Linearisation& now, double target) const
  {
    std::vector<StepDemand> demands;
    const Slope* slopes = now.Gradients.data();
    for (const Row& row : now.Rows)
    {
      const double aim = this->AimOf(now.Worth[row.Element], part.Cap[row.Element], target);
      if (row.Value < aim + Window)
      {
        demands.push_back({ row.Value, aim, slopes + row.Begin, slopes + row.End });
      }
    }
    return demands;
  }

  /// @param[in,out] now has the worth of the elements.
  void Linearise(const Part& part, Linearisation& now)
  {
    now.From = this->PositionsOf(part.Nodes);
    now.Free = this->VariablesOf(part.Nodes);
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      this->AddDeterminants(part.Elements[i], i, now);
      this->AddEdges(part.Elements[i], i, now);
    }
  }

  void AddTo(Linearisation& now, int node, const Vec3& gradient) const
  {
    const int slot = this->Slot[node];
    if (slot < 0)
    {
      return;
    }
    for (int v = now.Free.First[slot]; v < now.Free.First[slot + 1]; ++v)
    {
      now.Gradients.push_back({ v, gradient.dot(now.Free.Direction[v]) });
    }
  }

  /// Adds a row with what was added to the gradients since `begin`.
  static void AddRow(double value, std::size_t element, std::size_t begin, Linearisation& now)
  {
    if (now.Gradients.size() > begin)
    {
      now.Rows.push_back({ value, element, begin, now.Gradients.size() });
    }
  }

  /// No step aims at more.
  double HighestAim() const { return std::max(this->Goal, this->Floor + FloorSlack); }

  void AddDeterminants(int e, std::size_t index, Linearisation& now) const
  {
    const auto& element = this->Elements[e];
    for (const auto& at : ScaledDeterminants(this->PointsOf(e), element.Count))
    {
      if (at.Value >= this->HighestAim() + Window)
      {
        continue;
      }
      const std::size_t begin = now.Gradients.size();
      for (int i = 0; i < element.Count; ++i)
      {
        this->AddTo(now, element.Node[i], at.Gradient[i]);
      }
      AddRow(at.Value, index, begin, now);
    }
  }

  void AddEdges(int e, std::size_t index, Linearisation& now) const
  {
    const auto& element = this->Elements[e];
    const auto& topology = TopologyOf(element.Count);
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const int a = element.Node[topology.Edges[i].First];
      const int b = element.Node[topology.Edges[i].Second];
      const Vec3 way = this->TheMoves.Position[b] - this->TheMoves.Position[a];
      const Vec3 before = this->TheBand.Point[b] - this->TheBand.Point[a];
      const double worth = EdgeWorth * way.norm() / before.norm();
      if (worth < this->HighestAim() + Window)
      {
        const Vec3 along = way.norm() > NoEdge * before.norm() ? way : before;
        const Vec3 gradient = EdgeWorth / before.norm() * along.normalized();
        const std::size_t begin = now.Gradients.size();
        this->AddTo(now, a, -gradient);
        this->AddTo(now, b, gradient);
        AddRow(worth, index, begin, now);
      }
    }
  }

  void Shift(const std::vector<int>& nodes, const Linearisation& now, const Eigen::VectorXd& way)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      Vec3 to = now.From[i];
      for (int v = now.Free.First[i]; v < now.Free.First[i + 1]; ++v)
      {
        to += way[v] * now.Free.Direction[v];
      }
      this->TheMoves.Position[nodes[i]] = to;
    }
  }

  /// A node that finds no place where it went goes half of the way, or stays.
  void SettleFrom(int node, const Vec3& from)
  {
    Vec3& position = this->TheMoves.Position[node];
    const Vec3 to = position;
    double share = 1.0;
    while (!this->Settle({ node }))
    {
      share *= 0.5;
      if (share < 0.2)
      {
        position = from;
        break;
      }
      position = from + share * (to - from);
    }
  }

  double Floor;
  double Goal;
  bool EndsEarly;
  std::vector<int> Slot; // by node: its place in the part that is raised, or -1
  std::size_t Work = 0;  // steps times free directions
};

}

void RelaxJointly(const RelaxationCase& given, const std::vector<int>& active,
  const RelaxationGoal& goal, Moves& moves)
{
  JointRelaxation(given, goal, moves).Run(active);
}

}
