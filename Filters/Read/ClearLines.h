/**
 * @file ClearLines.h
 * @brief Lines of a grid over a trimmed parameter rectangle that keep clear of the trim loops'
 * corners.
 */
#ifndef ClearLines_h
#define ClearLines_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{

/**
 * The lines that the trimmed grid uses along one axis: the outermost are moved outwards, so that
 * loops along the border of the domain lie inside; the others clear of the loops' corners. Along u
 * one is added where a loop would lie between two.
 *
 * @param lines rising parameter values, at least two.
 */
std::vector<double> ClearLines(
  std::vector<double> lines, const std::vector<std::vector<Vec2>>& loops, int axis);

}

#endif
