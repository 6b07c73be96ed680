/**
 * @file OffcutHinges.h
 * @brief Where elements of the offcut hang on others by an edge or a node alone: the decision sees
 * to it that none of the trimmed grid do, and what goes then goes as it is.
 */
#ifndef OffcutHinges_h
#define OffcutHinges_h

#include "TrimBand.h"

#include <vector>

namespace trim
{

/// The elements of the band, ascending, with a part in the offcut that at a node of the cut no face
/// joins to most of those that it has there, though the whole mesh does.
std::vector<int> FindHinges(const TrimBand& near);

}

#endif
