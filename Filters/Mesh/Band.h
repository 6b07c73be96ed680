/**
 * @file Band.h
 * @brief The part of the mesh near the cut, as a small mesh of its own with full topology.
 *
 * Everything after the classification works on it, so the cost of the trim grows with the cut
 * and not with the mesh. Its outermost ring is a halo: there to tell the exterior of the mesh
 * from the border of the band, and never changed.
 */
#ifndef Band_h
#define Band_h

#include "BandCells.h"
#include "ElementMap.h"
#include "ElementTopology.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace trim
{

struct BandElement
{
  Id Global = -1;          ///< cell of the mesh; -1: of another rank's
  int Count = 0;           ///< 8 or 6
  std::array<int, 8> Node; ///< band nodes, in an order with positive Jacobian
  std::array<int, 6> Face; ///< band faces, by the slots of ElementTopology
  int Ring = 0;            ///< 0: meets the surface

  const int* begin() const { return this->Node.data(); }
  const int* end() const { return this->Node.data() + this->Count; }
};

struct BandFace
{
  int Count = 0;
  std::array<int, 4> Node; ///< in the order of the first element, outward
  std::array<int, 2> Element{ -1, -1 };
  std::array<int, 2> Slot{ -1, -1 }; ///< slot of the face in each element
  bool Exterior = false;             ///< on the border of the mesh

  const int* begin() const { return this->Node.data(); }
  const int* end() const { return this->Node.data() + this->Count; }
};

/// The corner of a face that a node is; their number if it is none.
inline int CornerOf(const BandFace& face, int node)
{
  return static_cast<int>(std::find(face.begin(), face.end(), node) - face.begin());
}

/// The corners of a face that its edges join with a node: the next one, and the one before.
inline std::array<int, 2> NeighboursOf(const BandFace& face, int node)
{
  const int at = CornerOf(face, node);
  const int last = face.Count - 1;
  return { face.Node[at < last ? at + 1 : 0], face.Node[at > 0 ? at - 1 : last] };
}

struct BandEdge
{
  int First, Second;
};

class Band
{
public:
  /**
   * @param cells in any order: the band has its own, see SortByPlace.
   * @param rings how many rings of cells were taken round ring 0, the halo included.
   * @param singlePrecision positions are stored as float.
   */
  Band(BandCells cells, int rings, bool singlePrecision);

  std::vector<BandElement> Elements;
  PageVector<BandFace> Faces;
  std::vector<BandEdge> Edges; ///< First < Second, ascending
  std::vector<Id> GlobalNode;  ///< point of the mesh; -1: only other ranks have it
  std::vector<Vec3> Point;     ///< original positions
  std::vector<unsigned char> NodeStatus;
  std::vector<unsigned char> ElementStatus;
  bool SinglePrecision = false; ///< positions are stored as float

  /// The band that a layer was inserted into; null unless this one has such a layer.
  std::shared_ptr<const Band> BeforeLayer;
  std::vector<Origin> NodeOrigins, ElementOrigins; ///< in BeforeLayer; empty without
  bool IsInserted(int element) const
  {
    return this->BeforeLayer && this->ElementOrigins[element].Inserted;
  }
  bool IsInsertedNode(int node) const
  {
    return this->BeforeLayer && this->NodeOrigins[node].Inserted;
  }
  bool HasInsertedNode(int element) const
  {
    const BandElement& own = this->Elements[element];
    return std::any_of(own.begin(), own.end(), [this](int n) { return this->IsInsertedNode(n); });
  }

  int NumberOfNodes() const { return static_cast<int>(this->GlobalNode.size()); }
  int NumberOfElements() const { return static_cast<int>(this->Elements.size()); }
  int NumberOfRings() const { return this->Halo; }
  bool InHalo(int element) const { return this->Elements[element].Ring >= this->Halo; }

  /// A list per item, in two flat arrays.
  struct Lists
  {
    std::vector<int> Offset, Item;
    const int* begin(int i) const { return this->Item.data() + this->Offset[i]; }
    const int* end(int i) const { return this->Item.data() + this->Offset[i + 1]; }
  };

  /// For range-based loops over one list.
  struct Range
  {
    const int *First, *Last;
    const int* begin() const { return this->First; }
    const int* end() const { return this->Last; }
    int size() const { return static_cast<int>(this->Last - this->First); }
  };
  Range ElementsOfNode(int n) const { return { ElementLists.begin(n), ElementLists.end(n) }; }
  Range FacesOfNode(int n) const { return { FaceLists.begin(n), FaceLists.end(n) }; }
  Range EdgesOfNode(int n) const { return { EdgeLists.begin(n), EdgeLists.end(n) }; }

  int Neighbour(int element, int slot) const
  {
    const auto& face = this->Faces[this->Elements[element].Face[slot]];
    return face.Element[0] == element ? face.Element[1] : face.Element[0];
  }
  int OtherEnd(int edge, int node) const
  {
    return this->Edges[edge].First == node ? this->Edges[edge].Second : this->Edges[edge].First;
  }
  int FindEdge(int a, int b) const; ///< -1 if there is none
  int FindElement(Id cell) const;   ///< of a cell of the mesh; -1 if it is not in the band
  /// The elements that are cells of the mesh, by ascending cell.
  std::vector<int> ElementsByCell() const;

private:
  void TakeElements(const BandCells& cells);
  void TakeOrigins(const BandCells& cells);
  /// A face as one of its elements has it; element -1: none.
  struct Side
  {
    int Element = -1, Slot = -1;
  };
  /// For each face of each element (six to an element) the first later element with a face of the
  /// same nodes.
  std::vector<Side> FindTwins() const;
  void OrderByCell();
  void BuildFaces();
  void SetFace(int number, Side side, Side twin);
  void BuildEdges();
  /// The edges from a node to later ones, ascending.
  void ListEdges(int node, std::vector<BandEdge>& edges) const;

  int Halo = 0;
  std::vector<std::pair<Id, int>> ElementByCell; ///< ascending
  Lists ElementLists, FaceLists, EdgeLists;
};

/// The nodes of an element where the nodes of its band are.
template <typename Element>
ElementPoints PointsAt(const std::vector<Vec3>& places, const Element& element)
{
  ElementPoints points;
  std::transform(element.begin(), element.end(), points.begin(),
    [&places](int node) -> const Vec3& { return places[node]; });
  return points;
}

/// The nodes of an element where the mesh has them.
inline ElementPoints PointsOf(const Band& band, int element)
{
  return PointsAt(band.Point, band.Elements[element]);
}

/// A node of a band for another one.
inline BandCells::Node TakeNode(const Band& band, int node, const Origin& from)
{
  return { band.GlobalNode[node], band.Point[node], band.NodeStatus[node], from };
}

/// An element of a band for another one, which has the node n of the band at numberOf(n).
template <typename NumberOf>
BandCells::Cell TakeElement(
  const Band& band, int element, const Origin& from, const NumberOf& numberOf)
{
  const BandElement& own = band.Elements[element];
  BandCells::Cell cell{ own.Global, own.Count, own.Ring, band.ElementStatus[element], own.Node,
    from };
  std::transform(own.begin(), own.end(), cell.Node.begin(), numberOf);
  return cell;
}

/// Length of the longest edge at a node, where the mesh has it.
inline double LongestEdgeAt(const Band& band, int node)
{
  double longest = 0.0;
  for (const int edge : band.EdgesOfNode(node))
  {
    longest = std::max(longest, (band.Point[band.OtherEnd(edge, node)] - band.Point[node]).norm());
  }
  return longest;
}

/// Length of the longest edge of an element, where the mesh has it.
/// @param counts whether an edge counts, by its two nodes.
template <typename Test>
double LongestEdgeOf(const Band& band, int element, const Test& counts)
{
  const auto& node = band.Elements[element].Node;
  const ElementPoints points = PointsOf(band, element);
  const auto& topology = TopologyOf(band.Elements[element].Count);
  double longest = 0.0;
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const auto& edge = topology.Edges[i];
    if (counts(node[edge.First], node[edge.Second]))
    {
      longest = std::max(longest, (points[edge.First] - points[edge.Second]).norm());
    }
  }
  return longest;
}
inline double LongestEdgeOf(const Band& band, int element)
{
  return LongestEdgeOf(band, element, [](int, int) { return true; });
}

/// Distance between neighbouring values of the largest coordinate of a node, as the mesh stores it:
/// its place is known to this.
inline double SpacingAt(const Band& band, int node)
{
  return band.Point[node].cwiseAbs().maxCoeff() *
    (band.SinglePrecision ? static_cast<double>(std::numeric_limits<float>::epsilon())
                          : std::numeric_limits<double>::epsilon());
}

/// The band as the mesh has it, without an inserted layer.
inline const Band& WithoutLayer(const Band& band)
{
  return band.BeforeLayer ? *band.BeforeLayer : band;
}

/// The node of WithoutLayer(band) that a node is, or in whose place it was inserted.
inline int NodeWithoutLayer(const Band& band, int node)
{
  return band.BeforeLayer ? band.NodeOrigins[node].Index : node;
}

/// The element of WithoutLayer(band) that an element is, or on whose face it was inserted.
inline int ElementWithoutLayer(const Band& band, int element)
{
  return band.BeforeLayer ? band.ElementOrigins[element].Index : element;
}

struct ElementShape
{
  int Count;
  ElementPoints Points;
};

/// An element as it came; of an inserted one that on whose face it stands, by which it is measured.
inline ElementShape ShapeBefore(const Band& band, int element)
{
  const Band& mesh = WithoutLayer(band);
  const int own = ElementWithoutLayer(band, element);
  return { mesh.Elements[own].Count, PointsOf(mesh, own) };
}

/**
 * The square of the length that an edge counts as having had: of one across an inserted layer the
 * shortest that the mesh has there, as a layer is thin from the start.
 */
inline double SquaredLengthBefore(const Band& band, int a, int b)
{
  double squared = (band.Point[a] - band.Point[b]).squaredNorm();
  const bool isAcross = band.IsInsertedNode(a) != band.IsInsertedNode(b) &&
    NodeWithoutLayer(band, a) == NodeWithoutLayer(band, b);
  if (isAcross)
  {
    const Band& mesh = WithoutLayer(band);
    const int node = NodeWithoutLayer(band, a);
    double shortest = std::numeric_limits<double>::infinity();
    for (const int edge : mesh.EdgesOfNode(node))
    {
      const Vec3& end = mesh.Point[mesh.OtherEnd(edge, node)];
      shortest = std::min(shortest, (end - mesh.Point[node]).squaredNorm());
    }
    squared = std::max(squared, shortest);
  }
  return squared;
}

/// The cell of this rank's piece that an element is, or on whose face it was inserted; -1: another
/// rank has it.
inline Id CellOf(const Band& band, int element)
{
  return WithoutLayer(band).Elements[ElementWithoutLayer(band, element)].Global;
}

/// Builds item lists from (owner, item) visits made twice by `visit(callback)`.
template <typename Visit>
Band::Lists BuildLists(int owners, const Visit& visit)
{
  Band::Lists lists;
  lists.Offset.assign(owners + 1, 0);
  visit([&](int owner, int) { ++lists.Offset[owner + 1]; });
  for (int i = 0; i < owners; ++i)
  {
    lists.Offset[i + 1] += lists.Offset[i];
  }
  lists.Item.resize(lists.Offset.back());
  std::vector<int> next(lists.Offset.begin(), lists.Offset.end() - 1);
  visit([&](int owner, int item) { lists.Item[next[owner]++] = item; });
  return lists;
}

}

#endif
