/**
 * @file CADShells.h
 * @brief Sews faces that a CAD file leaves loose, as IGES files do, into the bodies that they
 * bound.
 */
#ifndef CADShells_h
#define CADShells_h

#include "CADModel.h"

namespace nurbs
{
/// Adds a body to the model for each closed shell that faces without a body make; the faces keep
/// their shape and have that in the body beside it. Faces that end somewhere stay loose, and those
/// of which the file takes a part only that OpenCASCADE does not.
void SewBodies(CADModel& model);
}

#endif
