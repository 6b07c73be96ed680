// Faces that a file has twice, written alike or but for rounding: they are one surface, no body
// without an inside.
#include "Check.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"
#include "TrimmingSurface.h"

#include <cmath>
#include <string>
#include <vector>

using namespace nurbs;
using samples::RandomVector;

namespace
{

constexpr double Gap = 1e-5;

NurbsSurface Moved(const NurbsSurface& face, double by)
{
  return samples::Transformed(face, Eigen::Matrix3d::Identity(), Vec3(0.3, 0.2, 1) * by);
}

/// The sides of places are those of the faces without the last one, which is there twice.
void TestSides(const std::string& name, const std::vector<NurbsSurface>& faces, double by)
{
  const TrimmingSurface once({ faces.begin(), faces.end() - 1 }, Gap);
  const TrimmingSurface twice(faces, Gap);
  const int places = check::Trials(2000);
  int told = 0, wrong = 0;
  for (int k = 0; k < places; ++k)
  {
    const Vec3 p = 0.5 * Vec3::Ones() + 0.6 * RandomVector();
    const Foot foot = once.ClosestPoint(p);
    if (foot.Kind == FootKind::Interior && foot.Distance > 10 * by)
    {
      ++told;
      const double distance = twice.ClosestPoint(p).SignedDistance;
      wrong += !(std::abs(distance - foot.SignedDistance) <= 2 * by + 1e-11);
    }
  }
  check::That(told > places / 4, name + ": only " + std::to_string(told) + " places have a side");
  check::That(
    wrong == 0, name + ": " + std::to_string(wrong) + " of " + std::to_string(told) + " wrong");
}

}

int main()
{
  for (const double by : { 0.0, 1e-12, 1e-10, 1e-8, 1e-6 })
  {
    for (const bool reversed : { false, true })
    {
      const auto add = [&](std::vector<NurbsSurface> faces, std::size_t face)
      {
        const NurbsSurface other = reversed ? samples::ReversedU(faces[face]) : faces[face];
        faces.push_back(Moved(other, by));
        return faces;
      };
      const std::string name =
        "by " + std::to_string(1e6 * by) + "e-6" + (reversed ? ", turned" : "");
      TestSides("a wavy face " + name, add({ samples::Wavy() }, 0), by);
      TestSides("a creased face " + name, add({ samples::Creased() }, 0), by);
      TestSides("a face of a box " + name,
        add(samples::BoxShell(Vec3(0.2, 0.2, 0.2), Vec3(0.8, 0.7, 0.6)), 3), by);
    }
  }
  return check::Result();
}
