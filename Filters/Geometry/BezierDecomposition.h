/**
 * @file BezierDecomposition.h
 * @brief A NURBS surface as Bezier patches.
 */
#ifndef BezierDecomposition_h
#define BezierDecomposition_h

#include "BezierPatch.h"
#include "PageVector.h"

#include <vector>

namespace nurbs
{
/// Distinct knots of the domain and the side kinds at each of them.
struct KnotSpans
{
  std::vector<double> Breaks;  ///< n + 1 values that bound n spans
  std::vector<SideKind> Kinds; ///< one per break
  int Find(double u) const;    ///< the span that holds u
};

/**
 * Appends the Bezier patches of a surface (blossoming; NURBS Book, chapter 5.3), row by row,
 * u running fastest.
 */
void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, PageVector<BezierPatch>& patches, PageVector<Vec4>& nets);

}

#endif
