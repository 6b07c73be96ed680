/**
 * @file TestTrimRenumber.cxx
 * @brief Node numbers: the optimum on rectangular sheets, never worse than as it came or than
 * reverse Cuthill-McKee on anything.
 */
#include "RunTrim.h"

#include <algorithm>
#include <array>
#include <cstdio>

using namespace judge;

namespace
{
int Wrong = 0;

// The largest difference with the longest direction outermost, the shortest innermost, and the
// lower bound by the diameter of the node graph.
void ExpectOptimum(const std::string& name, const Outcome& outcome, std::array<int, 3> elements)
{
  std::sort(elements.begin(), elements.end());
  const Id inner = elements[0] + 1, plane = inner * (elements[1] + 1);
  const Id optimum = plane + inner + 1;
  const Id nodes = plane * (elements[2] + 1);
  const Id bound = (nodes - 1 + elements[2] - 1) / elements[2];
  const Id now = Bandwidth(Model(outcome.Case.Trimmed).Elements);
  std::printf("%-34s bandwidth %ld, sorted %ld, bound %ld\n", name.c_str(), long(now),
    long(optimum), long(bound));
  if (now > optimum || now < bound)
  {
    std::printf("FAIL %s: bandwidth %ld, not %ld\n", name.c_str(), long(now), long(optimum));
    ++Wrong;
  }
}

void TestSheet(int nx, int ny, int nz, bool permuted)
{
  MeshOptions o;
  o.Permuted = permuted;
  o.Data = false;
  const Mesh mesh = Sheet(nx, ny, nz, Vec3(1, 1, 0.4), o);
  const std::string name = "sheet " + std::to_string(nx) + "x" + std::to_string(ny) + "x" +
    std::to_string(nz) + (permuted ? " permuted" : "");
  // Missed by the surface, so it comes out whole; then cut along a row of facets.
  for (const double at : { nx + 5.0, nx - 3.0 })
  {
    const Surface plane = PlaneThrough(Vec3(at, 0, 0), Vec3::UnitX(), 10.0 * (nx + ny));
    Report report("renumber " + name);
    const Outcome outcome = RunAndJudge(mesh, plane, TrimOptions(), report);
    Wrong += report.Failures();
    ExpectOptimum(name, outcome, { { at > nx ? nx : nx - 3, ny, nz } });
  }
}
}

int main()
{
  for (const bool permuted : { false, true })
  {
    TestSheet(40, 25, 2, permuted);
    TestSheet(25, 40, 2, permuted);
    TestSheet(30, 30, 2, permuted);
    TestSheet(50, 12, 1, permuted);
    TestSheet(24, 12, 4, permuted);
    TestSheet(150, 60, 2, permuted); // large enough to be numbered by pillars
  }
  // Other shapes, where the best order is another: judged against the two candidates.
  for (const char* name : { "hole", "lshape", "blank", "irregular", "islands", "cup" })
  {
    const Mesh mesh = MakeMesh(name);
    for (const char* kind : { "cylinder", "scurve" })
    {
      Report report(std::string("renumber ") + name + " " + kind);
      RunAndJudge(mesh, MakeSurface(kind, mesh.Box, Placement()), TrimOptions(), report);
      Wrong += report.Failures("numbering");
    }
  }
  // A solid of many nodes, without pillars, cut aslant.
  MeshOptions plain;
  plain.Data = false;
  const Mesh block = Block(34, 32, 30, plain);
  Placement aslant;
  aslant.Lean = 0.6;
  aslant.Angle = 0.5;
  TrimOptions stepped;
  stepped.CorrectionType = 1;
  stepped.InvertSide = true;
  Report solid("renumber block");
  RunAndJudge(block, MakeSurface("cylinder", block.Box, aslant), stepped, solid);
  Wrong += solid.Failures("numbering");
  // A thin ring: Cuthill-McKee wins over any sort.
  Placement ring;
  ring.X = ring.Y = 0;
  ring.Size = 0.9;
  const Mesh plate = MakeMesh("sheet2");
  TrimOptions outside;
  Report report("renumber ring");
  Mesh round = plate;
  round.Grid =
    RunAndJudge(plate, MakeSurface("cylinder", plate.Box, ring), outside, report).Case.Trimmed;
  ring.Size = 0.55;
  outside.InvertSide = true;
  RunAndJudge(round, MakeSurface("cylinder", plate.Box, ring), outside, report);
  Wrong += report.Failures("numbering");
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
