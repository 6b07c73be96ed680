#include "ExposedEdges.h"

#include "DisjointSets.h"
#include "MovingNodes.h"
#include "NodeConstraint.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace trim
{
namespace
{

/// Whether no other kept element has both of two nodes of an element.
bool OnlyKeptAt(const Band& band, const std::vector<char>& kept, int element, int a, int b)
{
  const auto around = band.ElementsOfNode(a);
  return std::none_of(around.begin(), around.end(),
    [&](int e)
    {
      const BandElement& other = band.Elements[e];
      return e != element && kept[e] && std::find(other.begin(), other.end(), b) != other.end();
    });
}

/// Faces on the border of the mesh that lie beyond the surface; in a sheet in all its layers, so
/// that they turn into one wedge each or none does.
std::vector<char> FindLostSides(const Band& band, const Columns& columns)
{
  std::vector<char> lost(band.Faces.size(), 0);
  using Side = std::array<int, 3>; // column and its two pillars
  const auto sideOf = [&](const BandFace& face) -> Side
  {
    int first = columns.Pillar[face.Node[0]];
    int last = first;
    for (int i = 1; i < face.Count; ++i)
    {
      first = std::min(first, columns.Pillar[face.Node[i]]);
      last = std::max(last, columns.Pillar[face.Node[i]]);
    }
    return { columns.Column[face.Element[0]], first, last };
  };
  std::set<Side> staying;
  for (std::size_t f = 0; f < band.Faces.size(); ++f)
  {
    const auto& face = band.Faces[f];
    if (!face.Exterior || columns.IsLayerFace(band, static_cast<int>(f)))
    {
      continue;
    }
    lost[f] = GoesWhole(face, band.NodeStatus);
    if (!lost[f] && columns.HasThickness(face.Element[0]))
    {
      staying.insert(sideOf(face));
    }
  }
  for (std::size_t f = 0; f < band.Faces.size() && !staying.empty(); ++f)
  {
    lost[f] = lost[f] && staying.count(sideOf(band.Faces[f])) == 0;
  }
  return lost;
}

/// Faces of the new boundary: between kept and eliminated elements, and lost sides if asked for.
std::vector<char> BoundaryFaces(
  const Band& band, const Columns& columns, const std::vector<char>& kept, bool lostSides)
{
  std::vector<char> ofBoundary =
    lostSides ? FindLostSides(band, columns) : std::vector<char>(band.Faces.size(), 0);
  for (std::size_t f = 0; f < band.Faces.size(); ++f)
  {
    ofBoundary[f] |= IsCutFace(band.Faces[f], kept);
  }
  return ofBoundary;
}

/// @param newBoundary whether each face is one of the new boundary.
std::vector<ExposedEdge> FindExposed(const Band& band, const Columns& columns,
  const std::vector<char>& kept, const std::vector<char>& newBoundary)
{
  std::vector<ExposedEdge> exposed;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    if (!kept[e] || element.Count != 8 || element.Ring > 2)
    {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (columns.HasThickness(e) && columns.Axis[e] != axis)
      {
        continue;
      }
      for (int k = 0; k < 4; ++k)
      {
        const auto [a, b] = EndsOf(band, { e, axis, k });
        int cutFaces = 0;
        for (int slot = 0; slot < 6; ++slot)
        {
          const auto& face = band.Faces[element.Face[slot]];
          cutFaces += newBoundary[element.Face[slot]] && CornerOf(face, a) < face.Count &&
            CornerOf(face, b) < face.Count;
        }
        if (cutFaces == 2 && OnlyKeptAt(band, kept, e, a, b))
        {
          exposed.push_back({ e, axis, k });
        }
      }
    }
  }
  return exposed;
}

/// True if every kept element at the nodes of a chain drops them: the chain then ends at the
/// border of what is kept.
bool IsDroppable(
  const Band& band, const std::vector<char>& kept, const std::vector<ExposedEdge>& chain)
{
  std::vector<int> elements;
  for (const auto& edge : chain)
  {
    elements.push_back(edge.Element);
  }
  std::sort(elements.begin(), elements.end());
  if (std::adjacent_find(elements.begin(), elements.end()) != elements.end())
  {
    return false;
  }
  return std::all_of(chain.begin(), chain.end(),
    [&](const ExposedEdge& edge)
    {
      for (const int node : EndsOf(band, edge))
      {
        for (const int e : band.ElementsOfNode(node))
        {
          if (kept[e] && !std::binary_search(elements.begin(), elements.end(), e))
          {
            return false;
          }
        }
      }
      return true;
    });
}

/// In a block, edges that follow each other from border to border are one pillar; others stand
/// for themselves, and cannot be dropped.
void GroupChains(const Band& band, const std::vector<char>& kept,
  const std::vector<ExposedEdge>& edges, std::vector<ExposedPillar>& pillars)
{
  std::map<int, int> slots; // of nodes, in the sets
  for (const auto& edge : edges)
  {
    for (const int node : EndsOf(band, edge))
    {
      slots.emplace(node, static_cast<int>(slots.size()));
    }
  }
  nurbs::DisjointSets<int> sets(static_cast<int>(slots.size()));
  for (const auto& edge : edges)
  {
    const auto ends = EndsOf(band, edge);
    sets.Unite(slots[ends[0]], slots[ends[1]]);
  }
  std::map<int, std::vector<ExposedEdge>> chains;
  for (const auto& edge : edges)
  {
    chains[sets.Find(slots[EndsOf(band, edge)[0]])].push_back(edge);
  }
  for (const auto& chain : chains)
  {
    const bool droppable = IsDroppable(band, kept, chain.second);
    std::map<int, ExposedPillar> parts; // by the smallest node of the chain or of the edge
    for (const auto& edge : chain.second)
    {
      const auto ends = EndsOf(band, edge);
      const int node = std::min(ends[0], ends[1]);
      auto& part = parts[droppable ? -1 : node];
      part.Node = part.Node < 0 ? node : std::min(part.Node, node);
      part.Edges.push_back(edge);
      part.Droppable = droppable;
    }
    for (auto& part : parts)
    {
      pillars.push_back(std::move(part.second));
    }
  }
}

}

std::array<int, 2> EndsOf(const Band& band, const ExposedEdge& edge)
{
  const auto& node = band.Elements[edge.Element].Node;
  return { node[AxisEnds[edge.Axis][0][edge.Corner]], node[AxisEnds[edge.Axis][1][edge.Corner]] };
}

std::vector<ExposedPillar> FindExposedPillars(
  const Band& band, const Columns& columns, const std::vector<char>& kept, bool lostSides)
{
  std::vector<ExposedPillar> pillars;
  std::map<int, ExposedPillar> ofColumns;
  std::vector<ExposedEdge> ofBlocks;
  for (const auto& edge :
    FindExposed(band, columns, kept, BoundaryFaces(band, columns, kept, lostSides)))
  {
    if (!columns.HasThickness(edge.Element))
    {
      ofBlocks.push_back(edge);
      continue;
    }
    const int node = columns.Pillar[EndsOf(band, edge)[0]];
    ofColumns[node].Node = node;
    ofColumns[node].Edges.push_back(edge);
  }
  for (auto& pillar : ofColumns)
  {
    // A side of a column may be inside the mesh in one layer and on its border in another.
    pillar.second.Droppable = IsDroppable(band, kept, pillar.second.Edges);
    pillars.push_back(std::move(pillar.second));
  }
  GroupChains(band, kept, ofBlocks, pillars);
  std::sort(pillars.begin(), pillars.end(),
    [](const ExposedPillar& a, const ExposedPillar& b) { return a.Node < b.Node; });
  return pillars;
}

}
