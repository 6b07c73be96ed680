/**
 * @file LoopThinning.h
 * @brief Trim loops with fewer corners.
 */
#ifndef LoopThinning_h
#define LoopThinning_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{

/**
 * Loops with fewer corners, for drawing: those left out are within `tolerance` of the chord that
 * takes their place, u and v measured in units of `unit`. Corners that are kept are not moved.
 */
std::vector<std::vector<Vec2>> ThinLoops(
  const std::vector<std::vector<Vec2>>& loops, const Vec2& unit, double tolerance);

}

#endif
