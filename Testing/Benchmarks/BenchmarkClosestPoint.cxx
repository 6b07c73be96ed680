// The closest point: the kernel against the paper's Newton, OpenCASCADE and SISL on the same
// points. An answer is wrong if brute force knows a point that is nearer by 1e-8 of the size of the
// surface. Times in microseconds a point.
#include "BruteForce.h"
#include "OpenCascadeSurface.h"
#include "PlainNewton.h"
#include "Points.h"
#include "SampleSurfaces.h"
#include "SislSurface.h"
#include "Timing.h"
#include "TrimmingSurface.h"

#include <GeomAPI_ProjectPointOnSurf.hxx>

#include <cstdio>
#include <thread>

using namespace nurbs;
using namespace benchmark;

namespace
{

constexpr int Many = 20000, Some = 2000, Few = 300;
constexpr double Element = 0.01; ///< near the surface is within this of it

class Race
{
public:
  Race(const char* name, const NurbsSurface& surface, const std::vector<NearPoint>& points)
    : Name(name)
    , Surface(surface)
    , Ours({ surface }, 1e-9)
    , Plain(surface)
    , Sisl(MakeSislSurface(surface))
  {
    for (const NearPoint& point : points)
    {
      this->Points.push_back(point.Point);
    }
    this->OpenCascade.Init(
      occ::Convert(surface), surface.FirstU(), surface.LastU(), surface.FirstV(), surface.LastV());
  }

  void Run()
  {
    const auto ours = [this](const Vec3& p) { return this->Ours.ClosestPoint(p).Distance; };
    const auto plain = [this](const Vec3& p) { return this->Plain.Project(p).Distance; };
    const auto other = [this](const Vec3& p) { return this->ByOpenCascade(p); };
    const auto sisl = [this](const Vec3& p) { return this->BySisl(p); };
    std::vector<Contestant> contestants;
    this->Enter(contestants, Many, ours);
    this->Enter(contestants, Some, plain);
    this->Enter(contestants, Few, other);
    this->Enter(contestants, Some, sisl);
    TakeTurns(contestants, 5);
    const double time = contestants[0].Best;
    std::printf("%-36s %6.2f %5d", this->Name, time, this->CountWrong(ours, Some));
    std::printf("  | %6.2f %5d %5.2f", contestants[1].Best, this->CountWrong(plain, Some),
      time / contestants[1].Best);
    std::printf("  | %7.1f %5d %6.3f", contestants[2].Best, this->CountWrong(other, Few),
      time / contestants[2].Best);
    std::printf("  | %6.1f %5d %6.3f\n", contestants[3].Best, this->CountWrong(sisl, Some),
      time / contestants[3].Best);
  }

private:
  template <typename Project>
  void Enter(std::vector<Contestant>& contestants, int count, Project project)
  {
    contestants.push_back({ "", count,
      [this, count, project]()
      {
        for (int k = 0; k < count; ++k)
        {
          this->Sum += project(this->Points[k]);
        }
      } });
  }

  double ByOpenCascade(const Vec3& p)
  {
    this->OpenCascade.Perform(gp_Pnt(p.x(), p.y(), p.z()));
    return this->OpenCascade.NbPoints() > 0 ? this->OpenCascade.LowerDistance() : HUGE_VAL;
  }

  double BySisl(const Vec3& p)
  {
    double point[3] = { p.x(), p.y(), p.z() }, parameters[2], distance = HUGE_VAL;
    int status;
    s1958(this->Sisl.get(), point, 3, 1e-10, 1e-9, parameters, &distance, &status);
    return status < 0 ? HUGE_VAL : distance;
  }

  template <typename Project>
  int CountWrong(Project project, int count)
  {
    if (this->Truth.empty())
    {
      const samples::BruteForce brute(this->Surface);
      for (int k = 0; k < Some; ++k)
      {
        this->Truth.push_back(brute.Distance(this->Points[k]));
      }
    }
    int wrong = 0;
    for (int k = 0; k < count; ++k)
    {
      wrong += !(project(this->Points[k]) <= this->Truth[k] + 1e-8);
    }
    return wrong;
  }

  const char* Name;
  const NurbsSurface Surface;
  const TrimmingSurface Ours;
  const PlainNewton Plain;
  const SislSurface Sisl;
  GeomAPI_ProjectPointOnSurf OpenCascade;
  std::vector<Vec3> Points;
  std::vector<double> Truth;
  double Sum = 0; ///< so that nothing is left out
};

void RaceAll()
{
  std::printf("%-36s %6s %5s  | %6s %5s %5s  | %7s %5s %6s  | %6s %5s %6s\n",
    "microseconds, wrong, ratio", "kernel", "wrong", "Newton", "wrong", "ratio", "OCCT", "wrong",
    "ratio", "SISL", "wrong", "ratio");
  const NurbsSurface wavy = samples::Wavy(8), cylinder = samples::Cylinder(1, 2);
  Race("wavy 8x8, near, random order", wavy, PointsNear(wavy, Many, Element, Order::Random)).Run();
  Race("wavy 8x8, near, mesh order", wavy, PointsNear(wavy, Many, Element, Order::Mesh)).Run();
  Race("wavy 8x8, all round", wavy, PointsAround(wavy, Many)).Run();
  Race("cylinder, near, random order", cylinder, PointsNear(cylinder, Many, Element, Order::Random))
    .Run();
  Race("cylinder, all round", cylinder, PointsAround(cylinder, Many)).Run();
}

/// Growth with the control points. The plain Newton is given its knot: looking for it grows too.
void RaceSizes()
{
  std::printf("\n%-20s %8s %8s %10s %10s %12s\n", "control points", "random", "mesh", "of 8x8",
    "of 8x8", "plain Newton");
  double random8 = 0, mesh8 = 0;
  for (int size : { 8, 16, 32, 64, 128, 256 })
  {
    const NurbsSurface surface = samples::Wavy(size);
    const TrimmingSurface ours({ surface }, 1e-9);
    const PlainNewton plain(surface);
    const auto random = PointsNear(surface, Many, Element, Order::Random);
    const auto mesh = PointsNear(surface, 10 * Many, Element, Order::Mesh);
    std::vector<Vec2> knots;
    for (int k = 0; k < Some; ++k)
    {
      knots.push_back(plain.NearestKnot(random[k].Point));
    }
    double sum = 0;
    const auto project = [&](const std::vector<NearPoint>& points)
    {
      for (const NearPoint& point : points)
      {
        sum += ours.ClosestPoint(point.Point).Distance;
      }
    };
    std::vector<Contestant> contestants = { { "random", Many, [&]() { project(random); } },
      { "mesh", 10 * Many, [&]() { project(mesh); } },
      { "plain Newton", Some,
        [&]()
        {
          for (int k = 0; k < Some; ++k)
          {
            sum += plain.Project(random[k].Point, knots[k]).Distance;
          }
        } } };
    TakeTurns(contestants, 7);
    random8 = size == 8 ? contestants[0].Best : random8;
    mesh8 = size == 8 ? contestants[1].Best : mesh8;
    std::printf("%3d x %-14d %8.2f %8.2f %10.2f %10.2f %12.2f%s\n", size, size, contestants[0].Best,
      contestants[1].Best, contestants[0].Best / random8, contestants[1].Best / mesh8,
      contestants[2].Best, sum > 0 ? "" : "!");
  }
}

/// An arched sheet of many faces of one Bezier patch each.
std::vector<NurbsSurface> SheetOfFaces(int countU, int countV)
{
  std::vector<NurbsSurface> faces;
  const NurbsSurface whole =
    samples::FromNet(3, 3, 4, 4, [](double u, double v) { return Vec4(u, v, 0, 1); });
  for (int j = 0; j < countV; ++j)
  {
    for (int i = 0; i < countU; ++i)
    {
      NurbsSurface face = whole;
      for (Vec4& point : face.ControlPoints)
      {
        const double x = (i + point.x()) / countU, y = (j + point.y()) / countV;
        // The net alone decides about an edge, so neighbours have the same.
        point = Vec4(x, y, 0.3 * x * (1 - x) + 0.2 * y * (1 - y), 1);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

void RaceShells()
{
  std::printf("\n%-20s %12s %12s %12s\n", "faces", "build, ms", "random", "mesh");
  const int counts[4][2] = { { 1, 1 }, { 5, 2 }, { 10, 10 }, { 40, 25 } };
  for (const auto& count : counts)
  {
    const std::vector<NurbsSurface> faces = SheetOfFaces(count[0], count[1]);
    const TrimmingSurface ours(faces, 1e-9);
    std::vector<NearPoint> mesh;
    for (const NurbsSurface& face : faces)
    {
      const int share = Many / static_cast<int>(faces.size());
      const auto near = PointsNear(face, share, Element, Order::Mesh);
      mesh.insert(mesh.end(), near.begin(), near.end());
    }
    std::vector<NearPoint> random = mesh;
    std::shuffle(random.begin(), random.end(), std::mt19937(5));
    double sum = 0;
    const auto project = [&](const std::vector<NearPoint>& points)
    {
      for (const NearPoint& point : points)
      {
        sum += ours.ClosestPoint(point.Point).Distance;
      }
    };
    std::vector<Contestant> contestants = {
      { "build", 1, [&]() { sum += TrimmingSurface(faces, 1e-9).NumberOfFaces(); } },
      { "random", Many, [&]() { project(random); } }, { "mesh", Many, [&]() { project(mesh); } }
    };
    TakeTurns(contestants, 5);
    std::printf("%-20d %12.1f %12.2f %12.2f%s\n", static_cast<int>(faces.size()),
      1e-3 * contestants[0].Best, contestants[1].Best, contestants[2].Best, sum > 0 ? "" : "!");
  }
}

void RaceThreads()
{
  const NurbsSurface surface = samples::Wavy(8);
  const TrimmingSurface ours({ surface }, 1e-9);
  const auto points = PointsNear(surface, 10 * Many, Element, Order::Mesh);
  std::vector<double> distances(points.size());
  const auto project = [&](std::size_t begin, std::size_t end)
  {
    for (std::size_t k = begin; k < end; ++k)
    {
      distances[k] = ours.ClosestPoint(points[k].Point).Distance;
    }
  };
  std::vector<Contestant> contestants = { { "one", 10 * Many, [&]() { project(0, points.size()); },
                                            true },
    { "two", 10 * Many,
      [&]()
      {
        std::thread other([&]() { project(0, points.size() / 2); });
        project(points.size() / 2, points.size());
        other.join();
      },
      true } };
  TakeTurns(contestants, 9);
  std::printf("\nwall time: one thread %.2f, two threads %.2f, %.2f times as fast\n",
    contestants[0].Best, contestants[1].Best, contestants[0].Best / contestants[1].Best);
}

}

int main()
{
  RaceAll();
  RaceSizes();
  RaceShells();
  RaceThreads();
}
