#include "StatusArrays.h"

#include "Status.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

template <typename Array>
vtkNew<Array> MakeArray(const char* name, Id tuples, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// Tuple in the output of each moved point, by binary search over ascending or permuted ids.
template <typename Action>
void ForMovedPoints(const TrimResult& result, const std::vector<Id>& ids, const Action& action)
{
  const auto moved = MovedBandNodes(result);
  if (moved.empty())
  {
    return;
  }
  const auto& band = result.Near->Mesh;
  std::vector<int> bandNode(result.Nodes.Status.size(), -1);
  for (const int n : moved)
  {
    if (band.GlobalNode[n] >= 0)
    {
      bandNode[band.GlobalNode[n]] = n;
    }
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (bandNode[ids[i]] >= 0)
    {
      action(static_cast<Id>(i), bandNode[ids[i]]);
    }
  }
}

}

std::vector<int> MovedBandNodes(const TrimResult& result)
{
  std::vector<int> moved;
  if (!result.Near)
  {
    return moved;
  }
  const auto& near = *result.Near;
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (users[n] > 0 && near.Trimmed.NodeMoves.Applied[n] != Correction::None)
    {
      moved.push_back(n);
    }
  }
  return moved;
}

void AddPointStatuses(const TrimResult& result, const std::vector<Id>& ids, vtkPointData* pointData)
{
  const Id count = static_cast<Id>(ids.size());
  auto status = MakeArray<vtkUnsignedCharArray>("NodeStatus", count);
  auto distance = MakeArray<vtkFloatArray>("SignedDistance", count);
  auto displacement = MakeArray<vtkFloatArray>("Displacement", count, 3);
  auto correction = MakeArray<vtkUnsignedCharArray>("CorrectionApplied", count);
  unsigned char* statuses = status->GetPointer(0);
  float* distances = distance->GetPointer(0);
  for (Id i = 0; i < count; ++i)
  {
    statuses[i] = result.Nodes.Status[ids[i]];
    distances[i] = result.Nodes.SignedDistance[ids[i]];
  }
  float* moves = displacement->GetPointer(0);
  unsigned char* corrections = correction->GetPointer(0);
  std::fill_n(moves, 3 * count, 0.0f);
  std::fill_n(corrections, count, static_cast<unsigned char>(0));
  ForMovedPoints(result, ids,
    [&](Id tuple, int node)
    {
      const auto& near = *result.Near;
      const Vec3 move = near.Trimmed.NodeMoves.Position[node] - near.Mesh.Point[node];
      for (int i = 0; i < 3; ++i)
      {
        moves[3 * tuple + i] = static_cast<float>(move[i]);
      }
      corrections[tuple] = static_cast<unsigned char>(near.Trimmed.NodeMoves.Applied[node]);
    });
  pointData->AddArray(status);
  pointData->AddArray(distance);
  pointData->AddArray(displacement);
  pointData->AddArray(correction);
}

void AddCellStatuses(const TrimResult& result, const std::vector<Id>& ids, vtkCellData* cellData)
{
  const Id count = static_cast<Id>(ids.size());
  auto status = MakeArray<vtkUnsignedCharArray>("ElementStatus", count);
  auto fraction = MakeArray<vtkFloatArray>("EliminatedFraction", count);
  unsigned char* statuses = status->GetPointer(0);
  float* fractions = fraction->GetPointer(0);
  for (Id i = 0; i < count; ++i)
  {
    statuses[i] = result.ElementStatus[ids[i]];
    fractions[i] = statuses[i] == ElementEliminate ? 1.0f : 0.0f;
  }
  if (result.Near)
  {
    const auto& near = *result.Near;
    std::vector<std::pair<Id, float>> treated;
    for (const int e : near.Mesh.ElementsByCell())
    {
      const Id cell = near.Mesh.Elements[e].Global;
      if (result.ElementStatus[cell] == ElementToTreat)
      {
        treated.emplace_back(cell, static_cast<float>(near.Shares.Element[e]));
      }
    }
    // Both lists ascend: the cells of every output are in the order of the input.
    auto next = treated.begin();
    for (Id i = 0; i < count && next != treated.end(); ++i)
    {
      while (next != treated.end() && next->first < ids[i])
      {
        ++next;
      }
      if (next != treated.end() && next->first == ids[i])
      {
        fractions[i] = next->second;
      }
    }
  }
  cellData->AddArray(status);
  cellData->AddArray(fraction);
}

}
