/**
 * @file DoubledShells.h
 * @brief Shells that a file has twice, as surfaces and once more as those of a body.
 */
#ifndef DoubledShells_h
#define DoubledShells_h

#include <vector>

namespace nurbs
{
struct SurfaceModel;

/// Of shells all of whose faces are there twice or more often, however they are turned, all faces
/// but one of those at one place. Single faces that are there twice, as where two bodies share a
/// wall, are not among them.
std::vector<int> FindDoubledFaces(const SurfaceModel& model);

}

#endif
