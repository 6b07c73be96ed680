#include "JointRelaxation.h"

#include <vtkSMPTools.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace trim
{
namespace
{

/// Elements count as raised a little before they are at the margin above the goal.
constexpr double Reached = 1.01;
/// Steps of one patch, at most.
constexpr int MostSteps = 60;
/// Passes over all patches, and what an element has to gain for another one.
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
/// Elements this near to the lowest of a patch cannot be raised when it cannot.
constexpr double SameLevel = 5e-3;
/// How much an element that is held may lose.
constexpr double HoldSlack = 1e-3;
constexpr double Rounding = 1e-9;
/// What an edge is worth that has its whole length, as a scaled Jacobian.
constexpr double EdgeWorth = 6.0;
/// An edge with less of its length left has no direction.
constexpr double NoEdge = 1e-6;
/// How far above the floor an element aims that has reached it.
constexpr double FloorSlack = 1e-3;
/// How often a step is corrected for rows that it makes miss.
constexpr int MostRounds = 12;
/// Steps times free directions after which the relaxation ends.
constexpr std::size_t MostWork = 30000;
/// A larger patch is divided: one for each element.
constexpr std::size_t MostNodes = 250;
/// With fewer for each, threads cost more than they save.
constexpr Id NodesPerThread = 128;

class Patch : private RelaxedMesh
{
public:
  Patch(const RelaxationCase& given, const RelaxationGoal& goal, Moves& moves)
    : RelaxedMesh(given, moves)
    , Floor(goal.Floor)
    , Goal(GoalMargin * goal.Quality)
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
  };

  struct Row
  {
    double Value, Target;
    std::vector<std::pair<int, double>> Gradient; // by variable
  };

  struct Variables
  {
    std::vector<int> First;      // by node of the patch
    std::vector<Vec3> Direction; // as long as an edge
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
    Part part{ nodes, this->ElementsAt(nodes), {} };
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
    return gained;
  }

  /// Steps until the goal is reached or nothing more can be raised; false: no node moved.
  bool StepOn(Part& part)
  {
    bool moved = false;
    double rise = FirstRise;
    double damping = FirstDamping;
    for (int step = 0; step < MostSteps && this->Work < MostWork; ++step)
    {
      const double lowest = this->LowestWanted(part);
      if (lowest >= this->Goal * Reached / GoalMargin)
      {
        break;
      }
      if (this->Step(part, lowest, std::min(lowest + rise, this->Goal), damping))
      {
        moved = true;
        rise = std::min(2.0 * rise, MostRise);
        continue;
      }
      rise *= 0.25;
      damping = FirstDamping;
      if (rise < LeastRise)
      {
        this->Hold(lowest, part);
        rise = FirstRise;
      }
    }
    return moved;
  }

  /// Scaled Jacobian of an element, or less where an edge vanishes.
  double Worth(int element) const
  {
    return std::min(this->Quality(element), EdgeWorth * this->ShortestEdgeShare(element));
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
  double LowestWanted(const Part& part) const
  {
    double lowest = this->Goal;
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      if (part.Cap[i] >= this->Goal)
      {
        lowest = std::min(lowest, this->Worth(part.Elements[i]));
      }
    }
    return lowest;
  }

  /// The lowest ones are as good as they can be.
  void Hold(double lowest, Part& part) const
  {
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      const double worth = this->Worth(part.Elements[i]);
      if (part.Cap[i] >= this->Goal && worth < lowest + SameLevel)
      {
        part.Cap[i] = worth - HoldSlack;
      }
    }
  }

  /// Moves all nodes so that the lowest elements come nearer to the target; false if that fails.
  bool Step(const Part& part, double lowest, double target, double& damping)
  {
    const Variables variables = this->VariablesOf(part.Nodes);
    this->Work += variables.Direction.size();
    const std::vector<Row> rows = this->Linearise(part, variables, target);
    const std::vector<Vec3> from = this->PositionsOf(part.Nodes);
    const std::vector<double> before = this->WorthOf(part.Elements);
    for (int trial = 0; trial < MostTrials; ++trial, damping *= 8.0)
    {
      const Eigen::VectorXd way =
        Solve(rows, static_cast<int>(variables.Direction.size()), damping);
      if (!(way.norm() < LongestStep))
      {
        continue;
      }
      for (const double share : { 1.0, 0.5 })
      {
        this->Shift(part.Nodes, from, variables, share * way);
        this->SettleEach(part.Nodes, from);
        if (this->IsBetter(part, before, lowest))
        {
          damping = std::max(LeastDamping, 0.25 * damping);
          return true;
        }
        this->Place(part.Nodes, from);
      }
    }
    return false;
  }

  bool IsBetter(const Part& part, const std::vector<double>& before, double lowest) const
  {
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      const double least = part.Cap[i] < this->Goal
        ? part.Cap[i] - Rounding
        : std::max(lowest + LeastGain, before[i] >= this->Floor ? this->Floor : 0.0);
      if (!(this->Worth(part.Elements[i]) >= least))
      {
        return false;
      }
    }
    return true;
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
  double AimOf(int element, double cap, double target) const
  {
    if (cap < this->Goal)
    {
      return std::min(cap + HoldSlack, this->Goal);
    }
    return this->Worth(element) >= this->Floor ? std::max(target, this->Floor + FloorSlack)
                                               : target;
  }

  std::vector<Row> Linearise(const Part& part, const Variables& variables, double target) const
  {
    Slots slots;
    for (std::size_t i = 0; i < part.Nodes.size(); ++i)
    {
      slots[part.Nodes[i]] = static_cast<int>(i);
    }
    std::vector<Row> rows;
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      const double aim = this->AimOf(part.Elements[i], part.Cap[i], target);
      this->AddDeterminants(part.Elements[i], aim, slots, variables, rows);
      this->AddEdges(part.Elements[i], aim, slots, variables, rows);
    }
    rows.erase(
      std::remove_if(rows.begin(), rows.end(), [](const Row& row) { return row.Gradient.empty(); }),
      rows.end());
    return rows;
  }

  using Slots = std::unordered_map<int, int>; // of nodes in their part

  static void AddTo(
    Row& row, int node, const Vec3& gradient, const Slots& slots, const Variables& variables)
  {
    const auto slot = slots.find(node);
    if (slot == slots.end())
    {
      return;
    }
    for (int v = variables.First[slot->second]; v < variables.First[slot->second + 1]; ++v)
    {
      row.Gradient.emplace_back(v, gradient.dot(variables.Direction[v]));
    }
  }

  void AddDeterminants(
    int e, double aim, const Slots& slots, const Variables& variables, std::vector<Row>& rows) const
  {
    const auto& element = this->Elements[e];
    for (const auto& at : ScaledDeterminants(this->PointsOf(e), element.Count))
    {
      if (at.Value >= aim + Window)
      {
        continue;
      }
      rows.push_back({ at.Value, aim, {} });
      for (int i = 0; i < element.Count; ++i)
      {
        AddTo(rows.back(), element.Node[i], at.Gradient[i], slots, variables);
      }
    }
  }

  void AddEdges(
    int e, double aim, const Slots& slots, const Variables& variables, std::vector<Row>& rows) const
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
      if (worth < aim + Window)
      {
        const Vec3 along = way.norm() > NoEdge * before.norm() ? way : before;
        const Vec3 gradient = EdgeWorth / before.norm() * along.normalized();
        rows.push_back({ worth, aim, {} });
        AddTo(rows.back(), a, -gradient, slots, variables);
        AddTo(rows.back(), b, gradient, slots, variables);
      }
    }
  }

  /// The step that misses the targets least, in the sum of squares, with its length. Which rows
  /// miss is found by repetition.
  static Eigen::VectorXd Solve(const std::vector<Row>& rows, int variables, double damping)
  {
    Eigen::VectorXd way = Eigen::VectorXd::Zero(variables);
    std::vector<int> last;
    for (int round = 0; round < MostRounds; ++round)
    {
      std::vector<int> missed;
      for (std::size_t i = 0; i < rows.size(); ++i)
      {
        double value = rows[i].Value;
        for (const auto& [v, g] : rows[i].Gradient)
        {
          value += g * way[v];
        }
        if (value < rows[i].Target)
        {
          missed.push_back(static_cast<int>(i));
        }
      }
      if (missed == last)
      {
        break;
      }
      way = SolveFor(rows, missed, variables, damping);
      last = std::move(missed);
    }
    return way;
  }

  /// Least squares of the rows that miss, by their normal equations: there are fewer rows than
  /// variables.
  static Eigen::VectorXd SolveFor(
    const std::vector<Row>& rows, const std::vector<int>& missed, int variables, double damping)
  {
    const int count = static_cast<int>(missed.size());
    std::vector<std::vector<std::pair<int, double>>> byVariable(variables);
    Eigen::VectorXd misses(count);
    for (int i = 0; i < count; ++i)
    {
      const Row& row = rows[missed[i]];
      misses[i] = row.Target - row.Value;
      for (const auto& [v, g] : row.Gradient)
      {
        byVariable[v].emplace_back(i, g);
      }
    }
    Eigen::MatrixXd products = damping * Eigen::MatrixXd::Identity(count, count);
    for (const auto& column : byVariable)
    {
      // Half of them: the matrix is symmetric.
      for (auto first = column.begin(); first != column.end(); ++first)
      {
        for (auto second = first; second != column.end(); ++second)
        {
          products(second->first, first->first) += second->second * first->second;
        }
      }
    }
    const Eigen::VectorXd weights = products.ldlt().solve(misses);
    Eigen::VectorXd way = Eigen::VectorXd::Zero(variables);
    for (int v = 0; v < variables; ++v)
    {
      for (const auto& [i, g] : byVariable[v])
      {
        way[v] += weights[i] * g;
      }
    }
    return way;
  }

  void Shift(const std::vector<int>& nodes, const std::vector<Vec3>& from,
    const Variables& variables, const Eigen::VectorXd& way)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      Vec3 to = from[i];
      for (int v = variables.First[i]; v < variables.First[i + 1]; ++v)
      {
        to += way[v] * variables.Direction[v];
      }
      this->TheMoves.Position[nodes[i]] = to;
    }
  }

  /// Each node settles by itself.
  void SettleEach(const std::vector<int>& nodes, const std::vector<Vec3>& from)
  {
    vtkSMPTools::For(0, static_cast<Id>(nodes.size()), NodesPerThread,
      [&](Id begin, Id end)
      {
        for (Id i = begin; i < end; ++i)
        {
          this->SettleFrom(nodes[i], from[i]);
        }
      });
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
  std::size_t Work = 0; // steps times free directions
};

}

void RelaxJointly(const RelaxationCase& given, const std::vector<int>& active,
  const RelaxationGoal& goal, Moves& moves)
{
  Patch(given, goal, moves).Run(active);
}

}
