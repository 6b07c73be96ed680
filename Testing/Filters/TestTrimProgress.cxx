/**
 * @file TestTrimProgress.cxx
 * @brief The filter says how far it is, and ends when it is told to.
 */
#include "Expect.h"
#include "NURBSFieldData.h"
#include "NodeClassification.h"
#include "RunTrim.h"
#include "SharedNodes.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkTrimHexahedralGrid.h>

#include <cstdio>

using namespace judge;

namespace
{
// Aborted at the first progress event: an empty output or a whole one, no crash, and the
// filter works afterwards.
void TestAbort()
{
  const Mesh mesh = Sheet(80, 80, 2, Vec3(1, 1, 0.4));
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      ++*static_cast<int*>(data);
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    });
  int events = 0;
  stop->SetClientData(&events);
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  Expect(events > 0, "abort: no progress event");
  Expect(output->GetNumberOfCells() == 0 && output->GetNumberOfPoints() == 0,
    "abort: the output is not empty");
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(0));
  Expect(output->GetNumberOfCells() > 0, "abort: nothing comes out afterwards");
}

// Tells a filter to end when it has been asked so many times whether it should.
class Stopper
{
public:
  Stopper(vtkTrimHexahedralGrid* filter, int after)
    : Filter(filter)
    , Left(after)
  {
    vtkNew<vtkCallbackCommand> stop;
    stop->SetCallback(
      [](vtkObject* caller, unsigned long, void* data, void*)
      {
        if (--static_cast<Stopper*>(data)->Left < 0)
        {
          static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
        }
      });
    stop->SetClientData(this);
    this->Tag = filter->AddObserver(vtkCommand::AbortCheckEvent, stop);
  }
  ~Stopper()
  {
    this->Filter->RemoveObserver(this->Tag);
    this->Filter->SetAbortExecute(0);
    this->Filter->Modified();
  }
  bool HasStopped() const { return this->Left < 0; }

private:
  vtkTrimHexahedralGrid* Filter;
  int Left;
  unsigned long Tag;
};

// Aborted wherever it asks, with the parts that are made one after the other: the outputs are
// empty, and there is no crash.
void TestAbortAnywhere(bool offcut)
{
  const Mesh mesh = Sheet(8, 8, 2, Vec3(1, 1, 0.4));
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  filter->SetMinimumScaledJacobian(0.9);
  filter->SetProduceOffcut(offcut);
  filter->SetInsertLayer(!offcut);
  int stops = 0;
  bool stopped = true;
  for (int after = 0; stopped; after += 1 + after / 4)
  {
    const Stopper stopper(filter, after);
    filter->Update();
    stopped = stopper.HasStopped();
    stops += stopped;
    for (int port = 0; stopped && port < 3; ++port)
    {
      auto* output = vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(port));
      Expect(output->GetNumberOfCells() == 0, "abort anywhere: an output is not empty");
    }
  }
  Expect(stops > 15, "abort anywhere: the filter hardly asks");
}

// Once work is to end the classification ends too, without an error or a guess.
void TestAbortOfClassification()
{
  const Mesh mesh = Sheet(80, 80, 2, Vec3(1, 1, 0.4));
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  trim::HexMesh view;
  std::string error;
  std::vector<nurbs::NurbsSurface> faces;
  Expect(trim::ViewGrid(mesh.Grid, view, error) &&
      nurbs::ReadTrimmingSurface(surface.Data, faces, error),
    "abort of classification: " + error);
  const nurbs::TrimmingSurface trimming(std::move(faces), 0.0);
  const trim::MeshBlocks blocks = trim::BuildMeshBlocks(view);
  const auto everywhere = trim::FindRuns(blocks, [](const nurbs::Box3&) { return true; });
  const trim::Ranks alone;
  const trim::SharedNodes none;
  for (const bool stop : { false, true })
  {
    trim::NodeClassification nodes;
    const bool done = trim::ClassifyNodes(
      view, blocks, everywhere, { alone, none, {} }, trimming, 1e-9, [stop] { return stop; }, nodes,
      error);
    Expect(done != stop && error.empty(), "abort of classification: goes on, or an error");
  }
}

void TestProgress()
{
  const Mesh mesh = Sheet(40, 40, 2, Vec3(1, 1, 0.4));
  const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
  vtkNew<vtkTrimHexahedralGrid> filter;
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  vtkNew<vtkCallbackCommand> listen;
  std::vector<double> seen;
  listen->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      static_cast<std::vector<double>*>(data)->push_back(
        static_cast<vtkAlgorithm*>(caller)->GetProgress());
    });
  listen->SetClientData(&seen);
  filter->AddObserver(vtkCommand::ProgressEvent, listen);
  filter->Update();
  bool rises = seen.size() >= 4;
  for (std::size_t i = 1; i < seen.size(); ++i)
  {
    rises = rises && seen[i] >= seen[i - 1] && seen[i] <= 1;
  }
  Expect(rises, "progress: fewer than four events, or it falls");
}
}

int main()
{
  TestProgress();
  TestAbort();
  TestAbortAnywhere(true);
  TestAbortAnywhere(false);
  TestAbortOfClassification();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
