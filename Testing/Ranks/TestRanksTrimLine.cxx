/**
 * A trim line whose sheet lies in pieces: all ranks sweep it alike, as if the sheet were whole; and
 * a rank that cannot read the line's file does not leave the others waiting.
 */
#include "Meshes.h"
#include "Pieces.h"
#include "ThreadRanks.h"
#include "vtkTrimLineSource.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <iostream>

using namespace judge;

namespace
{
int Failures = 0;

void Check(bool holds, const std::string& what)
{
  if (!holds)
  {
    ++Failures;
    std::cerr << "FAILED: " << what << "\n";
  }
}

/// Direction and length of the sweep; zeros if there is none.
using Used = std::array<double, 4>;

Used Sweep(vtkUnstructuredGrid* sheet, vtkMultiProcessController* ranks, const char* file = nullptr)
{
  vtkNew<vtkTrimLineSource> source;
  source->SetController(ranks);
  source->SetInputData(sheet);
  source->SetFileName(file);
  source->SetNumberOfPoints(0);
  source->SetPoint(0, 3, -2, 0.2);
  source->SetPoint(1, 5, 4, 0.2);
  source->SetPoint(2, 4, 20, 0.2);
  source->Update();
  Used used{};
  vtkFieldData* data = source->GetOutput()->GetFieldData();
  if (data->HasArray("Direction"))
  {
    data->GetArray("Direction")->GetTuple(0, used.data());
    used[3] = data->GetArray("Length")->GetTuple1(0);
  }
  return used;
}

std::vector<Used> SweepPieces(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces,
  const std::vector<const char*>& files)
{
  const int count = static_cast<int>(pieces.size());
  const auto ranks = MakeThreadRanks(count);
  std::vector<Used> used(pieces.size());
  RunRanks(count, [&](int rank) { used[rank] = Sweep(pieces[rank], ranks[rank], files[rank]); });
  return used;
}
}

int main()
{
  MeshOptions options;
  options.Data = false;
  const Mesh mesh = Sheet(12, 16, 2, Vec3(1, 1, 0.2), options);
  const auto whole = WithWholeIds(mesh.Grid);
  const Used expected = Sweep(whole, nullptr);
  Check(expected[3] > 0.0, "the whole sheet");
  for (const std::string& partition : PartitionNames())
  {
    const auto pieces = Divide(mesh, whole, partition, 3);
    const std::vector<Used> used = SweepPieces(pieces, { nullptr, nullptr, nullptr });
    // Where every cell is on a rank of its own its sides count as skin.
    const double tolerance = partition == "scattered" || partition == "ids" ? 0.05 : 1e-12;
    for (const Used& found : used)
    {
      Check(found == used[0], partition + ": ranks differ");
      for (int i = 0; i < 4; ++i)
      {
        Check(std::abs(found[i] - expected[i]) < tolerance,
          partition + ": not as with the whole, off by " + std::to_string(found[i] - expected[i]));
      }
    }
  }
  const auto pieces = Divide(mesh, whole, "slabs", 3);
  const Listener listener;
  for (const Used& found : SweepPieces(pieces, { nullptr, "/nowhere/line.csv", nullptr }))
  {
    Check(found[3] == 0.0, "a line that not all ranks have");
  }
  Check(listener.Errors().size() == 1 &&
      listener.Errors()[0].find("/nowhere/line.csv") != std::string::npos &&
      listener.Errors()[0].find("on rank 1") != std::string::npos,
    "a line that not all ranks have: " + std::to_string(listener.Errors().size()) +
      " errors, not one that names the file and the rank");
  return Failures != 0;
}
