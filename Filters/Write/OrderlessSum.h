/**
 * @file OrderlessSum.h
 * @brief A sum that does not depend on the order of its terms, nor on how they are spread over
 * ranks.
 */
#ifndef OrderlessSum_h
#define OrderlessSum_h

#include "Ranks.h"

#include <vector>

namespace trim
{

/**
 * Sum of terms >= 0 over all ranks, the same bits whatever their order; collective. The terms
 * are added as integers, each rounded to 2^-62 of the largest.
 */
double OrderlessSum(const std::vector<double>& terms, const Ranks& ranks);

}

#endif
