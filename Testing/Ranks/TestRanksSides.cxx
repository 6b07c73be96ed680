/**
 * @file TestRanksSides.cxx
 * @brief Sides of pieces that cannot tell by themselves: where the nearest place of the surface
 * shows the wrong side, only the nodes shared with other pieces know.
 */
#include "ControllerRanks.h"
#include "PieceSides.h"
#include "Pieces.h"
#include "ThreadRanks.h"

#include <vtkNURBSSurfaceSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdio>

using namespace judge;

namespace
{
int Wrong = 0;

void Check(bool holds, const std::string& text)
{
  if (!holds)
  {
    std::printf("FAIL %s\n", text.c_str());
    ++Wrong;
  }
}

/// A polygon in the plane of the sheet, in half sizes of its box, straight through the thickness.
Surface Swept(const Mesh& mesh, const std::vector<Vec3>& polygon)
{
  const int count = static_cast<int>(polygon.size());
  vtkNew<vtkNURBSSurfaceSource> source;
  source->SetDegrees(1, 1);
  source->SetControlNetSize(count, 2);
  source->SetNumberOfControlPoints(2 * count);
  const Frame& box = mesh.Box;
  for (int i = 0; i < 2 * count; ++i)
  {
    const Vec3& p = polygon[i % count];
    const Vec3 local(p[0] * box.HalfX, p[1] * box.HalfY, i < count ? -5.0 : 5.0);
    const Vec3 at = box.Centre + box.Axes * local;
    source->SetControlPoint(i, at[0], at[1], at[2], 1.0);
  }
  source->SetNumberOfKnotsU(count + 2);
  for (int i = 0; i < count + 2; ++i)
  {
    source->SetKnotU(i, std::min(std::max(0, i - 1), count - 1));
  }
  source->SetNumberOfKnotsV(4);
  for (int i = 0; i < 4; ++i)
  {
    source->SetKnotV(i, i < 2 ? 0.0 : 1.0);
  }
  source->Update();
  Surface surface;
  surface.Data = source->GetOutput();
  return surface;
}

/// A wall through the sheet, and a second one beyond its end, which turns its other side to it.
Surface TwoWalls(const Mesh& mesh, double end)
{
  const auto wall = [&mesh](double x) {
    return Swept(mesh, { Vec3(x, -1.3, 0), Vec3(x, 1.3, 0) });
  };
  return Together(wall(-0.61 * end).Data, wall(1.3 * end).Data);
}

void Compare(const std::string& what, const Mesh& mesh, const Surface& surface)
{
  Mesh marked = mesh;
  marked.Grid = WithWholeIds(mesh.Grid);
  for (const bool invert : { false, true })
  {
    TrimOptions options;
    options.InvertSide = invert;
    const Outcome whole = RunTrim(marked, surface, options);
    Check(whole.Clean(), what + ": " + (whole.Clean() ? "" : whole.Errors[0]));
    for (const char* partition : { "slabs", "scattered" })
    {
      const auto pieces = Divide(mesh, marked.Grid, partition, 3);
      const PiecesOutcome parts =
        TrimPieces(pieces, { surface.Data, surface.Data, surface.Data }, options);
      const std::string difference = DifferenceFromWhole(whole.Case.Whole, parts.Statuses);
      Check(parts.Errors.empty() && difference.empty(),
        what + ", " + partition + ": " + (parts.Errors.empty() ? difference : parts.Errors[0]));
    }
  }
}

/// Of two edges the one crossed nearer to the node decides, on both ranks.
void TestVotes()
{
  const auto controllers = MakeThreadRanks(2);
  int right = 0;
  std::array<bool, 2> same{};
  RunRanks(2,
    [&](int rank)
    {
      const trim::ControllerRanks ranks(controllers[rank]);
      trim::SharedNodes shared;
      shared.Local = { rank == 0 ? 3 : 7 };
      shared.Number = { 0 };
      shared.LocalByNumber = shared.Local;
      std::vector<trim::NodeVote> votes{ { shared.Local[0],
        { rank == 0 ? 2.0 : 1.0, {}, rank == 0 ? trim::NodeKeep : trim::NodeEliminate } } };
      trim::ShareVotes({ ranks, shared, {} }, votes);
      trim::SideVote best;
      for (const auto& vote : votes)
      {
        best = vote.Node == shared.Local[0] && vote.Vote.Outvotes(best) ? vote.Vote : best;
      }
      same[rank] = best.Side == trim::NodeEliminate;
    });
  right = same[0] + same[1];
  Check(right == 2, "votes: " + std::to_string(right) + " ranks of 2 took the nearer crossing");
}
/// Sets of two pieces that share a node are one, and contradict each other on both ranks.
void TestContradiction()
{
  for (const bool agree : { true, false })
  {
    const auto controllers = MakeThreadRanks(2);
    std::array<bool, 2> parted{};
    RunRanks(2,
      [&](int rank)
      {
        const trim::ControllerRanks ranks(controllers[rank]);
        trim::SharedNodes shared;
        shared.Local = { 1 };
        shared.Number = { 0 };
        shared.LocalByNumber = shared.Local;
        trim::SetSides sides(2);
        sides.Set(1, rank == 0 || agree ? trim::NodeKeep : trim::NodeEliminate);
        trim::JoinedSets joined;
        parted[rank] = joined.Join(
          { ranks, shared, {} }, [](trim::Id node) { return node; }, sides);
      });
    Check(parted[0] == agree && parted[1] == agree, "sets that two pieces share");
  }
}
}

int main()
{
  MeshOptions plain;
  plain.Data = false;
  const Mesh mesh = Sheet(30, 10, 2, Vec3(1, 1, 0.4), plain);
  // Towards either end: of the nodes that a piece may ask by itself the first is the wrong one
  // once.
  Compare("two walls", mesh, TwoWalls(mesh, 1.0));
  Compare("two walls, mirrored", mesh, TwoWalls(mesh, -1.0));
  // Beside the sheet: its two ends lie on different sides of the plane, but nothing parts them.
  Compare("aside", mesh, Swept(mesh, { Vec3(0.05, 1.2, 0), Vec3(0.05, 3.0, 0) }));
  TestVotes();
  TestContradiction();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
