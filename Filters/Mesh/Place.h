/**
 * @file Place.h
 * @brief A position as plain numbers: it can be sent to other ranks, and be put in order.
 */
#ifndef Place_h
#define Place_h

#include "NurbsSurface.h"

#include <array>

namespace trim
{
using nurbs::Vec3;

using Place = std::array<double, 3>;

inline Place ToPlace(const Vec3& p)
{
  return { p[0], p[1], p[2] };
}

inline Vec3 ToVec3(const Place& p)
{
  return Vec3(p[0], p[1], p[2]);
}

}

#endif
