// Closest points near a surface: the kernel against the paper's Newton.
#include "PlainNewton.h"
#include "SampleSurfaces.h"
#include "Timing.h"
#include "TrimmingSurface.h"

#include <cstdio>
#include <random>

using namespace nurbs;

namespace
{

/// Points within the height of the surface, in no order.
std::vector<Vec3> PointsNear(const NurbsSurface& surface, int count, double height)
{
  std::mt19937 random(3);
  const auto draw = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k)
  {
    const double u = draw(surface.FirstU(), surface.LastU());
    const double v = draw(surface.FirstV(), surface.LastV());
    const SurfaceJet jet = EvaluateJet(surface, u, v);
    points.push_back(jet.S + draw(-height, height) * jet.Su.cross(jet.Sv).normalized());
  }
  return points;
}

}

int main()
{
  const int count = 20000;
  for (int size : { 8, 16, 32, 64, 128, 256 })
  {
    const NurbsSurface surface = samples::Wavy(size);
    const TrimmingSurface ours({ surface }, 1e-9);
    const benchmark::PlainNewton plain(surface);
    const std::vector<Vec3> points = PointsNear(surface, count, 0.01);
    std::vector<Vec2> knots;
    for (const Vec3& p : points)
    {
      knots.push_back(plain.NearestKnot(p));
    }
    double sum = 0;
    std::vector<benchmark::Contestant> contestants = { { "kernel",
                                                         [&]()
                                                         {
                                                           for (const Vec3& p : points)
                                                           {
                                                             sum += ours.ClosestPoint(p).Distance;
                                                           }
                                                         },
                                                         count },
      { "plain Newton, the nearest knot given",
        [&]()
        {
          for (int k = 0; k < count; ++k)
          {
            sum += plain.Project(points[k], knots[k]).Distance;
          }
        },
        count } };
    benchmark::TakeTurns(contestants, 5);
    std::printf("%d x %d control points: kernel %.2f us, plain Newton %.2f us, ratio %.2f (%g)\n",
      size, size, contestants[0].Microseconds(), contestants[1].Microseconds(),
      contestants[0].Best / contestants[1].Best, sum);
  }
}
