/**
 * @file PartedStrips.h
 * @brief Where a strip of the mesh between two cuts, or a cut and a border, is lost, and what it
 * held together comes apart: two holes become one, a hole opens to the border.
 */
#ifndef PartedStrips_h
#define PartedStrips_h

#include "TrimBand.h"

#include <vector>

namespace trim
{

/// The eliminated elements that such a strip goes through, ascending; of WithoutLayer(near.Mesh).
std::vector<int> FindPartedStrips(const TrimBand& near);

}

#endif
