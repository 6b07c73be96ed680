/**
 * @file TestTrimStretches.cxx
 * @brief What a cut becomes does not depend on what else is cut: parts of a mesh trimmed at once
 * are those trimmed one by one, to the bit.
 */
#include "Expect.h"
#include "Plan.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace judge;

namespace
{

/// A block of unit elements.
struct Part
{
  std::array<int, 3> Elements;
  Vec3 Origin;
};

void AddPart(const Part& part, RawMesh& raw)
{
  const auto [nx, ny, nz] = part.Elements;
  const double middle = 0.5 * nz;
  const RawMesh own = Extrude(GridPlan(nx, ny, 1, 1), nz, nz,
    [&](const Vec2& p, double z)
    { return Vec3(part.Origin + Vec3(p[0], p[1], std::round(z + middle))); });
  const Id first = static_cast<Id>(raw.Points.size());
  raw.Points.insert(raw.Points.end(), own.Points.begin(), own.Points.end());
  for (Element element : own.Elements)
  {
    for (Id& node : element.Node)
    {
      node += first;
    }
    raw.Elements.push_back(element);
  }
}

Mesh MakeMesh(const std::vector<Part>& parts)
{
  RawMesh raw;
  for (const Part& part : parts)
  {
    AddPart(part, raw);
  }
  MeshOptions options;
  options.Data = false;
  Mesh mesh = Finish("parts", raw, BoxOf(raw, 1.0), options);
  mesh.Sheet = false;
  return mesh;
}

/// The places of the nodes of each element, with what the arrays say of it, ascending.
using Elements = std::vector<std::vector<double>>;

void AddElements(vtkUnstructuredGrid* grid, Elements& elements)
{
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, nodes);
    std::vector<double> element;
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
    {
      const double* p = grid->GetPoint(nodes->GetId(i));
      element.insert(element.end(), p, p + 3);
    }
    for (const char* name : { "Rescue", "Shortfall", "Inserted" })
    {
      vtkDataArray* array = grid->GetCellData()->GetArray(name);
      element.push_back(array ? array->GetComponent(c, 0) : 0.0);
    }
    elements.push_back(std::move(element));
  }
}

/// What the trims did in all, so that a test of nothing is seen.
struct Tally
{
  int Left = 0, Inserted = 0, Offcut = 0;
};

/// @param parts the last ones are not cut, and give all meshes the same box.
/// @param cut how many are.
void Compare(const std::string& trial, const std::vector<Part>& parts, int cut,
  const Surface& surface, const TrimOptions& options, Tally& tally)
{
  Report report("stretches " + trial);
  const Mesh mesh = MakeMesh(parts);
  const Outcome together = RunAndJudge(mesh, surface, options, report);
  Wrong += report.Failures();
  Elements whole, wholeOffcut, single, singleOffcut;
  AddElements(together.Case.Trimmed, whole);
  AddElements(together.Offcut, wholeOffcut);
  double touched = 0;
  int left = 0;
  for (int p = 0; p < cut; ++p)
  {
    std::vector<Part> one(parts.begin() + cut, parts.end());
    one.push_back(parts[p]);
    const Outcome alone = RunTrim(MakeMesh(one), surface, options);
    Expect(alone.Clean(), trial + ": an error");
    AddElements(alone.Case.Trimmed, single);
    AddElements(alone.Offcut, singleOffcut);
    touched += Number(alone.Case.Trimmed, "TouchedElements");
    left += CountLeft(alone.Case.Trimmed);
  }
  for (Elements* elements : { &whole, &wholeOffcut, &single, &singleOffcut })
  {
    // What is not cut is there each time.
    std::sort(elements->begin(), elements->end());
    elements->erase(std::unique(elements->begin(), elements->end()), elements->end());
  }
  Expect(single == whole, trial + ": other elements than one by one");
  Expect(singleOffcut == wholeOffcut, trial + ": another offcut than one by one");
  Expect(Number(together.Case.Trimmed, "TouchedElements") == touched,
    trial + ": other elements touched than one by one");
  Expect(CountLeft(together.Case.Trimmed) == left, trial + ": other nodes left than one by one");
  tally.Left += left;
  tally.Inserted += static_cast<int>(Number(together.Case.Trimmed, "InsertedElements"));
  tally.Offcut += static_cast<int>(wholeOffcut.size());
}

/// Blocks that a plane cuts aslant to all their elements, which leaves nodes off.
void CompareBlocks(const std::string& trial, const TrimOptions& options, Tally& tally)
{
  for (const Vec3& normal : { Vec3(1, -4, -4), Vec3(-4, 4, 3), Vec3(-3, 4, -2) })
  {
    const Vec3 along = 40.0 * Vec3(normal.y(), -normal.x(), 0).normalized();
    const std::vector<Part> parts = { { { 8, 4, 5 }, Vec3::Zero() },
      { { 9, 8, 4 }, along.array().round() }, { { 6, 6, 3 }, -along.array().round() },
      { { 1, 1, 1 }, Vec3(-60, -60, -60) }, { { 1, 1, 1 }, Vec3(60, 60, 60) } };
    const Surface plane = PlaneThrough(Vec3(4.29, 1.71, 2.84), normal.normalized(), 300.0);
    Compare(
      trial + " " + std::to_string(static_cast<int>(normal.x())), parts, 3, plane, options, tally);
  }
}

/// A sheet beside one that the same plane cuts at a small angle: it keeps its columns.
void CompareSheets()
{
  const std::vector<Part> parts = { { { 20, 20, 3 }, Vec3::Zero() },
    { { 100, 2, 20 }, Vec3(50, 9, -10) }, { { 1, 1, 1 }, Vec3(0, -60, -60) },
    { { 1, 1, 1 }, Vec3(160, -60, 60) } };
  const Surface plane = PlaneThrough(Vec3(10, 10.2, 1.5), Vec3(0, 1, 0.5).normalized(), 300.0);
  Tally tally;
  Compare("sheets", parts, 2, plane, TrimOptions(), tally);
  Expect(tally.Left == 0, "sheets: nodes left off");
}

}

int main()
{
  CompareSheets();
  Tally plain, withLayer, withOffcut;
  TrimOptions options;
  CompareBlocks("blocks", options, plain);
  Expect(plain.Left > 0, "blocks: nothing is left off, and the test is none");
  options.InsertLayer = true;
  CompareBlocks("layers", options, withLayer);
  Expect(withLayer.Inserted > 0, "layers: none was inserted");
  options.InsertLayer = false;
  options.ProduceOffcut = true;
  CompareBlocks("offcuts", options, withOffcut);
  Expect(withOffcut.Offcut > 0, "offcuts: there is none");
  std::printf("%d nodes left, %d elements inserted, %d in offcuts\n", plain.Left,
    withLayer.Inserted, withOffcut.Offcut);
  return Wrong != 0;
}
