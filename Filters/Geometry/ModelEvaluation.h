/**
 * @file ModelEvaluation.h
 * @brief Points and feet on a model's faces and normals of its patches, also where these collapse.
 */
#ifndef ModelEvaluation_h
#define ModelEvaluation_h

#include "PointInversion.h"
#include "SurfaceModel.h"

namespace nurbs
{

/// Unit S_u x S_v of a patch; where it vanishes its limit from inside. Zero if there is none.
Vec3 UnitNormal(const SurfaceModel& model, const BezierPatch& patch, double s, double t);

/// The foot of p on the part of a patch that is a leaf.
LocalFoot FootOnLeaf(const SurfaceModel& model, int index, const Vec3& p);

/// S of a face at (u, v), about the local origin.
Vec3 FacePoint(const SurfaceModel& model, int face, const Vec2& uv);

}

#endif
