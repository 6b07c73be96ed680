#include "Band.h"

#include "Runs.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// Of an element.
constexpr int MostFaces = 6;

/// The nodes of a face in ascending order: the same from both its elements.
std::array<int, 4> FaceKey(const BandElement& element, int slot)
{
  const auto& face = TopologyOf(element.Count).Faces[slot];
  std::array<int, 4> key;
  key.fill(std::numeric_limits<int>::max()); // a triangle's fourth place sorts last
  for (int i = 0; i < face.Count; ++i)
  {
    key[i] = element.Node[face.Node[i]];
  }
  std::sort(key.begin(), key.end());
  return key;
}

}

Band::Band(BandCells cells, int rings, bool singlePrecision)
  : SinglePrecision(singlePrecision)
  , Halo(rings)
{
  SortByPlace(cells);
  this->TakeElements(cells);
  this->ElementLists = BuildLists(this->NumberOfNodes(),
    [this](auto&& add)
    {
      for (int e = 0; e < this->NumberOfElements(); ++e)
      {
        for (int i = 0; i < this->Elements[e].Count; ++i)
        {
          add(this->Elements[e].Node[i], e);
        }
      }
    });
  this->BuildFaces();
  this->BuildEdges();
}

void Band::TakeElements(const BandCells& cells)
{
  for (const auto& node : cells.Nodes)
  {
    this->GlobalNode.push_back(node.Global);
    this->Point.push_back(node.Point);
    this->NodeStatus.push_back(node.Status);
  }
  for (const auto& cell : cells.Cells)
  {
    BandElement element;
    element.Global = cell.Global;
    element.Count = cell.Count;
    element.Ring = cell.Ring;
    element.Face.fill(-1);
    element.Node.fill(-1);
    if (cell.Global >= 0)
    {
      this->ElementByCell.emplace_back(cell.Global, this->NumberOfElements());
    }
    std::copy_n(cell.Node.begin(), cell.Count, element.Node.begin());
    this->Elements.push_back(element);
    this->ElementStatus.push_back(cell.Status);
  }
  std::sort(this->ElementByCell.begin(), this->ElementByCell.end());
}

std::vector<Band::Side> Band::FindTwins() const
{
  const int count = this->NumberOfElements();
  PageVector<std::array<int, 4>> keys(MostFaces * static_cast<std::size_t>(count));
  vtkSMPTools::For(0, count, 500,
    [&](Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        const auto& element = this->Elements[e];
        for (int slot = 0; slot < TopologyOf(element.Count).NumberOfFaces; ++slot)
        {
          keys[MostFaces * e + slot] = FaceKey(element, slot);
        }
      }
    });
  // By their first nodes only few are left to be compared.
  const Lists sides = BuildLists(this->NumberOfNodes(),
    [&](auto&& add)
    {
      for (int e = 0; e < count; ++e)
      {
        for (int slot = 0; slot < TopologyOf(this->Elements[e].Count).NumberOfFaces; ++slot)
        {
          add(keys[MostFaces * e + slot][0], MostFaces * e + slot);
        }
      }
    });
  std::vector<Side> twins(keys.size());
  vtkSMPTools::For(0, this->NumberOfNodes(), 1000,
    [&](Id begin, Id end)
    {
      for (int n = static_cast<int>(begin); n < end; ++n)
      {
        for (const int* side = sides.begin(n); side != sides.end(n); ++side)
        {
          const int* twin = std::find_if(side + 1, sides.end(n),
            [&](int other)
            { return other / MostFaces > *side / MostFaces && keys[other] == keys[*side]; });
          if (twin != sides.end(n))
          {
            twins[*side] = { *twin / MostFaces, *twin % MostFaces };
          }
        }
      }
    });
  return twins;
}

void Band::BuildFaces()
{
  const std::vector<Side> twins = this->FindTwins();
  this->Faces.reserve(4 * this->Elements.size());
  for (int e = 0; e < this->NumberOfElements(); ++e)
  {
    for (int slot = 0; slot < TopologyOf(this->Elements[e].Count).NumberOfFaces; ++slot)
    {
      // Of three elements with one face the first two are twins, as no face has more than two.
      if (this->Elements[e].Face[slot] < 0)
      {
        this->AddFace({ e, slot }, twins[MostFaces * e + slot]);
      }
    }
  }
  this->FaceLists = BuildLists(this->NumberOfNodes(),
    [this](auto&& add)
    {
      for (std::size_t f = 0; f < this->Faces.size(); ++f)
      {
        for (int i = 0; i < this->Faces[f].Count; ++i)
        {
          add(this->Faces[f].Node[i], static_cast<int>(f));
        }
      }
    });
}

void Band::AddFace(Side side, Side twin)
{
  auto& element = this->Elements[side.Element];
  const auto& corners = TopologyOf(element.Count).Faces[side.Slot];
  BandFace face;
  face.Count = corners.Count;
  face.Node.fill(-1);
  for (int i = 0; i < face.Count; ++i)
  {
    face.Node[i] = element.Node[corners.Node[i]];
  }
  face.Element[0] = side.Element;
  face.Slot[0] = side.Slot;
  element.Face[side.Slot] = static_cast<int>(this->Faces.size());
  if (twin.Element >= 0)
  {
    face.Element[1] = twin.Element;
    face.Slot[1] = twin.Slot;
    this->Elements[twin.Element].Face[twin.Slot] = element.Face[side.Slot];
  }
  face.Exterior = twin.Element < 0 && element.Ring < this->Halo;
  this->Faces.push_back(face);
}

void Band::BuildEdges()
{
  constexpr Id length = 1000;
  std::vector<std::vector<BandEdge>> edges(NumberOfRuns(this->NumberOfNodes(), length));
  ForRuns(this->NumberOfNodes(), length,
    [&](Id run, Id begin, Id end)
    {
      for (Id n = begin; n < end; ++n)
      {
        this->ListEdges(static_cast<int>(n), edges[run]);
      }
    });
  for (const auto& list : edges)
  {
    this->Edges.insert(this->Edges.end(), list.begin(), list.end());
  }
  this->EdgeLists = BuildLists(this->NumberOfNodes(),
    [this](auto&& add)
    {
      for (std::size_t i = 0; i < this->Edges.size(); ++i)
      {
        add(this->Edges[i].First, static_cast<int>(i));
        add(this->Edges[i].Second, static_cast<int>(i));
      }
    });
}

void Band::ListEdges(int node, std::vector<BandEdge>& edges) const
{
  const auto first = static_cast<std::ptrdiff_t>(edges.size());
  for (const int e : this->ElementsOfNode(node))
  {
    const auto& element = this->Elements[e];
    const auto& topology = TopologyOf(element.Count);
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const int a = element.Node[topology.Edges[i].First];
      const int b = element.Node[topology.Edges[i].Second];
      if (std::min(a, b) == node)
      {
        edges.push_back({ node, std::max(a, b) });
      }
    }
  }
  const auto begin = edges.begin() + first;
  std::sort(
    begin, edges.end(), [](const BandEdge& a, const BandEdge& b) { return a.Second < b.Second; });
  edges.erase(std::unique(begin, edges.end(),
                [](const BandEdge& a, const BandEdge& b) { return a.Second == b.Second; }),
    edges.end());
}

int Band::FindEdge(int a, int b) const
{
  for (const int edge : this->EdgesOfNode(a))
  {
    if (this->OtherEnd(edge, a) == b)
    {
      return edge;
    }
  }
  return -1;
}

int Band::FindElement(Id cell) const
{
  const auto at = std::lower_bound(
    this->ElementByCell.begin(), this->ElementByCell.end(), std::make_pair(cell, 0));
  return at != this->ElementByCell.end() && at->first == cell ? at->second : -1;
}

std::vector<int> Band::ElementsByCell() const
{
  std::vector<int> elements;
  for (const auto& cell : this->ElementByCell)
  {
    elements.push_back(cell.second);
  }
  return elements;
}

}
