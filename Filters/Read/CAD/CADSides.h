/**
 * @file CADSides.h
 * @brief Whether two sets of solids fill the same space.
 */
#ifndef CADSides_h
#define CADSides_h

#include <TopoDS_Shape.hxx>

#include <vector>

namespace nurbs
{
/**
 * Whether a place beside each face of the bodies, on either side, is in some of the bodies just if
 * it is in the shape; of many faces some hundreds are looked at. Told by the winding numbers of
 * triangles that OpenCASCADE makes of the faces: its own classifier of places takes long and errs
 * where its lines meet edges.
 *
 * @param bodies closed solids, not inside out.
 * @param shape  closed solids.
 */
bool FillTheSame(const std::vector<TopoDS_Shape>& bodies, const TopoDS_Shape& shape);
}

#endif
