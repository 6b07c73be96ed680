/**
 * @file KnotSpans.h
 * @brief The spans of one parameter of a surface, one for each row of Bezier patches.
 */
#ifndef KnotSpans_h
#define KnotSpans_h

#include "BezierPatch.h"

#include <vector>

namespace nurbs
{

/// Where patches begin and end, in u or v: the distinct knots of the domain, and what else divides
/// it.
struct KnotSpans
{
  std::vector<double> Breaks;  ///< n + 1 values that bound n spans
  std::vector<SideKind> Kinds; ///< one per break
  int Find(double u) const;    ///< the span that holds u
};

}

#endif
