/**
 * @file IgesWeights.h
 * @brief Finds weights in an IGES file that are not positive.
 *
 * OpenCASCADE replaces all weights of such a spline by one, without a word: another surface.
 */
#ifndef IgesWeights_h
#define IgesWeights_h

#include <string>

namespace nurbs
{
/**
 * Looks at all B-spline curves and surfaces (types 126, 128) of an IGES file.
 * @return empty, or a few words that name the weight and the entity by its directory line.
 */
std::string FindBadIgesWeight(const std::string& path);
}

#endif
