/**
 * @file FloorClimb.h
 * @brief The ladder for elements that are valid, but below the quality floor.
 */
#ifndef FloorClimb_h
#define FloorClimb_h

#include "ColumnChoices.h"

namespace trim
{

/**
 * Takes other corrections and fates for columns that relaxation could not raise to what is aimed
 * at, where that helps and spoils nothing.
 *
 * @param given what the choices were made for.
 * @param[in,out] choices its position is what the columns end with.
 */
void RaiseToFloor(const TrimCase& given, ColumnChoices& choices, TrimmedBand& trimmed);

/// Leaves nodes off the surface for what is below the floor all the same; parameters as above.
void LeaveBelowFloor(ColumnChoices& choices, TrimmedBand& trimmed);

}

#endif
