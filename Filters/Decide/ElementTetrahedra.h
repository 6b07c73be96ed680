/**
 * @file ElementTetrahedra.h
 * @brief Into which tetrahedra an element is divided where its volume beyond the surface is
 * measured (paper, section 2.3): six for a hexahedron, three for a wedge.
 */
#ifndef ElementTetrahedra_h
#define ElementTetrahedra_h

#include "Band.h"

#include <array>

namespace trim
{

using Tetrahedron = std::array<int, 4>; ///< places in OrderForTetrahedra

/// Six tetrahedra round the diagonal 0-6, and three in a wedge; positive in VTK's node order.
constexpr std::array<Tetrahedron, 6> HexahedronTetrahedra = { { { 0, 1, 2, 6 }, { 0, 2, 3, 6 },
  { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 }, { 0, 5, 1, 6 } } };
constexpr std::array<Tetrahedron, 3> WedgeTetrahedra = { { { 0, 1, 2, 5 }, { 0, 1, 5, 4 },
  { 0, 4, 5, 3 } } };

/**
 * The nodes of an element of the band in a positive order, from that which is the first one of the
 * band on: the tetrahedra must not depend on how the element is numbered.
 */
std::array<int, 8> OrderForTetrahedra(const BandElement& element);

}

#endif
