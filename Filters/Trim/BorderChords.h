/**
 * @file BorderChords.h
 * @brief Where nodes of the new border had to go so far apart that the surface bends away between
 * them: beside a place where it grazes the border of the model, a facet there may be three elements
 * long.
 */
#ifndef BorderChords_h
#define BorderChords_h

#include "TrimBand.h"
#include "TrimmingSurface.h"

#include <vector>

namespace trim
{

/// The kept elements with such a facet, ascending.
std::vector<int> FindLongChords(const TrimBand& near, const nurbs::TrimmingSurface& surface);

}

#endif
