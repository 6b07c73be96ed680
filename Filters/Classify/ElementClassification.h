/**
 * @file ElementClassification.h
 * @brief STATUS(elements) (paper, section 2.2), from those of their nodes.
 */
#ifndef ElementClassification_h
#define ElementClassification_h

#include "NodeClassification.h"

namespace trim
{

/**
 * The status of every cell, see StatusOfElement; a cell that the surface does not meet lies on the
 * side of any of its nodes.
 *
 * @param rounding of a distance, absolute: a cell whose nodes all are on the surface is beyond it
 * where its middle is so by more.
 * @param nodes classified by the surface, which is turned as they are.
 */
UnsetVector<unsigned char> ClassifyElements(const HexMesh& mesh, const MeshBlocks& blocks,
  const nurbs::TrimmingSurface& surface, double rounding, const NodeClassification& nodes);

}

#endif
