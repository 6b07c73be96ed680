/// @file NodesOfElements.h
/// @brief Elements at nodes and nodes of elements of the band, as lists.
#ifndef NodesOfElements_h
#define NodesOfElements_h

#include "Band.h"
#include "SortUnique.h"

#include <vector>

namespace trim
{

/// The elements at any of the nodes, kept or not; ascending.
inline std::vector<int> ElementsAt(const Band& band, const std::vector<int>& nodes)
{
  std::vector<int> elements;
  for (const int node : nodes)
  {
    const auto at = band.ElementsOfNode(node);
    elements.insert(elements.end(), at.begin(), at.end());
  }
  SortUnique(elements);
  return elements;
}

/// The nodes of elements, also those that a wedge does without; ascending.
inline std::vector<int> NodesOf(const Band& band, const std::vector<int>& elements)
{
  std::vector<int> nodes;
  for (const int e : elements)
  {
    const auto& element = band.Elements[e];
    nodes.insert(nodes.end(), element.begin(), element.end());
  }
  SortUnique(nodes);
  return nodes;
}

/// The elements and those in rings round them, kept or not.
inline std::vector<int> RingsRound(const Band& band, std::vector<int> elements, int rings)
{
  for (int ring = 0; ring < rings; ++ring)
  {
    elements = ElementsAt(band, NodesOf(band, elements));
  }
  return elements;
}

}

#endif
