/**
 * @file TestRanks.cxx
 * @brief The trim of a grid in pieces against the trim of the whole, bit by bit.
 *
 * TestRanks [ranks [mesh|all [surface|all [partition|all [all|some]]]]]
 * With "some" each combination gets one of the corrections and treatments, in turn. Every fifth
 * trim makes an offcut too, every second one maps the values, every third one may insert a layer.
 */
#include "Pieces.h"
#include "SplineData.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <set>

using namespace judge;

namespace
{
int Trials = 0;
int Wrong = 0;
int Rescued = 0;
int Offcuts = 0;
int Layers = 0;

const std::vector<std::pair<int, int>> Treatments = { { 2, 2 }, { 2, 1 }, { 3, 2 }, { 2, 0 },
  { 3, 1 }, { 1, 0 }, { 3, 0 } };

void Fail(const std::string& trial, const std::string& text)
{
  std::printf("FAIL %s: %s\n", trial.c_str(), text.c_str());
  ++Wrong;
}

Surface SurfaceOf(const std::string& kind, const Mesh& mesh)
{
  Placement at;
  at.Seed = 3;
  at.Size = 0.45;
  at.Lean = kind == "leaning" ? 0.26 : kind == "aslant" ? 0.6 : 0;
  at.Angle = kind == "aslant" ? 0.7 : at.Angle;
  return MakeSurface(kind == "leaning" ? "cylinder"
      : kind == "aslant"               ? "plane"
                                       : kind,
    mesh.Box, at);
}

std::string DifferenceOfOffcuts(const Mesh& mesh, const Outcome& whole, const PiecesOutcome& parts)
{
  if (whole.Offcut->GetNumberOfCells() == 0)
  {
    const auto hasCells = [](const auto& piece) { return piece->GetNumberOfCells() > 0; };
    return std::any_of(parts.Offcuts.begin(), parts.Offcuts.end(), hasCells)
      ? "an offcut that the whole does not have"
      : "";
  }
  ++Offcuts;
  const std::string difference = DifferenceFromWhole(whole.Offcut, parts.Offcuts);
  const std::string summary = DifferenceOfSummaries(mesh.Grid, whole.Offcut, parts.Offcuts);
  return difference + summary == "" ? "" : "offcut: " + difference + summary;
}

using Grids = std::vector<vtkSmartPointer<vtkUnstructuredGrid>>;

/// @param divide makes the pieces of a grid WithWholeIds.
void CompareDivided(const std::string& trial, const Mesh& mesh, const Surface& surface,
  const TrimOptions& options, const std::function<Grids(vtkUnstructuredGrid*)>& divide)
{
  ++Trials;
  Mesh marked = mesh;
  marked.Grid = WithWholeIds(mesh.Grid);
  const Outcome whole = RunTrim(marked, surface, options);
  Rescued += !Rescues(whole.Case.Trimmed).empty();
  Layers += options.InsertLayer &&
    whole.Case.Trimmed->GetFieldData()->GetArray("InsertedElements")->GetComponent(0, 0) > 0;
  const Grids pieces = divide(marked.Grid);
  const PiecesOutcome parts = TrimPieces(pieces, { pieces.size(), surface.Data }, options);
  const std::string said = DifferenceOfTexts(whole.Errors, parts.Errors) +
    DifferenceOfTexts(whole.Warnings, parts.Warnings);
  const std::string trimmed = DifferenceFromWhole(whole.Case.Trimmed, parts.Trimmed);
  const std::string statuses = DifferenceFromWhole(whole.Case.Whole, parts.Statuses);
  const std::string summary = DifferenceOfSummaries(mesh.Grid, whole.Case.Trimmed, parts.Trimmed);
  const std::string offcut = DifferenceOfOffcuts(mesh, whole, parts);
  const std::string ids =
    DifferenceOfOriginalIds(pieces, parts.Trimmed) + DifferenceOfOriginalIds(pieces, parts.Offcuts);
  for (const auto& difference : { said, trimmed, statuses, summary, offcut, ids })
  {
    if (!difference.empty())
    {
      Fail(trial, difference);
      return;
    }
  }
}

void Compare(const std::string& trial, const Mesh& mesh, const Surface& surface,
  const TrimOptions& options, const std::string& partition, int ranks)
{
  CompareDivided(trial, mesh, surface, options,
    [&](vtkUnstructuredGrid* whole) { return Divide(mesh, whole, partition, ranks); });
}

using Places = std::set<std::array<double, 3>>;

Places PlacesOfNodes(const Mesh& mesh, const Surface& surface)
{
  const Outcome outcome = RunTrim(mesh, surface, TrimOptions());
  Places places;
  for (vtkIdType i = 0; i < outcome.Case.Trimmed->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> p;
    outcome.Case.Trimmed->GetPoint(i, p.data());
    places.insert(p);
  }
  return places;
}

/// A mesh with its nodes and cells in another order is trimmed alike.
void TestPermuted()
{
  MeshOptions plain, permuted;
  plain.Data = permuted.Data = false;
  permuted.Permuted = true;
  const auto compare =
    [](const std::string& name, const Mesh& mesh, const Mesh& other, const Surface& surface)
  {
    ++Trials;
    if (PlacesOfNodes(mesh, surface) != PlacesOfNodes(other, surface))
    {
      Fail("permuted " + name, "nodes at other places");
    }
  };
  const Vec3 element(1, 1, 0.4);
  const Mesh mesh = Sheet(24, 18, 2, element, plain);
  for (const char* kind : { "wavy", "contour", "rectangle" })
  {
    compare(kind, mesh, Sheet(24, 18, 2, element, permuted), SurfaceOf(kind, mesh));
  }
  const Mesh block = Block(11, 10, 9, plain);
  compare("block", block, Block(11, 10, 9, permuted), SurfaceOf("cone", block));
}

/// A hole that is not opened is told of by the ranks that have it, and a strip of another sheet
/// that is lost by all of them.
void TestLostVolume(int ranks)
{
  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, 0, 0));
  const Surface both = StripAndHole(sheets);
  if (RunTrim(sheets, both, TrimOptions()).Warnings.size() != 2)
  {
    Fail("strip and hole", "not both are told of");
  }
  for (const std::string& partition : PartitionNames())
  {
    Compare("strip and hole " + partition, sheets, both, TrimOptions(), partition, ranks);
  }
}

/// What is wrong with a surface is said alike, with the same place, whichever rank sees it.
void TestErrors(int ranks)
{
  MeshOptions plain;
  plain.Data = false;
  const Mesh mesh = Sheet(20, 16, 2, Vec3(1, 1, 0.4), plain);
  const Vec3 middle(0, 0, mesh.Box.Centre[2]);
  const auto wall = [&middle](double x, double from, double to) {
    return ToPolyData(Wall({ { x, from }, { x, to } }, middle));
  };
  const auto check = [&](const std::string& what, const std::string& words, vtkDataObject* data)
  {
    Surface surface;
    surface.Data = data;
    const Outcome whole = RunTrim(mesh, surface, TrimOptions());
    if (whole.Errors.size() != 1 || whole.Errors[0].find(words) == std::string::npos)
    {
      Fail(what, "no error that it " + words);
    }
    for (const std::string& partition : PartitionNames())
    {
      Compare(what + " " + partition, mesh, surface, TrimOptions(), partition, ranks);
    }
  };
  // The strip between them lies on both sides; either side is that of the fewer once.
  for (const double at : { 4.3, 15.3 })
  {
    check("two walls that face alike", "has its two sides mixed up",
      Together(wall(at, -9, 30), wall(9.6, -9, 30)).Data);
  }
  check("a wall that ends", "ends inside the grid", wall(9.6, -9, 7.3));
  // Its ends lie on faces: only the elements on both sides of these together hold them.
  check("a wall within elements", "ends inside the grid", wall(9.6, 7, 8));
  Surface within;
  within.Data = wall(9.6, 7, 8);
  CompareDivided("a wall within the elements of a rank", mesh, within, TrimOptions(),
    [](vtkUnstructuredGrid* whole)
    {
      std::vector<int> rankOf;
      for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
      {
        double bounds[6];
        whole->GetCellBounds(c, bounds);
        rankOf.push_back(bounds[2] > 6.5 && bounds[3] < 8.5 ? 0 : 1);
      }
      return DivideBy(whole, rankOf, DivideOptions());
    });
}

std::vector<std::string> Chosen(const std::string& argument, const std::vector<std::string>& all)
{
  return argument == "all" ? all : std::vector<std::string>{ argument };
}
}

int main(int argc, char* argv[])
{
  const auto argument = [&](int i) { return std::string(argc > i ? argv[i] : "all"); };
  const int ranks = argc > 1 ? std::atoi(argv[1]) : 2;
  std::vector<std::string> kinds = SurfaceKinds();
  kinds.insert(kinds.end(), { "leaning", "rectangle", "aslant" });
  std::size_t turn = 0;
  for (const std::string& meshName : Chosen(argument(2), MeshNames()))
  {
    const Mesh mesh = MakeMesh(meshName);
    for (const std::string& kind : Chosen(argument(3), kinds))
    {
      const Surface surface = SurfaceOf(kind, mesh);
      for (const std::string& partition : Chosen(argument(4), PartitionNames()))
      {
        ++turn;
        for (std::size_t k = 0; k < Treatments.size(); ++k)
        {
          if (argument(5) != "some" || k == turn % Treatments.size())
          {
            TrimOptions options;
            options.CorrectionType = Treatments[k].first;
            options.Optimization = Treatments[k].second;
            options.ProduceOffcut = turn % 5 == 2;
            options.MapValues = turn % 2 == 0;
            options.InsertLayer = turn % 3 == 0 || kind == "aslant";
            Compare(meshName + " " + kind + " " + partition + " " +
                std::to_string(options.CorrectionType) + std::to_string(options.Optimization),
              mesh, surface, options, partition, ranks);
          }
        }
      }
    }
  }
  TestPermuted();
  TestLostVolume(ranks);
  TestErrors(ranks);
  if (argument(2) == "block" && argument(3) == "aslant" && Layers == 0)
  {
    Fail("block aslant", "no layer was inserted");
  }
  std::printf("%d trials on %d ranks, %d of them with rescues, %d with an offcut, %d with a layer, "
              "%d wrong\n",
    Trials, ranks, Rescued, Offcuts, Layers, Wrong);
  return Wrong > 0;
}
