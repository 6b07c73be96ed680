/**
 * @file Types.h
 * @brief What numbers of nodes and cells, and places, are throughout the stages.
 */
#ifndef Types_h
#define Types_h

#include <Eigen/Core>

#include <vtkType.h>

namespace trim
{
using Id = vtkIdType;
using Vec3 = Eigen::Vector3d;
}

#endif
