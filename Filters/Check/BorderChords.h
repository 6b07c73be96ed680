/**
 * @file BorderChords.h
 * @brief Where the surface bends away between nodes of the new border: beside a place where it
 * grazes the border of the model, a facet there may be three elements long, and one of the usual
 * length may go from wall to wall of the surface.
 */
#ifndef BorderChords_h
#define BorderChords_h

#include "NodeClassification.h"
#include "Ranks.h"
#include "TrimBand.h"
#include "TrimmingSurface.h"

#include <vector>

namespace trim
{

/**
 * The kept elements with such a facet, ascending. Collective.
 *
 * @param feet of this rank's nodes where they came from.
 */
std::vector<int> FindLongChords(const TrimBand& near, const NodeFeet& feet,
  const nurbs::TrimmingSurface& surface, const Ranks& ranks);

}

#endif
