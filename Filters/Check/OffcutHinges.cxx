#include "OffcutHinges.h"

#include "DisjointSets.h"
#include "ElementTopology.h"
#include "SortUnique.h"

#include <algorithm>
#include <map>

namespace trim
{
namespace
{

/// Something with nodes in VTK's order, in an element of the band.
struct Piece
{
  int Element;
  int Count;
  const std::array<int, 8>* Node;
};

/// Joins parts at a node by the faces that they have there in common.
nurbs::DisjointSets<int> JoinAt(int node, const std::vector<Piece>& parts)
{
  nurbs::DisjointSets<int> joined(static_cast<int>(parts.size()));
  std::map<std::array<int, 4>, int> owners;
  for (int i = 0; i < joined.Size(); ++i)
  {
    const auto& topology = TopologyOf(parts[i].Count);
    for (int slot = 0; slot < topology.NumberOfFaces; ++slot)
    {
      const FaceNodes& face = topology.Faces[slot];
      std::array<int, 4> key{ -1, -1, -1, -1 };
      for (int k = 0; k < face.Count; ++k)
      {
        key[k] = (*parts[i].Node)[face.Node[k]];
      }
      if (std::find(key.begin(), key.end(), node) != key.end())
      {
        std::sort(key.begin(), key.end());
        joined.Unite(owners.emplace(key, i).first->second, i);
      }
    }
  }
  return joined;
}

/// By set: how many parts it has.
std::map<int, int> SizesOf(nurbs::DisjointSets<int>& joined)
{
  std::map<int, int> sizes;
  for (int i = 0; i < joined.Size(); ++i)
  {
    ++sizes[joined.Find(i)];
  }
  return sizes;
}

std::vector<Piece> WholeAt(const Band& band, int node)
{
  std::vector<Piece> parts;
  for (const int e : band.ElementsOfNode(node))
  {
    parts.push_back({ e, band.Elements[e].Count, &band.Elements[e].Node });
  }
  return parts;
}

}

std::vector<int> FindHinges(const TrimBand& near)
{
  const Band& band = near.Mesh;
  const std::vector<char> atCut = FindBoundaryNodes(band, near.Trimmed);
  std::map<int, std::vector<Piece>> partsAt; // of nodes at the cut
  for (const OffcutElement& part : near.Rest.Elements)
  {
    for (const int n : part)
    {
      if (atCut[n])
      {
        partsAt[n].push_back({ part.Element, part.Count, &part.Node });
      }
    }
  }
  std::vector<int> hinges;
  for (const auto& [node, parts] : partsAt)
  {
    nurbs::DisjointSets<int> joined = JoinAt(node, parts);
    const std::map<int, int> sizes = SizesOf(joined);
    if (sizes.size() < 2)
    {
      continue;
    }
    nurbs::DisjointSets<int> whole = JoinAt(node, WholeAt(band, node));
    if (SizesOf(whole).size() > 1)
    {
      continue;
    }
    const int largest = std::max_element(sizes.begin(), sizes.end(),
      [](const auto& a, const auto& b) {
        return a.second < b.second;
      })->first;
    for (int i = 0; i < joined.Size(); ++i)
    {
      if (joined.Find(i) != largest)
      {
        hinges.push_back(parts[i].Element);
      }
    }
  }
  SortUnique(hinges);
  return hinges;
}

}
