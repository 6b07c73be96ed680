#include "PartedStrips.h"

#include "DisjointSets.h"
#include "SortUnique.h"
#include "Status.h"

#include <algorithm>

namespace trim
{
namespace
{

/// The nodes, edges, faces and elements of the band that lie on the kept side and that no kept
/// element has, in pieces. Edges and faces are held against those that are kept by their nodes, so
/// a piece ends where the kept elements begin. Its Euler number tells how it hangs on them: 0 for
/// what juts out, 1 for what lies alone, less for what joins more places than one.
class LostPieces
{
public:
  explicit LostPieces(const TrimBand& near)
    : Mesh(WithoutLayer(near.Mesh))
    , Kept(Mesh.NumberOfElements(), 0)
    , NodeKept(Mesh.NumberOfNodes(), 0)
    , FirstEdge(Mesh.NumberOfNodes())
    , FirstFace(FirstEdge + static_cast<int>(Mesh.Edges.size()))
    , FirstElement(FirstFace + static_cast<int>(Mesh.Faces.size()))
    , Sets(FirstElement + Mesh.NumberOfElements())
    , Euler(Sets.Size(), 0)
  {
    for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
    {
      if (near.Trimmed.Kept[e] && !near.Mesh.IsInserted(e))
      {
        const int own = ElementWithoutLayer(near.Mesh, e);
        this->Kept[own] = 1;
        std::for_each(this->Mesh.Elements[own].begin(), this->Mesh.Elements[own].end(),
          [this](int n) { this->NodeKept[n] = 1; });
      }
    }
    this->FindLostEdges();
    this->CountNodes();
    this->CountFaces();
    this->CountElements();
    this->SumUp();
  }

  /// Elements at the lost edges of the pieces that join places.
  std::vector<int> ElementsThatJoin()
  {
    std::vector<int> elements;
    for (const int edge : this->LostEdges)
    {
      if (this->Euler[this->Sets.Find(this->FirstEdge + edge)] < 0)
      {
        this->ForElementsAt(edge, [&elements](int e) { elements.push_back(e); });
      }
    }
    SortUnique(elements);
    return elements;
  }

private:
  template <typename Visit>
  void ForElementsAt(int edge, const Visit& visit) const
  {
    for (const int e : this->Mesh.ElementsOfNode(this->Mesh.Edges[edge].First))
    {
      const BandElement& element = this->Mesh.Elements[e];
      if (std::find(element.begin(), element.end(), this->Mesh.Edges[edge].Second) != element.end())
      {
        visit(e);
      }
    }
  }

  template <typename Nodes>
  bool IsOnKeptSide(const Nodes& nodes) const
  {
    return std::all_of(
      nodes.begin(), nodes.end(), [this](int n) { return this->Mesh.NodeStatus[n] == NodeKeep; });
  }

  void FindLostEdges()
  {
    for (int edge = 0; edge < static_cast<int>(this->Mesh.Edges.size()); ++edge)
    {
      const BandEdge& own = this->Mesh.Edges[edge];
      bool lost = this->IsOnKeptSide(std::array<int, 2>{ own.First, own.Second });
      if (lost)
      {
        this->ForElementsAt(edge, [&](int e) { lost = lost && !this->Kept[e]; });
      }
      if (lost)
      {
        this->LostEdges.push_back(edge);
        this->Euler[this->FirstEdge + edge] = -1;
      }
    }
  }

  void CountNodes()
  {
    for (int n = 0; n < this->Mesh.NumberOfNodes(); ++n)
    {
      this->Euler[n] = this->Mesh.NodeStatus[n] == NodeKeep && !this->NodeKept[n] ? 1 : 0;
    }
    for (const int edge : this->LostEdges)
    {
      for (const int n : { this->Mesh.Edges[edge].First, this->Mesh.Edges[edge].Second })
      {
        this->UniteIfLost(this->FirstEdge + edge, n);
      }
    }
  }

  void CountFaces()
  {
    for (int face = 0; face < static_cast<int>(this->Mesh.Faces.size()); ++face)
    {
      const BandFace& own = this->Mesh.Faces[face];
      const bool kept = std::any_of(
        own.Element.begin(), own.Element.end(), [this](int e) { return e >= 0 && this->Kept[e]; });
      if (kept || !this->IsOnKeptSide(own))
      {
        continue;
      }
      this->Euler[this->FirstFace + face] = 1;
      for (int i = 0; i < own.Count; ++i)
      {
        const int edge = this->Mesh.FindEdge(own.Node[i], own.Node[(i + 1) % own.Count]);
        this->UniteIfLost(this->FirstFace + face, this->FirstEdge + edge);
      }
    }
  }

  void CountElements()
  {
    for (int e = 0; e < this->Mesh.NumberOfElements(); ++e)
    {
      const BandElement& own = this->Mesh.Elements[e];
      if (!this->Kept[e] && this->IsOnKeptSide(own))
      {
        this->Euler[this->FirstElement + e] = -1;
        for (int slot = 0; slot < TopologyOf(own.Count).NumberOfFaces; ++slot)
        {
          this->UniteIfLost(this->FirstElement + e, this->FirstFace + own.Face[slot]);
        }
      }
    }
  }

  /// A part and one of its border: what is kept belongs to no piece.
  void UniteIfLost(int part, int ofBorder)
  {
    if (this->Euler[ofBorder] != 0)
    {
      this->Sets.Unite(part, ofBorder);
    }
  }

  /// The Euler numbers of the pieces, at their roots.
  void SumUp()
  {
    for (int i = this->Sets.Size() - 1; i >= 0; --i)
    {
      const int root = this->Sets.Find(i);
      if (root != i) // the root is the smallest, so it comes last
      {
        this->Euler[root] += this->Euler[i];
      }
    }
  }

  const Band& Mesh;
  std::vector<char> Kept, NodeKept;
  int FirstEdge, FirstFace, FirstElement; ///< nodes, edges, faces and elements by one number
  std::vector<int> LostEdges;
  DisjointSets<int> Sets;
  std::vector<int> Euler; ///< 0: not lost
};

}

std::vector<int> FindPartedStrips(const TrimBand& near)
{
  return LostPieces(near).ElementsThatJoin();
}

}
