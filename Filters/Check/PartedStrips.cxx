#include "PartedStrips.h"

#include "DisjointSets.h"
#include "SortUnique.h"
#include "Status.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace trim
{
namespace
{

/// The nodes, edges, faces and elements of the band that lie on the kept side and that no kept
/// element has, in pieces; a piece ends where the kept elements begin. Its Euler number tells how
/// it hangs on them: 0 for what juts out, 1 for what lies alone, less for what joins several
/// places.
class LostPieces
{
public:
  explicit LostPieces(const TrimBand& near)
    : Mesh(WithoutLayer(near.Mesh))
    , Kept(Mesh.NumberOfElements(), 0)
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
        this->Kept[ElementWithoutLayer(near.Mesh, e)] = 1;
      }
    }
    this->FindNodes();
    this->FindEdges();
    this->FindFaces();
    this->FindElements();
  }

  /// Elements at the lost edges of the pieces that join places.
  std::vector<int> ElementsThatJoin()
  {
    std::unordered_map<int, int> sums; // by the root of each piece
    for (const int part : this->Lost)
    {
      sums[this->Sets.Find(part)] += this->Euler[part];
    }
    std::vector<int> elements;
    for (const int part : this->Lost)
    {
      const bool isEdge = part >= this->FirstEdge && part < this->FirstFace;
      if (isEdge && sums[this->Sets.Find(part)] < 0)
      {
        this->ForElementsAt(part - this->FirstEdge, [&elements](int e) { elements.push_back(e); });
      }
    }
    SortUnique(elements);
    return elements;
  }

private:
  template <typename Visit>
  void ForElementsAt(int edge, const Visit& visit) const
  {
    const auto& ends = this->Mesh.Edges[edge];
    for (const int e : this->Mesh.ElementsOfNode(ends.First))
    {
      const BandElement& element = this->Mesh.Elements[e];
      if (std::find(element.begin(), element.end(), ends.Second) != element.end())
      {
        visit(e);
      }
    }
  }

  bool IsKeptEdge(int edge) const
  {
    bool kept = false;
    this->ForElementsAt(edge, [&](int e) { kept = kept || this->Kept[e]; });
    return kept;
  }

  template <typename Nodes>
  bool MayBeLost(const Nodes& nodes) const
  {
    return std::all_of(
      nodes.begin(), nodes.end(), [this](int n) { return this->BesideCut[n] != 0; });
  }

  void AddLost(int part, int euler)
  {
    this->Lost.push_back(part);
    this->Euler[part] = euler;
  }

  /// Joins a lost part with one that it ends at, unless that is kept.
  void UniteIfLost(int part, int ofBorder)
  {
    if (this->Euler[ofBorder] != 0)
    {
      this->Sets.Unite(part, ofBorder);
    }
  }

  void FindNodes()
  {
    std::array<std::vector<char>, 2> has;
    has.fill(std::vector<char>(this->Mesh.NumberOfNodes(), 0));
    for (int e = 0; e < this->Mesh.NumberOfElements(); ++e)
    {
      for (const int n : this->Mesh.Elements[e])
      {
        has[this->Kept[e] ? 1 : 0][n] = 1;
      }
    }
    this->BesideCut = std::move(has[0]);
    for (int n = 0; n < this->Mesh.NumberOfNodes(); ++n)
    {
      this->BesideCut[n] = this->BesideCut[n] && this->Mesh.NodeStatus[n] == NodeKeep ? 1 : 0;
      if (this->BesideCut[n] && !has[1][n])
      {
        this->AddLost(n, 1);
      }
    }
  }

  void FindEdges()
  {
    for (int edge = 0; edge < static_cast<int>(this->Mesh.Edges.size()); ++edge)
    {
      const std::array<int, 2> ends = { this->Mesh.Edges[edge].First,
        this->Mesh.Edges[edge].Second };
      if (this->MayBeLost(ends) && !this->IsKeptEdge(edge))
      {
        this->AddLost(this->FirstEdge + edge, -1);
        this->UniteIfLost(this->FirstEdge + edge, ends[0]);
        this->UniteIfLost(this->FirstEdge + edge, ends[1]);
      }
    }
  }

  void FindFaces()
  {
    for (int face = 0; face < static_cast<int>(this->Mesh.Faces.size()); ++face)
    {
      const BandFace& own = this->Mesh.Faces[face];
      const bool kept = std::any_of(
        own.Element.begin(), own.Element.end(), [this](int e) { return e >= 0 && this->Kept[e]; });
      if (kept || !this->MayBeLost(own))
      {
        continue;
      }
      this->AddLost(this->FirstFace + face, 1);
      for (int i = 0; i < own.Count; ++i)
      {
        const int edge = this->Mesh.FindEdge(own.Node[i], own.Node[(i + 1) % own.Count]);
        this->UniteIfLost(this->FirstFace + face, this->FirstEdge + edge);
      }
    }
  }

  void FindElements()
  {
    for (int e = 0; e < this->Mesh.NumberOfElements(); ++e)
    {
      const BandElement& own = this->Mesh.Elements[e];
      if (!this->Kept[e] && this->MayBeLost(own))
      {
        this->AddLost(this->FirstElement + e, -1);
        for (int slot = 0; slot < TopologyOf(own.Count).NumberOfFaces; ++slot)
        {
          this->UniteIfLost(this->FirstElement + e, this->FirstFace + own.Face[slot]);
        }
      }
    }
  }

  const Band& Mesh;
  std::vector<char> Kept;
  std::vector<char> BesideCut;            ///< nodes on the kept side that an eliminated element has
  int FirstEdge, FirstFace, FirstElement; ///< nodes, edges, faces and elements by one number
  nurbs::DisjointSets<int> Sets;
  std::vector<int> Euler; ///< of each part alone; 0: not lost
  std::vector<int> Lost;
};

}

std::vector<int> FindPartedStrips(const TrimBand& near)
{
  return LostPieces(near).ElementsThatJoin();
}

}
