/**
 * @file LayerSkin.h
 * @brief Keeps the nodes of an inserted layer on the skin that the mesh came with.
 */
#ifndef LayerSkin_h
#define LayerSkin_h

#include "BandQuality.h"
#include "NodeMover.h"

namespace trim
{

/**
 * Takes nodes that moved along the skin of a layered band to the facets that there were without the
 * layer: it divides them, and pieces of a twisted facet are not that facet. A node stays where it
 * came to if an element would be spoiled: such elements, and those that fall below the floor, are
 * told in BelowFloor.
 *
 * @param layered its BeforeLayer is what the next three are of.
 * @param mover by the mesh without the layer.
 * @param kept what stays of that, by element.
 * @param quality of the layered band.
 * @param[in,out] trimmed the layered band.
 */
void ReturnToSkin(const Band& layered, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& kept, const BandQuality& quality, TrimmedBand& trimmed);

}

#endif
