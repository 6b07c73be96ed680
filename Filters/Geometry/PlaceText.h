/**
 * @file PlaceText.h
 * @brief How messages name a place.
 */
#ifndef PlaceText_h
#define PlaceText_h

#include "NurbsSurface.h"

#include <string>

namespace nurbs
{
/// "(x, y, z)" with nine digits.
std::string PlaceText(const Vec3& place);

}

#endif
