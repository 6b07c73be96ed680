/**
 * @file TestTrimArrays.cxx
 * @brief What the filter does with the input's arrays and with the input itself.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <cstdio>

using namespace judge;

namespace
{
void TestInputUntouched(const Mesh& mesh, const Surface& surface)
{
  vtkNew<vtkUnstructuredGrid> before;
  before->DeepCopy(mesh.Grid);
  const vtkMTimeType time = mesh.Grid->GetMTime();
  for (int correction = 1; correction <= 3; ++correction)
  {
    TrimOptions options;
    options.CorrectionType = correction;
    RunTrim(mesh, surface, options);
    const std::string difference = FirstDifference(before, mesh.Grid);
    Expect(difference.empty(), mesh.Name + ": the input has changed: " + difference);
    Expect(mesh.Grid->GetMTime() == time, mesh.Name + ": the input says it has changed");
  }
}

// Arrays without attributes, names of the filter's own, ghosts, no arrays at all.
void TestUnusual(Mesh mesh, const Surface& surface)
{
  Report report("arrays unusual");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkFloatArray> own;
  own->SetName("NodeStatus");
  own->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < mesh.Grid->GetNumberOfPoints(); ++i)
  {
    ghosts->InsertNextValue(0);
    own->InsertNextTuple2(7, 8);
  }
  mesh.Grid->GetPointData()->AddArray(ghosts);
  mesh.Grid->GetPointData()->AddArray(own);
  RunAndJudge(mesh, surface, TrimOptions(), report);

  mesh.Grid->GetPointData()->Initialize();
  mesh.Grid->GetCellData()->Initialize();
  mesh.Grid->GetFieldData()->Initialize();
  const Outcome bare = RunAndJudge(mesh, surface, TrimOptions(), report);
  Expect(bare.Case.Trimmed->GetPointData()->GetNumberOfArrays() >= 5, "arrays: some are missing");
  Wrong += report.Failures();
}

// Tuples follow their elements whatever the numbering: with and without renumbering.
void TestNumberings(const Mesh& mesh, const Surface& surface)
{
  for (const bool renumber : { false, true })
  {
    TrimOptions options;
    options.RenumberNodes = renumber;
    Report report("arrays " + mesh.Name + (renumber ? " renumbered" : ""));
    RunAndJudge(mesh, surface, options, report);
    Wrong += report.Failures();
  }
}
}

int main()
{
  for (const char* name : { "sheet2", "permuted", "float", "short", "wedges" })
  {
    const Mesh mesh = MakeMesh(name);
    const Surface surface = MakeSurface("contour", mesh.Box, Placement());
    TestInputUntouched(mesh, surface);
    TestNumberings(mesh, surface);
  }
  const Mesh mesh = MakeMesh("sheet2");
  TestUnusual(mesh, MakeSurface("scurve", mesh.Box, Placement()));
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
