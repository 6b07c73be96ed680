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

struct ElementVolumes
{
  double Total = 0;
  double Eliminated = 0;
  double Fraction() const { return this->Total > 0.0 ? this->Eliminated / this->Total : 0.0; }
};

/// Volumes of one element.
ElementVolumes MeasureEliminated(
  const Band& band, int element, const nurbs::TrimmingSurface& surface, const CutEdges& edges);

}

#endif
