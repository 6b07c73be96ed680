#include "TrimmedBand.h"

#include "MovingNodes.h"

namespace trim
{

std::vector<char> FindBoundaryNodes(const Band& band, const TrimmedBand& trimmed)
{
  std::vector<char> ofBoundary = FindCutNodes(band, trimmed.Kept);
  for (const auto& wedge : trimmed.Treated.Wedges)
  {
    for (const int corner : { 0, 2, 3, 5 })
    {
      ofBoundary[wedge.Node[corner]] = 1;
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
      const ReplacedElement* wedge = FindWedge(trimmed.Treated, e);
      const auto& node = wedge ? wedge->Node : band.Elements[e].Node;
      const int count = wedge ? 6 : band.Elements[e].Count;
      for (int i = 0; i < count; ++i)
      {
        ++users[node[i]];
      }
    }
  }
  return users;
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

}
