#include "MovingNodes.h"

#include "DisjointSets.h"
#include "Status.h"

#include <algorithm>

namespace trim
{
namespace
{

/// Nodes beyond the surface in a cut-out of a sheet that holds no whole element, and of which none
/// goes, nor any beside it: there is no border that they could lie on, and moving them would spoil
/// the elements for nothing.
std::vector<char> FindShutCutOuts(
  const Band& band, const Columns& columns, const std::vector<char>& touchesEliminated)
{
  std::vector<char> shut(band.NumberOfNodes(), 0);
  bool any = false;
  for (int n = 0; n < band.NumberOfNodes() && !any; ++n)
  {
    any = band.NodeStatus[n] == NodeEliminate && !touchesEliminated[n] &&
      !columns.IsChosenByCut(n) && !columns.IsOnBorder(band, n);
  }
  if (!any)
  {
    return shut; // as a rule
  }
  std::vector<char> open(band.NumberOfNodes(), 0);
  DisjointSets<int> cutOuts(band.NumberOfNodes());
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    const bool beside = !columns.HasThickness(e) || band.ElementStatus[e] == ElementEliminate ||
      std::any_of(element.begin(), element.end(),
        [&touchesEliminated](int n) { return touchesEliminated[n] != 0; });
    int first = -1;
    for (const int n : element)
    {
      if (band.NodeStatus[n] == NodeEliminate)
      {
        open[n] |= beside;
        first = first < 0 ? n : first;
        cutOuts.Unite(first, n);
      }
    }
  }
  std::vector<char> ofRoot(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (band.NodeStatus[n] == NodeEliminate)
    {
      ofRoot[cutOuts.Find(n)] |= open[n] || columns.IsChosenByCut(n) || columns.IsOnBorder(band, n);
    }
  }
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    shut[n] = band.NodeStatus[n] == NodeEliminate && !ofRoot[cutOuts.Find(n)];
  }
  return shut;
}

}

std::vector<char> FindMovingNodes(
  const Band& band, const Columns& columns, const std::vector<char>& kept)
{
  std::vector<char> touchesKept(band.NumberOfNodes(), 0), touchesEliminated = touchesKept;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      (kept[e] ? touchesKept : touchesEliminated)[element.Node[i]] = 1;
    }
  }
  const std::vector<char> shut = FindShutCutOuts(band, columns, touchesEliminated);
  std::vector<char> moving(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    const bool beyond = band.NodeStatus[n] == NodeEliminate && !shut[n];
    moving[n] =
      touchesKept[n] && band.NodeStatus[n] != NodeOnSurface && (touchesEliminated[n] || beyond);
  }
  return moving;
}

std::vector<char> FindCutNodes(const Band& band, const std::vector<char>& kept)
{
  std::vector<char> onCut(band.NumberOfNodes(), 0);
  for (const auto& face : band.Faces)
  {
    for (int i = 0; IsCutFace(face, kept) && i < face.Count; ++i)
    {
      onCut[face.Node[i]] = 1;
    }
  }
  return onCut;
}

}
