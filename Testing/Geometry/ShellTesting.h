/**
 * @file ShellTesting.h
 * @brief What the tests of shells have in common: faces, and how a place is told.
 */
#ifndef ShellTesting_h
#define ShellTesting_h

#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace samples
{
/// Of a message.
inline std::string Place(const nurbs::Vec3& p, const nurbs::Foot& foot)
{
  std::ostringstream text;
  text << " at (" << p.transpose() << "), foot (" << foot.Point.transpose() << ") of face "
       << foot.Face;
  return text.str();
}

/// Faces turned over at random and in random order.
inline std::vector<nurbs::NurbsSurface> Shuffled(std::vector<nurbs::NurbsSurface> faces)
{
  for (nurbs::NurbsSurface& face : faces)
  {
    if (Random() % 2)
    {
      face = ReversedU(face);
    }
  }
  std::shuffle(faces.begin(), faces.end(), Random);
  return faces;
}

/// An upright face between two places in the plane; by its own border, or by a loop in a larger
/// one.
inline nurbs::NurbsSurface UprightFace(
  const nurbs::Vec2& from, const nurbs::Vec2& to, double half, bool byLoop)
{
  const nurbs::Vec3 along(to.x() - from.x(), to.y() - from.y(), 0), up(0, 0, 2 * half);
  const nurbs::Vec3 corner(from.x(), from.y(), -half);
  if (!byLoop)
  {
    return Plane(corner, along, up);
  }
  nurbs::NurbsSurface face = Plane(corner - along - up, 3 * along, 3 * up);
  const double a = 1.0 / 3.0, b = 2.0 / 3.0;
  face.TrimLoops = { { nurbs::Vec2(a, a), nurbs::Vec2(b, a), nurbs::Vec2(b, b),
    nurbs::Vec2(a, b) } };
  return face;
}
}

#endif
