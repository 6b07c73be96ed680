/**
 * @file StickingNodes.h
 * @brief Nodes that a trim took out of the mesh.
 */
#ifndef StickingNodes_h
#define StickingNodes_h

#include "TrimBand.h"
#include "TrimmingSurface.h"

namespace trim
{

/// Whether a node that no face holds was taken along the surface to where that has left the mesh:
/// what is kept would have a lump there that the part has not.
bool SticksOut(const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision);

}

#endif
