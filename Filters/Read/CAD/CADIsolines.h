/**
 * @file CADIsolines.h
 * @brief Edges along a line of constant parameter whose curve in the parameters strays from it.
 */
#ifndef CADIsolines_h
#define CADIsolines_h

#include "CADWires.h"

class TopoDS_Edge;

namespace nurbs
{
/**
 * OpenCASCADE finds the curves in the parameters that a STEP file leaves out by projection. At the
 * pole of a surface, where it does not know of it, the parameter along the pole is by chance, and
 * the curve swings from there to that of the edge: what lies between is missing from the face, or
 * there twice.
 *
 * @param boundary the curve of the edge, in its own direction.
 * @return a straight one where that is the edge and the given curve strays from it; else as given.
 */
BoundaryCurve WithoutStraying(
  const TopoDS_Edge& edge, const Handle(Geom_Surface) & surface, const BoundaryCurve& boundary);
}

#endif
