/**
 * @file TestRanksFindings.cxx
 * @brief What is found at the cut is told of alike where one rank has the elements that are kept,
 * and another those that the surface meets.
 */
#include "Expect.h"
#include "Pieces.h"
#include "SplineData.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>

using namespace judge;

namespace
{
/// A tip of 90 degrees that is kept, at a place of the mesh's x-y plane.
vtkSmartPointer<vtkPolyData> Tip(const Vec3& at)
{
  return ToPolyData(Wall({ { -30, -30 }, { 0, 0 }, { -30, 30 } }, at));
}

/// A facet from wall to wall of a tip, whose nodes no element that is kept is met at: the feet of
/// the nodes are known to the rank alone that has the elements beyond.
void TestLongChord()
{
  const Mesh mesh = Sheet(20, 17, 1, Vec3(1, 1, 0.5));
  const auto whole = WithWholeIds(mesh.Grid);
  const Vec3 first(whole->GetPoint(0));
  TrimOptions options;
  options.Optimization = 0;
  options.MinimumScaledJacobian = 0;
  options.EliminationFraction = 0;
  options.UseKeepPoint = true;
  options.KeepPoint = first + Vec3(1, 8.5, 0);
  const Vec3 tip = first + Vec3(12.8, 8.5, 0);
  const PiecesOutcome alone = TrimPieces({ whole }, { Tip(tip) }, options);
  Expect(alone.Errors.empty(), "a tip: an error");
  vtkDataArray* const told = alone.Trimmed[0]->GetCellData()->GetArray("Feasibility");
  Expect(told && told->GetRange()[1] > 0, "a tip: nothing is told of");

  vtkDataArray* const statuses = alone.Statuses[0]->GetCellData()->GetArray("ElementStatus");
  std::vector<int> rankOf;
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    rankOf.push_back(statuses->GetComponent(c, 0) > 0 ? 1 : 0);
  }
  const PiecesOutcome parts =
    TrimPieces(DivideBy(whole, rankOf, DivideOptions{}), { Tip(tip), Tip(tip) }, options);
  Expect(parts.Errors.empty(), "a tip on two ranks: an error");
  const std::string difference = DifferenceFromWhole(alone.Trimmed[0], parts.Trimmed);
  Expect(difference.empty(), "a tip on two ranks: " + difference);
  const std::string texts = DifferenceOfTexts(alone.Warnings, parts.Warnings);
  Expect(texts.empty(), "a tip on two ranks: " + texts);
}
}

int main()
{
  TestLongChord();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
