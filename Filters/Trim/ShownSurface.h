/**
 * @file ShownSurface.h
 * @brief Whether the polygons that show a trimming surface lie on it: Transform and its like move
 * them alone.
 */
#ifndef ShownSurface_h
#define ShownSurface_h

#include "TrimmingSurface.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace trim
{

/// A few points of the polygons of poly data, or of each poly data of a composite.
std::vector<nurbs::Vec3> SamplePolygons(vtkDataObject* data);

/// What is wrong if points do not lie on the surface; empty: nothing.
std::string FindShift(const std::vector<nurbs::Vec3>& shown, const nurbs::TrimmingSurface& surface);

}

#endif
