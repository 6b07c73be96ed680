/**
 * @file TetrahedronShare.h
 * @brief The share of a tetrahedron that lies beyond a surface, from where it crosses the edges
 * (paper, section 2.3).
 */
#ifndef TetrahedronShare_h
#define TetrahedronShare_h

#include "ElementMap.h"
#include "ElementTetrahedra.h"

#include <array>
#include <cmath>

namespace trim
{

/**
 * By how many of its nodes are eliminated.
 *
 * @param edges tells by nodes' places in OrderForTetrahedra: IsEliminated(node), and
 * Beyond(eliminated, other), the share of the edge between the two that lies beyond.
 */
template <typename Edges>
double ShareOfTetrahedron(const Tetrahedron& tetrahedron, const Edges& edges)
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

/// Calls visit(tetrahedron, volume) for those of a hexahedron or wedge.
/// @param points of the nodes in OrderForTetrahedra.
template <typename Visit>
void ForTetrahedra(const ElementPoints& points, int count, const Visit& visit)
{
  const auto visitAll = [&](const auto& tetrahedra)
  {
    for (const Tetrahedron& own : tetrahedra)
    {
      const Vec3& first = points[own[0]];
      const Vec3 across = (points[own[1]] - first).cross(points[own[2]] - first);
      visit(own, std::abs(across.dot(points[own[3]] - first) / 6.0));
    }
  };
  count == 8 ? visitAll(HexahedronTetrahedra) : visitAll(WedgeTetrahedra);
}

}

#endif
