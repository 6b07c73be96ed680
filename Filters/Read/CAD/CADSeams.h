/**
 * @file CADSeams.h
 * @brief The border of faces that are whole spheres, tori and the like, or go from pole to pole.
 */
#ifndef CADSeams_h
#define CADSeams_h

#include "CADWires.h"

namespace nurbs
{
/**
 * A wire that only runs along a seam, there and back, bounds all of a surface that ends in seams
 * and poles only: it gets the border of the whole range. Of IGES files OpenCASCADE may read no more
 * of it, neither the seam's other side nor the poles, nor the second seam.
 */
void CompleteSeams(const Handle(Geom_Surface) & surface, std::vector<BoundaryWire>& wires);

/**
 * Makes the wire of a part from pole to pole, as of a sphere between two lines of longitude, that
 * of the other part: the lines alone do not say which one it is, and OpenCASCADE takes the wrong
 * one now and then where a file has no curves in the parameters.
 *
 * @return false, with nothing changed, if the wires are not of this kind.
 */
bool TakeOtherPart(const Handle(Geom_Surface) & surface, std::vector<BoundaryWire>& wires);
}

#endif
