/**
 * @file LocalThickness.h
 * @brief The thickness axis of each element by itself, where sheets meet at joints.
 */
#ifndef LocalThickness_h
#define LocalThickness_h

#include "Band.h"

#include <vector>

namespace trim
{

/**
 * The axis of each element of a part whose chain ends at the skin and is clearly the shortest.
 * Sheets that meet at a joint have a thickness axis each, and what joins them has none: where the
 * axes of two elements do not go on through the face between them, the one that ends at it gives
 * way, else both.
 *
 * @param part elements that faces join.
 * @param[in,out] axis of each element of the band: those of the part are set, -1: none.
 */
void FindLocalThickness(
  const Band& band, const std::vector<int>& part, std::vector<signed char>& axis);

}

#endif
