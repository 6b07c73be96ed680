/**
 * @file CADFins.h
 * @brief Takes out of a CAD file's bodies what has no thickness.
 */
#ifndef CADFins_h
#define CADFins_h

#include "CADModel.h"

#include <Message_ProgressRange.hxx>

namespace nurbs
{
/**
 * Some programs write bodies with walls that have no thickness, as those of the leads of a chip:
 * two faces lie back to back, as a whole or in part, and nothing is between them. Beside them no
 * normal tells a side. Puts the faces of what has a volume in their place; a body that falls apart
 * without its fin is several then. Only plane faces are looked for.
 *
 * What cannot be done without a doubt is left as it is.
 */
void RemoveFins(CADModel& model, const Message_ProgressRange& progress);
}

#endif
