#include "TrimWarnings.h"

#include "Status.h"

#include <algorithm>
#include <string>

namespace trim
{
namespace
{

struct Text
{
  Feasibility Value;
  const char* What;
};

constexpr Text FeasibilityTexts[] = {
  { Feasibility::NotOpened,
    " elements hold a cut-out, or a part of one, that is smaller than an element and is not "
    "opened: refine the mesh there." },
  { Feasibility::CrossedTwice,
    " elements have an edge that the surface crosses more than once: what lies between the "
    "crossings is lost. Refine the mesh there or straighten the surface." },
  { Feasibility::Narrow,
    " elements lie at a hole or slot narrower than three elements, which comes out coarse: refine "
    "the mesh there." },
  { Feasibility::Inclined,
    " elements are cut under less than 45 degrees between surface and skin: turn the surface "
    "towards the thickness direction, or look at the elements there." },
  { Feasibility::Curved,
    " elements are cut where the surface has an edge or bends with a radius below two element "
    "sizes, which the border cuts off: refine the mesh there or round the surface off." },
};

struct ShortfallText
{
  Shortfall Value;
  const char* What;
};

constexpr ShortfallText ShortfallTexts[] = {
  { Shortfall::Invalid,
    " elements at the cut are distorted beyond repair: refine the mesh there, or try the other "
    "correction type." },
  { Shortfall::BelowFloor,
    " elements at the cut stay below MinimumScaledJacobian: refine the mesh there or move the "
    "surface." },
};

std::string FirstCell(const HexMesh& mesh, Id cell)
{
  std::array<Id, 8> nodes;
  mesh.Cell(cell, nodes);
  return " The first (cell " + std::to_string(cell) + " of the input) is at " +
    PlaceText(mesh.Point(nodes[0])) + ".";
}

template <typename List, typename Texts>
void WarnOfCells(
  const HexMesh& mesh, const List& list, const Texts& texts, std::vector<std::string>& warnings)
{
  for (const auto& text : texts)
  {
    const auto is = [&text](const auto& item) { return item.second == text.Value; };
    const auto first = std::find_if(list.begin(), list.end(), is);
    if (first != list.end())
    {
      warnings.push_back(std::to_string(std::count_if(first, list.end(), is)) + text.What +
        FirstCell(mesh, first->first));
    }
  }
}

void WarnOfNodesLeft(const HexMesh& mesh, TrimResult& result)
{
  const auto& left = result.Found.DistancesLeft;
  if (left.empty())
  {
    return;
  }
  const auto farthest = std::max_element(
    left.begin(), left.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  result.Warnings.push_back(std::to_string(left.size()) +
    " nodes of the new boundary were left off the surface, as no valid element was to be had "
    "otherwise: refine the mesh there or move the surface. The farthest, " +
    std::to_string(farthest->second) + " away, is at " + PlaceText(mesh.Point(farthest->first)) +
    ".");
}

/// A surface that touches no element, and is not hidden within one either.
void WarnIfMissed(const HexMesh& mesh, TrimResult& result)
{
  const auto& status = result.ElementStatus;
  if (result.Near || mesh.NumberOfCells == 0 || !result.Found.Feasibilities.empty())
  {
    return;
  }
  const bool oneSide =
    std::all_of(status.begin(), status.end(), [&](unsigned char s) { return s == status.front(); });
  if (oneSide)
  {
    result.Warnings.push_back(std::string("The trimming surface misses the grid, which is ") +
      (status.front() == ElementKeep ? "kept" : "eliminated") +
      " whole: move the surface, or turn the side with InvertSide.");
  }
}

}

void AddWarnings(const HexMesh& mesh, TrimResult& result)
{
  WarnIfMissed(mesh, result);
  WarnOfCells(mesh, result.Found.Feasibilities, FeasibilityTexts, result.Warnings);
  WarnOfCells(mesh, result.Found.Shortfalls, ShortfallTexts, result.Warnings);
  WarnOfNodesLeft(mesh, result);
}

}
