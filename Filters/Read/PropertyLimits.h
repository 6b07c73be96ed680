/**
 * @file PropertyLimits.h
 * @brief How many points or knots the sources take as properties.
 */
#ifndef PropertyLimits_h
#define PropertyLimits_h

namespace nurbs
{
/// More than any line or surface has: an index or a number beyond is a mistake, and would take all
/// the memory.
constexpr int MostValues = 10000000;
}

#endif
