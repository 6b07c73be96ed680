/**
 * @file FaceOrder.h
 * @brief Faces in an order of their own, whatever order they come in.
 */
#ifndef FaceOrder_h
#define FaceOrder_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{

/**
 * The faces by their control points, then by what else they have. On an edge it is a matter of
 * rounding which face has the closest point, and sums over faces are rounded by their order; a trim
 * that is hard to do may come out otherwise for a last bit. The order in a file must not decide.
 */
std::vector<NurbsSurface> InOwnOrder(std::vector<NurbsSurface> faces);

}

#endif
