#include "LooseParts.h"

#include "DisjointSets.h"
#include "ElementTopology.h"

#include <algorithm>

namespace trim
{
namespace
{

/// By element: whether it is kept and has one of some nodes, or has a layer between it and them.
std::vector<char> FindKeptAt(const TrimBand& near, const std::vector<int>& nodes)
{
  std::vector<char> found(near.Mesh.NumberOfElements(), 0);
  for (int e = 0; near.Mesh.BeforeLayer && e < near.Mesh.NumberOfElements(); ++e)
  {
    found[e] = near.Trimmed.Kept[e] && near.Mesh.HasInsertedNode(e);
  }
  for (const int n : nodes)
  {
    for (const int e : near.Mesh.ElementsOfNode(n))
    {
      found[e] = near.Trimmed.Kept[e];
    }
  }
  return found;
}

}

std::vector<int> FindLooseParts(const TrimBand& near, const std::vector<int>& boundary, Id kept)
{
  const Band& band = near.Mesh;
  const std::vector<char> atCut = FindKeptAt(near, boundary);
  // What an element away from the cut holds is one set, with the number behind all.
  const int held = band.NumberOfElements();
  nurbs::DisjointSets<int> parts(held + 1);
  for (int e = 0; e < held; ++e)
  {
    const int faces = atCut[e] ? TopologyOf(band.Elements[e].Count).NumberOfFaces : 0;
    for (int slot = 0; slot < faces; ++slot)
    {
      const int other = band.Neighbour(e, slot);
      if (other >= 0 && near.Trimmed.Kept[other])
      {
        parts.Unite(e, atCut[other] ? other : held);
      }
    }
  }
  std::vector<int> loose;
  std::vector<int> sizes(held + 1, 0); // of the loose parts, by root
  for (int e = 0; e < held; ++e)
  {
    if (atCut[e] && parts.Find(e) != parts.Find(held))
    {
      loose.push_back(e);
      ++sizes[parts.Find(e)];
    }
  }
  if (static_cast<Id>(loose.size()) == kept)
  {
    // The largest is what was to be kept.
    const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
    loose.erase(std::remove_if(loose.begin(), loose.end(),
                  [&](int e) { return parts.Find(e) == static_cast<int>(largest); }),
      loose.end());
  }
  return loose;
}

}
