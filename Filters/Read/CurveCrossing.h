/**
 * @file CurveCrossing.h
 * @brief Finds where trim lines, seen along the direction of the sweep, cross.
 */
#ifndef CurveCrossing_h
#define CurveCrossing_h

#include "TrimLineCurve.h"

namespace nurbs
{
struct CurveCrossing
{
  bool Found = false;
  size_t First = 0, Second = 0; ///< the lines; the same twice if one crosses itself
  bool TurnsBack = false;       ///< the line does not cross, but turns back on itself there
  Vec3 Place = Vec3::Zero();    ///< on the first line
};

/**
 * A place where a line crosses or touches itself or another one, seen along `direction`, a unit
 * vector, or where it turns back by 180 degrees. Lines are sampled, crossings of the samples
 * confirmed on the curves themselves: crossings within one of sixteen steps between two knots are
 * not seen.
 */
CurveCrossing FindCrossing(const std::vector<TrimLine>& lines, const Vec3& direction);
}

#endif
