/**
 * @file FuzzFiles.cxx
 * @brief Damaged IGES and STEP files through vtkCADSurfaceReader: each gives surfaces that the
 * kernel accepts, or one error; nothing crashes, hangs, leaks or is printed.
 *
 * FuzzFiles [count [seed [first [step]]]]: files first, first + step, ... below count, so that
 * several processes can share a series. `FuzzFiles 812 7 811` repeats file 811 of seed 7 alone.
 */
#include "Mutation.h"
#include "ProcessState.h"
#include "ReadTesting.h"
#include "Samples.h"
#include "Tally.h"

#include "SurfaceGaps.h"
#include "TrimmingSurface.h"

#include "vtkMultiBlockDataSet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <unistd.h>

using nurbs::NurbsSurface;
using nurbs::Vec3;

namespace
{
/// Longest time for one file, seconds of wall clock: the machine may be busy.
constexpr unsigned Patience = 300;
/// Processor seconds that the reader gives a file here: OpenCASCADE turns in circles on many, and
/// the reader's own limit would be most of the time of a series.
constexpr double TimeLimit = 1;
/// What the process may grow by while it reads all files, megabytes: allocators keep some.
constexpr double Growth = 60;

/// The part of a message by which it is counted.
std::string Outcome(const ReadResult& result)
{
  if (result.Errors.empty())
  {
    return result.Warnings.empty() ? "surfaces" : "surfaces, some left out";
  }
  static const std::vector<const char*> parts = { "is cut short", "neither IGES nor STEP",
    "content cannot be read", "no surface", "are left out", "weight", "OpenCASCADE crash",
    "too long", "too much memory", "OpenCASCADE reports", "is empty", "compressed" };
  for (const char* part : parts)
  {
    if (result.Errors[0].find(part) != std::string::npos)
    {
      return std::string("error: ") + part;
    }
  }
  return "error: other";
}

/// One message line: VTK puts two line ends behind it.
bool IsOneLine(const std::string& message)
{
  const size_t colon = message.find("): ");
  return colon != std::string::npos && message.find('\n', colon) + 2 >= message.size();
}

/// Of all faces' sizes the middle one.
double MiddleSize(const std::vector<NurbsSurface>& surfaces)
{
  std::vector<double> sizes;
  for (const NurbsSurface& surface : surfaces)
  {
    sizes.push_back(BoxOf(surface).diagonal().norm());
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

/// The kernel takes the surfaces and answers with finite numbers. The grid that they would trim is
/// taken to be as large as a face: a damaged place can be 1e9 away, and by the size of the whole
/// all other faces would lie in one gap.
bool KernelAccepts(const std::vector<NurbsSurface>& surfaces)
{
  nurbs::Box3 box;
  for (const NurbsSurface& surface : surfaces)
  {
    box.extend(BoxOf(surface));
  }
  const double size = nurbs::SizeForGaps(box.diagonal().norm(), MiddleSize(surfaces));
  const nurbs::TrimmingSurface model(surfaces, 0.1 * nurbs::GapShare * size);
  bool good = true;
  for (const double share : { 0.1, 0.45, 0.8 })
  {
    const Vec3 place = box.min() + share * box.diagonal();
    const nurbs::Foot foot = model.ClosestPoint(place);
    good = good && foot.Point.allFinite() && std::isfinite(foot.Distance) && foot.Face >= 0;
    for (const nurbs::LineHit& hit : model.Intersect(place, box.max() + 0.1 * box.diagonal()))
    {
      good = good && hit.Point.allFinite();
    }
  }
  return good;
}

void CheckResult(const ReadResult& result, const std::string& path, const std::string& name)
{
  CHECK(result.Errors.size() <= 1, name << ": " << result.Errors.size() << " errors");
  CHECK(result.Warnings.size() <= 1, name << ": " << result.Warnings.size() << " warnings");
  CHECK(result.Errors.empty() || result.Warnings.empty(), name << ": an error and a warning");
  CHECK(result.Errors.empty() == (result.Output->GetNumberOfBlocks() > 0),
    name << ": either an error or surfaces");
  for (const auto* list : { &result.Errors, &result.Warnings })
  {
    for (const std::string& message : *list)
    {
      CHECK(IsOneLine(message), name << ": more than one line: " << message);
      CHECK(
        message.find(path) != std::string::npos, name << ": the file is not named: " << message);
    }
  }
  for (const NurbsSurface& surface : result.Surfaces)
  {
    const std::string defect = nurbs::FindDefect(surface);
    CHECK(defect.empty(), name << ": " << defect);
  }
  CHECK(
    result.Surfaces.empty() || KernelAccepts(result.Surfaces), name << ": the kernel's answers");
}

/// The files before they are damaged are read without a word.
void CheckSamples(const std::vector<fuzz::Sample>& samples, const std::string& path)
{
  for (const fuzz::Sample& sample : samples)
  {
    WriteText(path, sample.Text);
    const ReadResult result = ReadFile(path);
    CHECK(!result.Surfaces.empty() && result.Errors.empty() && result.Warnings.empty(),
      sample.Name << " itself: "
                  << (result.Errors.empty() ? std::string("no surface, or a warning")
                                            : result.Errors[0]));
  }
}
}

int main(int argc, char* argv[])
{
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const int count = argc > 1 ? std::atoi(argv[1]) : 2000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  const int step = argc > 4 ? std::atoi(argv[4]) : 1;
  const std::string path = OutputPath("fuzz-" + std::to_string(getpid()) + ".cad");
  const std::vector<fuzz::Sample> samples = fuzz::CadSamples(READ_TEST_OUTPUT);
  CheckSamples(samples, path);

  const int openFiles = fuzz::OpenFiles();
  double resident = 0;
  int files = 0;
  fuzz::Tally tally;
  const double start = fuzz::Now();
  for (int i = first; i < count && !fuzz::IsStopped(); i += step, ++files)
  {
    fuzz::Random random(seed, static_cast<unsigned>(i));
    const fuzz::Sample& sample = random.Pick(samples);
    const fuzz::Mutation mutation = fuzz::Mutate(sample.Text, sample.Iges, random);
    const std::string name = "file " + std::to_string(i) + " of seed " + std::to_string(seed) +
      " (" + sample.Name + ", " + mutation.Kind + ")";
    WriteText(path, mutation.Text);
    fuzz::Watch(name, Patience);
    const double before = fuzz::Now();
    const ReadResult result = ReadFile(path, 0, TimeLimit);
    CheckResult(result, path, name);
    tally.Add(mutation.Kind, Outcome(result), fuzz::Now() - before);
    CHECK(fuzz::HasNoChildren(), name << " leaves a child process");
    CHECK(fuzz::OpenFiles() == openFiles, name << " leaves files open");
    // The first hundreds fill the allocator's stores.
    resident = files == 300 ? fuzz::ResidentMegabytes() : resident;
  }
  fuzz::Unwatch();
  const double seconds = fuzz::Now() - start;
  tally.Print();
  std::printf("%d files, seed %u, %.1f s, %.2f ms a file, memory grew by %.1f MB, %d failures\n",
    files, seed, seconds, 1e3 * seconds / std::max(1, files),
    resident > 0 ? fuzz::ResidentMegabytes() - resident : 0.0, Failures);
  CHECK(resident == 0 || fuzz::ResidentMegabytes() - resident < Growth, "memory grows");
  std::remove(path.c_str());
  return Failures != 0;
}
