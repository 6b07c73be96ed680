// The filter on a sheet of two layers cut through the middle, against the least a trim can do.
//
// Arguments: number of elements of the main comparison (1000000), largest number of elements of
// the growth and of the memory (10000000), rounds (5), and which parts to run, of the letters
// c (comparison), r (random order), s (surfaces), g (growth), m (memory); all if there is none.
#include "OtherFilters.h"
#include "SheetTrim.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkTrimHexahedralGrid.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <vector>

using namespace benchmark;

namespace
{

/// Seconds on the clock, and of all threads of this process together. The first tell of two threads
/// only where each has a core to itself: with other work on the machine, at real-time priority
/// (chrt -f 10).
struct Seconds
{
  double Wall = 1e300, Processor = 1e300;
};

double SecondsOf(clockid_t clock)
{
  timespec time;
  clock_gettime(clock, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

/// A job to be timed: `Run` returns what is to be destroyed when the clock has stopped.
struct Job
{
  std::string Name;
  int Threads;
  std::function<std::shared_ptr<void>()> Run;
  Seconds Best;
};

void UseThreads(int threads)
{
  vtkSMPTools::SetBackend(threads > 1 ? "STDThread" : "Sequential");
  vtkSMPTools::Initialize(threads);
}

/// The jobs take turns, so that other programs on the machine disturb all alike.
void TakeTurns(std::vector<Job>& jobs, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    for (Job& job : jobs)
    {
      UseThreads(job.Threads);
      const auto start = std::chrono::steady_clock::now();
      const double processor = SecondsOf(CLOCK_PROCESS_CPUTIME_ID);
      const auto made = job.Run();
      const double all = SecondsOf(CLOCK_PROCESS_CPUTIME_ID) - processor;
      job.Best.Processor = std::min(job.Best.Processor, all);
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
      job.Best.Wall = std::min(job.Best.Wall, wall.count());
    }
  }
}

vtkSmartPointer<vtkTrimHexahedralGrid> MakeFilter(
  vtkUnstructuredGrid* grid, vtkPolyData* surface, bool renumber)
{
  auto filter = vtkSmartPointer<vtkTrimHexahedralGrid>::New();
  filter->SetInputDataObject(0, grid);
  filter->SetInputDataObject(1, surface);
  filter->SetRenumberNodes(renumber);
  return filter;
}

std::shared_ptr<void> Hold(vtkSmartPointer<vtkTrimHexahedralGrid> filter)
{
  return std::make_shared<vtkSmartPointer<vtkTrimHexahedralGrid>>(std::move(filter));
}

struct Case
{
  vtkIdType Cells;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  vtkSmartPointer<vtkPolyData> Wave[2];

  Case(vtkIdType cells, bool shuffled)
    : Cells(cells)
    , Grid(MakeSheet(cells, shuffled))
    , Wave{ MakeWave(cells, 0.0), MakeWave(cells, 0.01) }
  {
  }
  /// The same sheet, and waves of so many control points a side.
  Case(const Case& sheet, int control)
    : Cells(sheet.Cells)
    , Grid(sheet.Grid)
    , Wave{ MakeFineWave(sheet.Cells, 0.0, control), MakeFineWave(sheet.Cells, 0.01, control) }
  {
  }

  Job Floor() const
  {
    return { "floor", 1,
      [this]() -> std::shared_ptr<void> {
        return std::make_shared<AnalyticTrim>(
          TrimByPlane(this->Grid, 0.5 * SideOfSheet(this->Cells)));
      },
      {} };
  }

  /// What VTK takes for less, on one thread: tells machines and ways of counting apart.
  std::vector<Job> Others() const
  {
    const double middle = 0.5 * SideOfSheet(this->Cells);
    return { { "deep copy of the grid", 1,
               [this]() -> std::shared_ptr<void> { return CopyGrid(this->Grid); }, {} },
      { "VTK's Extract Cells, 60 % of them", 1,
        [this]() -> std::shared_ptr<void> { return ExtractCells(this->Grid, 0.6); }, {} },
      { "VTK's Clip by a plane", 1,
        [this, middle]() -> std::shared_ptr<void> { return ClipByPlane(this->Grid, middle); },
        {} } };
  }

  /// A filter that has not run before.
  Job First(bool renumber, int threads) const
  {
    return { std::string("first run") + (renumber ? ", renumbered" : ""), threads,
      [this, renumber]()
      {
        auto filter = MakeFilter(this->Grid, this->Wave[0], renumber);
        filter->Update();
        return Hold(filter);
      },
      {} };
  }

  /// One that has, on another surface; the outputs of the run before go within the time.
  Job Again(bool renumber, int threads) const
  {
    auto filter = MakeFilter(this->Grid, this->Wave[0], renumber);
    filter->Update();
    auto next = std::make_shared<int>(1);
    return { std::string("only the surface moved") + (renumber ? ", renumbered" : ""), threads,
      [this, filter, next]()
      {
        filter->SetInputDataObject(1, this->Wave[*next]);
        *next = 1 - *next;
        filter->Update();
        return std::shared_ptr<void>();
      },
      {} };
  }
};

void PrintTable(const std::vector<Job>& jobs)
{
  const Seconds& floor = jobs.front().Best;
  for (const Job& job : jobs)
  {
    std::printf("  %-36s %d thread%c %8.3f s, %5.2f x the floor; processor %8.3f s, %5.2f x\n",
      job.Name.c_str(), job.Threads, job.Threads > 1 ? 's' : ' ', job.Best.Wall,
      job.Best.Wall / floor.Wall, job.Best.Processor, job.Best.Processor / floor.Processor);
  }
}

void CompareWithFloor(vtkIdType cells, bool shuffled, int rounds)
{
  const Case sheet(cells, shuffled);
  std::vector<Job> jobs = { sheet.Floor() };
  for (const int threads : { 1, 2 })
  {
    for (const bool renumber : { false, true })
    {
      UseThreads(threads);
      jobs.push_back(sheet.First(renumber, threads));
      jobs.push_back(sheet.Again(renumber, threads));
    }
  }
  TakeTurns(jobs, rounds);
  // By themselves: a virtual machine takes the memory that Clip gives back, and then the next job
  // pays for getting it again.
  std::vector<Job> others = sheet.Others();
  TakeTurns(others, rounds);
  std::move(others.begin(), others.end(), std::back_inserter(jobs));
  std::printf("%lld elements%s\n", static_cast<long long>(sheet.Grid->GetNumberOfCells()),
    shuffled ? ", nodes and cells in random order" : "");
  PrintTable(jobs);
}

/// By the number of control points; the ratios are those to the fewest.
void MeasureSurfaces(vtkIdType cells, bool shuffled, int rounds)
{
  const Case sheet(cells, shuffled);
  const std::vector<int> controls = { 8, 16, 32, 64, 128, 256 };
  std::vector<std::unique_ptr<Case>> cases;
  std::vector<Job> first, again;
  UseThreads(1);
  for (const int control : controls)
  {
    cases.push_back(std::make_unique<Case>(sheet, control));
    first.push_back(cases.back()->First(false, 1));
    again.push_back(cases.back()->Again(false, 1));
  }
  TakeTurns(first, rounds);
  TakeTurns(again, rounds);
  std::printf("control points a side, %lld elements%s, one thread, processor time\n",
    static_cast<long long>(sheet.Grid->GetNumberOfCells()), shuffled ? " in random order" : "");
  for (std::size_t i = 0; i < controls.size(); ++i)
  {
    std::printf("  %3d: first run %.3f s, %.2f x; only the surface moved %.3f s, %.2f x\n",
      controls[i], first[i].Best.Processor, first[i].Best.Processor / first[0].Best.Processor,
      again[i].Best.Processor, again[i].Best.Processor / again[0].Best.Processor);
  }
}

/// Slope of log time over log size, by least squares.
double Exponent(const std::vector<double>& sizes, const std::vector<double>& seconds)
{
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    x += std::log(sizes[i]);
    y += std::log(seconds[i]);
    xx += std::log(sizes[i]) * std::log(sizes[i]);
    xy += std::log(sizes[i]) * std::log(seconds[i]);
  }
  const double n = static_cast<double>(sizes.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void MeasureGrowth(vtkIdType largest, int rounds)
{
  std::vector<double> sizes;
  std::vector<std::vector<double>> seconds(4);
  std::printf("growth, one thread, processor time\n");
  for (const vtkIdType cells : { 100000, 300000, 1000000, 3000000, 10000000 })
  {
    if (cells > largest)
    {
      break;
    }
    const Case sheet(cells, false);
    UseThreads(1);
    std::vector<Job> jobs = { sheet.Floor(), sheet.First(false, 1), sheet.Again(false, 1),
      sheet.First(true, 1) };
    TakeTurns(jobs, cells > 1000000 ? std::min(rounds, 3) : rounds);
    sizes.push_back(static_cast<double>(cells));
    std::printf("  %9lld elements", static_cast<long long>(cells));
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
      seconds[i].push_back(jobs[i].Best.Processor);
      std::printf("; %s %.3f s", jobs[i].Name.c_str(), jobs[i].Best.Processor);
    }
    std::printf("\n");
  }
  if (sizes.size() > 1)
  {
    std::printf("  exponents: floor %.3f, first run %.3f, surface moved %.3f, renumbered %.3f\n",
      Exponent(sizes, seconds[0]), Exponent(sizes, seconds[1]), Exponent(sizes, seconds[2]),
      Exponent(sizes, seconds[3]));
  }
}

/// Bytes of resident memory by the kernel's account: "VmRSS" now, "VmHWM" at most so far.
double ResidentBytes(const std::string& what)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0;
  while (status >> word)
  {
    if (word == what + ":")
    {
      status >> kilobytes;
    }
  }
  return 1024.0 * kilobytes;
}

/// Bytes of all arrays of a grid that were not counted before.
double ArrayBytes(vtkUnstructuredGrid* grid, std::set<vtkAbstractArray*>& counted)
{
  std::vector<vtkAbstractArray*> arrays = { grid->GetPoints()->GetData(),
    grid->GetCells()->GetOffsetsArray(), grid->GetCells()->GetConnectivityArray(),
    grid->GetCellTypesArray() };
  for (vtkFieldData* data : { static_cast<vtkFieldData*>(grid->GetPointData()),
         static_cast<vtkFieldData*>(grid->GetCellData()) })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      arrays.push_back(data->GetAbstractArray(i));
    }
  }
  double bytes = 0;
  for (vtkAbstractArray* array : arrays)
  {
    if (counted.insert(array).second)
    {
      bytes += static_cast<double>(array->GetNumberOfValues()) * array->GetDataTypeSize();
    }
  }
  return bytes;
}

/// In a process of its own: the high-water mark knows no way back.
void MeasureMemory(vtkIdType cells, bool renumber, bool shuffled, int threads)
{
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0)
  {
    UseThreads(threads);
    const auto grid = MakeSheet(cells, shuffled);
    const auto wave = MakeWave(cells, 0.0);
    std::ofstream("/proc/self/clear_refs") << "5"; // forget what making the sheet took
    const double before = ResidentBytes("VmRSS");
    const auto filter = MakeFilter(grid, wave, renumber);
    filter->Update();
    std::set<vtkAbstractArray*> counted;
    ArrayBytes(grid, counted);
    const double outputs =
      ArrayBytes(vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0)), counted) +
      ArrayBytes(vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(1)), counted);
    const double above = ResidentBytes("VmHWM") - before - outputs;
    std::printf(
      "  %lld elements%s%s, %d thread%s: peak above input and output %.1f bytes an element,"
      " outputs %.1f, kept when done %.1f\n",
      static_cast<long long>(grid->GetNumberOfCells()), shuffled ? " in random order" : "",
      renumber ? ", renumbered" : "", threads, threads > 1 ? "s" : "",
      above / grid->GetNumberOfCells(), outputs / grid->GetNumberOfCells(),
      (ResidentBytes("VmRSS") - before - outputs) / grid->GetNumberOfCells());
    std::fflush(stdout);
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

}

int main(int argc, char* argv[])
{
  const vtkIdType cells = argc > 1 ? std::atoll(argv[1]) : 1000000;
  const vtkIdType largest = argc > 2 ? std::atoll(argv[2]) : 10000000;
  const int rounds = argc > 3 ? std::atoi(argv[3]) : 5;
  const std::string parts = argc > 4 ? argv[4] : "crsgm";
  if (cells < 1 || largest < 1 || rounds < 1)
  {
    std::fprintf(
      stderr, "usage: BenchmarkTrim [elements [largest number of them [rounds [parts]]]]\n");
    return EXIT_FAILURE;
  }
  // Large pieces of memory are fresh each time, for all alike. By itself the C library begins to
  // keep them at some time, which halves the floor.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const auto wanted = [&parts](char part) { return parts.find(part) != std::string::npos; };
  if (wanted('m')) // first: later, this process holds memory of its own
  {
    std::printf("peak memory\n");
    MeasureMemory(largest, false, false, 1);
    MeasureMemory(largest, true, false, 1);
    MeasureMemory(largest, true, false, 2);
    MeasureMemory(largest, true, true, 1);
  }
  if (wanted('c'))
  {
    CompareWithFloor(cells, false, rounds);
  }
  if (wanted('r'))
  {
    CompareWithFloor(cells, true, std::min(rounds, 2));
  }
  if (wanted('s'))
  {
    MeasureSurfaces(cells, false, rounds);
    MeasureSurfaces(cells, true, std::min(rounds, 2));
  }
  if (wanted('g'))
  {
    MeasureGrowth(largest, rounds);
  }
  return 0;
}
