/**
 * @file ShellOrientation.h
 * @brief Makes the normals of the faces alike across shared edges.
 */
#ifndef ShellOrientation_h
#define ShellOrientation_h

namespace nurbs
{
struct SurfaceModel;

/// Sets FaceData::Sign; in each connected shell the face of largest area keeps its normal, or most
/// of those that are as large.
void OrientShells(SurfaceModel& model);

}

#endif
