#include "MovingNodes.h"

#include "DisjointSets.h"
#include "Status.h"

#include <algorithm>

namespace trim
{
/// Whether a node beyond the surface has no eliminated element, and nothing else opens it.
bool MovingNodes::AnyIsShut(const std::vector<char>& touchesEliminated) const
{
  const Band& band = this->TheBand;
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (band.NodeStatus[n] == NodeEliminate && !touchesEliminated[n] &&
      !this->TheColumns.IsChosenByCut(n) && !this->TheColumns.IsOnBorder(band, n))
    {
      return true;
    }
  }
  return false;
}

void MovingNodes::FindCutOuts()
{
  const Band& band = this->TheBand;
  const Columns& columns = this->TheColumns;
  this->CutOut.assign(band.NumberOfNodes(), -1);
  nurbs::DisjointSets<int> sets(band.NumberOfNodes());
  std::vector<char> open(band.NumberOfNodes(), 0);
  const auto isBeyond = [&band](int n) { return band.NodeStatus[n] == NodeEliminate; };
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    const bool opens = !columns.HasThickness(e) || band.ElementStatus[e] == ElementEliminate;
    const auto first = std::find_if(element.begin(), element.end(), isBeyond);
    for (auto node = first; node != element.end(); ++node)
    {
      if (isBeyond(*node))
      {
        open[*node] |= opens || columns.IsChosenByCut(*node) || columns.IsOnBorder(band, *node);
        sets.Unite(*first, *node);
      }
    }
  }
  std::vector<char> ofSet(band.NumberOfNodes(), 0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    ofSet[sets.Find(n)] |= open[n];
  }
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    if (isBeyond(n) && !ofSet[sets.Find(n)])
    {
      this->CutOut[n] = sets.Find(n);
    }
  }
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    const auto node =
      std::find_if(element.begin(), element.end(), [this](int n) { return this->CutOut[n] >= 0; });
    if (node != element.end())
    {
      this->AtCutOuts.emplace_back(e, this->CutOut[*node]);
    }
  }
}

/// By node: whether it is in a cut-out of which no node goes, nor any beside it.
std::vector<char> MovingNodes::FindShut(const std::vector<char>& touchesEliminated)
{
  std::vector<char> shut(this->TheBand.NumberOfNodes(), 0);
  if (!this->AnyIsShut(touchesEliminated))
  {
    return shut; // as a rule
  }
  if (this->CutOut.empty())
  {
    this->FindCutOuts();
  }
  std::vector<char> open(this->TheBand.NumberOfNodes(), 0);
  for (const auto& [e, cutOut] : this->AtCutOuts)
  {
    const auto& element = this->TheBand.Elements[e];
    open[cutOut] |= std::any_of(element.begin(), element.end(),
      [&touchesEliminated](int n) { return touchesEliminated[n] != 0; });
  }
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    shut[n] = this->CutOut[n] >= 0 && !open[this->CutOut[n]];
  }
  return shut;
}

const std::vector<char>& MovingNodes::Find(const std::vector<char>& kept)
{
  return this->Found.At(kept, [&] { return this->FindAnew(kept); });
}

std::vector<char> MovingNodes::FindAnew(const std::vector<char>& kept)
{
  const Band& band = this->TheBand;
  std::vector<char> touchesKept(band.NumberOfNodes(), 0), touchesEliminated = touchesKept;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      (kept[e] ? touchesKept : touchesEliminated)[element.Node[i]] = 1;
    }
  }
  const std::vector<char> shut = this->FindShut(touchesEliminated);
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
