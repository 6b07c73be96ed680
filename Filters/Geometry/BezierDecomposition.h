/**
 * @file BezierDecomposition.h
 * @brief A NURBS surface as Bezier patches.
 */
#ifndef BezierDecomposition_h
#define BezierDecomposition_h

#include "BezierPatch.h"
#include "KnotSpans.h"
#include "PageVector.h"

namespace nurbs
{
/**
 * Appends the Bezier patches of a surface (blossoming; NURBS Book, chapter 5.3), row by row,
 * u running fastest. Each is one of a span between knots, or of a part of it: see WeightSpans.h.
 */
void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, PageVector<BezierPatch>& patches, PageVector<Vec4>& nets);

}

#endif
