/**
 * @file TestTrimDegenerate.cxx
 * @brief Wedges that come as hexahedra with two pairs of corners in one node each, as solvers
 * without elements of six nodes write them: trimmed as the wedges are.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

using namespace judge;

namespace
{
const char* const Phrase = "come as the wedges that they are";

/// A wedge as one of the twelve hexahedra of which two edges are a node each.
struct Pattern
{
  int Collapsed, Along, Side; ///< axis of these edges, of the wedge; on which side they are

  std::array<vtkIdType, 8> Hexahedron(const vtkIdType* wedge) const
  {
    static const int corners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
      { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
    const int across = 3 - this->Collapsed - this->Along;
    std::array<vtkIdType, 8> nodes;
    for (int i = 0; i < 8; ++i)
    {
      const int* at = corners[i];
      const int ofTriangle = at[across] == this->Side ? 0 : 1 + at[this->Collapsed];
      nodes[i] = wedge[ofTriangle + 3 * at[this->Along]];
    }
    return nodes;
  }
};

std::vector<Pattern> AllPatterns()
{
  std::vector<Pattern> patterns;
  for (int collapsed = 0; collapsed < 3; ++collapsed)
  {
    for (int along = 0; along < 3; ++along)
    {
      for (int side = 0; side < 2 && along != collapsed; ++side)
      {
        patterns.push_back({ collapsed, along, side });
      }
    }
  }
  return patterns;
}

/// The mesh with its wedges as hexahedra; returns how many there are.
int WriteAsHexahedra(vtkUnstructuredGrid* grid, const Pattern& pattern, bool narrow)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  if (narrow)
  {
    cells->Use32BitStorage();
  }
  int wedges = 0;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, nodes);
    if (grid->GetCellType(c) == VTK_WEDGE)
    {
      cells->InsertNextCell(8, pattern.Hexahedron(nodes->GetPointer(0)).data());
      ++wedges;
    }
    else
    {
      cells->InsertNextCell(nodes);
    }
    types->InsertNextValue(VTK_HEXAHEDRON);
  }
  grid->SetCells(types, cells);
  return wedges;
}

std::set<vtkIdType> NodesOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(cell, nodes);
  return { nodes->begin(), nodes->end() };
}

/// The order of an element's nodes is left to the pattern.
void ExpectSame(const std::string& name, vtkUnstructuredGrid* right, vtkUnstructuredGrid* other)
{
  Expect(other->GetNumberOfCells() == right->GetNumberOfCells() &&
      other->GetNumberOfPoints() == right->GetNumberOfPoints(),
    name + ": another number of cells or points");
  int differ = 0;
  for (vtkIdType c = 0; c < std::min(right->GetNumberOfCells(), other->GetNumberOfCells()); ++c)
  {
    differ +=
      other->GetCellType(c) != right->GetCellType(c) || NodesOf(other, c) != NodesOf(right, c);
  }
  Expect(differ == 0, name + ": " + std::to_string(differ) + " cells differ");
  double apart = 0.0;
  for (vtkIdType p = 0; p < std::min(right->GetNumberOfPoints(), other->GetNumberOfPoints()); ++p)
  {
    apart = std::max(apart, (Vec3(right->GetPoint(p)) - Vec3(other->GetPoint(p))).norm());
  }
  Expect(apart < 1e-9, name + ": nodes are " + std::to_string(apart) + " apart");
}

void ExpectCertified(
  const std::string& name, vtkUnstructuredGrid* right, vtkUnstructuredGrid* other)
{
  Expect(Number(other, "CertifiedElements") == Number(other, "TouchedElements") &&
      Number(other, "TouchedElements") == Number(right, "TouchedElements"),
    name + ": certified elements");
}

void TestPatterns()
{
  const Mesh mesh = MakeMesh("wedges");
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome right = RunTrim(mesh, surface, options);
  int number = 0;
  for (const Pattern& pattern : AllPatterns())
  {
    Mesh other = mesh;
    other.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    other.Grid->DeepCopy(mesh.Grid);
    const int wedges = WriteAsHexahedra(other.Grid, pattern, number % 2 == 0);
    const Outcome outcome = RunTrim(other, surface, options);
    const std::string name = "pattern " + std::to_string(number++);
    Expect(outcome.Clean() && wedges > 20 && CountWarned(outcome, Phrase) == wedges &&
        outcome.Warnings.size() == right.Warnings.size() + 1,
      name + ": the warning");
    ExpectSame(name, right.Case.Trimmed, outcome.Case.Trimmed);
    ExpectCertified(name, right.Case.Trimmed, outcome.Case.Trimmed);
    ExpectSame(name + ", offcut", right.Offcut, outcome.Offcut);
    ExpectSame(name + ", whole", right.Case.Whole, outcome.Case.Whole);
  }
  Expect(number == 12, "patterns are missing");
}

}

int main()
{
  TestPatterns();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
