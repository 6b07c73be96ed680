#include "EliminatedFraction.h"

#include "Status.h"

#include <cmath>

namespace trim
{
namespace
{

/// Of a tetrahedron.
inline double Volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

/// The edges of one element by the places of its nodes in OrderForTetrahedra.
struct ElementEdges
{
  const std::array<int, 8>& Node;
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

/// Calls visit(tetrahedron, volume) for those of an element.
template <std::size_t N, typename Visit>
void ForTetrahedra(const Band& band, const std::array<Tetrahedron, N>& tetrahedra,
  const std::array<int, 8>& nodes, const Visit& visit)
{
  for (const auto& tetrahedron : tetrahedra)
  {
    const auto corner = [&](int i) -> const Vec3& { return band.Point[nodes[tetrahedron[i]]]; };
    visit(tetrahedron, std::abs(Volume(corner(0), corner(1), corner(2), corner(3))));
  }
}

template <typename Visit>
void ForTetrahedra(
  const Band& band, int element, const std::array<int, 8>& nodes, const Visit& visit)
{
  band.Elements[element].Count == 8 ? ForTetrahedra(band, HexahedronTetrahedra, nodes, visit)
                                    : ForTetrahedra(band, WedgeTetrahedra, nodes, visit);
}

}

double MeasureVolume(const Band& band, int element, const std::array<int, 8>& nodes)
{
  double total = 0.0;
  ForTetrahedra(
    band, element, nodes, [&total](const Tetrahedron&, double volume) { total += volume; });
  return total;
}

double MeasureEliminated(
  const Band& band, int element, const std::array<int, 8>& nodes, const CutEdges& edges)
{
  const ElementEdges ofElement{ nodes, band.NodeStatus, edges };
  double eliminated = 0.0;
  ForTetrahedra(band, element, nodes,
    [&](const Tetrahedron& tetrahedron, double volume)
    { eliminated += volume * ShareOfTetrahedron(tetrahedron, ofElement); });
  return eliminated;
}

}
