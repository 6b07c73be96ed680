/**
 * @file LayerPits.h
 * @brief Elements of an inserted layer that are left out.
 */
#ifndef LayerPits_h
#define LayerPits_h

#include "Columns.h"
#include "TrimmedBand.h"

#include <vector>

namespace trim
{

/**
 * Eliminates elements of an inserted layer, by whole columns: the nodes on which they stood are
 * left off the surface, and no other element changes its shape.
 *
 * @param faulty elements of the band.
 * @param[in,out] trimmed what is eliminated is faulty no more.
 * @return false, with nothing changed, where one of them is none of the layer, or the rest would
 * not be a manifold.
 */
bool DigPits(const Band& layered, const Columns& columns, const std::vector<int>& faulty,
  TrimmedBand& trimmed);

}

#endif
