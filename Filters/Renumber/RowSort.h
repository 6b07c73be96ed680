/**
 * @file RowSort.h
 * @brief Orders points by rows along three axes, in time proportional to their number.
 */
#ifndef RowSort_h
#define RowSort_h

#include "NurbsSurface.h"
#include "PageVector.h"

namespace trim
{
using nurbs::PageVector;

/**
 * The points by their rows along the columns of `axes`, the first outermost, then as they came.
 * Coordinates without a gap of a millionth of the extent between them are one row.
 */
PageVector<int> SortByRows(const PageVector<nurbs::Vec3>& points, const Eigen::Matrix3d& axes);

}

#endif
