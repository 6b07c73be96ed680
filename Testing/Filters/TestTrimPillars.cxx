/**
 * @file TestTrimPillars.cxx
 * @brief Layers of a sheet that is cut straight through come out alike: the nodes of a pillar stay
 * above each other, also where they were moved for the quality of the elements.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

using namespace judge;

namespace
{

/// How far the nodes of each pillar that was moved are from each other along the sheet, by what
/// share of pillars that is more than `limit`.
struct Bends
{
  int Moved = 0, Bent = 0;
  double Largest = 0.0;
};

void AddBends(const Mesh& sheet, vtkUnstructuredGrid* trimmed, double limit, Bends& bends)
{
  vtkDataArray* const ids = trimmed->GetPointData()->GetArray("vtkOriginalPointIds");
  struct Pillar
  {
    Vec3 First;
    bool Moved = false;
    double Bend = 0.0;
  };
  std::map<std::pair<long, long>, Pillar> pillars;
  for (vtkIdType i = 0; i < trimmed->GetNumberOfPoints(); ++i)
  {
    const Vec3 now(trimmed->GetPoint(i));
    const Vec3 before(sheet.Grid->GetPoint(static_cast<vtkIdType>(ids->GetComponent(i, 0))));
    const auto at = pillars.emplace(
      std::make_pair(std::lround(1e4 * before.x()), std::lround(1e4 * before.y())), Pillar{ now });
    Pillar& pillar = at.first->second;
    pillar.Moved |= now != before;
    pillar.Bend = std::max(pillar.Bend, (now - pillar.First).head<2>().norm());
  }
  for (const auto& [place, pillar] : pillars)
  {
    bends.Moved += pillar.Moved;
    bends.Bent += pillar.Bend > limit;
    bends.Largest = std::max(bends.Largest, pillar.Bend);
  }
}

/// A rectangle along the mesh: what is inside goes.
Surface Window(const Vec2& from, const Vec2& to)
{
  Surface surface;
  surface.Data =
    ToPolyData(Wall({ from, Vec2(to.x(), from.y()), to, Vec2(from.x(), to.y()), from }));
  return surface;
}

// The corners of a rectangle, where nodes behind the cut are moved most.
void CheckWindows(int layers, bool offcut)
{
  const Mesh sheet = Sheet(30, 20, layers, Vec3(1, 1, 0.29 / layers));
  // Bent a little: in a flat one all layers take the very same steps.
  MovePoints(sheet.Grid,
    [](const Vec3& p)
    { return Vec3(p + Vec3(0, 0, 0.003 * p.x() * p.x() - 0.002 * p.y() * p.y())); });
  Bends kept;
  for (int k = 0; k < 50; ++k)
  {
    const Vec2 from(2.0 + 0.1 * (k % 10), 2.0 + 0.2 * (k / 10));
    TrimOptions options;
    options.InvertSide = k % 3 != 0;
    options.CorrectionType = 2 + k % 2;
    options.ProduceOffcut = offcut;
    const Outcome outcome = RunTrim(sheet, Window(from, Vec2(30, 20) - from), options);
    Expect(outcome.Clean(), "a rectangle does not trim");
    AddBends(sheet, outcome.Case.Trimmed, 0.05, kept);
  }
  std::printf("%d layers%s: %d pillars moved, %d bent, by %.3f at the most\n", layers,
    offcut ? ", with an offcut" : "", kept.Moved, kept.Bent, kept.Largest);
  Expect(kept.Moved > 1000, "hardly a pillar moved");
  Expect(kept.Bent <= kept.Moved / 1000, "pillars are bent");
}

}

int main()
{
  for (const int layers : { 1, 2, 3 })
  {
    CheckWindows(layers, false);
  }
  CheckWindows(2, true);
  return Wrong != 0;
}
