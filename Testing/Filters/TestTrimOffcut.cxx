/**
 * @file TestTrimOffcut.cxx
 * @brief Kept part and offcut of one trim: both valid, facet by facet the same along the cut, and
 * together the whole.
 *
 * TestTrimOffcut [mesh|corners|all [all|some]]: with "some" two surfaces and two treatments only.
 */
#include "WarnedFindings.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

using namespace judge;

namespace
{
struct Treatment
{
  int Correction, Optimization;
};

const std::vector<Treatment> AllTreatments = { { 2, 2 }, { 2, 1 }, { 2, 0 }, { 3, 2 }, { 3, 1 },
  { 3, 0 }, { 1, 2 } };

struct Totals
{
  int Trials = 0, Failed = 0, KeptChanged = 0, WithLeft = 0, CornersLost = 0;
  long Touched = 0, Certified = 0;
  double WorstQuality = 1;
};

/// The facets at the cut, by their nodes in the input. Where a node of the cut has come to a corner
/// of the model, one with that node lies on the model's border, and belongs to one part only.
std::vector<std::array<Id, 4>> CutFacets(const Evidence& e)
{
  std::vector<std::array<Id, 4>> keys;
  for (const Facet& facet : e.NewBoundary)
  {
    Facet original = facet;
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < facet.Size(); ++i)
    {
      original.Node[i] = e.PointOf[facet.Node[i]];
      middle += e.Out.Points[facet.Node[i]] / facet.Size();
    }
    if (e.Border.Distance(middle) > e.Exact)
    {
      keys.push_back(FacetKey(original));
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

void CheckSharedNodes(const Evidence& kept, const Evidence& rest, Report& report)
{
  std::map<Id, Id> other;
  for (Id p = 0; p < static_cast<Id>(rest.Out.Points.size()); ++p)
  {
    other[rest.PointOf[p]] = p;
  }
  Id shared = 0;
  for (Id p = 0; p < static_cast<Id>(kept.Out.Points.size()); ++p)
  {
    const auto twin = other.find(kept.PointOf[p]);
    if (twin == other.end())
    {
      continue;
    }
    ++shared;
    if (kept.Out.Points[p] != rest.Out.Points[twin->second])
    {
      report.Fail("a node is at one place", "input point " + std::to_string(kept.PointOf[p]), 1, 0);
    }
  }
  if (shared == 0 && !kept.NewBoundary.empty())
  {
    report.Fail("shared nodes", "none", 0, 1);
  }
}

void CheckCells(const Evidence& kept, const Evidence& rest, Report& report)
{
  for (Id c = 0; c < static_cast<Id>(kept.In.Elements.size()); ++c)
  {
    if (!kept.KeptCell[c] && !rest.KeptCell[c])
    {
      report.Fail("each element is in a part", "input cell " + std::to_string(c), 0, 1);
    }
  }
}

// What the warnings count is in the arrays: corners on port 1, elements of the offcut on port 2,
// where parts of one element share its id.
void CheckWarnings(const Outcome& outcome, Report& report)
{
  int lost = 0;
  vtkDataArray* corners = outcome.Case.Whole->GetPointData()->GetArray("CornerLost");
  for (vtkIdType i = 0; i < corners->GetNumberOfTuples(); ++i)
  {
    lost += corners->GetComponent(i, 0) != 0;
  }
  const int lostWarned = CountWarned(outcome, "does not add up");
  if (lost != lostWarned)
  {
    report.Fail("CornerLost", "against the warning", lost, lostWarned);
  }
  vtkDataArray* shortfall = outcome.Offcut->GetCellData()->GetArray("Shortfall");
  vtkDataArray* ids = outcome.Offcut->GetCellData()->GetArray("vtkOriginalCellIds");
  std::map<int, std::set<double>> elements;
  for (vtkIdType i = 0; i < shortfall->GetNumberOfTuples(); ++i)
  {
    elements[static_cast<int>(shortfall->GetComponent(i, 0))].insert(ids->GetComponent(i, 0));
  }
  // Of one element, and of many.
  const std::map<int, std::array<const char*, 2>> phrases = {
    { 1, { "of the offcut stays below", "of the offcut stay below" } },
    { 3, { "of the offcut is distorted", "of the offcut are distorted" } },
    { 4, { "of the offcut was inside out", "of the offcut were inside out" } }
  };
  for (const auto& [value, phrase] : phrases)
  {
    const int warned = CountWarned(outcome, phrase[0]) + CountWarned(outcome, phrase[1]);
    if (static_cast<int>(elements[value].size()) != warned)
    {
      report.Fail(
        "Shortfall of the offcut", phrase[1], static_cast<double>(elements[value].size()), warned);
    }
  }
}

/// The volumes add up, unless it is told of nodes at which they do not; then they do not.
void CheckVolumes(const Evidence& kept, const Evidence& rest, bool told, Report& report)
{
  const Mesh& mesh = *kept.Case.Input;
  const double whole = VolumeOf(kept.In);
  const double parts = VolumeOf(kept.Out) + VolumeOf(rest.Out);
  const double limit = (1e-12 + 10 * kept.Rounding / mesh.Box.ElementSize) * whole;
  if ((std::abs(parts - whole) <= limit) == told)
  {
    report.Fail(told ? "CornerLost where the volumes do not add up" : "the volumes add up",
      "against " + std::to_string(whole), parts, limit);
  }
}

void CheckCertificate(const Evidence& rest, Report& report, Totals& totals)
{
  // An element that was divided need not have a moved node.
  Id touched = 0, certified = 0, moved = 0;
  for (Id c = 0; c < static_cast<Id>(rest.Out.Elements.size()); ++c)
  {
    const int size = rest.Out.Elements[c].Size;
    if (!rest.Touched(c) && size == rest.In.Elements[rest.CellOf[c]].Size)
    {
      continue;
    }
    ++touched;
    moved += rest.Touched(c);
    const auto bezier = BezierJacobians(rest.Out.Corners(c), size);
    certified += *std::min_element(bezier.begin(), bezier.end()) > 0;
  }
  if (rest.Number("TouchedElements") != moved)
  {
    report.Fail("TouchedElements of the offcut", "recomputed", rest.Number("TouchedElements"),
      static_cast<double>(moved));
  }
  // In a solid block straight corners stay flat where they are not made wedges.
  if (certified != touched && (rest.Case.Input->Sheet || rest.Case.Options.Optimization == 2))
  {
    report.Fail("every touched element of the offcut is certified", "elements",
      static_cast<double>(certified), static_cast<double>(touched));
  }
  totals.Touched += touched;
  totals.Certified += certified;
  totals.WorstQuality = std::fmin(totals.WorstQuality, rest.Number("MinimumScaledJacobian"));
}

void Judge(const Outcome& outcome, Report& report, Totals& totals)
{
  const Evidence kept(outcome.Case, report);
  Trial trial = outcome.Case;
  trial.Trimmed = outcome.Offcut;
  trial.MayDivide = true;
  const Evidence rest(trial, report);
  if (!kept.Usable || !rest.Usable)
  {
    return;
  }
  JudgeAll(kept, report);
  CheckElements(rest, report);
  CheckCarriedArrays(rest, report);
  CheckCertificate(rest, report, totals);
  CheckSharedNodes(kept, rest, report);
  CheckCells(kept, rest, report);
  CheckWarnings(outcome, report);
  const bool cornersLost = CountWarned(outcome, "does not add up") > 0;
  totals.CornersLost += cornersLost;
  if (kept.Case.Input->Flat)
  {
    CheckVolumes(kept, rest, cornersLost, report);
  }
  const auto a = CutFacets(kept), b = CutFacets(rest);
  if (a != b)
  {
    std::vector<std::array<Id, 4>> alone;
    std::set_symmetric_difference(
      a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(alone));
    report.Fail("the facets at the cut are the same",
      "at input point " + std::to_string(alone.front()[3]), static_cast<double>(alone.size()), 0);
  }
  const FacetTable facets(rest.Out);
  if (facets.OverUsed > 0)
  {
    report.Fail("no facet has three elements", "offcut", facets.OverUsed, 0);
  }
  totals.WithLeft += kept.Number("RescuedByLeaving") > 0;
}

void Run(const Mesh& mesh, const std::string& name, const Surface& surface,
  const std::vector<Treatment>& treatments, Totals& totals)
{
  for (const Treatment treatment : treatments)
  {
    for (const bool invert : { false, true })
    {
      TrimOptions options;
      options.CorrectionType = treatment.Correction;
      options.Optimization = treatment.Optimization;
      options.InvertSide = invert;
      Report report("offcut " + mesh.Name + " " + name + " " +
        std::to_string(treatment.Correction) + " " + std::to_string(treatment.Optimization) +
        (invert ? " inverted" : ""));
      const Outcome without = RunTrim(mesh, surface, options);
      if (without.Offcut->GetNumberOfCells() != 0 || without.Offcut->GetNumberOfPoints() != 0)
      {
        report.Fail("offcut", "there though it was not asked for");
      }
      options.ProduceOffcut = true;
      const Outcome with = RunTrim(mesh, surface, options);
      for (const std::string& error : with.Errors)
      {
        report.Fail("error", error);
      }
      if (with.Clean())
      {
        Judge(with, report, totals);
      }
      totals.KeptChanged += !FirstDifference(without.Case.Trimmed, with.Case.Trimmed).empty();
      ++totals.Trials;
      totals.Failed += report.Failures() > 0;
    }
  }
}

/// Planes that meet corners of the model exactly: the elements there part into wedges, and no node
/// is left off.
void RunThroughCorners(Totals& totals)
{
  for (const auto& [nx, ny, layers] :
    { std::array<int, 3>{ 10, 10, 2 }, std::array<int, 3>{ 10, 7, 1 } })
  {
    const Mesh mesh = Sheet(nx, ny, layers, Vec3(1, 1, 0.4));
    const Vec3 corner(0, 0, 0);
    for (const Vec3& along : { Vec3(nx, ny, 0), Vec3(3, 2, 0), Vec3(2, 3, 0) })
    {
      Run(mesh, "through corners",
        PlaneThrough(corner, Vec3(-along[1], along[0], 0).normalized(), 200),
        { { 2, 2 }, { 3, 2 } }, totals);
    }
  }
  if (totals.WithLeft > 0 || totals.KeptChanged > 0)
  {
    std::printf("FAIL through corners: nodes left, or the kept part is another with the offcut\n");
    ++totals.Failed;
  }
}

/// Cuts that leave less than an element beside the border: nodes there leave it, or slide along it.
void RunBesideBorder(Totals& totals)
{
  for (const Mesh& mesh : { Sheet(32, 24, 1, Vec3(1, 1, 1.5)), SheetWithWedges(32, 24, 1) })
  {
    for (const double y : { 0.3, 0.36, 0.42, 0.48, 0.54 })
    {
      Placement at;
      at.X = 0.1;
      at.Y = y;
      at.Size = 0.5;
      at.Lean = 0.52;
      at.Angle = 1.7;
      Run(mesh, "cylinder beside the border at " + std::to_string(y),
        MakeSurface("cylinder", mesh.Box, at), { { 2, 2 }, { 3, 2 }, { 2, 1 } }, totals);
    }
  }
}

/// Cuts along walls that meet without a radius: nodes leave the folds between them.
void RunAlongFolds(Totals& totals)
{
  const Mesh mesh = MakePart("section");
  for (const auto& [kind, lean, angle, x, size] :
    { std::tuple<const char*, double, double, double, double>{ "rectangle", 1.57, 1.3, 0.13, 0.8 },
      { "rectangle", 1.2, 0.3, 0.5, 0.8 }, { "cylinder", 1.2, 0.785, 0.5, 0.4 } })
  {
    Placement at;
    at.Lean = lean;
    at.Angle = angle;
    at.X = x;
    at.Size = size;
    Run(mesh, std::string(kind) + " along folds", MakeSurface(kind, mesh.Box, at),
      { { 2, 2 }, { 3, 1 }, { 2, 0 } }, totals);
  }
}

/// Cuts through a block beside an earlier cut, where faces of the elements are warped: what is told
/// to be missing is what is missing.
void RunOnTrimmed(Totals& totals)
{
  for (int i = 0; i < 4; ++i)
  {
    Mesh mesh = Block(9, 8, 10);
    const Vec3 first = Vec3(0.3 + 0.2 * i, 0.5, 0.8 - 0.1 * i).normalized();
    const Vec3 second = (first + Vec3(0.1, -0.15, 0.04 * i)).normalized();
    TrimOptions options;
    mesh.Grid = RunTrim(mesh, PlaneThrough(mesh.Box.Centre, first, 200), options).Case.Trimmed;
    options.ProduceOffcut = true;
    const Outcome outcome =
      RunTrim(mesh, PlaneThrough(mesh.Box.Centre - (0.6 + 0.2 * i) * first, second, 200), options);
    const double missing = MeasureMissing(mesh, outcome);
    const double told = ToldMissing(outcome);
    if (std::abs(missing) < 1 || std::abs(missing - told) > 0.05 * std::abs(missing))
    {
      std::printf("FAIL on trimmed: %g elements are missing, told of are %g\n", missing, told);
      ++totals.Failed;
    }
  }
}

/// Cuts through a round blank, whose border turns at each node: what is cut off a bend is told
/// of, and of hardly anything nothing is.
/// @param most elements that may be missing without a word.
void RunPastBends(const Mesh& mesh, double most, Totals& totals)
{
  const double element = mesh.Box.ElementSize;
  int told = 0;
  for (int i = 0; i < 24; ++i)
  {
    const double turn = 0.3 + 0.26 * i;
    const Vec3 normal(std::cos(turn), std::sin(turn), 0);
    TrimOptions options;
    options.ProduceOffcut = true;
    const Outcome outcome = RunTrim(mesh,
      PlaneThrough(mesh.Box.Centre + (0.37 * i - 4.4) * element / 4 * normal, normal, 200),
      options);
    const double missing = std::abs(VolumeOf(Model(mesh.Grid)) -
      VolumeOf(Model(outcome.Case.Trimmed)) - VolumeOf(Model(outcome.Offcut)));
    const double missed = missing / (element * element * mesh.Box.LayerThickness);
    const bool tells = CountWarned(outcome, "does not add up") > 0;
    told += tells;
    if (tells ? missed < 0.005 : missed > most)
    {
      std::printf("FAIL past bends: %g elements are missing, %s\n", missed,
        tells ? "told of" : "not told of");
      ++totals.Failed;
    }
  }
  if (told < 5)
  {
    std::printf("FAIL past bends: told of in %d trims\n", told);
    ++totals.Failed;
  }
}
}

int main(int argc, char* argv[])
{
  const std::string chosen = argc > 1 ? argv[1] : "all";
  const bool some = argc > 2 && std::string(argv[2]) == "some";
  const std::vector<std::string> meshes = chosen == "all" ? std::vector<std::string>{ "sheet1",
    "sheet2", "sheet3", "channel", "irregular", "hole", "block", "dome", "cup", "stretched" }
                                                          : std::vector<std::string>{ chosen };
  const std::vector<const char*> kinds = some
    ? std::vector<const char*>{ "cylinder", "plane" }
    : std::vector<const char*>{ "plane", "cylinder", "contour", "wavy" };
  const std::vector<Treatment> treatments =
    some ? std::vector<Treatment>{ { 2, 2 }, { 3, 1 } } : AllTreatments;
  Totals totals;
  if (chosen == "corners" || chosen == "all")
  {
    RunThroughCorners(totals);
    RunBesideBorder(totals);
    RunAlongFolds(totals);
    RunOnTrimmed(totals);
    // By 22.5 degrees at each node, and by 9, which add up in many layers.
    RunPastBends(Blank(4, 2, 1), 0.1, totals);
    RunPastBends(Blank(10, 2, 16), 0.5, totals);
  }
  for (const std::string& meshName : chosen == "corners" ? std::vector<std::string>() : meshes)
  {
    const Mesh mesh = MakeMesh(meshName);
    for (const char* kind : kinds)
    {
      Placement at;
      at.Seed = 3;
      at.Size = 0.45;
      Run(mesh, kind, MakeSurface(kind, mesh.Box, at), treatments, totals);
    }
  }
  std::printf(
    "%d trims, %d with failures; touched elements of the offcuts %ld, certified %ld, "
    "scaled Jacobian at least %.3f; kept part not as without the offcut in %d, nodes left "
    "off the surface in %d, corners of the model in %d\n",
    totals.Trials, totals.Failed, totals.Touched, totals.Certified, totals.WorstQuality,
    totals.KeptChanged, totals.WithLeft, totals.CornersLost);
  return totals.Failed > 0;
}
