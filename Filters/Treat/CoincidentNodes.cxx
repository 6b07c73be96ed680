#include "CoincidentNodes.h"

#include "Runs.h"

#include <algorithm>
#include <array>
#include <utility>

namespace trim
{
namespace
{

/// How many elements may be between two nodes that come together.
constexpr int MostElementsBetween = static_cast<int>(2 * LongestMoveByCut);

/// A node by its place along a line on which hardly any two of a mesh coincide.
struct Candidate
{
  int Node;
  double Place;
  double Reach; ///< another node may be so near that it counts as the same
};

double ReachOf(const Band& band, int node)
{
  return SmallestDistanceShare * LongestEdgeAt(band, node);
}

/// Whether two nodes, one of which has moved, count as the same.
bool AreTooNear(const Band& band, const Moves& moves, int a, int b, double reach)
{
  const double before = (band.Point[a] - band.Point[b]).norm();
  const double after = (moves.Position[a] - moves.Position[b]).norm();
  return after < std::min(SmallestDistanceShare * before, reach);
}

class CoincidenceSearch
{
public:
  CoincidenceSearch(const Band& band, const TrimmedBand& trimmed)
    : TheBand(band)
    , NodeMoves(trimmed.NodeMoves)
    , Moving(trimmed.Moving)
    , Users(CountUsers(band, trimmed))
  {
  }

  std::vector<char> Find() const
  {
    std::vector<char> coincides(this->TheBand.NumberOfNodes(), 0);
    const std::vector<Candidate> candidates = this->Candidates();
    for (const Candidate* a : this->FindFirst(candidates))
    {
      for (const Candidate* b = a + 1; IsWithinReach(*a, b, candidates); ++b)
      {
        if (this->Coincide(*a, *b) && this->AreNear(a->Node, b->Node))
        {
          coincides[this->GivesWay(a->Node, b->Node) ? a->Node : b->Node] = 1;
        }
      }
    }
    return coincides;
  }

private:
  static bool IsWithinReach(
    const Candidate& a, const Candidate* b, const std::vector<Candidate>& candidates)
  {
    return b != candidates.data() + candidates.size() && b->Place - a.Place <= a.Reach;
  }

  /// The candidates that coincide with a later one, in turn: hardly any.
  std::vector<const Candidate*> FindFirst(const std::vector<Candidate>& candidates) const
  {
    std::vector<char> has(candidates.size(), 0);
    ForAll(
      static_cast<int>(candidates.size()),
      [&](int i)
      {
        const Candidate& a = candidates[i];
        for (const Candidate* b = &a + 1; !has[i] && IsWithinReach(a, b, candidates); ++b)
        {
          has[i] = this->Coincide(a, *b);
        }
      },
      LightGrain / 5);
    std::vector<const Candidate*> first;
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (has[i])
      {
        first.push_back(&candidates[i]);
      }
    }
    return first;
  }

  bool HasMoved(int node) const { return this->NodeMoves.Applied[node] != Correction::None; }

  /// Nodes that moved, are of the new boundary, or have a neighbour that moved; by place.
  std::vector<Candidate> Candidates() const
  {
    std::vector<char> chosen(this->TheBand.NumberOfNodes(), 0);
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      chosen[n] |= this->Moving[n] || this->HasMoved(n);
      if (this->HasMoved(n))
      {
        for (const int edge : this->TheBand.EdgesOfNode(n))
        {
          chosen[this->TheBand.OtherEnd(edge, n)] = 1;
        }
      }
    }
    const Vec3 line = Vec3(0.543, 0.712, 0.444);
    std::vector<Candidate> candidates;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      if (chosen[n] && this->Users[n] > 0)
      {
        candidates.push_back({ n, 0.0, 0.0 });
      }
    }
    ForAll(
      static_cast<int>(candidates.size()),
      [&](int i)
      {
        Candidate& own = candidates[i];
        own.Place = line.dot(this->NodeMoves.Position[own.Node]);
        own.Reach = ReachOf(this->TheBand, own.Node);
      },
      LightGrain / 5);
    std::sort(candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b)
      { return a.Place != b.Place ? a.Place < b.Place : a.Node < b.Node; });
    return candidates;
  }

  bool Coincide(const Candidate& a, const Candidate& b) const
  {
    if (!this->HasMoved(a.Node) && !this->HasMoved(b.Node))
    {
      return false;
    }
    return AreTooNear(this->TheBand, this->NodeMoves, a.Node, b.Node, std::min(a.Reach, b.Reach));
  }

  /// Whether a few elements lead from one node to the other. At a slit they do not, and a search
  /// from one end alone would have been through some thousand elements before it says so.
  bool AreNear(int a, int b) const
  {
    std::vector<char> end(this->TheBand.NumberOfNodes(), 0); // from which a node was reached
    std::array<std::vector<int>, 2> last = { std::vector<int>{ a }, std::vector<int>{ b } };
    end[a] = 1;
    end[b] = 2;
    for (int step = 0; step < MostElementsBetween; ++step)
    {
      const char own = static_cast<char>(1 + step % 2);
      std::vector<int> next;
      for (const int from : last[step % 2])
      {
        for (const int e : this->TheBand.ElementsOfNode(from))
        {
          for (const int node : this->TheBand.Elements[e])
          {
            if (end[node] == 0)
            {
              end[node] = own;
              next.push_back(node);
            }
            else if (end[node] != own)
            {
              return true;
            }
          }
        }
      }
      last[step % 2] = std::move(next);
    }
    return false;
  }

  /// Of two nodes the one that fewer elements need, or else the one that came from farther.
  bool GivesWay(int a, int b) const
  {
    if (this->HasMoved(a) != this->HasMoved(b))
    {
      return this->HasMoved(a);
    }
    if (this->Users[a] != this->Users[b])
    {
      return this->Users[a] < this->Users[b];
    }
    const auto way = [this](int n)
    { return (this->NodeMoves.Position[n] - this->TheBand.Point[n]).squaredNorm(); };
    return way(a) != way(b) ? way(a) > way(b) : a < b;
  }

  const Band& TheBand;
  const Moves& NodeMoves;
  const std::vector<char>& Moving;
  const std::vector<int> Users;
};

}

std::vector<char> FindCoincidentNodes(const Band& band, const TrimmedBand& trimmed)
{
  return CoincidenceSearch(band, trimmed).Find();
}

NodeGrid MakeNodeGrid(const Band& band)
{
  double longest = 0.0, sum = 0.0;
  for (const auto& edge : band.Edges)
  {
    const double length = (band.Point[edge.Second] - band.Point[edge.First]).norm();
    longest = std::max(longest, length);
    sum += length;
  }
  // A mean edge wide, but no narrower than any node's reach to either side.
  const double mean = sum / static_cast<double>(std::max<std::size_t>(1, band.Edges.size()));
  const double side = std::max(mean, 2.0 * SmallestDistanceShare * longest);
  return NodeGrid(band.NumberOfNodes(), side > 0.0 ? side : 1.0);
}

bool IsCoincident(const Band& band, const Moves& moves, const NodeGrid& others, int node)
{
  const double reach = ReachOf(band, node);
  const Vec3& place = moves.Position[node];
  return others.AnyNear(place, reach,
    [&](int other)
    {
      return other != node && (moves.Position[other] - place).squaredNorm() < reach * reach &&
        AreTooNear(band, moves, node, other, std::min(reach, ReachOf(band, other)));
    });
}

}
