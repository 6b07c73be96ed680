/**
 * @file TestCornerShape.cxx
 * @brief The energy of a corner's shape: its derivatives, where it is least, and what stands for
 * determinants that are not positive.
 */
#include "CornerShape.h"
#include "Expect.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace judge;
using namespace trim;

namespace
{
Corner PerfectCorner(int count)
{
  return { { 0, 1, 2, 3 }, 0, ScaleOfCorner(Vec3(2, 3, 0.5), count) };
}

std::vector<Vec3> PlacesOf(int count)
{
  const Vec3 second = count == 6 ? Vec3(1.5, 3 * std::sqrt(0.75), 0) : Vec3(0, 3, 0);
  const Vec3 from(7, 8, 9);
  return { from, from + Vec3(2, 0, 0), from + second, from + Vec3(0, 0, 0.5) };
}

double EnergyAt(const Corner& corner, const std::vector<Vec3>& places, double epsilon)
{
  return CornerEnergy(corner, EdgesOf(corner, places), 0, 1.0)
    .After(Vec3::Zero(), PositiveDeterminant(epsilon));
}

/// The derivatives are those of the energy, wherever a node is, and so is the energy after a step.
void CheckDerivatives(int count, const Vec3& shift, double epsilon)
{
  constexpr double Step = 1e-4;
  const Corner corner = PerfectCorner(count);
  for (int node = 0; node < 4; ++node)
  {
    std::vector<Vec3> places = PlacesOf(count);
    places[2] += shift;
    const CornerEnergy energy(corner, EdgesOf(corner, places), node, 1.0);
    const PositiveDeterminant positive(epsilon);
    Derivatives at;
    energy.AddDerivatives(positive, at);
    const double scale = 1 + energy.After(Vec3::Zero(), positive);
    const auto after = [&](const Vec3& step)
    {
      std::vector<Vec3> moved = places;
      moved[node] += step;
      const double value = EnergyAt(corner, moved, epsilon);
      Expect(std::abs(value - energy.After(step, positive)) < 1e-9 * scale,
        "the energy after a step is that of the places there");
      return value;
    };
    for (int i = 0; i < 3; ++i)
    {
      const Vec3 u = Step * Vec3::Unit(i);
      Expect(std::abs((after(u) - after(-u)) / (2 * Step) - at.Gradient[i]) <
          1e-5 * (scale + at.Gradient.norm()),
        "the gradient is that of the energy");
      for (int j = 0; j < 3; ++j)
      {
        const Vec3 v = Step * Vec3::Unit(j);
        const double mixed =
          (after(u + v) - after(u - v) - after(v - u) + after(-u - v)) / (4 * Step * Step);
        Expect(std::abs(mixed - at.Hessian(i, j)) < 1e-3 * (scale + at.Hessian.norm()),
          "the second derivatives are those of the energy");
      }
    }
  }
}

/// A perfect corner, of whatever edges, has the least energy there is.
void CheckLeast(int count)
{
  const Corner corner = PerfectCorner(count);
  const double least = EnergyAt(corner, PlacesOf(count), 0);
  Expect(std::abs(least - std::pow(3.0, 1.5)) < 1e-12, "a perfect corner's energy");
  for (int i = 0; i < 12; ++i)
  {
    for (const double step : { -0.1, 0.1 })
    {
      std::vector<Vec3> places = PlacesOf(count);
      places[i / 3][i % 3] += step;
      Expect(EnergyAt(corner, places, 0) > least, "another corner has more");
    }
  }
}

/// Inverted corners have an energy that falls on the way out of it; without anything added to the
/// determinant it has no end.
void CheckInverted()
{
  const Corner corner = PerfectCorner(8);
  double last = std::numeric_limits<double>::infinity();
  for (const double height : { -1.0, -0.5, -0.1, 0.0, 0.1, 0.3, 0.5 })
  {
    std::vector<Vec3> places = PlacesOf(8);
    places[3] = places[0] + Vec3(0, 0, height);
    const double energy = EnergyAt(corner, places, 0.05);
    Expect(energy < last, "less inverted, but no less energy");
    last = energy;
    Expect(height > 0 || !(EnergyAt(corner, places, 0) < 1e300), "an end of the energy");
  }
  const PositiveDeterminant positive(0.05);
  Expect(
    std::abs(positive(0) - 0.025) < 1e-15 && positive(-1e6) > 0 && std::abs(positive(3) - 3) < 1e-3,
    "what stands for a determinant");
}
}

int main()
{
  for (const int count : { 8, 6 })
  {
    CheckLeast(count);
    CheckDerivatives(count, Vec3::Zero(), 0);
    CheckDerivatives(count, Vec3(0.4, -0.7, 0.3), 0);
    CheckDerivatives(count, Vec3(0.4, -0.7, 0.3), 0.1);
    CheckDerivatives(count, Vec3(0.4, -5, 0.1), 0.2);
  }
  CheckInverted();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
