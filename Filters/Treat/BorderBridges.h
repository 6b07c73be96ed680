/**
 * @file BorderBridges.h
 * @brief Where the border of the model bends and a facet that an element has on it goes straight
 * across, as its nodes are too far apart: it takes what lies outside of the model, or leaves out
 * what lies in it.
 */
#ifndef BorderBridges_h
#define BorderBridges_h

#include "TrimmedBand.h"
#include "TrimmingSurface.h"

#include <vector>

namespace trim
{

/**
 * Whether an exterior facet of an element passes both the border of the model and the surface by a
 * fifth of an edge, in its middle or in that of an edge.
 *
 * @param longest edge with which the element came.
 * @param node the element's `count` nodes, in VTK's order.
 * @param points where they are now.
 */
bool HasBridge(const Band& band, const nurbs::TrimmingSurface& surface, int element, double longest,
  const std::array<int, 8>& node, const ElementPoints& points, int count);

/// The kept elements with such a facet, ascending.
std::vector<int> FindBridges(
  const Band& band, const nurbs::TrimmingSurface& surface, const TrimmedBand& trimmed);

}

#endif
