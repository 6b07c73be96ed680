#include "Moves.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <map>

namespace trim
{
namespace
{

/// One edge direction of a pillar: where it leads and what it would cost.
struct Direction
{
  int Crossed = 0;     ///< nodes of the pillar whose edge the surface crosses
  double Length = 0.0; ///< sum of their moves
  std::vector<std::pair<int, NodeMove>> Found;
};

/// Type III: the same edge direction for all nodes of a pillar, or the columns twist; the
/// shortest move otherwise. Nodes whose edge is not crossed take type II.
void SlidePillar(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<int>& nodes, std::map<int, NodeMove>& result)
{
  std::map<int, Direction> directions; // by the pillar that the edges lead to
  for (const int node : nodes)
  {
    for (const int edge : mover.SlidingEdges(node))
    {
      const NodeMove move = mover.SlideAlong(node, edge);
      if (move.Found)
      {
        auto& direction = directions[columns.Pillar[band.OtherEnd(edge, node)]];
        ++direction.Crossed;
        direction.Length += (move.Target - band.Point[node]).norm();
        direction.Found.emplace_back(node, move);
      }
    }
  }
  const auto best = std::max_element(
    directions.begin(), directions.end(), [](const auto& a, const auto& b) {
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
      result[node] = mover.Project(node);
    }
  }
}

}

Moves MoveNodes(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& moving, Correction asked, const std::vector<CorrectionChoice>& choice)
{
  Moves moves;
  moves.Position = band.Point;
  moves.Applied.assign(band.NumberOfNodes(), Correction::None);
  moves.Failed.assign(band.NumberOfNodes(), 0);

  std::vector<std::vector<int>> pillars;
  std::vector<int> slot(band.NumberOfNodes(), -1);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (!moving[n])
    {
      continue;
    }
    int& at = slot[columns.Pillar[n]];
    if (at < 0)
    {
      at = static_cast<int>(pillars.size());
      pillars.emplace_back();
    }
    pillars[at].push_back(n);
  }
  vtkSMPTools::For(0, static_cast<Id>(pillars.size()), 16, [&](Id begin, Id end) {
    for (Id i = begin; i < end; ++i)
    {
      const auto& nodes = pillars[i];
      const auto chosen = choice[columns.Pillar[nodes.front()]];
      if (chosen == CorrectionChoice::Leave)
      {
        continue;
      }
      const bool slide = (asked == Correction::Slide) == (chosen == CorrectionChoice::AsAsked);
      std::map<int, NodeMove> found;
      if (slide)
      {
        SlidePillar(band, columns, mover, nodes, found);
      }
      for (const int node : nodes)
      {
        const NodeMove move = slide ? found[node] : mover.Project(node);
        moves.Failed[node] = !move.Found;
        if (move.Found)
        {
          moves.Position[node] = AsStored(band, move.Target);
          moves.Applied[node] = move.By;
        }
      }
    }
  });
  return moves;
}

}
