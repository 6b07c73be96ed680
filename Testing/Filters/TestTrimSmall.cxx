/**
 * @file TestTrimSmall.cxx
 * @brief Trims of which paper tells what comes out: exact ids, statuses, positions and volumes.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

using namespace judge;

namespace
{
// The trim, judged by everything, and its original cell ids.
struct Small
{
  Small(const std::string& name, const Mesh& mesh, const Surface& surface, TrimOptions options)
    : Name(name)
    , Input(mesh)
  {
    options.RenumberNodes = false;
    Report report(name);
    this->Result = RunAndJudge(mesh, surface, options, report);
    Wrong += report.Failures();
    vtkDataArray* ids = this->Result.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
    for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
    {
      this->Cells.insert(static_cast<Id>(ids->GetComponent(i, 0)));
    }
  }

  void ExpectCells(const std::set<Id>& cells) const
  {
    Expect(this->Cells == cells, this->Name + ": other elements kept than expected");
  }

  // The input's node at `from` (x, y; all layers) is now at `to`.
  void ExpectMove(const Vec2& from, const Vec2& to, double limit = 1e-12) const
  {
    vtkUnstructuredGrid* out = this->Result.Case.Trimmed;
    vtkDataArray* ids = out->GetPointData()->GetArray("vtkOriginalPointIds");
    int seen = 0;
    for (vtkIdType i = 0; ids && i < ids->GetNumberOfTuples(); ++i)
    {
      const auto o = static_cast<vtkIdType>(ids->GetComponent(i, 0));
      const Vec3 was(this->Input.Grid->GetPoint(o)), is(out->GetPoint(i));
      if ((was.head<2>() - from).norm() > 1e-12)
      {
        continue;
      }
      ++seen;
      const double off = (is - Vec3(to[0], to[1], was[2])).norm();
      Expect(off <= limit,
        this->Name + ": node at " + std::to_string(from[0]) + " " + std::to_string(from[1]) +
          " is now at " + std::to_string(is[0]) + " " + std::to_string(is[1]) + ", not " +
          std::to_string(to[0]) + " " + std::to_string(to[1]) + ": off by " +
          std::to_string(1e12 * off) + "e-12");
    }
    Expect(seen > 0, this->Name + ": a node is gone");
  }

  void ExpectArray(bool cells, const char* name, const std::vector<double>& values) const
  {
    vtkUnstructuredGrid* whole = this->Result.Case.Whole;
    vtkDataArray* array =
      cells ? whole->GetCellData()->GetArray(name) : whole->GetPointData()->GetArray(name);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const double value = array && static_cast<vtkIdType>(i) < array->GetNumberOfTuples()
        ? array->GetComponent(i, 0)
        : std::nan("");
      Expect(std::abs(value - values[i]) <= 1e-6,
        this->Name + ": " + name + " at " + std::to_string(i) + " is " + std::to_string(value) +
          ", not " + std::to_string(values[i]));
    }
  }

  std::string Name;
  const Mesh& Input;
  Outcome Result;
  std::set<Id> Cells;
};

TrimOptions With(int correction, int optimization, bool invert = false)
{
  TrimOptions options;
  options.CorrectionType = correction;
  options.Optimization = optimization;
  options.InvertSide = invert;
  return options;
}

// Four elements in a row, cut across.
void TestRow()
{
  const Mesh row = Sheet(4, 1, 1, Vec3(1, 1, 1));
  const Surface at14 = PlaneThrough(Vec3(1.4, 0, 0), Vec3::UnitX(), 50);
  const Surface at16 = PlaneThrough(Vec3(1.6, 0, 0), Vec3::UnitX(), 50);
  const Surface at20 = PlaneThrough(Vec3(2, 0, 0), Vec3::UnitX(), 50);
  for (int type : { 2, 3 })
  {
    const std::string name = "row type " + std::to_string(type);
    Small out(name + " pulled out", row, at14, With(type, 2));
    out.ExpectCells({ 0 });
    out.ExpectMove(Vec2(1, 0), Vec2(1.4, 0));
    out.ExpectMove(Vec2(1, 1), Vec2(1.4, 1));
    out.ExpectMove(Vec2(0, 0), Vec2(0, 0), 0);
    out.ExpectArray(true, "ElementStatus", { 0, 2, 1, 1 });
    out.ExpectArray(true, "EliminatedFraction", { 0, 0.6, 1, 1 });
    out.ExpectArray(false, "NodeStatus", { 0, 0, 1, 1, 1, 0, 0, 1, 1, 1 });
    Small in(name + " pulled in", row, at16, With(type, 2));
    in.ExpectCells({ 0, 1 });
    in.ExpectMove(Vec2(2, 0), Vec2(1.6, 0));
    Small inverted(name + " inverted", row, at16, With(type, 2, true));
    inverted.ExpectCells({ 2, 3 });
    inverted.ExpectMove(Vec2(2, 1), Vec2(1.6, 1));
    inverted.ExpectArray(true, "EliminatedFraction", { 1, 0.6, 0, 0 });
    Small on(name + " on the nodes", row, at20, With(type, 2));
    on.ExpectCells({ 0, 1 });
    on.ExpectMove(Vec2(2, 0), Vec2(2, 0), 0);
    on.ExpectArray(false, "NodeStatus", { 0, 0, 2, 1, 1, 0, 0, 2, 1, 1 });
    on.ExpectArray(true, "ElementStatus", { 0, 0, 1, 1 });
  }
  Small one("row type 1", row, at16, With(1, 2));
  one.ExpectCells({ 0, 1 });
  one.ExpectMove(Vec2(2, 0), Vec2(2, 0), 0);

  TrimOptions strict = With(2, 2);
  strict.EliminationFraction = 0.3;
  Small third("row with EliminationFraction 0.3", row, at16, strict);
  third.ExpectCells({ 0 });
  third.ExpectMove(Vec2(1, 0), Vec2(1.6, 0));

  TrimOptions point = With(2, 2);
  point.UseKeepPoint = true;
  point.KeepPoint = Vec3(3.5, 0.5, 0);
  Small far("row with KeepPoint", row, at16, point);
  far.ExpectCells({ 2, 3 });
  point.InvertSide = true;
  Small near("row with KeepPoint inverted", row, at16, point);
  near.ExpectCells({ 0, 1 });
}

// Strips cut lengthwise. One of a single element has none behind the side that is lost, so its
// volume decides; in a wider one those behind come out to the surface.
void TestStrip()
{
  const Mesh strip = Sheet(4, 1, 1, Vec3(1, 1, 0.4));
  for (int type : { 2, 3 })
  {
    const std::string name = "strip type " + std::to_string(type);
    const Surface at07 = PlaneThrough(Vec3(0, 0.7, 0), Vec3::UnitY(), 50);
    Small most(name + " mostly kept", strip, at07, With(type, 2));
    most.ExpectCells({ 0, 1, 2, 3 });
    for (int x = 0; x <= 4; ++x)
    {
      most.ExpectMove(Vec2(x, 1), Vec2(x, 0.7));
      most.ExpectMove(Vec2(x, 0), Vec2(x, 0), 0);
    }
    const Surface leaning = PlaneThrough(Vec3(0, 0.8, 0), Vec3(0.05, 1, 0), 50);
    Small slope(name + " cut aslant", strip, leaning, With(type, 2));
    slope.ExpectCells({ 0, 1, 2, 3 });
    slope.ExpectMove(Vec2(0, 1), Vec2(0, 0.8));
    slope.ExpectMove(Vec2(4, 1), Vec2(4, 0.6));
    Small none(name + " mostly lost", strip, PlaneThrough(Vec3(0, 0.3, 0), Vec3::UnitY(), 50),
      With(type, 2));
    none.ExpectCells({});
    const Mesh wide = Sheet(4, 2, 1, Vec3(1, 1, 0.4));
    Small two(
      name + " of two rows", wide, PlaneThrough(Vec3(0, 1.7, 0), Vec3::UnitY(), 50), With(type, 2));
    two.ExpectCells({ 0, 1, 2, 3 });
    two.ExpectMove(Vec2(2, 1), Vec2(2, 1.7));
  }
  const Mesh bar = Sheet(1, 1, 6, Vec3(1, 1, 1));
  Small along(
    "bar cut lengthwise", bar, PlaneThrough(Vec3(0.7, 0, 0), Vec3::UnitX(), 50), With(2, 2));
  along.ExpectCells({ 0, 1, 2, 3, 4, 5 });
  along.ExpectMove(Vec2(1, 0), Vec2(0.7, 0));
  along.ExpectMove(Vec2(1, 1), Vec2(0.7, 1));
}

// Fig. 7: a line of small slope, y = 1.3 + 0.1 x. In the second row the elements lose 65, 55, 45
// and 35 %: the last two stay, and the third shows two facets to the cut.
void TestPentahedron()
{
  const Mesh sheet = Sheet(4, 3, 1, Vec3(1, 1, 0.4));
  const Surface line = PlaneThrough(Vec3(0, 1.3, 0), Vec3(-0.1, 1, 0), 50);
  const std::set<Id> kept = { 0, 1, 2, 3, 6, 7 };
  const Vec2 n = Vec2(-0.1, 1) / 1.01;
  const Vec2 low = Vec2(2, 1) + 0.5 * n, high = Vec2(2, 2) - 0.5 * n;
  const Vec2 left = Vec2(1, 1) + 0.4 * n, right = Vec2(3, 2) - 0.4 * n;

  Small plain("pentahedron type 2 plain", sheet, line, With(2, 0));
  plain.ExpectCells(kept);
  plain.ExpectArray(true, "EliminatedFraction", { 0, 0, 0, 0, 0.65, 0.55, 0.45, 0.35, 1, 1, 1, 1 });
  plain.ExpectMove(Vec2(0, 1), Vec2(0, 1.3)); // on the border along the ridge
  plain.ExpectMove(Vec2(4, 2), Vec2(4, 1.7));
  plain.ExpectMove(Vec2(1, 1), left);
  plain.ExpectMove(Vec2(2, 1), low);
  plain.ExpectMove(Vec2(2, 2), high);
  plain.ExpectMove(Vec2(3, 2), right);
  plain.ExpectMove(Vec2(3, 1), Vec2(3, 1), 0);

  Small spread("pentahedron type 2 distributed", sheet, line, With(2, 1));
  spread.ExpectCells(kept);
  spread.ExpectMove(Vec2(2, 1), low);
  spread.ExpectMove(Vec2(2, 2), (low + right) / 2);

  Small wedge("pentahedron type 2 wedge", sheet, line, With(2, 2));
  wedge.ExpectCells(kept);
  wedge.ExpectMove(Vec2(2, 1), low);
  wedge.ExpectMove(Vec2(3, 2), right);
  Expect(wedge.Result.Case.Trimmed->GetNumberOfPoints() == 2 * 12,
    "pentahedron type 2 wedge: the node between the two facets is still there");

  Small spread3("pentahedron type 3 distributed", sheet, line, With(3, 1));
  spread3.ExpectCells(kept);
  spread3.ExpectMove(Vec2(0, 1), Vec2(0, 1.3));
  spread3.ExpectMove(Vec2(1, 1), Vec2(1, 1.4));
  spread3.ExpectMove(Vec2(2, 1), Vec2(2, 1.5));
  spread3.ExpectMove(Vec2(2, 2), Vec2(2.5, 1.55));
  spread3.ExpectMove(Vec2(3, 2), Vec2(3, 1.6));
  spread3.ExpectMove(Vec2(4, 2), Vec2(4, 1.7));

  Small wedge3("pentahedron type 3 wedge", sheet, line, With(3, 2));
  wedge3.ExpectCells(kept);
  wedge3.ExpectMove(Vec2(3, 2), Vec2(3, 1.6));
}

// Two layers under a leaning plane x = a + 0.5 z: the layers alone would fall differently.
void TestColumns()
{
  const Mesh sheet = Sheet(4, 4, 2, Vec3(1, 1, 0.2));
  const Surface goes = PlaneThrough(Vec3(1.48, 0, 0), Vec3(1, 0, -0.5), 50);
  const Surface stays = PlaneThrough(Vec3(1.52, 0, 0), Vec3(1, 0, -0.5), 50);
  Small a("columns 52 %", sheet, goes, With(2, 2));
  a.ExpectCells({ 0, 4, 8, 12, 16, 20, 24, 28 });
  a.ExpectArray(true, "EliminatedFraction", { 0, 0.57, 1, 1, 0, 0.57 });
  Small b("columns 48 %", sheet, stays, With(2, 2));
  b.ExpectCells({ 0, 1, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21, 24, 25, 28, 29 });
  b.ExpectArray(true, "EliminatedFraction", { 0, 0.53, 1, 1, 0, 0.53 });
  // Along the sheet only: on the skins by the skin, between the layers by their common facet.
  vtkUnstructuredGrid* out = b.Result.Case.Trimmed;
  int moved = 0;
  for (vtkIdType i = 0; i < out->GetNumberOfPoints(); ++i)
  {
    const Vec3 p(out->GetPoint(i));
    if (p[0] > 1.2)
    {
      ++moved;
      Expect(std::abs(p[0] - (1.52 + 0.5 * p[2])) < 1e-12 &&
          std::abs(p[2] * 5 - std::round(p[2] * 5)) < 1e-12 &&
          std::abs(p[1] - std::round(p[1])) < 1e-12,
        "columns 48 %: a node left its layer");
    }
  }
  Expect(moved == 15, "columns 48 %: fifteen nodes on the cut");
}

// A corner of the model that is cut off through the nodes beside it: what is left of its elements
// are wedges with these nodes, half as large, and nothing moves.
void TestCornerThroughNodes()
{
  const Mesh sheet = Sheet(6, 4, 2, Vec3(1, 1, 0.5));
  const Surface corner = PlaneThrough(Vec3(5, 4, 0), Vec3(1, 1, 0), 50);
  const Mesh cube = Sheet(1, 1, 1, Vec3(1, 1, 1));
  const Surface diagonal = PlaneThrough(Vec3(1, 0, 0), Vec3(1, 1, 0), 50);
  for (int type : { 2, 3 })
  {
    const std::string name = " through nodes, type " + std::to_string(type);
    for (const bool one : { true, false })
    {
      const Small cut((one ? "cube" : "corner of a sheet") + name, one ? cube : sheet,
        one ? diagonal : corner, With(type, 2));
      vtkUnstructuredGrid* out = cut.Result.Case.Trimmed;
      Expect(cut.Cells.size() == (one ? 1 : 48), cut.Name + ": an element is gone");
      Expect(Number(out, "Wedges") == (one ? 1 : 2), cut.Name + ": no wedge at the corner");
      Expect(Number(out, "MovedNodes") == 0, cut.Name + ": nodes moved");
      Expect(std::abs(Number(out, "Volume") - (one ? 0.5 : 23.5)) < 1e-12,
        cut.Name + ": another volume than the surface leaves");
      Expect(Rescues(out).empty(), cut.Name + ": " + Rescues(out));
    }
  }
}

// The plane x + 0.6 y + 0.3 z = 3.2 passes through the pillar at (2, 2): its nodes slide to both
// sides along one line of the mesh, and stay one line.
void TestSlideToBothSides()
{
  const Mesh sheet = Sheet(4, 4, 2, Vec3(1, 1, 0.5));
  const Surface plane = PlaneThrough(Vec3(2, 2, 0), Vec3(1, 0.6, 0.3), 50);
  const Small cut("pillar on both sides, type 3", sheet, plane, With(3, 2));
  vtkUnstructuredGrid* out = cut.Result.Case.Trimmed;
  vtkDataArray* ids = out->GetPointData()->GetArray("vtkOriginalPointIds");
  int seen = 0;
  for (vtkIdType i = 0; ids && i < out->GetNumberOfPoints(); ++i)
  {
    const Vec3 was(sheet.Grid->GetPoint(static_cast<vtkIdType>(ids->GetComponent(i, 0))));
    if ((was.head<2>() - Vec2(2, 2)).norm() > 1e-12)
    {
      continue;
    }
    ++seen;
    const Vec3 expected(2 - 0.3 * was.z(), 2, was.z());
    Expect((Vec3(out->GetPoint(i)) - expected).norm() < 1e-9,
      "pillar on both sides, type 3: its node in layer " + std::to_string(was.z()) +
        " left the line of the others");
  }
  Expect(seen == 3, "pillar on both sides, type 3: a node is gone");
}

// A chamfer of just 45 degrees keeps its edges: both sides of a cut make up the whole.
void TestChamfer()
{
  Mesh block = Sheet(10, 8, 8, Vec3(1, 1, 0.75));
  MovePoints(block.Grid,
    [](const Vec3& p)
    {
      const double rise = std::max(0.0, p.z() - 1.5), share = std::max(0.0, (p.y() - 3) / 5);
      return Vec3(p.x(), p.y() - rise * share, p.z());
    });
  const double whole = VolumeOf(Model(block.Grid));
  for (const Vec3& way : { Vec3(1, 0, 0.5), Vec3(1, 0.2, -0.5) })
  {
    const Vec3 normal = way.normalized();
    const Surface plane = PlaneThrough(Vec3(5, 4, 0) + 0.3 * normal, normal, 50);
    double both = 0;
    for (const bool invert : { false, true })
    {
      const Outcome outcome = RunTrim(block, plane, With(2, 2, invert));
      Expect(outcome.Clean(), "a chamfer: not trimmed");
      both += VolumeOf(Model(outcome.Case.Trimmed));
    }
    Expect(std::abs(both - whole) < 1e-6 * whole,
      "a chamfer: both sides of a cut have " + std::to_string(both) + " of " +
        std::to_string(whole));
  }
}
}

int main()
{
  TestRow();
  TestChamfer();
  TestStrip();
  TestPentahedron();
  TestColumns();
  TestCornerThroughNodes();
  TestSlideToBothSides();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
