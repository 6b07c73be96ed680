#include "TrimmedBand.h"

#include <algorithm>

namespace trim
{

FinalElement FinalShape(const Band& band, const TrimmedBand& trimmed, int element)
{
  FinalElement final;
  const auto& original = band.Elements[element];
  final.Count = original.Count;
  final.Node = original.Node;
  const auto& wedges = trimmed.Treated.Wedges;
  const auto wedge = std::lower_bound(wedges.begin(), wedges.end(), element,
    [](const ReplacedElement& w, int e) { return w.Element < e; });
  if (wedge != wedges.end() && wedge->Element == element)
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
