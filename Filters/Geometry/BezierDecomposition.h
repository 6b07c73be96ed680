/**
 * @file BezierDecomposition.h
 * @brief A NURBS surface as Bezier patches.
 */
#ifndef BezierDecomposition_h
#define BezierDecomposition_h

#include "BezierPatch.h"
#include "KnotSpans.h"
#include "PageVector.h"

#include <functional>

namespace nurbs
{
/**
 * Appends the Bezier patches of a surface (blossoming; NURBS Book, chapter 5.3), row by row,
 * u running fastest. Each is one of a span between knots, or of a part of it: see WeightSpans.h.
 *
 * @param origin what the nets are about.
 * @param[out] spansU, spansV the rows and columns of patches.
 * @param visit is told of each as it is made.
 */
void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, UnsetVector<BezierPatch>& patches, UnsetVector<Vec4>& nets,
  const std::function<void(const BezierPatch&, const Vec4* net)>& visit);

}

#endif
