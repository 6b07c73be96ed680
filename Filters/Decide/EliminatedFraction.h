/**
 * @file EliminatedFraction.h
 * @brief V^e, the share of an element that lies beyond the surface (paper, section 2.3).
 *
 * The element is divided into tetrahedra (six for a hexahedron, three for a wedge), and each is
 * cut where the surface crosses its edges.
 */
#ifndef EliminatedFraction_h
#define EliminatedFraction_h

#include "CutEdges.h"

namespace trim
{

/// The places of an element's nodes.
/// @param nodes see OrderForTetrahedra.
ElementPoints PointsInOrder(const Band& band, int count, const std::array<int, 8>& nodes);

/// Volume of an element.
/// @param nodes see OrderForTetrahedra.
double MeasureVolume(const Band& band, int element, const std::array<int, 8>& nodes);

/// Volume of an element that lies beyond the surface.
double MeasureEliminated(
  const Band& band, int element, const std::array<int, 8>& nodes, const CutEdges& edges);

/// Of the surface where it crosses the edges of an element; zero if it crosses none.
Vec3 MeanNormal(
  const Band& band, int element, const std::array<int, 8>& nodes, const CutEdges& edges);

}

#endif
