#include "TrimVerdict.h"

#include "ProcessState.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>

namespace fuzz
{
namespace
{
/// Longest time for one trim, seconds of wall clock: the machine may be busy.
constexpr unsigned Patience = 120;
/// One that takes longer is named.
constexpr double Slow = 5;

/// The first words of what an error says after the class and address, without numbers.
std::string ShortForm(const std::string& message)
{
  const size_t colon = message.find("): ");
  std::string words = message.substr(colon == std::string::npos ? 0 : colon + 3);
  words = words.substr(0, words.find('\n'));
  std::string text;
  for (char c : words)
  {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit || text.empty() || text.back() != '#')
    {
      text.push_back(digit ? '#' : c);
    }
  }
  return "error: " + text.substr(0, 26);
}

void CheckRefusal(const judge::Outcome& outcome, judge::Report& report)
{
  if (outcome.Errors.size() > 1)
  {
    report.Fail("one error", outcome.Errors[0] + " and " + outcome.Errors[1]);
  }
  for (vtkUnstructuredGrid* output : { outcome.Case.Trimmed.Get(), outcome.Case.Whole.Get() })
  {
    if (output->GetNumberOfPoints() > 0 || output->GetNumberOfCells() > 0)
    {
      report.Fail("empty output with an error", outcome.Errors[0]);
    }
  }
}

void CheckFinite(const judge::Outcome& outcome, judge::Report& report)
{
  vtkUnstructuredGrid* grid = outcome.Case.Trimmed;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    if (!judge::Vec3(grid->GetPoint(i)).allFinite())
    {
      report.Fail("finite points", "point " + std::to_string(i));
    }
  }
}

void CheckResult(const judge::Outcome& outcome, judge::Report& report)
{
  judge::CheckArrays(outcome.Case, report);
  CheckFinite(outcome, report);
  const judge::Evidence evidence(outcome.Case, report);
  if (!evidence.Usable)
  {
    return;
  }
  judge::CheckCarriedArrays(evidence, report);
  const bool unrepaired = std::any_of(outcome.Warnings.begin(), outcome.Warnings.end(),
    [](const std::string& text) { return text.find("beyond repair") != std::string::npos; });
  if (!unrepaired)
  {
    judge::CheckElements(evidence, report);
  }
}

std::string Classify(const judge::Outcome& outcome)
{
  if (!outcome.Errors.empty())
  {
    return ShortForm(outcome.Errors[0]);
  }
  return outcome.Warnings.empty() ? "trimmed" : "trimmed, with a warning";
}
}

const std::vector<judge::Mesh>& SmallMeshes()
{
  static const std::vector<judge::Mesh> meshes = []
  {
    judge::MeshOptions odd;
    odd.Permuted = true;
    odd.Short = true;
    odd.Float = true;
    return std::vector<judge::Mesh>{ judge::Sheet(8, 6, 2, judge::Vec3(1, 1, 0.4)),
      judge::Sheet(7, 7, 1, judge::Vec3(1, 0.9, 0.3), odd), judge::Block(5, 4, 4),
      judge::SheetWithWedges(8, 6, 2), judge::Irregular(3, 2), judge::Cup(2, 1) };
  }();
  return meshes;
}

int TrimAndJudge(const judge::Mesh& mesh, const judge::Surface& surface,
  const judge::TrimOptions& options, const std::string& kind, const std::string& name, Tally& tally)
{
  judge::Report report(name);
  Watch(name, Patience);
  const double before = Now();
  const judge::Outcome outcome = judge::RunTrim(mesh, surface, options);
  const double seconds = Now() - before;
  tally.Add(kind, Classify(outcome), seconds);
  if (seconds > Slow)
  {
    std::printf("slow %s: %.1f s\n", name.c_str(), seconds);
  }
  if (outcome.Errors.empty())
  {
    CheckResult(outcome, report);
  }
  else
  {
    CheckRefusal(outcome, report);
  }
  Unwatch();
  return report.Failures();
}

int RunSeries(int argc, char* argv[], int defaultCount, const std::string& things,
  const std::function<Trial(Random&)>& make)
{
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const int count = argc > 1 ? std::atoi(argv[1]) : defaultCount;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  const int step = argc > 4 ? std::max(1, std::atoi(argv[4])) : 1;
  Tally tally;
  int failures = 0;
  int done = 0;
  const double start = Now();
  for (int i = first; i < count && !IsStopped(); i += step, ++done)
  {
    Random random(seed, static_cast<unsigned>(i));
    const Trial trial = make(random);
    judge::TrimOptions options;
    options.CorrectionType = 1 + static_cast<int>(random.Below(3));
    options.Optimization = static_cast<int>(random.Below(3));
    options.InvertSide = random.OneIn(2);
    const std::string name = things + " " + std::to_string(i) + " of seed " + std::to_string(seed) +
      " (" + trial.What + ")";
    failures += TrimAndJudge(trial.Mesh, trial.Surface, options, trial.Kind, name, tally) > 0;
  }
  tally.Print();
  std::printf("%.1f s, %d of %d %ss failed\n", Now() - start, failures, done, things.c_str());
  return failures > 0;
}

judge::Surface SoundSurface(const judge::Mesh& mesh, double mostLean, Random& random)
{
  judge::Placement at;
  at.X = random.Between(-0.6, 0.6);
  at.Y = random.Between(-0.6, 0.6);
  at.Angle = random.Between(0, 6);
  at.Lean = mostLean > 0 && !random.OneIn(2) ? random.Between(0, mostLean) : 0;
  at.Seed = static_cast<unsigned>(random.Below(1000));
  return judge::MakeSurface(random.Pick(judge::SurfaceKinds()), mesh.Box, at);
}
}
