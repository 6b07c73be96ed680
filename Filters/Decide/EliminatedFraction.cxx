#include "EliminatedFraction.h"

#include "Status.h"

#include <cmath>

namespace trim
{
namespace
{

double Volume(const std::array<Vec3, 4>& p)
{
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
}

/// The edges of one element by the places of its nodes in OrderForTetrahedra.
struct ElementEdges
{
  std::array<int, 8> Node;
  const std::vector<unsigned char>& Status;
  const CutEdges& Edges;

  bool IsEliminated(int i) const { return this->Status[this->Node[i]] == NodeEliminate; }
  double Beyond(int eliminated, int other) const
  {
    return this->Edges.Beyond(this->Node[eliminated], this->Node[other]);
  }
};

/// Share of a tetrahedron beyond the surface, by how many of its nodes are eliminated.
double ShareOfTetrahedron(const Tetrahedron& tetrahedron, const ElementEdges& edges)
{
  std::array<int, 4> beyond;
  std::array<int, 4> kept;
  int b = 0;
  int k = 0;
  for (const int node : tetrahedron)
  {
    (edges.IsEliminated(node) ? beyond[b++] : kept[k++]) = node;
  }
  switch (b)
  {
    case 0:
      return 0.0;
    case 1:
      return edges.Beyond(beyond[0], kept[0]) * edges.Beyond(beyond[0], kept[1]) *
        edges.Beyond(beyond[0], kept[2]);
    case 2:
    {
      // A prism with the two nodes as its short edges, as three tetrahedra.
      const double ac = edges.Beyond(beyond[0], kept[0]);
      const double ad = edges.Beyond(beyond[0], kept[1]);
      const double bc = edges.Beyond(beyond[1], kept[0]);
      const double bd = edges.Beyond(beyond[1], kept[1]);
      return ac * ad + ad * bc * (1.0 - ac) + bc * bd * (1.0 - ad);
    }
    case 3:
    {
      double left = 1.0;
      for (int i = 0; i < 3; ++i)
      {
        left *= 1.0 - edges.Beyond(beyond[i], kept[0]);
      }
      return 1.0 - left;
    }
    default:
      return 1.0;
  }
}

template <std::size_t N>
ElementVolumes Measure(
  const std::array<Tetrahedron, N>& tetrahedra, const Band& band, const ElementEdges& edges)
{
  ElementVolumes volumes;
  for (const auto& tetrahedron : tetrahedra)
  {
    std::array<Vec3, 4> p;
    for (int i = 0; i < 4; ++i)
    {
      p[i] = band.Point[edges.Node[tetrahedron[i]]];
    }
    const double volume = std::abs(Volume(p));
    volumes.Total += volume;
    volumes.Eliminated += volume * ShareOfTetrahedron(tetrahedron, edges);
  }
  return volumes;
}

}

ElementVolumes MeasureEliminated(
  const Band& band, int element, const nurbs::TrimmingSurface& surface, const CutEdges& edges)
{
  const auto& e = band.Elements[element];
  const ElementEdges ofElement{ OrderForTetrahedra(band, e, surface), band.NodeStatus, edges };
  return e.Count == 8 ? Measure(HexahedronTetrahedra, band, ofElement)
                      : Measure(WedgeTetrahedra, band, ofElement);
}

}
