/**
 * @file TestTrimSequence.cxx
 * @brief Fig. 9: one trim outside, then holes, each on the result of the one before; and the same
 * trim again, which finds nothing to do.
 */
#include "RunTrim.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <cstdio>

using namespace judge;

namespace
{
struct Step
{
  const char* Kind;
  double X, Y, Size, Lean;
  bool Hole;
};

int RunSequence(const char* meshName, int correction, int optimization)
{
  static const Step steps[] = {
    { "roundrect", 0.02, 0.03, 0.68, 0, false }, { "cylinder", -0.35, 0.1, 0.22, 0, true },
    { "contour", 0.3, -0.1, 0.25, 0, true },
    { "plane", 0.05, -0.5, 0, 0.2, false },   // across the border that the first left
    { "cylinder", 0.7, 0.6, 0.3, 0.1, true }, // a bite out of a border
  };
  Mesh mesh = MakeMesh(meshName);
  const Frame frame = mesh.Box;
  int failures = 0, number = 0;
  for (const Step& step : steps)
  {
    Placement at;
    at.X = step.X;
    at.Y = step.Y;
    at.Size = step.Size;
    at.Lean = step.Lean;
    at.Angle = std::string(step.Kind) == "plane" ? -1.45 : 0.1;
    at.Seed = 5;
    const Surface surface = MakeSurface(step.Kind, frame, at);
    TrimOptions options;
    options.CorrectionType = correction;
    options.Optimization = optimization;
    options.InvertSide = step.Hole;
    Report report(std::string("sequence ") + meshName + " " + std::to_string(correction) + " " +
      std::to_string(optimization) + " step " + std::to_string(++number) + " " + step.Kind);
    const Outcome outcome = RunAndJudge(mesh, surface, options, report);
    failures += report.Failures();
    mesh.Grid = outcome.Case.Trimmed;
    if (mesh.Grid->GetNumberOfCells() == 0)
    {
      std::printf("FAIL sequence: nothing left after step %d\n", number);
      return failures + 1;
    }
  }
  return failures;
}

/// Calls action(kind, surface) for one of each kind that cuts the mesh.
template <typename Action>
void ForSurfaces(const Mesh& mesh, const Action& action)
{
  for (const std::string& kind : AllSurfaceKinds())
  {
    Placement at;
    at.Size = 0.6;
    action(kind, MakeSurface(kind, mesh.Box, at));
  }
}

// Where the first trim had nothing to tell: all its nodes are on the surface, as the mesh stores
// their places.
int TrimAgain(const char* meshName)
{
  const Mesh mesh = MakeMesh(meshName);
  int failures = 0, compared = 0;
  ForSurfaces(mesh,
    [&](const std::string& kind, const Surface& surface)
    {
      const Outcome first = RunTrim(mesh, surface, TrimOptions());
      if (!first.Clean() || !first.Warnings.empty())
      {
        return;
      }
      ++compared;
      Mesh trimmed = mesh;
      trimmed.Grid = first.Case.Trimmed;
      const Outcome again = RunTrim(trimmed, surface, TrimOptions());
      const auto number = [&again](const char* name) { return Number(again.Case.Trimmed, name); };
      const bool onlyTouches = again.Warnings.size() == 1 &&
        again.Warnings[0].find("touches the grid, but does not part it") != std::string::npos;
      if (!again.Clean() || !onlyTouches || number("Eliminated") > 0 || number("MovedNodes") > 0)
      {
        std::printf("FAIL %s by %s again: %g elements eliminated, %g nodes moved, %zu warnings\n",
          meshName, kind.c_str(), number("Eliminated"), number("MovedNodes"),
          again.Warnings.size());
        ++failures;
      }
    });
  if (compared < 5)
  {
    std::printf("FAIL %s again: compared in %d trims only\n", meshName, compared);
    ++failures;
  }
  return failures;
}

/// The whole mesh with its nodes where kept part and offcut have them.
vtkSmartPointer<vtkUnstructuredGrid> Conformed(const Mesh& mesh, const Outcome& outcome)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->DeepCopy(mesh.Grid);
  for (vtkUnstructuredGrid* part : { outcome.Offcut.Get(), outcome.Case.Trimmed.Get() })
  {
    vtkDataArray* ids = part->GetPointData()->GetArray("vtkOriginalPointIds");
    for (vtkIdType p = 0; p < part->GetNumberOfPoints(); ++p)
    {
      grid->GetPoints()->SetPoint(
        static_cast<vtkIdType>(ids->GetComponent(p, 0)), part->GetPoint(p));
    }
  }
  return grid;
}

// Where all nodes are where they go, those that are distributed among them, none is touched.
int TrimConformed(const char* meshName)
{
  const Mesh mesh = MakeMesh(meshName);
  int failures = 0, compared = 0;
  ForSurfaces(mesh,
    [&](const std::string& kind, const Surface& surface)
    {
      TrimOptions options;
      options.Optimization = 1;
      options.ProduceOffcut = true;
      Mesh conformed = mesh;
      conformed.Grid = Conformed(mesh, RunTrim(mesh, surface, options));
      const Outcome again = RunTrim(conformed, surface, options);
      if (Number(again.Case.Trimmed, "MovedNodes") > 0)
      {
        return;
      }
      ++compared;
      const double touched = Number(again.Case.Trimmed, "TouchedElements");
      if (touched > 0)
      {
        std::printf("FAIL %s by %s conformed: %g elements touched though no node moved\n", meshName,
          kind.c_str(), touched);
        ++failures;
      }
    });
  if (compared < 5)
  {
    std::printf("FAIL %s conformed: compared in %d trims only\n", meshName, compared);
    ++failures;
  }
  return failures;
}
}

int main()
{
  int failures = 0;
  for (const char* mesh : { "sheet1", "sheet2" })
  {
    for (int correction = 1; correction <= 3; ++correction)
    {
      for (int optimization = 0; optimization <= (correction == 1 ? 0 : 2); ++optimization)
      {
        failures += RunSequence(mesh, correction, optimization);
      }
    }
  }
  failures += RunSequence("wedges", 2, 2);
  failures += RunSequence("irregular", 2, 1);
  for (const char* mesh : { "sheet2", "float", "far" })
  {
    failures += TrimAgain(mesh);
  }
  failures += TrimConformed("float");
  std::printf("%d failures\n", failures);
  return failures > 0;
}
