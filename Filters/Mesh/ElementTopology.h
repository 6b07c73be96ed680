/**
 * @file ElementTopology.h
 * @brief Faces, edges and axes of the two element types (paper, Fig. 1), in VTK's node order.
 *
 * An *axis* of an element is a class of its parallel edges: a hexahedron has three, a wedge
 * has one, which joins its two triangles. The *end faces* of an axis are the two it joins.
 * Wedges are taken with the normal of nodes 0-1-2 pointing to nodes 3-4-5, the order in which
 * the Jacobian of the shape functions is positive.
 */
#ifndef ElementTopology_h
#define ElementTopology_h

#include <array>

namespace trim
{

/// Local node indices of one face, outward; Count is 3 or 4.
struct FaceNodes
{
  int Count;
  std::array<int, 4> Node;
};

/// Local node indices of one edge, and the axis it is parallel to (-1: none).
struct EdgeNodes
{
  int First, Second;
  int Axis;
};

struct ElementTopology
{
  int NumberOfNodes;
  int NumberOfFaces;
  int NumberOfEdges;
  int NumberOfAxes;
  std::array<FaceNodes, 6> Faces;
  std::array<int, 6> FaceAxis; ///< the axis that a face ends, or -1
  std::array<EdgeNodes, 12> Edges;
};

inline constexpr ElementTopology HexahedronTopology = { 8, 6, 12, 3,
  { { { 4, { 0, 4, 7, 3 } }, { 4, { 1, 2, 6, 5 } }, { 4, { 0, 1, 5, 4 } }, { 4, { 3, 7, 6, 2 } },
    { 4, { 0, 3, 2, 1 } }, { 4, { 4, 5, 6, 7 } } } },
  { 0, 0, 1, 1, 2, 2 },
  { { { 0, 1, 0 }, { 3, 2, 0 }, { 4, 5, 0 }, { 7, 6, 0 }, { 0, 3, 1 }, { 1, 2, 1 }, { 4, 7, 1 },
    { 5, 6, 1 }, { 0, 4, 2 }, { 1, 5, 2 }, { 2, 6, 2 }, { 3, 7, 2 } } } };

inline constexpr ElementTopology WedgeTopology = { 6, 5, 9, 1,
  { { { 3, { 0, 2, 1, -1 } }, { 3, { 3, 4, 5, -1 } }, { 4, { 0, 1, 4, 3 } }, { 4, { 1, 2, 5, 4 } },
    { 4, { 2, 0, 3, 5 } }, { 0, { -1, -1, -1, -1 } } } },
  { 0, 0, -1, -1, -1, -1 },
  { { { 0, 3, 0 }, { 1, 4, 0 }, { 2, 5, 0 }, { 0, 1, -1 }, { 1, 2, -1 }, { 2, 0, -1 }, { 3, 4, -1 },
    { 4, 5, -1 }, { 5, 3, -1 }, { -1, -1, -1 }, { -1, -1, -1 }, { -1, -1, -1 } } } };

/// The two ends of a hexahedron along each axis, in cyclic order, the first one's normal
/// pointing to the second.
inline constexpr int AxisEnds[3][2][4] = { { { 0, 3, 7, 4 }, { 1, 2, 6, 5 } },
  { { 0, 4, 5, 1 }, { 3, 7, 6, 2 } }, { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } } };

inline constexpr int HexahedronCorners[8][3] = { { 1, 3, 4 }, { 2, 0, 5 }, { 3, 1, 6 }, { 0, 2, 7 },
  { 7, 5, 0 }, { 4, 6, 1 }, { 5, 7, 2 }, { 6, 4, 3 } };
inline constexpr int WedgeCorners[6][3] = { { 1, 2, 3 }, { 2, 0, 4 }, { 0, 1, 5 }, { 5, 4, 0 },
  { 3, 5, 1 }, { 4, 3, 2 } };

/// The other ends of the three edges from a corner of an element of 8 or 6 nodes, positively
/// oriented; a wedge's third is its axis.
inline const int* CornerEnds(int corner, int numberOfNodes)
{
  return numberOfNodes == 8 ? HexahedronCorners[corner] : WedgeCorners[corner];
}

/// The topology of an element of 8 or 6 nodes.
inline const ElementTopology& TopologyOf(int numberOfNodes)
{
  return numberOfNodes == 8 ? HexahedronTopology : WedgeTopology;
}

/// The other end face of the axis that a face ends (end faces are stored in pairs).
inline int OppositeFace(int face)
{
  return face ^ 1;
}

}

#endif
