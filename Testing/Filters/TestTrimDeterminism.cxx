/**
 * @file TestTrimDeterminism.cxx
 * @brief The same bits twice, from one filter run again, and with one and several threads.
 *
 * TestTrimDeterminism [small|large]: many small meshes, or few that are large enough for every
 * loop of the filter to be shared out among threads; both if there is no argument.
 */
#include "RunTrim.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkTrimHexahedralGrid.h>
#include <vtkUnstructuredGrid.h>

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

using namespace judge;

namespace
{
int Wrong = 0;

void Compare(const std::string& what, const Outcome& a, const Outcome& b)
{
  const std::string trimmed = FirstDifference(a.Case.Trimmed, b.Case.Trimmed);
  const std::string whole = FirstDifference(a.Case.Whole, b.Case.Whole);
  const std::string offcut = FirstDifference(a.Offcut, b.Offcut);
  if (!trimmed.empty() || !whole.empty() || !offcut.empty())
  {
    std::printf("FAIL %s: port 0 %s, port 1 %s, port 2 %s\n", what.c_str(), trimmed.c_str(),
      whole.c_str(), offcut.c_str());
    ++Wrong;
  }
}

void TestRerun(const Mesh& mesh, const Surface& first, const Surface& second)
{
  // A filter that has run on another surface before gives what a fresh one gives.
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, first.Data);
  filter->Update();
  filter->SetInputDataObject(1, second.Data);
  filter->SetCorrectionType(3);
  filter->Update();
  filter->SetCorrectionType(2);
  filter->SetInputDataObject(1, second.Data);
  filter->Update();
  const Outcome fresh = RunTrim(mesh, second, TrimOptions());
  const std::string difference = FirstDifference(fresh.Case.Trimmed, filter->GetOutput());
  if (!difference.empty())
  {
    std::printf("FAIL rerun on %s: %s\n", mesh.Name.c_str(), difference.c_str());
    ++Wrong;
  }
}

/// A filter that has run on a much larger grid before, for which two planes near each other are one
/// that is there twice, sees both on a small one, as a fresh one does.
void TestRerunOnSmallerGrid()
{
  const Mesh large = Sheet(20, 20, 1, Vec3(100, 100, 10)), small = Sheet(20, 20, 1, Vec3(1, 1, 1));
  const Surface one = PlaneThrough(Vec3(0.3, 0, 0), Vec3::UnitX(), 4000);
  const Surface turned = PlaneThrough(Vec3(0.31, 0, 0), -Vec3::UnitX(), 4000);
  const Surface twice = Together(one.Data, turned.Data);
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(1, twice.Data);
  const Listener listener;
  for (const Mesh& mesh : { large, small })
  {
    filter->SetInputDataObject(0, mesh.Grid);
    filter->Update();
  }
  const Outcome fresh = RunTrim(small, twice, TrimOptions());
  const std::string difference = FirstDifference(fresh.Case.Trimmed, filter->GetOutput());
  const bool sawBoth = fresh.Case.Trimmed->GetNumberOfCells() == small.Grid->GetNumberOfCells();
  if (!difference.empty() || !sawBoth)
  {
    std::printf("FAIL rerun on a smaller grid: %s; both planes %s seen\n", difference.c_str(),
      sawBoth ? "were" : "were not");
    ++Wrong;
  }
}

/// The backends that are active while the filter runs, by its progress.
std::set<std::string> BackendsDuring(const Mesh& mesh, const Surface& surface)
{
  std::set<std::string> backends;
  vtkNew<vtkCallbackCommand> listener;
  listener->SetClientData(&backends);
  listener->SetCallback([](vtkObject*, unsigned long, void* seen, void*)
    { static_cast<std::set<std::string>*>(seen)->insert(vtkSMPTools::GetBackend()); });
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  filter->AddObserver(vtkCommand::ProgressEvent, listener);
  filter->Update();
  return backends;
}

// Threads by default, for the time of the filter only, and never against a choice.
void TestChoiceOfBackend()
{
  const Mesh mesh = MakeMesh("sheet2");
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  const auto expect = [&](const std::string& what, const std::string& during)
  {
    // The executive reports the beginning and the end, where nothing is changed yet or any more.
    const std::set<std::string> expected{ "Sequential", during };
    if (BackendsDuring(mesh, surface) != expected ||
      std::string(vtkSMPTools::GetBackend()) != "Sequential")
    {
      std::printf("FAIL %s: not %s during the trim, or %s after it\n", what.c_str(), during.c_str(),
        vtkSMPTools::GetBackend());
      ++Wrong;
    }
  };
  vtkSMPTools::SetBackend("Sequential");
  vtkSMPTools::Initialize(2);
  expect("default", "STDThread");
  if (vtkSMPTools::GetEstimatedNumberOfThreads() != 1)
  {
    std::printf("FAIL the sequential backend has several threads after the trim\n");
    ++Wrong;
  }
  vtkSMPTools::Initialize(1);
  expect("one thread allowed", "Sequential");
  vtkSMPTools::Initialize(2);
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);
  expect("chosen by the environment", "Sequential");
  unsetenv("VTK_SMP_BACKEND_IN_USE");
}

/// The same elements, each numbered from another node on: round, and in turn upside down.
vtkSmartPointer<vtkUnstructuredGrid> NumberOtherwise(vtkUnstructuredGrid* grid)
{
  auto other = vtkSmartPointer<vtkUnstructuredGrid>::New();
  other->SetPoints(grid->GetPoints());
  other->Allocate(grid->GetNumberOfCells());
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, nodes);
    const auto corners = static_cast<int>(nodes->GetNumberOfIds()) / 2;
    std::vector<vtkIdType> numbered(2 * corners);
    for (int i = 0; i < corners; ++i)
    {
      const bool turned = c % 2 != 0;
      const int from = static_cast<int>(c % 7);
      const int corner = (turned ? from + 2 * corners - i : from + i) % corners;
      numbered[i] = nodes->GetId(turned ? corner + corners : corner);
      numbered[i + corners] = nodes->GetId(turned ? corner : corner + corners);
    }
    other->InsertNextCell(grid->GetCellType(c), 2 * corners, numbered.data());
  }
  return other;
}

/// How elements are numbered decides nothing about them.
void TestNumberingOfElements()
{
  for (const char* meshName : { "sheet2", "perturbed", "block", "wedges", "dome" })
  {
    Mesh mesh = MakeMesh(meshName), other = mesh;
    other.Grid = NumberOtherwise(mesh.Grid);
    for (const char* kind : { "wavy", "contour", "cone" })
    {
      const Surface surface = MakeSurface(kind, mesh.Box, Placement());
      const Outcome a = RunTrim(mesh, surface, TrimOptions());
      const Outcome b = RunTrim(other, surface, TrimOptions());
      vtkDataArray* fractions = a.Case.Whole->GetCellData()->GetArray("EliminatedFraction");
      vtkDataArray* others = b.Case.Whole->GetCellData()->GetArray("EliminatedFraction");
      int different = 0, cut = 0;
      for (vtkIdType c = 0; c < fractions->GetNumberOfTuples(); ++c)
      {
        const double share = fractions->GetComponent(c, 0);
        cut += share > 0 && share < 1;
        different += share != others->GetComponent(c, 0);
      }
      if (cut == 0 || different > 0)
      {
        std::printf("FAIL %s %s: %d of %d shares depend on the numbering of the elements\n",
          meshName, kind, different, cut);
        ++Wrong;
      }
    }
  }
}

/// One thread twice, and against others.
void CompareThreads(const std::string& name, const Mesh& mesh, const Surface& surface,
  const TrimOptions& options, const std::vector<int>& numbers)
{
  vtkSMPTools::SetBackend("Sequential");
  vtkSMPTools::Initialize(1);
  const Outcome one = RunTrim(mesh, surface, options);
  if (!one.Clean())
  {
    std::printf("FAIL %s: %s\n", name.c_str(), one.Errors[0].c_str());
    ++Wrong;
  }
  Compare(name + " twice", one, RunTrim(mesh, surface, options));
  if (!vtkSMPTools::SetBackend("STDThread"))
  {
    std::printf("FAIL no STDThread backend\n");
    ++Wrong;
  }
  for (const int threads : numbers)
  {
    vtkSMPTools::Initialize(threads);
    Compare(name + " threads " + std::to_string(threads), one, RunTrim(mesh, surface, options));
  }
  vtkSMPTools::SetBackend("Sequential");
}

void TestSmall()
{
  for (const char* meshName : { "sheet2", "permuted", "irregular", "block", "cup", "wedges" })
  {
    const Mesh mesh = MakeMesh(meshName);
    for (const char* kind : { "wavy", "contour", "roundrect" })
    {
      const Surface surface = MakeSurface(kind, mesh.Box, Placement());
      TrimOptions options;
      options.Optimization = 1;
      CompareThreads(std::string(meshName) + " " + kind, mesh, surface, options, { 1, 2, 5 });
    }
    Placement other;
    other.X = -0.3;
    TestRerun(
      mesh, MakeSurface("plane", mesh.Box, other), MakeSurface("scurve", mesh.Box, Placement()));
  }
}

// Elements below what is aimed at: other corrections and fates are tried, several at once.
void TestTrials()
{
  for (const char* meshName : { "tee", "cup" })
  {
    const Mesh mesh = MakeMesh(meshName);
    for (const double x : { -0.3, 0.2 })
    {
      Placement at;
      at.X = x;
      at.Size = 0.5;
      at.Lean = 0.3;
      for (const char* kind : { "torus", "sphere" })
      {
        CompareThreads(std::string(meshName) + " " + kind + " at " + std::to_string(x), mesh,
          MakeSurface(kind, mesh.Box, at), TrimOptions(), { 2, 5 });
      }
    }
  }
}

// Many nodes are left: which of them find room is foreseen by all threads, of several nodes at
// once.
void TestReturns()
{
  const Mesh mesh = Block(12, 12, 12);
  Placement at;
  at.Lean = 0.5;
  const TrimOptions options;
  const Surface surface = MakeSurface("plane", mesh.Box, at);
  CompareThreads("nodes left", mesh, surface, options, { 2, 3 });
  const int left = CountLeft(RunTrim(mesh, surface, options).Case.Trimmed);
  if (left < 20)
  {
    std::printf("FAIL only %d nodes left\n", left);
    ++Wrong;
  }
}

void TestLarge()
{
  for (const bool permuted : { false, true })
  {
    MeshOptions numbering;
    numbering.Permuted = permuted;
    // More than 100 000 elements, the largest share of a thread.
    const Mesh mesh = Sheet(260, 200, 2, Vec3(1, 1, 0.4), numbering);
    TrimOptions options;
    options.ProduceOffcut = permuted;
    CompareThreads(permuted ? "large, permuted" : "large", mesh,
      MakeSurface("wavy", mesh.Box, Placement()), options, { 2, 5 });
  }
}

// Cut aslant to all elements: hundreds of nodes of a block are relaxed at once, in the order of one
// thread; a cut through three islands is decided in each, side by side.
void TestAslant()
{
  Placement at;
  at.Lean = 0.35;
  for (const Mesh& mesh : { Block(16, 16, 16), Islands(16, 4) })
  {
    at.Angle = mesh.Sheet ? 1.6 : 0.5;
    for (const bool layer : { false, true })
    {
      TrimOptions options;
      options.InsertLayer = layer;
      CompareThreads(mesh.Name + (layer ? " aslant, with a layer" : " aslant"), mesh,
        MakeSurface("plane", mesh.Box, at), options, { 2, 5 });
    }
  }
}
}

int main(int argc, char* argv[])
{
  const std::string part = argc > 1 ? argv[1] : "";
  if (part != "large")
  {
    TestChoiceOfBackend();
    TestRerunOnSmallerGrid();
    TestSmall();
    TestTrials();
    TestNumberingOfElements();
  }
  if (part != "small")
  {
    TestLarge();
    TestAslant();
    TestReturns();
  }
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
