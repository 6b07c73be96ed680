/**
 * @file BothParts.h
 * @brief Kept part and offcut together, both valid.
 *
 * The kept part is what it would be without the offcut, unless the offcut has an element that
 * cannot be made valid: then the kept part takes that element's column, and where that is no way
 * either the nodes there are left off the surface, no farther than it takes.
 */
#ifndef BothParts_h
#define BothParts_h

#include "Offcut.h"
#include "ValidityLadder.h"

namespace trim
{

struct BothParts
{
  TrimmedBand Kept;
  Offcut Rest;
  ClimbMade Made; ///< of the kept part
};

/// The offcut of a kept part.
Offcut FitOffcut(const TrimCase& given, const LadderOptions& options, const TrimmedBand& kept);

/// See ClimbLadder.
BothParts ClimbForBothParts(const TrimCase& given, const LadderOptions& options);

}

#endif
