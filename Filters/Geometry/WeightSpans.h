/**
 * @file WeightSpans.h
 * @brief More spans where the weights of a surface are very unequal.
 *
 * Where one weight of a Bezier patch is a thousand times another, nearly all of the patch lies
 * within a thousandth of its parameters: steps and tolerances of searches, which are shares of the
 * parameters, would pass over it.
 */
#ifndef WeightSpans_h
#define WeightSpans_h

#include "KnotSpans.h"
#include "NurbsSurface.h"

namespace nurbs
{

/// Where the weights of a surface differ by a factor of 10 000 or more: divides spans until those
/// of each patch along u, and along v, are within a factor of 100 of each other, as far as the
/// parameters can be told apart.
void DivideByWeights(const NurbsSurface& surface, KnotSpans& spansU, KnotSpans& spansV);

}

#endif
