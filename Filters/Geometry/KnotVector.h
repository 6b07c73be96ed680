/**
 * @file KnotVector.h
 * @brief Where a parameter lies among the knots of a curve or surface.
 *
 * A vector of n+p+2 non-decreasing knots for n+1 control points and degree p, see NurbsSurface.h.
 */
#ifndef KnotVector_h
#define KnotVector_h

#include <algorithm>
#include <vector>

namespace nurbs
{

/// The last knot that is less than `next`; -1: there is none.
inline int LastKnotBefore(const std::vector<double>& knots, double next)
{
  return static_cast<int>(std::lower_bound(knots.begin(), knots.end(), next) - knots.begin()) - 1;
}

/// The last knot that is not above t; -1: there is none.
inline int LastKnotNotAbove(const std::vector<double>& knots, double t)
{
  return static_cast<int>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1;
}

/**
 * The span [u_k, u_{k+1}) of positive length that holds u; at a jump the one to its right, at the
 * end of the domain and beyond it the last one. (NURBS Book, A2.1)
 *
 * @param count n+1 control points.
 * @param u not before the domain.
 */
inline int FindSpan(int degree, int count, const std::vector<double>& knots, double u)
{
  const auto begin = knots.begin() + degree;
  const auto end = knots.begin() + count;
  const auto next =
    u >= *end ? std::lower_bound(begin, end, *end) : std::upper_bound(begin, end, u);
  return static_cast<int>(next - knots.begin()) - 1;
}

}

#endif
