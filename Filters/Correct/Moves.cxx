#include "Moves.h"

#include "Runs.h"

#include <algorithm>
#include <map>

namespace trim
{
namespace
{

/// Projections shorter than this many elements are never questioned.
constexpr double LongProjection = 0.75;
/// How many times longer than a slide a projection has to be to give way to it.
constexpr double MuchLonger = 1.5;
/// Cosine of the widest turn (25 degrees) with which an edge goes on where another comes from.
constexpr double GoesOnCosine = 0.9;
/// A node farther from the surface than this share of its edge is not beside it: the surface does
/// not pass through its pillar, but leans past it.
constexpr double BesideSurface = 0.5;

/// One edge direction of a pillar: where it leads and what it would cost.
struct Direction
{
  int Crossed = 0;         ///< nodes of the pillar whose edge the surface crosses
  double Length = 0.0;     ///< sum of their moves
  Vec3 Way = Vec3::Zero(); ///< sum of the unit vectors along their edges
  std::vector<std::pair<int, NodeMove>> Found;
};

Vec3 AlongEdge(const Band& band, int edge, int node)
{
  return (band.Point[band.OtherEnd(edge, node)] - band.Point[node]).normalized();
}

/// The slide of a node along the edge that most nearly leads away from where its pillar's goes, so
/// that both are one line; not found where none does, or the surface does not cross it.
NodeMove SlideBack(const Band& band, const NodeMover& mover, int node, const Vec3& way)
{
  NodeMove back;
  double lowest = -GoesOnCosine * way.norm();
  for (const int edge : mover.SlidingEdges(node))
  {
    const double along = AlongEdge(band, edge, node).dot(way);
    if (along < lowest)
    {
      lowest = along;
      back = mover.SlideAlong(node, edge);
    }
  }
  back.Found = back.Found && back.Elements < BesideSurface;
  return back;
}

/// Type III: the same edge direction for all nodes of a pillar, or the columns twist; the
/// shortest move otherwise. Where the surface passes through the pillar its other nodes slide the
/// other way along the same line. Nodes whose edges of that line are not crossed take type II.
void SlidePillar(const Band& band, const NodeMover& mover, const std::vector<int>& nodes,
  std::map<int, NodeMove>& result)
{
  std::map<int, Direction> directions; // by the pillar that the edges lead to
  for (const int node : nodes)
  {
    for (const int edge : mover.SlidingEdges(node))
    {
      const NodeMove move = mover.SlideAlong(node, edge);
      if (move.Found)
      {
        auto& direction = directions[mover.PillarOf(band.OtherEnd(edge, node))];
        ++direction.Crossed;
        direction.Length += (move.Target - band.Point[node]).norm();
        direction.Way += AlongEdge(band, edge, node);
        direction.Found.emplace_back(node, move);
      }
    }
  }
  const auto best = std::max_element(directions.begin(), directions.end(),
    [](const auto& a, const auto& b)
    {
      return a.second.Crossed != b.second.Crossed ? a.second.Crossed < b.second.Crossed
                                                  : a.second.Length > b.second.Length;
    });
  if (best != directions.end())
  {
    for (const auto& found : best->second.Found)
    {
      result[found.first] = found.second;
    }
  }
  for (const int node : nodes)
  {
    if (result.find(node) == result.end())
    {
      const NodeMove back =
        best != directions.end() ? SlideBack(band, mover, node, best->second.Way) : NodeMove();
      result[node] = back.Found ? back : mover.Project(node);
    }
  }
}

/// The longest move of a pillar, in elements.
double LongestMove(const std::map<int, NodeMove>& found)
{
  double longest = 0.0;
  for (const auto& move : found)
  {
    longest = std::max(longest, move.second.Elements);
  }
  return longest;
}

/**
 * Type II. In stretched elements the way straight to the surface may lead past the next nodes,
 * which folds the mesh, where the edges show a shorter way, counted in elements: then it is taken.
 */
void ProjectPillar(const Band& band, const NodeMover& mover, const std::vector<int>& nodes,
  bool maySlide, std::map<int, NodeMove>& result)
{
  for (const int node : nodes)
  {
    result[node] = mover.Project(node);
  }
  const double length = LongestMove(result);
  if (!maySlide || length < LongProjection)
  {
    return;
  }
  std::map<int, NodeMove> slid;
  SlidePillar(band, mover, nodes, slid);
  if (length > MuchLonger * LongestMove(slid))
  {
    result = std::move(slid);
  }
}

/// Sets the new places of a pillar's nodes.
void MovePillar(const Band& band, const NodeMover& mover, const std::vector<int>& nodes, bool slide,
  const PillarChoice& choice, Moves& moves)
{
  const bool leave = choice.Correction == CorrectionChoice::Leave;
  std::map<int, NodeMove> found;
  if ((leave && choice.Way == 0.0) || choice.Correction == CorrectionChoice::Inside)
  {
    for (const int node : nodes)
    {
      moves.Left[node] = 1;
    }
    return;
  }
  if (slide)
  {
    SlidePillar(band, mover, nodes, found);
  }
  else
  {
    ProjectPillar(band, mover, nodes, choice.Correction != CorrectionChoice::Other, found);
  }
  for (const int node : nodes)
  {
    NodeMove move = found[node];
    if (!move.Found && !leave && choice.MayEndAtCorner)
    {
      move = mover.EndAtCorner(node);
    }
    if (leave)
    {
      NodeFreedom freedom = mover.FreedomOf(node);
      move.By = Correction::Relax;
      move.Found = move.Found &&
        mover.Constrained(node, freedom,
          band.Point[node] + choice.Way * (move.Target - band.Point[node]), false, move.Target);
    }
    moves.Failed[node] = !move.Found && !leave;
    moves.Left[node] = leave || !move.Found || !move.OnSurface;
    if (move.Found)
    {
      moves.Position[node] = AsStored(band, move.Target);
      moves.Applied[node] = moves.Position[node] != band.Point[node] ? move.By : Correction::None;
    }
  }
}

}

Moves MoveNodes(const Band& band, const NodeMover& mover, const std::vector<char>& moving,
  Correction asked, const std::vector<PillarChoice>& choice)
{
  Moves moves;
  moves.Position = band.Point;
  moves.Applied.assign(band.NumberOfNodes(), Correction::None);
  for (int n = 0; band.BeforeLayer && n < band.NumberOfNodes(); ++n)
  {
    moves.Applied[n] = band.IsInsertedNode(n) ? Correction::Relax : Correction::None;
  }
  moves.Failed.assign(band.NumberOfNodes(), 0);
  moves.Left.assign(band.NumberOfNodes(), 0);

  std::vector<std::vector<int>> pillars;
  std::vector<int> slot(band.NumberOfNodes(), -1);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (!moving[n])
    {
      continue;
    }
    int& at = slot[mover.PillarOf(n)];
    if (at < 0)
    {
      at = static_cast<int>(pillars.size());
      pillars.emplace_back();
    }
    pillars[at].push_back(n);
  }
  ForAll(
    static_cast<int>(pillars.size()),
    [&](int i)
    {
      const auto& nodes = pillars[i];
      const auto& chosen = choice[mover.PillarOf(nodes.front())];
      const bool slide =
        (asked == Correction::Slide) != (chosen.Correction == CorrectionChoice::Other);
      MovePillar(band, mover, nodes, slide, chosen, moves);
    },
    16);
  return moves;
}

}
