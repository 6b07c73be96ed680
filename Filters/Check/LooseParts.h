/**
 * @file LooseParts.h
 * @brief Parts of the trimmed grid that are hardly more than a shred: an implicit solver cannot do
 * with what nothing holds.
 */
#ifndef LooseParts_h
#define LooseParts_h

#include "TrimBand.h"

#include <vector>

namespace trim
{

/**
 * The kept elements of parts that no face joins to the rest, and all of whose elements are at the
 * new boundary, or beneath a layer inserted there; ascending. A part that is all there is is not
 * loose.
 *
 * @param boundary see ListBoundaryNodes.
 * @param kept how many elements are kept in all, in the band and elsewhere.
 */
std::vector<int> FindLooseParts(const TrimBand& near, const std::vector<int>& boundary, Id kept);

}

#endif
