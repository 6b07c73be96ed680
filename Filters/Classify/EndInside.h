/**
 * @file EndInside.h
 * @brief Whether a surface that has all nodes on one side ends within the grid all the same.
 */
#ifndef EndInside_h
#define EndInside_h

#include "NodeClassification.h"
#include "Place.h"

namespace trim
{

/// A place on the free border of the surface that lies within the elements round it; false if there
/// is none next to an element with a node that the border is nearest to.
bool FindEndInside(const HexMesh& mesh, const NodeClassification& nodes,
  const nurbs::TrimmingSurface& surface, Place& place);

}

#endif
