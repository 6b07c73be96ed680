/**
 * @file Binomials.h
 * @brief Binomial coefficients.
 */
#ifndef Binomials_h
#define Binomials_h

namespace nurbs
{
/**
 * The coefficients n over k, k = 0 .. n.
 *
 * @param n up to 2 MaximumBezierDegree: the degree of a squared distance.
 */
const double* Binomials(int n);

}

#endif
