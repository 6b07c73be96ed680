#include "Relaxation.h"

#include "Wavefront.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace trim
{
namespace
{

/// Steps of the search, in lengths of the shortest edge at the node.
constexpr std::array<double, 4> Steps{ 0.3, 0.1, 0.03, 0.01 };
/// Where an element is below this, the ways to the surface are spread over the nodes behind first.
constexpr double SpreadQuality = 0.2;
constexpr int SpreadRounds = 30;
constexpr int SpreadAttempts = 10;
/// On a curved surface or skin a step may turn out better than it looks by this much.
constexpr double Foresight = 0.02;

/// The square of the length of an edge that is as good as none.
constexpr double NoLength = 1e-100;

constexpr std::size_t LeastForThreads = 500;

class Relaxer : private RelaxedMesh
{
public:
  Relaxer(const RelaxationCase& given, const RelaxationGoal& goal, Moves& moves)
    : RelaxedMesh(given, moves)
    , Floor(goal.Floor)
    , Goal(GoalMargin * goal.Quality)
    , Effort(goal.Effort)
    , IsRelaxed(given.TheBand.NumberOfNodes(), 0)
    , WorthTrying(given.TheBand.NumberOfNodes())
    , KnownWorth(given.TheBand.NumberOfElements(), Unknown)
  {
  }

  void Run(const std::vector<int>& active)
  {
    const std::vector<int> nodes = this->NodesRound(active, RelaxedRings);
    const std::vector<std::vector<int>> parts = this->PartsOf(nodes);
    this->Spread(parts);
    std::vector<Pillar> pillars;
    for (const auto& part : parts)
    {
      this->AddPillars(part, pillars);
    }
    // For a few nodes threads cost more than they save.
    if (nodes.size() < LeastForThreads || ThreadsForLoops() < 2)
    {
      this->Sweep(active,
        [&](const auto& improve) { std::for_each(pillars.begin(), pillars.end(), improve); });
      return;
    }
    const Wavefront inTurn(this->MetBefore(pillars));
    this->Sweep(
      active, [&](const auto& improve) { inTurn.Run([&](int i) { improve(pillars[i]); }); });
  }

private:
  using Pillar = std::vector<int>;

  /// Improves pillars in turn, again and again.
  /// @param forAll calls a function for each of them, as if in their order.
  template <typename ForAll>
  void Sweep(const std::vector<int>& active, const ForAll& forAll)
  {
    for (int sweep = 0; sweep < this->Effort.Sweeps && !this->Aborted(); ++sweep)
    {
      std::atomic<bool> gained{ false };
      forAll(
        [&](const Pillar& pillar)
        {
          // What was tried in vain is not tried again before something moves round it.
          auto& worthIt = this->WorthTrying[this->Mover.PillarOf(pillar.front())];
          if (worthIt.exchange(0, std::memory_order_relaxed) && this->ImproveEach(pillar))
          {
            gained.store(true, std::memory_order_relaxed);
          }
        });
      if (!gained || this->Reached(active))
      {
        return;
      }
    }
  }

  /// For each pillar those before it that share an element with it: one of them must not move
  /// while the other looks.
  Band::Lists MetBefore(const std::vector<Pillar>& pillars) const
  {
    const int count = static_cast<int>(pillars.size());
    std::vector<int> slot(this->TheBand.NumberOfNodes(), count);
    std::vector<int> last(count, -1); // by pillar: the last one that it was listed for
    Band::Lists met{ { 0 }, {} };
    for (int i = 0; i < count; ++i)
    {
      for (const int node : pillars[i])
      {
        slot[node] = i;
        for (const int e : this->TheBand.ElementsOfNode(node))
        {
          const auto& element = this->TheBand.Elements[e];
          for (int k = 0; k < element.Count; ++k)
          {
            const int other = slot[element.Node[k]];
            if (other < i && last[other] != i)
            {
              last[other] = i;
              met.Item.push_back(other);
            }
          }
        }
      }
      met.Offset.push_back(static_cast<int>(met.Item.size()));
    }
    return met;
  }

  /// An element is no better than its worse end: the whole pillar first, then its nodes.
  bool ImproveEach(const Pillar& pillar)
  {
    if (this->Improve(pillar))
    {
      return true;
    }
    bool gained = false;
    for (std::size_t i = 0; pillar.size() > 1 && i < pillar.size(); ++i)
    {
      gained |= this->Improve({ pillar[i] });
    }
    return gained;
  }

  /**
   * Where the cut came farther into the mesh than the next nodes are, steps of single nodes do not
   * get out again: there the nodes behind it go along, each as far as its neighbours in the mean.
   */
  void Spread(std::vector<std::vector<int>> parts)
  {
    for (auto& part : parts)
    {
      part.erase(
        std::remove_if(part.begin(), part.end(), [this](int n) { return this->OnCut[n] != 0; }),
        part.end());
      this->SpreadOver(part);
    }
  }

  void SpreadOver(std::vector<int> nodes)
  {
    const std::vector<int> elements = this->ElementsAt(nodes);
    const std::vector<double> before = this->QualitiesOf(elements);
    if (elements.empty() || *std::min_element(before.begin(), before.end()) >= SpreadQuality)
    {
      return;
    }
    // What helps along most of a long cut may do harm at a place of it: there the nodes stay.
    for (int attempt = 0; attempt < SpreadAttempts && !nodes.empty() && !this->Aborted(); ++attempt)
    {
      const std::vector<Vec3> from = this->PositionsOf(nodes);
      std::vector<int> staying = this->TakeWays(nodes);
      const std::vector<double> after = this->QualitiesOf(elements);
      const std::vector<int> spoiled = this->NodesOfSpoiled(elements, before, after);
      if (staying.empty() &&
        (this->RaisesLowest(before, after) ||
          (spoiled.empty() && Shortage(after) < Shortage(before))))
      {
        this->TellMoved(nodes);
        return;
      }
      this->Place(nodes, from);
      staying.insert(staying.end(), spoiled.begin(), spoiled.end());
      std::sort(staying.begin(), staying.end());
      const auto end = std::remove_if(nodes.begin(), nodes.end(),
        [&staying](int n) { return std::binary_search(staying.begin(), staying.end(), n); });
      if (end == nodes.end())
      {
        return;
      }
      nodes.erase(end, nodes.end());
    }
  }

  /// Lets nodes go along with their neighbours; returns those that found no place.
  std::vector<int> TakeWays(const std::vector<int>& nodes)
  {
    const Band::Lists beside = BuildLists(static_cast<int>(nodes.size()),
      [&](auto&& add)
      {
        for (std::size_t i = 0; i < nodes.size(); ++i)
        {
          this->ForNeighbours(nodes[i], [&](int other) { add(static_cast<int>(i), other); });
        }
      });
    for (int round = 0; round < SpreadRounds; ++round)
    {
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        const int at = static_cast<int>(i);
        this->TheMoves.Position[nodes[i]] +=
          this->WayOf(nodes[i], Band::Range{ beside.begin(at), beside.end(at) });
      }
    }
    std::vector<int> lost;
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(lost),
      [this](int node) { return !this->Settle({ node }); });
    return lost;
  }

  /// No more than the goal.
  std::vector<double> QualitiesOf(const std::vector<int>& elements) const
  {
    std::vector<double> qualities;
    std::transform(elements.begin(), elements.end(), std::back_inserter(qualities),
      [this](int e) { return std::min(this->Goal, this->WorthOrGoal(e)); });
    return qualities;
  }

  /// Whether the lowest has come up and no more are below the floor.
  bool RaisesLowest(const std::vector<double>& before, const std::vector<double>& after) const
  {
    const auto below = [this](double quality) { return quality < this->Floor; };
    return *std::min_element(after.begin(), after.end()) >
      *std::min_element(before.begin(), before.end()) + this->Effort.Gain &&
      std::count_if(after.begin(), after.end(), below) <=
      std::count_if(before.begin(), before.end(), below);
  }

  /// By how much qualities miss what needs no spreading.
  static double Shortage(const std::vector<double>& qualities)
  {
    return std::accumulate(qualities.begin(), qualities.end(), 0.0,
      [](double sum, double quality) { return sum + std::max(0.0, SpreadQuality - quality); });
  }

  /// Nodes of elements that came down to where they need spreading.
  std::vector<int> NodesOfSpoiled(const std::vector<int>& elements,
    const std::vector<double>& before, const std::vector<double>& after) const
  {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < elements.size(); ++i)
    {
      if (after[i] < std::min(before[i], SpreadQuality))
      {
        const auto& element = this->Elements[elements[i]];
        nodes.insert(nodes.end(), element.begin(), element.end());
      }
    }
    return nodes;
  }

  /// Adds nodes grouped by their pillars, in the order of the first of each.
  void AddPillars(const std::vector<int>& nodes, std::vector<Pillar>& pillars)
  {
    std::unordered_map<int, std::size_t> slots;
    for (const int node : nodes)
    {
      const auto slot = slots.emplace(this->Mover.PillarOf(node), pillars.size());
      if (slot.second)
      {
        pillars.emplace_back();
        this->WorthTrying[slot.first->first].store(1, std::memory_order_relaxed);
      }
      pillars[slot.first->second].push_back(node);
      this->IsRelaxed[node] = 1;
    }
  }

  /// Pillars that share an element or an edge with a node are worth another try when it moves.
  void TellAround(int node)
  {
    const auto tell = [this](int other)
    {
      if (this->IsRelaxed[other])
      {
        this->WorthTrying[this->Mover.PillarOf(other)].store(1, std::memory_order_relaxed);
      }
    };
    for (const int e : this->TheBand.ElementsOfNode(node))
    {
      const auto& element = this->Elements[e];
      std::for_each(element.begin(), element.end(), tell);
    }
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      tell(this->TheBand.OtherEnd(edge, node));
    }
  }

  /// What an element is worth, the goal at least if that is enough for it.
  /// @param limit see Worth.
  double WorthOrGoal(int element, double limit = -std::numeric_limits<double>::infinity()) const
  {
    const double enough = this->EnoughFor(element, this->Goal);
    const double worth = this->Worth(element, std::min(limit, enough));
    return worth >= enough ? std::max(worth, this->Goal) : worth;
  }

  /// Smallest quality of elements, no more than the goal; of what is below a limit, any.
  double Lowest(const std::vector<int>& elements, double limit) const
  {
    double quality = this->Goal;
    for (std::size_t i = 0; i < elements.size() && quality >= limit; ++i)
    {
      quality = std::min(quality, this->WorthOrGoal(elements[i], limit));
    }
    return quality;
  }

  /// The worst first, so that a search for worse ones ends soon; returns the quality of each.
  std::vector<double> SortByQuality(std::vector<int>& elements)
  {
    std::vector<std::pair<double, int>> ranked;
    ranked.reserve(elements.size());
    for (const int e : elements)
    {
      ranked.emplace_back(this->WorthAsPlaced(e), e);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<double> qualities;
    qualities.reserve(elements.size());
    for (std::size_t i = 0; i < ranked.size(); ++i)
    {
      elements[i] = ranked[i].second;
      qualities.push_back(ranked[i].first);
    }
    return qualities;
  }

  bool Reached(const std::vector<int>& active)
  {
    return std::all_of(
      active.begin(), active.end(), [this](int e) { return this->WorthAsPlaced(e) >= this->Goal; });
  }

  /// Worth of an element between attempts. All of its nodes ask for it, and most stay.
  double WorthAsPlaced(int element)
  {
    double& known = this->KnownWorth[element];
    if (known == Unknown)
    {
      known = this->WorthOrGoal(element);
    }
    return known;
  }

  /// Calls visit(neighbour) for those of a node within its layer.
  template <typename Visit>
  void ForNeighbours(int node, const Visit& visit) const
  {
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      const int other = this->TheBand.OtherEnd(edge, node);
      if (this->Mover.IsLateral(node, other))
      {
        visit(other);
      }
    }
  }

  /// How much farther than a node others have gone in the mean.
  /// @param forEach forEach(visit) calls visit(other, weight) for each of them.
  template <typename ForEach>
  Vec3 WayToMean(int node, const ForEach& forEach) const
  {
    const auto wayOf = [this](int n) -> Vec3
    { return this->TheMoves.Position[n] - this->TheBand.Point[n]; };
    Vec3 sum = Vec3::Zero();
    double weights = 0.0;
    forEach(
      [&](int other, double weight)
      {
        sum += weight * wayOf(other);
        weights += weight;
      });
    return weights > 0.0 ? Vec3(sum / weights - wayOf(node)) : Vec3::Zero();
  }

  Vec3 WayOf(int node, const Band::Range& neighbours) const
  {
    return this->WayToMean(node,
      [&](const auto& visit)
      {
        for (const int other : neighbours)
        {
          visit(other, this->Stiffness(node, other));
        }
      });
  }
  Vec3 WayOfNeighbours(int node) const
  {
    return this->WayToMean(node,
      [this, node](const auto& visit)
      { this->ForNeighbours(node, [&visit](int other) { visit(other, 1.0); }); });
  }

  /// How closely a node follows another one. An inserted layer is thin: its nodes have to go where
  /// those on the cut go, or it turns over.
  double Stiffness(int node, int other) const
  {
    if (!this->TheBand.BeforeLayer)
    {
      return 1.0;
    }
    const Vec3 edge = this->TheBand.Point[other] - this->TheBand.Point[node];
    return 1.0 / std::max(edge.squaredNorm(), NoLength);
  }

  /// Nodes of one pillar, where they are, and the elements at them.
  struct Places
  {
    const std::vector<int>& Nodes;
    std::vector<Vec3> From;
    std::vector<int> Elements; ///< the worst first
    std::vector<int> Guarded;  ///< that have reached the floor, and must not pay for what cannot
    std::vector<int> AtWorst, Elsewhere; ///< the nodes of the worst element, and the others
    /// What edges are to keep of their lengths, by element; empty: what is worth more has that.
    std::vector<double> EdgeShares;
    bool Free; ///< wherever the nodes go, they may be there
  };

  Places PlacesOf(const std::vector<int>& nodes, const std::vector<int>& elements,
    const std::vector<double>& qualities)
  {
    const auto atFloor = std::lower_bound(qualities.begin(), qualities.end(), this->Floor);
    Places places{ nodes, this->PositionsOf(nodes), elements,
      { elements.begin() + (atFloor - qualities.begin()), elements.end() }, {}, {}, {}, true };
    if (qualities.front() < EdgeWorth * LeastEdgeShare)
    {
      std::transform(elements.begin(), elements.end(), std::back_inserter(places.EdgeShares),
        [this](int e) { return this->EdgeShareToKeep(e); });
    }
    for (const int node : nodes)
    {
      (this->Uses(elements.front(), node) ? places.AtWorst : places.Elsewhere).push_back(node);
      places.Free &= this->IsFree(node);
    }
    return places;
  }

  /// Whether an element stays at a limit or below wherever the nodes go: for a corner that none of
  /// them has a part in.
  bool IsStuck(double limit, const std::vector<int>& nodes, const std::vector<int>& elements,
    const std::vector<double>& qualities) const
  {
    for (std::size_t i = 0; i < elements.size() && qualities[i] <= limit; ++i)
    {
      const auto& element = this->Elements[elements[i]];
      unsigned moving = 0;
      for (int k = 0; k < element.Count; ++k)
      {
        const bool moves = std::find(nodes.begin(), nodes.end(), element.Node[k]) != nodes.end();
        moving |= static_cast<unsigned>(moves) << k;
      }
      if (ScaledJacobianBound(this->PointsOf(elements[i]), element.Count, moving) <= limit)
      {
        return true;
      }
    }
    return false;
  }

  /// Moves nodes of one pillar alike, if that raises the lowest of the elements at them.
  bool Improve(const std::vector<int>& nodes)
  {
    std::vector<int> elements = this->ElementsAt(nodes);
    const std::vector<double> qualities = this->SortByQuality(elements);
    const double before = qualities.empty() ? this->Goal : qualities.front();
    if (before >= this->Goal)
    {
      return false;
    }
    double best = before + this->Effort.Gain;
    if (best >= this->Goal || this->IsStuck(best, nodes, elements, qualities))
    {
      return false;
    }
    const Places places = this->PlacesOf(nodes, elements, qualities);
    std::vector<Vec3> to = places.From;
    const auto attempt = [&](const Vec3& step)
    {
      if (this->IsBetter(places, step, best))
      {
        to = this->PositionsOf(nodes);
      }
      this->Place(nodes, places.From);
    };
    const int guide = nodes.front();
    const Vec3 way = this->WayOfNeighbours(guide);
    attempt(way);
    attempt(0.5 * way);
    const double edge = this->ShortestEdge(guide);
    const auto directions = this->Mover.Directions(
      guide, this->FreedomOf(guide), places.From.front(), this->OnCut[guide] != 0);
    for (const double step : Steps)
    {
      const double found = best;
      for (const Vec3& direction : directions)
      {
        attempt(step * edge * direction);
      }
      if (best > found)
      {
        break;
      }
    }
    if (to == places.From)
    {
      return false;
    }
    this->Place(nodes, to);
    this->TellMoved(nodes);
    std::for_each(
      elements.begin(), elements.end(), [this](int e) { this->KnownWorth[e] = Unknown; });
    std::for_each(nodes.begin(), nodes.end(), [this](int node) { this->TellAround(node); });
    return true;
  }

  /// Takes a step and settles; whether the elements are above `best` there, which becomes what the
  /// lowest of them has.
  bool IsBetter(const Places& places, const Vec3& step, double& best)
  {
    this->Shift(places, step);
    // Finding the places on the surface is dear: only where it promises something.
    const double promising = best - Foresight;
    if ((!places.Free && this->Lowest(places.Elements, promising) < promising) ||
      !this->Settle(places.AtWorst) || this->WorthOrGoal(places.Elements.front(), best) <= best ||
      !this->Settle(places.Elsewhere))
    {
      return false;
    }
    const double quality = this->Lowest(places.Elements, best);
    const double floor = std::min(this->Floor, this->Goal);
    if (quality <= best || this->Lowest(places.Guarded, floor) < floor || this->Shortens(places))
    {
      return false;
    }
    best = quality;
    return true;
  }

  /// Whether an edge vanishes, or nearly does more than before.
  bool Shortens(const Places& places) const
  {
    for (std::size_t i = 0; i < places.EdgeShares.size(); ++i)
    {
      if (this->ShortestEdgeShare(places.Elements[i]) < places.EdgeShares[i])
      {
        return true;
      }
    }
    return false;
  }

  void Shift(const Places& places, const Vec3& step)
  {
    for (std::size_t i = 0; i < places.Nodes.size(); ++i)
    {
      this->TheMoves.Position[places.Nodes[i]] = places.From[i] + step;
    }
  }

  double Floor;
  double Goal;
  RelaxationEffort Effort;
  std::vector<char> IsRelaxed; ///< by node
  /// By pillar. Two that do not meet may both tell one between them.
  std::vector<std::atomic<char>> WorthTrying;
  static constexpr double Unknown = std::numeric_limits<double>::infinity();
  std::vector<double> KnownWorth; ///< by element, once nodes behind the cut are spread
};

}

void Relax(const RelaxationCase& given, const std::vector<int>& active, const RelaxationGoal& goal,
  Moves& moves)
{
  Relaxer(given, goal, moves).Run(active);
}

}
