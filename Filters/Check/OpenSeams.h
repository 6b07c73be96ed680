/**
 * @file OpenSeams.h
 * @brief Where the mesh at the cut is open along a seam: faces that lie on each other and are not
 * the same, as when the pieces of a mesh were put together and not merged, or where a part of it is
 * refined and has nodes on the edges and faces of coarser elements.
 */
#ifndef OpenSeams_h
#define OpenSeams_h

#include "TrimBand.h"

#include <vector>

namespace trim
{

/// Elements that the surface meets and that have such a face, ascending. Skins of sheets may lie on
/// each other: they count where they have nodes in common and others that hang between those.
std::vector<int> FindOpenSeams(const TrimBand& near);

}

#endif
