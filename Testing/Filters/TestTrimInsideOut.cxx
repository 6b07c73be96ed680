/**
 * @file TestTrimInsideOut.cxx
 * @brief Elements with their nodes in the other order, as in mirrored meshes: trimmed as those in
 * the right one are, and in the right order in the result.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace judge;

namespace
{
const char* const Phrase = "hexahedra of the grid are inside out";

/// Gives some cells their nodes in the other order; returns how many hexahedra are among them.
int Turn(vtkUnstructuredGrid* grid, const std::function<bool(vtkIdType)>& isTurned)
{
  int hexahedra = 0;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    if (!isTurned(c))
    {
      continue;
    }
    grid->GetCellPoints(c, nodes);
    const vtkIdType half = nodes->GetNumberOfIds() / 2;
    std::swap_ranges(nodes->GetPointer(0), nodes->GetPointer(half), nodes->GetPointer(half));
    grid->GetCells()->ReplaceCellAtId(c, nodes);
    hexahedra += half == 4;
  }
  grid->GetCells()->Modified();
  grid->Modified();
  return hexahedra;
}

/// The volume of the summary is a sum of such as are rounded in another way where nodes have
/// another order.
void TakeVolume(vtkUnstructuredGrid* grid, double& volume)
{
  vtkDataArray* array = grid->GetFieldData()->GetArray("Volume");
  volume = array->GetComponent(0, 0);
  array->SetComponent(0, 0, 0.0);
}

void ExpectSame(const std::string& name, vtkUnstructuredGrid* upright, vtkUnstructuredGrid* turned)
{
  double before = 0.0, after = 0.0;
  TakeVolume(upright, before);
  TakeVolume(turned, after);
  Expect(std::abs(after - before) <= 1e-12 * before, name + ": volume");
  const std::string difference = FirstDifference(upright, turned);
  Expect(difference.empty(), name + ": " + difference);
}

// The same mesh in both orders gives the same, told of once.
void TestOrder(Mesh mesh, const TrimOptions& options, const std::string& surface,
  const std::string& which, const std::function<bool(vtkIdType)>& isTurned)
{
  const std::string what = mesh.Name + " by " + surface + ", " + which;
  const Surface cut = MakeSurface(surface, mesh.Box, Placement());
  Outcome upright = RunTrim(mesh, cut, options);
  const int count = Turn(mesh.Grid, isTurned);
  Outcome turned = RunTrim(mesh, cut, options);
  Expect(count > 20 && turned.Clean() && CountWarned(turned, Phrase) == count &&
      turned.Warnings.size() == upright.Warnings.size() + 1,
    what + ": the warning");
  ExpectSame(what, upright.Case.Trimmed, turned.Case.Trimmed);
  if (options.ProduceOffcut)
  {
    ExpectSame(what + ", offcut", upright.Offcut, turned.Offcut);
  }
  vtkNew<vtkIdList> before, after;
  for (vtkIdType c = 0; c < mesh.Grid->GetNumberOfCells(); ++c)
  {
    mesh.Grid->GetCellPoints(c, before);
    turned.Case.Whole->GetCellPoints(c, after);
    if (!std::equal(before->begin(), before->end(), after->begin(), after->end()))
    {
      Expect(false, what + ": port 1 is not the mesh as it came");
      break;
    }
  }
}

// What Transform makes of a part, half of which was there before, too.
void TestMirrored(const std::string& name, const std::string& surface)
{
  Mesh mesh = MakeMesh(name);
  MovePoints(mesh.Grid, [](const Vec3& p) { return Vec3(p[0], p[1], -p[2]); });
  mesh.Box.Centre[2] *= -1.0;
  const Outcome outcome = RunTrim(mesh, MakeSurface(surface, mesh.Box, Placement()), TrimOptions());
  vtkUnstructuredGrid* trimmed = outcome.Case.Trimmed;
  const auto number = [&](const char* entry) { return Number(trimmed, entry); };
  Expect(number("TouchedElements") > 20 && number("CertifiedElements") == number("TouchedElements"),
    name + ", mirrored: certified elements");
  for (vtkIdType c = 0; c < trimmed->GetNumberOfCells(); ++c)
  {
    if (trimmed->GetCellType(c) == VTK_HEXAHEDRON &&
      !(vtkMeshQuality::HexScaledJacobian(trimmed->GetCell(c)) > 0.0))
    {
      Expect(false, name + ", mirrored: an element is inside out");
      break;
    }
  }
}

// Elements without volume have no order that is the right one.
void TestFlat()
{
  Mesh mesh = MakeMesh("sheet2");
  MovePoints(mesh.Grid, [](const Vec3& p) { return Vec3(p[0], p[1], p[0] < 5.5 ? 0.0 : -p[2]); });
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, Placement()), TrimOptions());
  Expect(CountWarned(outcome, Phrase) == 15 * 16 * 2, "flat elements are told as turned");
}

// A few are defects of the mesh, and stay as they came.
void TestFew()
{
  Mesh mesh = MakeMesh("sheet2");
  Turn(mesh.Grid, [](vtkIdType c) { return c % 25 == 0; });
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, Placement()), TrimOptions());
  Expect(CountWarned(outcome, Phrase) == 0, "a few elements are told as turned");
  vtkUnstructuredGrid* trimmed = outcome.Case.Trimmed;
  vtkDataArray* ids = trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  vtkDataArray* status = trimmed->GetCellData()->GetArray("ElementStatus");
  int few = 0, turned = 0;
  for (vtkIdType c = 0; c < trimmed->GetNumberOfCells(); ++c)
  {
    const auto id = static_cast<vtkIdType>(ids->GetComponent(c, 0));
    if (id % 25 == 0 && status->GetComponent(c, 0) == 0.0)
    {
      ++few;
      turned += vtkMeshQuality::HexScaledJacobian(trimmed->GetCell(c)) > 0.0;
    }
  }
  Expect(few > 5 && turned == 0, "a few elements are turned");
}

// Elements that are no better in the other order stay as they came, and are not counted.
void TestFolded()
{
  Mesh mesh = MakeMesh("sheet2");
  vtkNew<vtkIdList> nodes;
  mesh.Grid->GetCellPoints(0, nodes);
  const Vec3 away(mesh.Grid->GetPoint(nodes->GetId(0)));
  const Vec3 size = Vec3(mesh.Grid->GetPoint(nodes->GetId(6))) - away;
  // One corner far beyond the opposite one: the volume is below zero, but other corners are sound.
  MovePoints(mesh.Grid,
    [&](const Vec3& p) { return p == away ? Vec3(p + Vec3(0.0, 0.0, 40.0 * size[2])) : p; });
  const int count = Turn(mesh.Grid, [](vtkIdType c) { return c % 2 == 1; });
  Placement at;
  at.X = 0.4;
  const Outcome outcome = RunTrim(mesh, MakeSurface("plane", mesh.Box, at), TrimOptions());
  vtkUnstructuredGrid* trimmed = outcome.Case.Trimmed;
  vtkDataArray* ids = trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  int found = 0;
  for (vtkIdType c = 0; c < trimmed->GetNumberOfCells(); ++c)
  {
    if (ids->GetComponent(c, 0) == 0.0)
    {
      ++found;
      Expect(Vec3(trimmed->GetCell(c)->GetPoints()->GetPoint(0)) ==
          Vec3(mesh.Grid->GetPoint(nodes->GetId(0))),
        "a folded element was turned");
    }
  }
  Expect(found == 1 && CountWarned(outcome, Phrase) == count, "a folded element is told as turned");
}

}

int main()
{
  const auto all = [](vtkIdType) { return true; };
  const auto some = [](vtkIdType c) { return (7 * c * c + c) % 5 < 2; };
  TrimOptions plain, whole, layer, distribute;
  whole.ProduceOffcut = true;
  whole.RenumberNodes = true;
  whole.MapValues = true;
  layer.InsertLayer = true;
  distribute.CorrectionType = 3;
  for (const auto& [which, isTurned] :
    { std::pair<std::string, std::function<bool(vtkIdType)>>("all turned", all),
      { "some turned", some } })
  {
    TestOrder(Sheet(32, 16, 1, Vec3(1.0, 1.0, 0.4)), whole, "plane", which, isTurned); // rows alone
    TestOrder(MakeMesh("sheet2"), whole, "wavy", which, isTurned);
    TestOrder(MakeMesh("permuted"), plain, "cylinder", which, isTurned);
    TestOrder(MakeMesh("short"), distribute, "plane", which, isTurned);
    TestOrder(MakeMesh("float"), whole, "plane", which, isTurned);
    TestOrder(MakeMesh("wedges"), plain, "wavy", which, isTurned);
    TestOrder(MakeMesh("irregular"), whole, "wavy", which, isTurned);
    TestOrder(MakeMesh("cup"), plain, "plane", which, isTurned);
    TestOrder(MakeMesh("block"), whole, "wavy", which, isTurned);
    TestOrder(MakeMesh("block"), layer, "wavy", which, isTurned);
  }
  TestMirrored("sheet2", "wavy");
  TestMirrored("cup", "plane");
  TestMirrored("block", "plane");
  TestFlat();
  TestFew();
  TestFolded();
  std::printf("%s\n", Wrong == 0 ? "all as expected" : "some wrong");
  return Wrong == 0 ? 0 : 1;
}
