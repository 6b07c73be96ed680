/**
 * @file CADFaceConversion.h
 * @brief One face of a CAD model as a NURBS surface with its trim loops.
 */
#ifndef CADFaceConversion_h
#define CADFaceConversion_h

#include "NurbsSurface.h"

#include <string>
#include <vector>

class TopoDS_Face;

namespace nurbs
{
/**
 * Converts a face with its location and orientation; the result is multiplied by `scale`.
 *
 * @param limits u, u, v, v: part of the surface's parameters beyond which the face does not
 *               reach, whatever its wires say; empty: none.
 * @param[out] surfaces one, or one for each turn of a face that winds round its surface.
 * @param isOtherPart whether the face is what its wire leaves of its surface (HasOtherPart).
 * @return empty, or in a few words why the face has no NURBS surface. OpenCASCADE's exceptions
 * pass through.
 */
std::string ConvertFace(const TopoDS_Face& face, const std::vector<double>& limits, double scale,
  std::vector<NurbsSurface>& surfaces, bool isOtherPart = false);

/// Whether a face goes from pole to pole, as a part of a sphere between two lines of longitude: its
/// wire bounds the other part of its surface as well.
bool HasOtherPart(const TopoDS_Face& face);
}

#endif
