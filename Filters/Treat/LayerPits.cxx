#include "LayerPits.h"

#include "Manifold.h"
#include "NodesOfElements.h"
#include "SortUnique.h"

#include <algorithm>

namespace trim
{
namespace
{

/// Those of the columns that elements are in.
std::vector<int> ColumnMates(const Columns& columns, const std::vector<int>& elements)
{
  const Band::Lists members = columns.Elements();
  std::vector<int> mates;
  for (const int e : elements)
  {
    const int column = columns.Column[e];
    mates.insert(mates.end(), members.begin(column), members.end(column));
  }
  SortUnique(mates);
  return mates;
}

/// What is eliminated is no pentahedron, nor the wedge that it became.
void ForgetPentahedra(const std::vector<int>& elements, Pentahedra& treated)
{
  for (const int e : elements)
  {
    treated.Count -= treated.FlatCorner[e] || FindWedge(treated, e) ? 1 : 0;
    treated.FlatCorner[e] = 0;
  }
  treated.Wedges.erase(
    std::remove_if(treated.Wedges.begin(), treated.Wedges.end(),
      [&elements](const ReplacedElement& wedge)
      { return std::binary_search(elements.begin(), elements.end(), wedge.Element); }),
    treated.Wedges.end());
}

}

bool DigPits(
  const Band& layered, const Columns& columns, const std::vector<int>& faulty, TrimmedBand& trimmed)
{
  const std::vector<int> pits = ColumnMates(columns, faulty);
  std::vector<char> kept = trimmed.Kept;
  for (const int e : pits)
  {
    kept[e] = 0;
  }
  const std::vector<int> nodes = NodesOf(layered, pits);
  const bool isSound =
    std::all_of(pits.begin(), pits.end(), [&](int e) { return layered.IsInserted(e); }) &&
    std::all_of(nodes.begin(), nodes.end(), [&](int n) { return IsManifoldAt(layered, kept, n); });
  if (!isSound)
  {
    return false;
  }
  trimmed.Kept = std::move(kept);
  ForgetPentahedra(pits, trimmed.Treated);
  for (const int n : nodes)
  {
    if (layered.IsInsertedNode(n))
    {
      trimmed.Moving[n] = 1;
      trimmed.NodeMoves.Left[n] = 1;
    }
  }
  for (auto* list : { &trimmed.BelowFloor, &trimmed.Invalid })
  {
    list->erase(std::remove_if(list->begin(), list->end(), [&](int e) { return !trimmed.Kept[e]; }),
      list->end());
  }
  return true;
}

}
