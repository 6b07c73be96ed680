/**
 * @file CADFaceConversion.h
 * @brief One face of a CAD model as a NURBS surface with its trim loops.
 */
#ifndef CADFaceConversion_h
#define CADFaceConversion_h

#include "NurbsSurface.h"

#include <string>

class TopoDS_Face;

namespace nurbs
{
/**
 * Converts a face with its location and orientation; the result is multiplied by `scale`.
 *
 * @return empty, or in a few words why the face has no NURBS surface. OpenCASCADE's exceptions
 * pass through.
 */
std::string ConvertFace(const TopoDS_Face& face, double scale, NurbsSurface& surface);
}

#endif
