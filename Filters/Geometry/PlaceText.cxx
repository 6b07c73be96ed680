#include "PlaceText.h"

#include <locale>
#include <sstream>

namespace nurbs
{

std::string PlaceText(const Vec3& place)
{
  std::ostringstream text;
  text.imbue(std::locale::classic()); // commas part the coordinates
  text.precision(9);
  text << "(" << place.x() << ", " << place.y() << ", " << place.z() << ")";
  return text.str();
}

}
