#include "StatusArrays.h"

#include "ArrayNames.h"
#include "Rescue.h"
#include "Runs.h"
#include "SparseArray.h"
#include "Status.h"
#include "Team.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// Points or cells for a thread at a time.
constexpr Id Grain = 30000;

/// The nodes in use that were moved, and not back to where they were.
template <typename Flags>
MovedNodes Collect(const Band& band, const Moves& moves, const Flags& used)
{
  MovedNodes moved;
  moved.NodeMoves = &moves;
  moved.TheBand = &band;
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    const bool isElsewhere = band.IsInsertedNode(n) || moves.Position[n] != band.Point[n];
    if (used[n] && moves.Applied[n] != Correction::None && isElsewhere)
    {
      moved.Nodes.push_back(n);
    }
  }
  std::sort(moved.Nodes.begin(), moved.Nodes.end(),
    [&band](int a, int b) { return band.GlobalNode[a] < band.GlobalNode[b]; });
  return moved;
}

}

MovedNodes MovedNodesOfKept(const TrimResult& result)
{
  if (!result.Near)
  {
    return {};
  }
  const auto& near = *result.Near;
  return Collect(near.Mesh, near.Trimmed.NodeMoves, CountUsers(near.Mesh, near.Trimmed));
}

MovedNodes MovedNodesOfOffcut(const TrimResult& result)
{
  if (!result.Near)
  {
    return {};
  }
  const auto& near = *result.Near;
  return Collect(near.Mesh, near.Rest.NodeMoves, FindUsed(near.Mesh, near.Rest));
}

namespace
{

/// Where a node was in the input; an inserted one: where that was in whose place it is.
const Vec3& StartOf(const Band& band, int node)
{
  return WithoutLayer(band).Point[NodeWithoutLayer(band, node)];
}

/// Displacement and CorrectionApplied.
void AddMoves(const MovedNodes& moved, const Selection& ids, vtkPointData* pointData)
{
  std::vector<Id> places;
  std::vector<int> nodes;
  moved.ForPlaces(ids,
    [&](Id place, int node)
    {
      places.push_back(place);
      nodes.push_back(node);
    });
  AddSparseArray<vtkFloatArray>(
    names::Displacement, ids.size(), 3, places,
    [&](Id i, float* stored)
    {
      const Vec3 move = moved.NodeMoves->Position[nodes[i]] - StartOf(*moved.TheBand, nodes[i]);
      for (int k = 0; k < 3; ++k)
      {
        stored[k] = static_cast<float>(move[k]);
      }
    },
    pointData);
  AddSparseArray<vtkUnsignedCharArray>(
    names::CorrectionApplied, ids.size(), 1, places,
    [&](Id i, unsigned char* stored)
    { *stored = static_cast<unsigned char>(moved.NodeMoves->Applied[nodes[i]]); },
    pointData);
}

}

void AddPointStatuses(
  const TrimResult& result, const MovedNodes& moved, const Selection& ids, vtkPointData* pointData)
{
  const Id count = ids.size();
  const auto status = MakeArray<vtkUnsignedCharArray>(names::NodeStatus, count);
  const auto distance = MakeArray<vtkFloatArray>(names::SignedDistance, count);
  unsigned char* statuses = status->GetPointer(0);
  float* distances = distance->GetPointer(0);
  ParallelFor(0, count, Grain,
    [&](Id begin, Id end)
    {
      std::fill(distances + begin, distances + end, std::numeric_limits<float>::quiet_NaN());
      ids.Gather(result.Nodes.Status.data(), begin, end, statuses);
    });
  for (const auto& node : result.Nodes.SignedDistances)
  {
    ids.ForPlaces(node.first, [&](Id place) { distances[place] = node.second; });
  }
  pointData->AddArray(status);
  pointData->AddArray(distance);
  AddMoves(moved, ids, pointData);
}

void AddCellStatuses(const TrimResult& result, const Selection& ids, vtkCellData* cellData)
{
  const Id count = ids.size();
  const auto status = MakeArray<vtkUnsignedCharArray>(names::ElementStatus, count);
  const auto fraction = MakeArray<vtkFloatArray>(names::EliminatedFraction, count);
  unsigned char* statuses = status->GetPointer(0);
  float* fractions = fraction->GetPointer(0);
  ParallelFor(0, count, Grain,
    [&](Id begin, Id end)
    {
      ids.Gather(result.ElementStatus.data(), begin, end, statuses);
      for (Id i = begin; i < end; ++i)
      {
        fractions[i] = statuses[i] == ElementEliminate ? 1.0f : 0.0f;
      }
    });
  const int elements = result.Near ? result.Near->Mesh.NumberOfElements() : 0;
  ForAll(
    elements,
    [&](int e)
    {
      const Id cell = result.Near->Mesh.Elements[e].Global;
      if (cell >= 0 && result.ElementStatus[cell] == ElementToTreat)
      {
        const auto share = static_cast<float>(result.Near->Shares.Element[e]);
        ids.ForPlaces(cell, [fractions, share](Id place) { fractions[place] = share; });
      }
    },
    LightGrain);
  cellData->AddArray(status);
  cellData->AddArray(fraction);
}

namespace
{

/// Elements of the band; for an inserted one that on whose face it stands.
std::vector<int> ElementsBeneath(const Band& band)
{
  std::vector<int> beneath(band.NumberOfElements());
  std::iota(beneath.begin(), beneath.end(), 0);
  if (!band.BeforeLayer)
  {
    return beneath;
  }
  std::vector<int> ofOrigin(band.BeforeLayer->NumberOfElements(), -1);
  for (const int e : beneath)
  {
    int& own = ofOrigin[band.ElementOrigins[e].Index];
    own = band.IsInserted(e) ? own : e;
  }
  for (int& e : beneath)
  {
    e = ofOrigin[band.ElementOrigins[e].Index];
  }
  return beneath;
}

}

void AddRescues(
  const TrimResult& result, Id cells, const std::vector<Id>& placeOf, vtkCellData* cellData)
{
  static_assert(static_cast<unsigned char>(Rescue::None) == 0, "most of the array is not written");
  std::vector<Id> places;
  std::vector<Rescue> rescues;
  const auto beneath = result.Near ? ElementsBeneath(result.Near->Mesh) : std::vector<int>();
  for (std::size_t e = 0; e < placeOf.size(); ++e)
  {
    const Rescue rescue = RescueOf(*result.Near, beneath[e]);
    if (placeOf[e] >= 0 && rescue != Rescue::None)
    {
      places.push_back(placeOf[e]);
      rescues.push_back(rescue);
    }
  }
  AddSparseArray<vtkUnsignedCharArray>(
    names::Rescue, cells, 1, places,
    [&](Id i, unsigned char* stored) { *stored = static_cast<unsigned char>(rescues[i]); },
    cellData);
}

}
