#include "StraightPillars.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <unordered_map>
#include <utility>

namespace trim
{
namespace
{

/// Shares of an edge by which nodes of one pillar may differ.
constexpr double StraightEnough = 0.02;
/// How much of its scaled Jacobian an element may lose, of which more than enough does not count.
constexpr double LargestLoss = 0.04, EnoughQuality = 0.6;
/// What is above one of these does not fall below: straight cuts and round holes reach them.
constexpr std::array<double, 2> Reached{ 0.5, 0.55 };
/// A pillar has to come so much nearer to straight.
constexpr double NearerShare = 0.7;
/// Of the angle between two edges that are a basis.
constexpr double SmallestSine = 0.05;
constexpr int MostSweeps = 5;

/// Ways of a stack's nodes, in shares of its edges.
using Shares = std::vector<Eigen::Vector2d>;

Shares MeanOf(const Shares& shares)
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& own : shares)
  {
    sum += own;
  }
  return Shares(shares.size(), sum / static_cast<double>(shares.size()));
}

/// The line through shares at even steps, by least squares.
Shares LineThrough(const Shares& shares)
{
  const double middle = 0.5 * static_cast<double>(shares.size() - 1);
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double squares = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const double step = static_cast<double>(i) - middle;
    slope += step * shares[i];
    squares += step * step;
  }
  Shares line = MeanOf(shares);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    line[i] += (static_cast<double>(i) - middle) / squares * slope;
  }
  return line;
}

Shares HalfWay(const Shares& a, const Shares& b)
{
  Shares middle;
  std::transform(a.begin(), a.end(), b.begin(), std::back_inserter(middle),
    [](const auto& p, const auto& q) -> Eigen::Vector2d { return 0.5 * (p + q); });
  return middle;
}

double LargestDifference(const Shares& a, const Shares& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

Shares SharesOf(const Stack& stack, const Band& band, const Moves& moves)
{
  Shares shares;
  for (std::size_t i = 0; i < stack.Nodes.size(); ++i)
  {
    const int node = stack.Nodes[i];
    const Vec3 way = moves.Position[node] - band.Point[node];
    const auto& edges = stack.Edges[i];
    const Eigen::Matrix2d square = edges.transpose() * edges;
    shares.push_back(square.inverse() * (edges.transpose() * way));
  }
  return shares;
}

/// Looks for bent pillars.
class StackFinder
{
public:
  StackFinder(const Band& band, const Columns& columns, const NodeMover& mover, const Moves& moves)
    : TheBand(band)
    , TheColumns(columns)
    , Mover(mover)
    , TheMoves(moves)
  {
  }

  std::vector<Stack> Find() const
  {
    std::vector<char> isRelaxed(this->TheBand.NumberOfNodes(), 0); // by pillar
    bool any = false;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      const bool relaxed = this->TheMoves.Applied[n] == Correction::Relax;
      isRelaxed[this->TheColumns.Pillar[n]] |= relaxed;
      any |= relaxed;
    }
    std::vector<Stack> stacks;
    const Band::Lists pillars = any ? this->TheColumns.Nodes() : Band::Lists();
    for (int p = 0; any && p < this->TheBand.NumberOfNodes(); ++p)
    {
      const std::vector<int> nodes =
        isRelaxed[p] ? std::vector<int>(pillars.begin(p), pillars.end(p)) : std::vector<int>();
      auto stack = nodes.size() > 1 && this->MayBend(nodes) ? this->MakeStack(nodes) : std::nullopt;
      if (stack && this->BendOf(*stack) > StraightEnough)
      {
        stacks.push_back(std::move(*stack));
      }
    }
    return stacks;
  }

private:
  bool MayBend(const std::vector<int>& nodes) const
  {
    return std::all_of(nodes.begin(), nodes.end(),
      [this](int n)
      {
        const auto elements = this->TheBand.ElementsOfNode(n);
        return !this->TheMoves.Left[n] && !this->TheMoves.Failed[n] && this->Mover.IsInSheet(n) &&
          std::none_of(
            elements.begin(), elements.end(), [this](int e) { return this->TheBand.InHalo(e); });
      });
  }

  /// The neighbour of a node in another pillar; -1: none.
  int NeighbourIn(int pillar, int node) const
  {
    for (const int edge : this->TheBand.EdgesOfNode(node))
    {
      const int other = this->TheBand.OtherEnd(edge, node);
      if (this->Mover.PillarOf(other) == pillar)
      {
        return other;
      }
    }
    return -1;
  }

  /// From one end to the other; empty: they are no chain.
  std::vector<int> InOrder(const std::vector<int>& nodes) const
  {
    const auto countAbove = [this](int node)
    {
      const auto edges = this->TheBand.EdgesOfNode(node);
      return std::count_if(edges.begin(), edges.end(),
        [this, node](int e)
        { return !this->Mover.IsLateral(node, this->TheBand.OtherEnd(e, node)); });
    };
    const auto end =
      std::find_if(nodes.begin(), nodes.end(), [&](int node) { return countAbove(node) == 1; });
    std::vector<int> chain;
    for (int node = end != nodes.end() ? *end : -1; node >= 0;)
    {
      chain.push_back(node);
      const int from = node;
      node = -1;
      for (const int edge : this->TheBand.EdgesOfNode(from))
      {
        const int other = this->TheBand.OtherEnd(edge, from);
        if (!this->Mover.IsLateral(from, other) &&
          std::find(chain.begin(), chain.end(), other) == chain.end())
        {
          node = other;
        }
      }
    }
    return chain.size() == nodes.size() ? chain : std::vector<int>();
  }

  /// With the two pillars of one column beside it between which its nodes have gone; none: there
  /// are no such that go through all layers.
  std::optional<Stack> MakeStack(const std::vector<int>& nodes) const
  {
    Stack stack{ this->InOrder(nodes), {} };
    std::optional<Stack> best;
    double most = 0.0;
    if (stack.Nodes.empty())
    {
      return best;
    }
    const int first = stack.Nodes.front();
    for (const int e : this->TheBand.ElementsOfNode(first))
    {
      std::vector<int> beside;
      for (const int n : this->TheBand.Elements[e])
      {
        const int pillar = this->Mover.PillarOf(n);
        if (this->Mover.IsLateral(first, n) && this->NeighbourIn(pillar, first) == n)
        {
          beside.push_back(pillar);
        }
      }
      if (beside.size() != 2 || !this->TakeEdges(beside[0], beside[1], stack))
      {
        continue;
      }
      const double least =
        MeanOf(SharesOf(stack, this->TheBand, this->TheMoves)).front().minCoeff();
      if (!best || least > most)
      {
        best = stack;
        most = least;
      }
    }
    return best;
  }

  /// False where a layer does not have them, or they are no basis.
  bool TakeEdges(int a, int b, Stack& stack) const
  {
    stack.Edges.clear();
    for (const int node : stack.Nodes)
    {
      const int toA = this->NeighbourIn(a, node), toB = this->NeighbourIn(b, node);
      if (toA < 0 || toB < 0)
      {
        return false;
      }
      const auto& point = this->TheBand.Point;
      const Vec3 alongA = point[toA] - point[node], alongB = point[toB] - point[node];
      if (!(alongA.cross(alongB).norm() > SmallestSine * alongA.norm() * alongB.norm()))
      {
        return false;
      }
      stack.Edges.emplace_back();
      stack.Edges.back() << alongA, alongB;
    }
    return true;
  }

  double BendOf(const Stack& stack) const
  {
    const Shares shares = SharesOf(stack, this->TheBand, this->TheMoves);
    return LargestDifference(shares, MeanOf(shares));
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const NodeMover& Mover;
  const Moves& TheMoves;
};

class Straightener : private GuardedMesh
{
public:
  using GuardedMesh::GuardedMesh;

  void Run(std::vector<Stack> stacks)
  {
    stacks.erase(std::remove_if(stacks.begin(), stacks.end(),
                   [this](const Stack& stack) { return !this->MayStraighten(stack.Nodes); }),
      stacks.end());
    for (const Stack& stack : stacks)
    {
      this->Hold(stack);
    }
    for (int sweep = 0; sweep < MostSweeps && !this->Given.ToRelax.Aborted(); ++sweep)
    {
      bool changed = false;
      for (const Stack& stack : stacks)
      {
        changed |= this->Straighten(stack);
      }
      if (!changed)
      {
        return;
      }
    }
  }

private:
  bool MayStraighten(const std::vector<int>& nodes) const
  {
    const bool onCut = this->OnCut[nodes.front()] != 0;
    return std::all_of(nodes.begin(), nodes.end(),
      [this, onCut](int n)
      {
        return (this->OnCut[n] != 0) == onCut && !this->Given.Fixed[n] &&
          this->Mover.MayRelax(n, onCut) && !this->ElementsAt({ n }).empty();
      });
  }

  Shares WaysOf(const Stack& stack) const { return SharesOf(stack, this->TheBand, this->TheMoves); }

  /// Takes what the elements at it have for what they are held to.
  void Hold(const Stack& stack)
  {
    for (const int e : this->ElementsAt(stack.Nodes))
    {
      const double now = this->Quality(e);
      double least = std::max(this->Given.Least, std::min(now, EnoughQuality) - LargestLoss);
      for (const double reached : Reached)
      {
        least = now >= reached ? std::max(least, reached) : least;
      }
      this->Held.emplace(e, this->StandardOf(e, std::min(now, least)));
    }
  }

  bool Straighten(const Stack& stack)
  {
    const Shares shares = this->WaysOf(stack);
    const Shares mean = MeanOf(shares);
    const double bend = LargestDifference(shares, mean);
    if (bend <= StraightEnough)
    {
      return false;
    }
    const auto nearer = [&](const Shares& now)
    { return LargestDifference(now, MeanOf(now)) <= NearerShare * bend; };
    if (this->GoTo(stack, shares, mean, nearer) ||
      this->GoTo(stack, shares, HalfWay(shares, mean), nearer))
    {
      return true;
    }
    const Shares line = LineThrough(shares);
    const double fromLine = LargestDifference(shares, line);
    return fromLine > StraightEnough &&
      this->GoTo(stack, shares, line,
        [fromLine](const Shares& now)
        { return LargestDifference(now, LineThrough(now)) <= NearerShare * fromLine; });
  }

  /// @param good says whether the places that the nodes come to are better.
  template <typename Good>
  bool GoTo(const Stack& stack, const Shares& from, const Shares& to, const Good& good)
  {
    const State before = this->StateOf(stack.Nodes);
    for (std::size_t i = 0; i < stack.Nodes.size(); ++i)
    {
      this->TheMoves.Position[stack.Nodes[i]] += stack.Edges[i] * (to[i] - from[i]);
    }
    if (this->Settle(stack.Nodes) && good(this->WaysOf(stack)) && this->Stands(stack.Nodes) &&
      !this->HasCoincident(before))
    {
      this->TellMoved(stack.Nodes);
      return true;
    }
    this->Restore(before);
    return false;
  }

  bool Stands(const std::vector<int>& nodes) const
  {
    const std::vector<int> elements = this->ElementsAt(nodes);
    std::vector<Standard> standards;
    std::transform(elements.begin(), elements.end(), std::back_inserter(standards),
      [this](int e) { return this->Held.at(e); });
    return this->LowestOf(elements, standards) >= 0.0;
  }

  std::unordered_map<int, Standard> Held; ///< by element
};

}

std::vector<Stack> FindBentPillars(
  const Band& band, const Columns& columns, const NodeMover& mover, const Moves& moves)
{
  return StackFinder(band, columns, mover, moves).Find();
}

void StraightenPillars(const GuardedCase& given, std::vector<Stack> bent)
{
  Straightener(given).Run(std::move(bent));
}

}
