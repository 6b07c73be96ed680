/**
 * @file TrimCampaign.cxx
 * @brief Random trims: mesh x surface x position x options, each judged; a table of outcomes.
 *
 * TrimCampaign [count [seed [only ["layer"] [meshes]]]]: `only` repeats one trim of the series
 * alone, and shows what the filter says of it, -1: all; with "layer" InsertLayer is on; the meshes
 * (files, .vtu, or the tests' own by name) are trimmed instead of all of the tests'.
 */
#include "RunTrim.h"

#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <stdexcept>

using namespace judge;

namespace
{
struct Draw
{
  std::string Mesh, Kind;
  Placement At;
  TrimOptions Options;
};

// Every trim has a generator of its own, so that it can be repeated alone.
Draw DrawTrim(unsigned seed, int number, const std::vector<std::string>& names)
{
  std::seed_seq sequence{ seed, static_cast<unsigned>(number) };
  std::mt19937 random(sequence);
  std::uniform_real_distribution<double> any(0, 1);
  const auto pick = [&](const std::vector<std::string>& from)
  { return from[static_cast<std::size_t>(any(random) * from.size())]; };
  Draw draw;
  draw.Mesh = pick(names);
  draw.Kind = pick(AllSurfaceKinds());
  draw.At.X = 1.4 * any(random) - 0.7;
  draw.At.Y = 1.4 * any(random) - 0.7;
  draw.At.Angle = 2 * M_PI * any(random);
  // Upright as often as not; up to 45 degrees, less where the surface itself widens.
  const double lean = (draw.Kind == "cone" || draw.Kind == "wavy" ? 0.25 : 0.78) * any(random);
  draw.At.Lean = any(random) < 0.5 ? 0 : lean;
  draw.At.Size = 0.35 + 0.4 * any(random);
  draw.At.Seed = 1 + static_cast<unsigned>(1e6 * any(random));
  draw.At.Reversed = any(random) < 0.5;
  draw.Options.CorrectionType = any(random) < 0.1 ? 1 : any(random) < 0.5 ? 2 : 3;
  draw.Options.Optimization = static_cast<int>(3 * any(random));
  draw.Options.InvertSide = any(random) < 0.5;
  const double floor = any(random);
  draw.Options.MinimumScaledJacobian = floor < 0.7 ? 0.2
    : floor < 0.8                                  ? 0
    : floor < 0.9                                  ? 0.3
                                                   : 0.5;
  const double fraction = any(random);
  draw.Options.EliminationFraction = fraction < 0.8 ? 0.5 : 5 * (fraction - 0.8);
  const double tolerance = any(random);
  draw.Options.Tolerance = tolerance < 0.8 ? 1e-9
    : tolerance < 0.9                      ? 0
                                           : std::pow(10.0, -12 + 70 * (tolerance - 0.9));
  return draw;
}

Mesh GetMesh(const std::string& name)
{
  const std::string ending = ".vtu";
  const bool isFile = name.size() > ending.size() &&
    name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
  return isFile ? ReadMesh(name) : MakeMesh(name);
}

std::string Words(const Draw& draw)
{
  char text[300];
  std::snprintf(text, sizeof(text),
    "%s %s x %.3f y %.3f angle %.3f lean %.3f size %.3f seed %u%s type %d opt %d floor %g "
    "fraction %.3f tolerance %.2g%s",
    draw.Mesh.c_str(), draw.Kind.c_str(), draw.At.X, draw.At.Y, draw.At.Angle, draw.At.Lean,
    draw.At.Size, draw.At.Seed, draw.At.Reversed ? " reversed" : "", draw.Options.CorrectionType,
    draw.Options.Optimization, draw.Options.MinimumScaledJacobian, draw.Options.EliminationFraction,
    draw.Options.Tolerance, draw.Options.InvertSide ? " inverted" : "");
  return text;
}

struct Row
{
  int Trims = 0, Good = 0, Rescued = 0, Left = 0, Warned = 0, Failed = 0;
  double Lowest = 1; ///< scaled Jacobian, with the default floor and treatment
};

/// What became of the trims, by surface and by mesh.
class Outcomes
{
public:
  void Add(const Draw& draw, const Outcome& outcome, const Report& report)
  {
    const auto number = [&outcome](const char* name) { return Number(outcome.Case.Trimmed, name); };
    const bool wedges = outcome.Clean() && draw.Options.CorrectionType != 1 &&
      draw.Options.Optimization == 2 && number("TouchedElements") > 0;
    this->Touched += wedges ? number("TouchedElements") : 0;
    this->Certified += wedges ? number("CertifiedElements") : 0;
    const bool good = report.Failures() == 0;
    for (const std::string& key : { "surface " + draw.Kind, "mesh " + draw.Mesh })
    {
      Row& row = this->Table[key];
      ++row.Trims;
      row.Failed += !good;
      row.Good += good;
      row.Rescued += good && !Rescues(outcome.Case.Trimmed).empty();
      row.Left += good && report.Notes().count(NodesLeftOff) > 0;
      row.Warned += good && !outcome.Warnings.empty();
      if (wedges && draw.Options.MinimumScaledJacobian == 0.2)
      {
        row.Lowest = std::min(row.Lowest, number("MinimumScaledJacobian"));
      }
    }
    for (const auto& check : report.ByCheck())
    {
      ++this->Checks[check.first];
    }
  }

  /// Good: no check failed. Of these, rescued: some rung of the ladder was climbed; left: nodes
  /// are off the surface, and the filter says so; lowest: the worst scaled Jacobian of touched
  /// elements with wedges and the default floor.
  /// @return whether no check failed.
  bool Print() const
  {
    std::printf("\n%-22s %6s %6s %8s %6s %7s %7s %7s\n", "", "trims", "good", "rescued", "left",
      "warned", "failed", "lowest");
    for (const auto& [key, row] : this->Table)
    {
      std::printf("%-22s %6d %6d %8d %6d %7d %7d %7.3f\n", key.c_str(), row.Trims, row.Good,
        row.Rescued, row.Left, row.Warned, row.Failed, row.Lowest);
    }
    std::printf(
      "with wedges: %.0f touched elements, %.0f certified\n", this->Touched, this->Certified);
    for (const auto& check : this->Checks)
    {
      std::printf("failed check: %-40s in %d trims\n", check.first.c_str(), check.second);
    }
    return std::none_of(this->Table.begin(), this->Table.end(),
      [](const auto& row) { return row.second.Failed > 0; });
  }

private:
  double Touched = 0, Certified = 0; ///< elements, with wedges
  std::map<std::string, Row> Table;
  std::map<std::string, int> Checks; ///< trims in which one failed, by its name
};

/// @param tells shows what the filter says of it.
void RunDraw(
  const Draw& draw, const Mesh& mesh, const std::string& name, bool tells, Outcomes& outcomes)
{
  const Surface surface = MakeSurface(draw.Kind, mesh.Box, draw.At);
  Report report(name + " (" + Words(draw) + ")");
  const Outcome outcome = RunAndJudge(mesh, surface, draw.Options, report);
  const std::string rescues = Rescues(outcome.Case.Trimmed);
  if (report.Failures() > 0 && !rescues.empty())
  {
    std::printf("     with %s\n", rescues.c_str());
  }
  if (tells)
  {
    std::printf("%s\n%s\n", Words(draw).c_str(), rescues.c_str());
    for (const std::string& warning : outcome.Warnings)
    {
      std::printf("%s", warning.c_str());
    }
  }
  outcomes.Add(draw, outcome, report);
}
}

int main(int argc, char* argv[])
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 300;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const int only = argc > 3 ? std::atoi(argv[3]) : -1;
  const bool layer = argc > 4 && std::string(argv[4]) == "layer";
  const std::vector<std::string> given(argv + std::min(argc, layer ? 5 : 4), argv + argc);
  const std::vector<std::string> names = given.empty() ? AllMeshNames() : given;
  std::map<std::string, Mesh> meshes;
  try
  {
    for (const std::string& name : names)
    {
      meshes[name] = GetMesh(name);
    }
  }
  catch (const std::invalid_argument& wrong)
  {
    std::printf("%s\n", wrong.what());
    return 2;
  }
  Outcomes outcomes;
  for (int i = 0; i < count; ++i)
  {
    if (only >= 0 && i != only)
    {
      continue;
    }
    Draw draw = DrawTrim(seed, i, names);
    draw.Options.InsertLayer = layer;
    const std::string name =
      "campaign " + std::to_string(count) + " " + std::to_string(seed) + " " + std::to_string(i);
    RunDraw(draw, meshes[draw.Mesh], name, only >= 0, outcomes);
  }
  return !outcomes.Print();
}
