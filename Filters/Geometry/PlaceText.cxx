#include "PlaceText.h"

#include <cstdio>

namespace nurbs
{

std::string PlaceText(const Vec3& place)
{
  char text[128];
  std::snprintf(text, sizeof(text), "(%.9g, %.9g, %.9g)", place.x(), place.y(), place.z());
  return text;
}

}
