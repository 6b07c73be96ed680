/**
 * @file CADBodies.h
 * @brief Joins the bodies of a CAD file that touch or cross each other, as those of an assembly
 * do.
 */
#ifndef CADBodies_h
#define CADBodies_h

#include "CADModel.h"

namespace nurbs
{
/**
 * Puts the faces of their union in the place of those of bodies that touch or cross each other:
 * where two bodies lie against each other there is no boundary of what they fill together, and no
 * side that is cut away. Faces keep their names; of two that lie on each other the first does.
 *
 * OpenCASCADE's general fuse does it. Bodies that it cannot join without a doubt stay as they are
 * and are counted as unjoined; so stay those that do not meet, or only along edges, and bodies that
 * are inside out.
 *
 * @return false when stopped by `progress` (0..1).
 */
bool JoinBodies(CADModel& model, const std::function<bool(double)>& progress);
}

#endif
