/**
 * @file KnotSpans.h
 * @brief The spans of one parameter of a surface, one for each row of Bezier patches.
 */
#ifndef KnotSpans_h
#define KnotSpans_h

#include "BezierPatch.h"

#include <algorithm>
#include <vector>

namespace nurbs
{

/// Where patches begin and end, in u or v: the distinct knots of the domain, and what else divides
/// it.
struct KnotSpans
{
  std::vector<double> Breaks;  ///< n + 1 values that bound n spans
  std::vector<SideKind> Kinds; ///< one per break

  int Count() const { return static_cast<int>(this->Breaks.size()) - 1; }

  /// The span that holds u; beyond the ends the first or the last.
  int Find(double u) const
  {
    const auto next = std::upper_bound(this->Breaks.begin() + 1, this->Breaks.end() - 1, u);
    return static_cast<int>(next - this->Breaks.begin()) - 1;
  }
};

}

#endif
