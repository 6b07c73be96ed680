/**
 * @file BorderCorners.h
 * @brief Where the border of the model is cut, and a node beside the cut has gone behind it.
 */
#ifndef BorderCorners_h
#define BorderCorners_h

#include "Band.h"
#include "Columns.h"
#include "TrimmedBand.h"
#include "TrimmingSurface.h"

#include <vector>

namespace trim
{

/**
 * Nodes beyond the surface that slid along the border behind the cut, though the next node there
 * has left the border for the surface: the corner between border and surface, which they should
 * have come to, is cut off by more than a tenth of the edge.
 *
 * @return ascending.
 */
std::vector<int> FindCornersCutOff(const Band& band, const Columns& columns,
  const nurbs::TrimmingSurface& surface, const TrimmedBand& trimmed);

}

#endif
