#include "TrimmedBand.h"

#include "MovingNodes.h"

#include <algorithm>

namespace trim
{

std::vector<char> FindBoundaryNodes(const Band& band, const TrimmedBand& trimmed)
{
  std::vector<char> ofBoundary = FindCutNodes(band, trimmed.Kept);
  for (const auto& wedge : trimmed.Treated.Wedges)
  {
    for (const int node : OpenedFacet(wedge))
    {
      ofBoundary[node] = 1;
    }
  }
  return ofBoundary;
}

std::vector<int> CountUsers(const Band& band, const TrimmedBand& trimmed)
{
  std::vector<int> users(band.NumberOfNodes(), 0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (trimmed.Kept[e])
    {
      const auto& element = band.Elements[e];
      std::for_each(element.begin(), element.end(), [&users](int n) { ++users[n]; });
    }
  }
  for (const auto& wedge : trimmed.Treated.Wedges)
  {
    if (trimmed.Kept[wedge.Element])
    {
      std::for_each(wedge.Dropped.begin(), wedge.Dropped.end(), [&users](int n) { --users[n]; });
    }
  }
  return users;
}

std::vector<int> ListBoundaryNodes(const Band& band, const TrimmedBand& trimmed)
{
  const std::vector<char> ofBoundary = FindBoundaryNodes(band, trimmed);
  const std::vector<int> users = CountUsers(band, trimmed);
  std::vector<int> nodes;
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (ofBoundary[n] && users[n] > 0)
    {
      nodes.push_back(n);
    }
  }
  return nodes;
}

FinalElement FinalShape(const Band& band, const TrimmedBand& trimmed, int element)
{
  FinalElement final;
  const auto& original = band.Elements[element];
  final.Count = original.Count;
  final.Node = original.Node;
  if (const ReplacedElement* wedge = FindWedge(trimmed.Treated, element))
  {
    final.Count = 6;
    final.Node = wedge->Node;
    final.Touched = true;
  }
  for (int i = 0; i < final.Count; ++i)
  {
    final.Points[i] = trimmed.NodeMoves.Position[final.Node[i]];
    final.Touched |= trimmed.NodeMoves.Applied[final.Node[i]] != Correction::None;
  }
  return final;
}

std::vector<int> FindTouchedElements(const Band& band, const TrimmedBand& trimmed)
{
  std::vector<char> touched(band.NumberOfElements(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (trimmed.NodeMoves.Applied[n] != Correction::None)
    {
      for (const int e : band.ElementsOfNode(n))
      {
        touched[e] = 1;
      }
    }
  }
  for (const auto& wedge : trimmed.Treated.Wedges)
  {
    touched[wedge.Element] = 1;
  }
  std::vector<int> elements;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (touched[e] && trimmed.Kept[e])
    {
      elements.push_back(e);
    }
  }
  return elements;
}

}
