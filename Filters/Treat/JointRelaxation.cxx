#include "JointRelaxation.h"

#include "LeastSquaresStep.h"
#include "StepDirections.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
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
/// An element that is worth so much more than a limit has no determinant below it.
constexpr double SameWorth = 1e-6;
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
    , Budget{ goal.Effort.Solving }
    , Directions(*this)
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
        [this](int e) { return this->IsLow(e); });
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
    std::vector<double> Cap; ///< by element
    Band::Lists Slots;       ///< of each element: its nodes, by their places in the part
    std::vector<int> Order;  ///< of elements: those that spoiled a step first
  };

  struct Variables
  {
    std::vector<int> First;      ///< by node of the part
    std::vector<Vec3> Direction; ///< as long as an edge
  };

  /// A determinant of an element, or an edge's worth, and how it changes.
  struct Row
  {
    double Value;
    std::size_t Element;    ///< of the part
    std::size_t Begin, End; ///< of its gradient
  };
  /// All there is to know of a part before a step.
  struct Linearisation
  {
    std::vector<double> Worth; ///< by element
    Variables Free;
    std::vector<Vec3> From; ///< by node
    std::vector<Row> Rows;
    std::vector<Slope> Gradients;
    /// Where nodes settle that a step leaves where they are, by node, once known.
    std::vector<std::optional<Vec3>> Home;
  };

  bool IsLow(int e) const
  {
    return this->Worth(e) < std::min(this->Goal / GoalMargin, this->EnoughFor(e, this->Goal));
  }

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
      if (std::binary_search(low.begin(), low.end(), e) && this->IsLow(e))
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
      this->Directions.TellMoved(nodes);
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
    std::vector<double> worth = this->WorthOf(part.Elements);
    std::optional<Linearisation> now;
    for (int step = 0;
         step < MostSteps && this->Work < MostWork && !this->Budget.IsSpent() && !this->Aborted();
         ++step)
    {
      const double lowest = this->LowestWanted(part, worth);
      if (lowest >= this->Goal * Reached / GoalMargin)
      {
        break;
      }
      if (!now)
      {
        now = this->Linearise(part, worth);
      }
      this->Work += now->Free.Direction.size();
      if (this->Step(part, *now, lowest, std::min(lowest + rise, this->Goal), damping, worth))
      {
        moved = true;
        rise = std::min(2.0 * rise, MostRise);
        now.reset();
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
        this->Hold(lowest, worth, part);
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
  /// @param[out] worth of the elements then.
  bool Step(Part& part, Linearisation& now, double lowest, double target, double& damping,
    std::vector<double>& worth)
  {
    const std::vector<StepDemand> demands = this->DemandsFor(part, now, target);
    std::vector<int> missed; // with more damping much the same ones
    for (int trial = 0; trial < MostTrials && !this->Budget.IsSpent(); ++trial, damping *= 8.0)
    {
      const Eigen::VectorXd way =
        FindLeastSquaresStep(demands, now.Free.Direction.size(), damping, this->Budget, missed);
      if (!(way.norm() < LongestStep))
      {
        continue;
      }
      for (const double share : { 1.0, 0.5 })
      {
        this->Shift(part.Nodes, now, share * way);
        std::vector<double> after = now.Worth;
        if (this->SettleBetter(part, now, lowest, after))
        {
          worth = std::move(after);
          damping = std::max(LeastDamping, 0.25 * damping);
          return true;
        }
        this->Place(part.Nodes, now.From);
      }
    }
    return false;
  }

  /// Each node settles by itself; false, with some that did not, if an element is no better for it.
  /// @param[in,out] worth of the elements, before and after.
  bool SettleBetter(Part& part, Linearisation& now, double lowest, std::vector<double>& worth)
  {
    enum : char
    {
      Unsettled,
      Stayed,
      Moved
    };
    std::vector<char> states(part.Nodes.size(), Unsettled);
    // What a step spoils another one is likely to spoil: it comes first then.
    for (std::size_t i = 0; i < part.Order.size(); ++i)
    {
      const int index = part.Order[i];
      bool moved = false;
      for (const int* slot = part.Slots.begin(index); slot != part.Slots.end(index); ++slot)
      {
        char& state = states[*slot];
        if (state == Unsettled)
        {
          state = this->SettleFrom(part.Nodes[*slot], *slot, now) ? Moved : Stayed;
        }
        moved |= state == Moved;
      }
      const double least = this->LeastOf(part.Cap[index], worth[index], lowest);
      worth[index] = moved ? this->Worth(part.Elements[index], least) : worth[index];
      if (!(worth[index] >= least))
      {
        std::rotate(part.Order.begin(), part.Order.begin() + i, part.Order.begin() + i + 1);
        return false;
      }
    }
    return true;
  }

  /// What an element has to be worth after a step.
  double LeastOf(double cap, double before, double lowest) const
  {
    return cap < this->Goal
      ? cap - Rounding
      : std::max(lowest + LeastGain, before >= this->Floor ? this->Floor : 0.0);
  }

  Variables VariablesOf(const std::vector<int>& nodes)
  {
    Variables variables;
    for (const int node : nodes)
    {
      variables.First.push_back(static_cast<int>(variables.Direction.size()));
      const Eigen::Matrix3Xd& directions = this->Directions.At(node);
      for (int i = 0; i < directions.cols(); ++i)
      {
        variables.Direction.push_back(directions.col(i));
      }
    }
    variables.First.push_back(static_cast<int>(variables.Direction.size()));
    return variables;
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

  Linearisation Linearise(const Part& part, const std::vector<double>& worth)
  {
    Linearisation now{ worth, this->VariablesOf(part.Nodes), this->PositionsOf(part.Nodes), {}, {},
      std::vector<std::optional<Vec3>>(part.Nodes.size()) };
    for (std::size_t i = 0; i < part.Elements.size(); ++i)
    {
      if (worth[i] < this->HighestOfRows() + SameWorth)
      {
        this->AddDeterminants(part.Elements[i], i, now);
        this->AddEdges(part.Elements[i], i, now);
      }
    }
    return now;
  }

  /// Adds the part of a gradient that is by one node; false if the node does not move.
  bool AddTo(Linearisation& now, int node, const Vec3& gradient) const
  {
    const int slot = this->Slot[node];
    if (slot < 0)
    {
      return false;
    }
    const int begin = now.Free.First[slot], end = now.Free.First[slot + 1];
    for (int v = begin; v < end && gradient != Vec3::Zero(); ++v)
    {
      now.Gradients.push_back({ v, gradient.dot(now.Free.Direction[v]) });
    }
    return begin < end;
  }

  /// What is above is of no concern to any step.
  double HighestOfRows() const { return std::max(this->Goal, this->Floor + FloorSlack) + Window; }

  void AddDeterminants(int e, std::size_t index, Linearisation& now) const
  {
    const auto& element = this->Elements[e];
    for (const auto& at :
      ScaledDeterminants(this->PointsOf(e), element.Count, this->HighestOfRows()))
    {
      const std::size_t begin = now.Gradients.size();
      bool moves = false;
      for (int i = 0; i < element.Count; ++i)
      {
        moves |= this->AddTo(now, element.Node[i], at.Gradient[i]);
      }
      if (moves)
      {
        now.Rows.push_back({ at.Value, index, begin, now.Gradients.size() });
      }
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
      if (worth < this->HighestOfRows())
      {
        const Vec3 along = way.norm() > NoEdge * before.norm() ? way : before;
        const Vec3 gradient = EdgeWorth / before.norm() * along.normalized();
        const std::size_t begin = now.Gradients.size();
        const bool moves = this->AddTo(now, a, -gradient);
        if (this->AddTo(now, b, gradient) || moves)
        {
          now.Rows.push_back({ worth, index, begin, now.Gradients.size() });
        }
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

  /// Whether a node has moved then.
  bool SettleFrom(int node, int slot, Linearisation& now)
  {
    Vec3& position = this->TheMoves.Position[node];
    const Vec3& from = now.From[slot];
    if (position == from)
    {
      auto& home = now.Home[slot];
      if (!home)
      {
        this->SettleOnWay(node, from);
        home = position;
      }
      position = *home;
    }
    else
    {
      this->SettleOnWay(node, from);
    }
    return position != from;
  }

  /// A node that finds no place where it went goes half of the way, or stays.
  void SettleOnWay(int node, const Vec3& from)
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
  SolvingBudget Budget;
  StepDirections Directions;
  std::vector<int> Slot; ///< by node: its place in the part that is raised, or -1
  std::size_t Work = 0;  ///< steps times free directions
};

}

void RelaxJointly(const RelaxationCase& given, const std::vector<int>& active,
  const RelaxationGoal& goal, Moves& moves)
{
  JointRelaxation(given, goal, moves).Run(active);
}

}
