#include "Band.h"

#include "Runs.h"
#include "SortFour.h"

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// Of an element.
constexpr int MostFaces = 6;
/// In place of a number: the face has that of its first side.
constexpr int IsTwin = -2;

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
  SortFour(key);
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
  // None of these needs the others.
  constexpr std::array<void (Band::*)(), 3> tasks{ &Band::BuildFaces, &Band::BuildEdges,
    &Band::OrderByCell };
  const bool isLarge = this->NumberOfElements() > LightGrain;
  ForAll(
    3, [&](int task) { (this->*tasks[task])(); }, isLarge ? 1 : 3);
}

void Band::TakeElements(const BandCells& cells)
{
  const int nodes = static_cast<int>(cells.Nodes.size());
  this->GlobalNode.resize(nodes);
  this->Point.resize(nodes);
  this->NodeStatus.resize(nodes);
  ForAll(
    nodes,
    [&](int n)
    {
      this->GlobalNode[n] = cells.Nodes[n].Global;
      this->Point[n] = cells.Nodes[n].Point;
      this->NodeStatus[n] = cells.Nodes[n].Status;
    },
    LightGrain);
  const int count = static_cast<int>(cells.Cells.size());
  this->Elements.resize(count);
  this->ElementStatus.resize(count);
  ForAll(
    count,
    [&](int e)
    {
      const auto& cell = cells.Cells[e];
      auto& element = this->Elements[e];
      element.Global = cell.Global;
      element.Count = cell.Count;
      element.Ring = cell.Ring;
      element.Face.fill(-1);
      element.Node.fill(-1);
      std::copy_n(cell.Node.begin(), cell.Count, element.Node.begin());
      this->ElementStatus[e] = cell.Status;
    },
    LightGrain);
  this->TakeOrigins(cells);
}

void Band::OrderByCell()
{
  for (int e = 0; e < this->NumberOfElements(); ++e)
  {
    if (this->Elements[e].Global >= 0)
    {
      this->ElementByCell.emplace_back(this->Elements[e].Global, e);
    }
  }
  std::sort(this->ElementByCell.begin(), this->ElementByCell.end());
}

void Band::TakeOrigins(const BandCells& cells)
{
  if (cells.Cells.empty() || cells.Cells.front().From.Index < 0)
  {
    return; // as a rule
  }
  for (const auto& node : cells.Nodes)
  {
    this->NodeOrigins.push_back(node.From);
  }
  for (const auto& cell : cells.Cells)
  {
    this->ElementOrigins.push_back(cell.From);
  }
}

std::vector<Band::Side> Band::FindTwins() const
{
  const int count = this->NumberOfElements();
  PageVector<std::array<int, 4>> keys(MostFaces * static_cast<std::size_t>(count));
  ForAll(count,
    [&](int e)
    {
      const auto& element = this->Elements[e];
      for (int slot = 0; slot < TopologyOf(element.Count).NumberOfFaces; ++slot)
      {
        keys[MostFaces * e + slot] = FaceKey(element, slot);
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
  ForAll(
    this->NumberOfNodes(),
    [&](int n)
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
    },
    1000);
  return twins;
}

void Band::BuildFaces()
{
  const std::vector<Side> twins = this->FindTwins();
  std::vector<int> number(twins.size(), -1); // of the face that a side is the first of
  int count = 0;
  for (int e = 0; e < this->NumberOfElements(); ++e)
  {
    for (int slot = 0; slot < TopologyOf(this->Elements[e].Count).NumberOfFaces; ++slot)
    {
      // Of three elements with one face the first two are twins, as no face has more than two.
      const Side& twin = twins[MostFaces * e + slot];
      int& own = number[MostFaces * e + slot];
      own = own == IsTwin ? IsTwin : count++;
      if (own != IsTwin && twin.Element >= 0)
      {
        number[MostFaces * twin.Element + twin.Slot] = IsTwin;
      }
    }
  }
  this->Faces.resize(count);
  ForAll(
    static_cast<int>(number.size()),
    [&](int side)
    {
      if (number[side] >= 0)
      {
        this->SetFace(number[side], { side / MostFaces, side % MostFaces }, twins[side]);
      }
    },
    LightGrain);
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

void Band::SetFace(int number, Side side, Side twin)
{
  auto& element = this->Elements[side.Element];
  const auto& corners = TopologyOf(element.Count).Faces[side.Slot];
  BandFace& face = this->Faces[number];
  face.Count = corners.Count;
  face.Node.fill(-1);
  for (int i = 0; i < face.Count; ++i)
  {
    face.Node[i] = element.Node[corners.Node[i]];
  }
  face.Element[0] = side.Element;
  face.Slot[0] = side.Slot;
  element.Face[side.Slot] = number;
  if (twin.Element >= 0)
  {
    face.Element[1] = twin.Element;
    face.Slot[1] = twin.Slot;
    this->Elements[twin.Element].Face[twin.Slot] = number;
  }
  face.Exterior = twin.Element < 0 && element.Ring < this->Halo;
}

void Band::BuildEdges()
{
  constexpr Id length = 1000;
  std::vector<std::vector<BandEdge>> edges(NumberOfRuns(this->NumberOfNodes(), length));
  for (auto& list : edges)
  {
    list.reserve(4 * length);
  }
  ForRuns(this->NumberOfNodes(), length,
    [&](Id run, Id begin, Id end)
    {
      for (Id n = begin; n < end; ++n)
      {
        this->ListEdges(static_cast<int>(n), edges[run]);
      }
    });
  this->Edges = Joined(edges);
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
    const auto corner = std::find(element.begin(), element.end(), node) - element.begin();
    const int* const ends = CornerEnds(static_cast<int>(corner), element.Count);
    for (int k = 0; k < 3; ++k)
    {
      const BandEdge edge{ node, element.Node[ends[k]] };
      const auto isSame = [&edge](const BandEdge& other) { return other.Second == edge.Second; };
      if (edge.Second > node && std::none_of(edges.begin() + first, edges.end(), isSame))
      {
        edges.push_back(edge);
      }
    }
  }
  std::sort(edges.begin() + first, edges.end(),
    [](const BandEdge& a, const BandEdge& b) { return a.Second < b.Second; });
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
