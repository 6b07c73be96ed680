/**
 * @file CADOtherParts.h
 * @brief Faces of STEP files of which OpenCASCADE takes the wrong part of their surface.
 */
#ifndef CADOtherParts_h
#define CADOtherParts_h

#include "CADModel.h"

#include <functional>
#include <optional>

namespace nurbs
{
/// Whether the file says that a face's normal is that of its surface; nothing: it does not say.
using SenseOfFace = std::function<std::optional<bool>(const CADFace&)>;

/**
 * Marks the faces from pole to pole of which OpenCASCADE has taken the wrong part
 * (CADFace::IsOtherPart), as of a ring whose hole is one point, through which the wire goes, and
 * gives them and their shells the orientation that the file says.
 */
void MarkOtherParts(CADModel& model, const SenseOfFace& senseOf);
}

#endif
