// Short edges across a surface, like those of the elements that it cuts: the kernel against
// OpenCASCADE and SISL. Each edge runs through a known place of the surface; an answer is wrong if
// none of its points is within 1e-7 of that place. Times in microseconds an edge.
#include "OpenCascadeSurface.h"
#include "Points.h"
#include "SampleSurfaces.h"
#include "SislSurface.h"
#include "Timing.h"
#include "TrimmingSurface.h"

#include <GeomAPI_IntCS.hxx>
#include <Geom_Line.hxx>
#include <gp_Lin.hxx>

#include <cstdio>
#include <cstdlib>

using namespace nurbs;
using namespace benchmark;

namespace
{

constexpr int Many = 20000, Few = 50;

class Race
{
public:
  Race(const char* name, const NurbsSurface& surface)
    : Name(name)
    , Surface(surface)
    , Ours({ surface }, 1e-9)
    , OpenCascade(occ::Convert(surface))
    , Sisl(MakeSislSurface(surface))
    , Edges(PointsNear(surface, Many, 0.01, Order::Random))
  {
  }

  void Run()
  {
    const auto ours = [this](const NearPoint& edge) { return this->ByKernel(edge); };
    const auto other = [this](const NearPoint& edge) { return this->ByOpenCascade(edge); };
    const auto sisl = [this](const NearPoint& edge) { return this->BySisl(edge); };
    std::vector<Contestant> contestants;
    this->Enter(contestants, Many, ours);
    this->Enter(contestants, Few, other);
    this->Enter(contestants, Few, sisl);
    TakeTurns(contestants, 2);
    std::printf("%-22s kernel %5.2f (%d of %d wrong), OpenCASCADE %7.1f (%d of %d), SISL %7.1f "
                "(%d of %d)\n",
      this->Name, contestants[0].Best, this->CountWrong(ours, Many), Many, contestants[1].Best,
      this->CountWrong(other, Few), Few, contestants[2].Best, this->CountWrong(sisl, Few), Few);
  }

private:
  template <typename Meet>
  void Enter(std::vector<Contestant>& contestants, int count, Meet meet)
  {
    contestants.push_back({ "", count,
      [this, count, meet]()
      {
        for (int k = 0; k < count; ++k)
        {
          this->Sum += meet(this->Edges[k]);
        }
      } });
  }

  template <typename Meet>
  int CountWrong(Meet meet, int count)
  {
    int wrong = 0;
    for (int k = 0; k < count; ++k)
    {
      wrong += !(meet(this->Edges[k]) <= 1e-7);
    }
    return wrong;
  }

  /// From the point as far beyond the surface as it is before it.
  static Vec3 OtherEnd(const NearPoint& edge) { return 2 * edge.Foot - edge.Point; }

  // Each: the distance of the nearest meeting from the known place.

  double ByKernel(const NearPoint& edge)
  {
    double best = HUGE_VAL;
    for (const LineHit& hit : this->Ours.Intersect(edge.Point, OtherEnd(edge)))
    {
      best = std::min(best, (hit.Point - edge.Foot).norm());
    }
    return best;
  }

  double ByOpenCascade(const NearPoint& edge)
  {
    const Vec3 d = edge.Foot - edge.Point;
    const Handle(Geom_Line) line = new Geom_Line(
      gp_Lin(gp_Pnt(edge.Point.x(), edge.Point.y(), edge.Point.z()), gp_Dir(d.x(), d.y(), d.z())));
    const GeomAPI_IntCS meetings(line, this->OpenCascade);
    double best = HUGE_VAL;
    for (int k = 1; meetings.IsDone() && k <= meetings.NbPoints(); ++k)
    {
      const gp_Pnt p = meetings.Point(k);
      best = std::min(best, (Vec3(p.X(), p.Y(), p.Z()) - edge.Foot).norm());
    }
    return best;
  }

  double BySisl(const NearPoint& edge)
  {
    const Vec3 d = (edge.Foot - edge.Point).normalized();
    double point[3] = { edge.Point.x(), edge.Point.y(), edge.Point.z() };
    double direction[3] = { d.x(), d.y(), d.z() }, *parameters = nullptr;
    int points = 0, curves = 0, status = 0;
    SISLIntcurve** ofCurves = nullptr;
    s1856(this->Sisl.get(), point, direction, 3, 1e-10, 1e-9, &points, &parameters, &curves,
      &ofCurves, &status);
    double best = HUGE_VAL;
    for (int k = 0; k < points; ++k)
    {
      const Vec3 p = Evaluate(this->Surface, parameters[2 * k], parameters[2 * k + 1]);
      best = std::min(best, (p - edge.Foot).norm());
    }
    std::free(parameters);
    if (ofCurves)
    {
      freeIntcrvlist(ofCurves, curves);
    }
    return best;
  }

  const char* Name;
  const NurbsSurface Surface;
  const TrimmingSurface Ours;
  const Handle(Geom_BSplineSurface) OpenCascade;
  const SislSurface Sisl;
  const std::vector<NearPoint> Edges;
  double Sum = 0; ///< so that nothing is left out
};

}

int main()
{
  std::printf("microseconds an edge; OpenCASCADE and SISL intersect the whole line\n");
  Race("wavy 8x8", samples::Wavy(8)).Run();
  Race("wavy 64x64", samples::Wavy(64)).Run();
  Race("cylinder", samples::Cylinder(1, 2)).Run();
}
