/**
 * @file CADSolids.h
 * @brief What is asked of solids that OpenCASCADE makes of others, and where their faces come from.
 */
#ifndef CADSolids_h
#define CADSolids_h

#include "CADModel.h"

#include <set>

class BRepTools_History;

namespace nurbs
{
/// Of the volumes that OpenCASCADE integrates over curved faces.
constexpr double VolumeTolerance = 1e-3;

/// The volume that a closed shape encloses as OpenCASCADE integrates it; negative if inside out.
double VolumeOf(const TopoDS_Shape& shape);

/// Are all its shells closed, and is it valid by OpenCASCADE's own check?
bool AreSoundSolids(const TopoDS_Shape& shape);

/// Of each face the faces of the result that are it, or a part of it; none if a face of the result
/// is of none.
std::vector<std::vector<CADFace>> PartsOf(
  const std::vector<CADFace>& faces, BRepTools_History& history, const TopoDS_Shape& result);

/// Bodies with a face whose other part is taken: their solids still have the wrong one.
std::set<int> BodiesOfOtherParts(const CADModel& model);

/// Of each face of the model whether it is of such a body.
std::vector<bool> FacesOf(const CADModel& model, const std::function<bool(int)>& isBody);

/// The faces that are marked.
std::vector<CADFace> TakeMarked(const CADModel& model, const std::vector<bool>& isMarked);

/**
 * Puts parts of the marked faces in their place.
 *
 * @param parts  see PartsOf.
 * @param bodyOf (part): the body that it is of.
 */
void ReplaceFaces(CADModel& model, const std::vector<bool>& isMarked,
  std::vector<std::vector<CADFace>> parts, const std::function<int(const CADFace&)>& bodyOf);
}

#endif
