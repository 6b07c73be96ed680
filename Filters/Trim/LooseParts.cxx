#include "LooseParts.h"

#include "DisjointSets.h"
#include "ElementTopology.h"

#include <algorithm>

namespace trim
{
namespace
{

/// The kept elements that have a node of the new boundary, ascending.
std::vector<int> FindElementsAtCut(const TrimBand& near)
{
  std::vector<char> atCut(near.Mesh.NumberOfElements(), 0);
  for (const int n : ListBoundaryNodes(near.Mesh, near.Trimmed))
  {
    for (const int e : near.Mesh.ElementsOfNode(n))
    {
      atCut[e] = near.Trimmed.Kept[e];
    }
  }
  std::vector<int> elements;
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (atCut[e])
    {
      elements.push_back(e);
    }
  }
  return elements;
}

}

std::vector<int> FindLooseParts(const TrimBand& near, Id kept)
{
  const std::vector<int> elements = FindElementsAtCut(near);
  // What an element away from the cut holds is one set, with the number behind all.
  const int held = static_cast<int>(elements.size());
  std::vector<int> place(near.Mesh.NumberOfElements(), held);
  for (int i = 0; i < held; ++i)
  {
    place[elements[i]] = i;
  }
  DisjointSets<int> parts(held + 1);
  for (int i = 0; i < held; ++i)
  {
    const int count = near.Mesh.Elements[elements[i]].Count;
    for (int slot = 0; slot < TopologyOf(count).NumberOfFaces; ++slot)
    {
      const int other = near.Mesh.Neighbour(elements[i], slot);
      if (other >= 0 && near.Trimmed.Kept[other])
      {
        parts.Unite(i, place[other]);
      }
    }
  }
  std::vector<int> sizes(held + 1, 0);
  int number = 0;
  for (int i = 0; i < held; ++i)
  {
    const int root = parts.Find(i);
    const bool loose = root != parts.Find(held);
    sizes[root] += loose;
    number += loose;
  }
  // Where nothing else is kept the largest is what was to be kept.
  const int largest = number < kept
    ? -1
    : static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<int> found;
  for (int i = 0; i < held; ++i)
  {
    const int root = parts.Find(i);
    if (sizes[root] > 0 && root != largest)
    {
      found.push_back(elements[i]);
    }
  }
  return found;
}

}
