#include "Band.h"

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// Position of a value in an ascending list, or -1.
template <typename T>
int Locate(const std::vector<T>& sorted, T value)
{
  const auto it = std::lower_bound(sorted.begin(), sorted.end(), value);
  return it != sorted.end() && *it == value ? static_cast<int>(it - sorted.begin()) : -1;
}

std::vector<Id> NodesOfCells(const HexMesh& mesh, const std::vector<Id>& cells)
{
  std::vector<Id> all;
  all.reserve(cells.size() * 8);
  std::array<Id, 8> nodes;
  for (const Id c : cells)
  {
    const int count = mesh.Cell(c, nodes);
    all.insert(all.end(), nodes.begin(), nodes.begin() + count);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

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

/// Breadth-first rings over cells that share a node; -1 outside.
std::vector<int> GrowRings(const std::vector<int>& seeds,
  const std::vector<std::array<int, 8>>& cells, const std::vector<int>& counts, int numberOfNodes,
  int rings)
{
  const auto links = BuildLists(numberOfNodes,
    [&](auto&& add)
    {
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        for (int i = 0; i < counts[c]; ++i)
        {
          add(cells[c][i], static_cast<int>(c));
        }
      }
    });
  std::vector<int> ring(cells.size(), -1);
  std::vector<char> nodeSeen(numberOfNodes, 0);
  std::vector<int> front = seeds;
  for (const int c : front)
  {
    ring[c] = 0;
  }
  for (int r = 1; r <= rings && !front.empty(); ++r)
  {
    std::vector<int> next;
    for (const int c : front)
    {
      for (int i = 0; i < counts[c]; ++i)
      {
        const int node = cells[c][i];
        if (nodeSeen[node])
        {
          continue;
        }
        nodeSeen[node] = 1;
        for (const int* other = links.begin(node); other != links.end(node); ++other)
        {
          if (ring[*other] < 0)
          {
            ring[*other] = r;
            next.push_back(*other);
          }
        }
      }
    }
    front = std::move(next);
  }
  return ring;
}

}

Band::Band(
  const HexMesh& mesh, const std::vector<Id>& seeds, const std::vector<Id>& near, int rings)
  : SinglePrecision(mesh.PointsFloat != nullptr)
  , Halo(rings)
{
  this->TakeElements(mesh, seeds, near, rings);
  this->OrientWedges();
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

void Band::TakeElements(
  const HexMesh& mesh, const std::vector<Id>& seeds, const std::vector<Id>& near, int rings)
{
  const std::vector<Id> nearNodes = NodesOfCells(mesh, near);
  std::vector<std::array<int, 8>> cells(near.size());
  std::vector<int> counts(near.size());
  std::array<Id, 8> nodes;
  for (std::size_t c = 0; c < near.size(); ++c)
  {
    counts[c] = mesh.Cell(near[c], nodes);
    for (int i = 0; i < counts[c]; ++i)
    {
      cells[c][i] = Locate(nearNodes, nodes[i]);
    }
  }
  std::vector<int> seedCells;
  for (const Id seed : seeds)
  {
    seedCells.push_back(Locate(near, seed));
  }
  const auto ring = GrowRings(seedCells, cells, counts, static_cast<int>(nearNodes.size()), rings);

  std::vector<int> local(nearNodes.size(), -1);
  for (std::size_t c = 0; c < near.size(); ++c)
  {
    for (int i = 0; ring[c] >= 0 && i < counts[c]; ++i)
    {
      local[cells[c][i]] = 0;
    }
  }
  for (std::size_t n = 0; n < nearNodes.size(); ++n)
  {
    if (local[n] == 0)
    {
      local[n] = this->NumberOfNodes();
      this->GlobalNode.push_back(nearNodes[n]);
      this->Point.push_back(mesh.Point(nearNodes[n]));
    }
  }
  for (std::size_t c = 0; c < near.size(); ++c)
  {
    if (ring[c] < 0)
    {
      continue;
    }
    BandElement element;
    element.Global = near[c];
    element.Count = counts[c];
    element.Ring = ring[c];
    element.Face.fill(-1);
    element.Node.fill(-1);
    for (int i = 0; i < counts[c]; ++i)
    {
      element.Node[i] = local[cells[c][i]];
    }
    this->Elements.push_back(element);
  }
}

void Band::OrientWedges()
{
  for (auto& element : this->Elements)
  {
    if (element.Count != 6)
    {
      continue;
    }
    const auto& n = element.Node;
    const Vec3 normal =
      (this->Point[n[1]] - this->Point[n[0]]).cross(this->Point[n[2]] - this->Point[n[0]]);
    const Vec3 up = this->Point[n[3]] + this->Point[n[4]] + this->Point[n[5]] - this->Point[n[0]] -
      this->Point[n[1]] - this->Point[n[2]];
    if (normal.dot(up) < 0.0)
    {
      std::swap_ranges(element.Node.begin(), element.Node.begin() + 3, element.Node.begin() + 3);
    }
  }
}

int Band::FindTwin(int element, const std::array<int, 4>& key, int& slot) const
{
  for (const int other : this->ElementsOfNode(key[0]))
  {
    const auto& candidate = this->Elements[other];
    for (slot = 0; other > element && slot < TopologyOf(candidate.Count).NumberOfFaces; ++slot)
    {
      if (candidate.Face[slot] < 0 && FaceKey(candidate, slot) == key)
      {
        return other;
      }
    }
  }
  return -1;
}

void Band::BuildFaces()
{
  for (int e = 0; e < this->NumberOfElements(); ++e)
  {
    auto& element = this->Elements[e];
    const auto& topology = TopologyOf(element.Count);
    for (int slot = 0; slot < topology.NumberOfFaces; ++slot)
    {
      if (element.Face[slot] >= 0)
      {
        continue;
      }
      BandFace face;
      face.Count = topology.Faces[slot].Count;
      face.Node.fill(-1);
      for (int i = 0; i < face.Count; ++i)
      {
        face.Node[i] = element.Node[topology.Faces[slot].Node[i]];
      }
      face.Element[0] = e;
      face.Slot[0] = slot;
      const int index = static_cast<int>(this->Faces.size());
      element.Face[slot] = index;
      int twinSlot = -1;
      const int twin = this->FindTwin(e, FaceKey(element, slot), twinSlot);
      if (twin >= 0)
      {
        face.Element[1] = twin;
        face.Slot[1] = twinSlot;
        this->Elements[twin].Face[twinSlot] = index;
      }
      face.Exterior = twin < 0 && element.Ring < this->Halo;
      this->Faces.push_back(face);
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

void Band::BuildEdges()
{
  std::vector<int> ends;
  for (int n = 0; n < this->NumberOfNodes(); ++n)
  {
    ends.clear();
    for (const int e : this->ElementsOfNode(n))
    {
      const auto& element = this->Elements[e];
      const auto& topology = TopologyOf(element.Count);
      for (int i = 0; i < topology.NumberOfEdges; ++i)
      {
        const int a = element.Node[topology.Edges[i].First];
        const int b = element.Node[topology.Edges[i].Second];
        if (a == n && b > n)
        {
          ends.push_back(b);
        }
        else if (b == n && a > n)
        {
          ends.push_back(a);
        }
      }
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const int other : ends)
    {
      this->Edges.push_back({ n, other });
    }
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

int Band::FindNode(Id global) const
{
  return Locate(this->GlobalNode, global);
}

}
