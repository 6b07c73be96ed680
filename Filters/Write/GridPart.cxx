#include "GridPart.h"

#include "ArrayNames.h"
#include "ArrayRanges.h"
#include "CountBytes.h"
#include "FindingArrays.h"
#include "FollowingIds.h"
#include "GatherAttributes.h"
#include "SparseArray.h"
#include "Team.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstring>

namespace trim
{
namespace
{

/// Coordinates in the precision of the input; those of unmoved points bit by bit.
template <typename ArrayType, typename Value>
void WriteCoordinates(
  const Value* from, const GridPart& part, const MovedNodes& moved, vtkUnstructuredGrid* output)
{
  const Id count = part.Points.size();
  const auto coordinates = MakeArray<ArrayType>(nullptr, count, 3);
  Value* to = coordinates->GetPointer(0);
  ParallelFor(0, count, PartGrain,
    [&](Id begin, Id end)
    {
      ForFollowing(part.Points.data(), begin, end,
        [&](Id i, Id point, auto points)
        { std::memcpy(to + 3 * i, from + 3 * point, 3 * points * sizeof(Value)); });
    });
  moved.ForPlaces(part.PointIds(),
    [&](Id place, int node)
    {
      for (int k = 0; k < 3; ++k)
      {
        to[3 * place + k] = static_cast<Value>(moved.NodeMoves->Position[node][k]);
      }
    });
  output->SetPoints(MakePoints(coordinates));
}

}

std::vector<Id> PlacesInBand(const GridPart& part, int count)
{
  std::vector<Id> places(count, -1);
  ForRuns(part.Cells.size(),
    [&](Id, Id begin, Id end)
    { part.ForInBand(begin, end, [&](Id i) { places[part.InBand[i]] = i; }); });
  return places;
}

std::vector<InsertedPoint> FindInsertedPoints(const TrimResult& result)
{
  std::vector<InsertedPoint> inserted;
  const int nodes = result.Near ? result.Near->Mesh.NumberOfNodes() : 0;
  for (int n = 0; n < nodes; ++n)
  {
    const Band& band = result.Near->Mesh;
    if (band.IsInsertedNode(n) && band.GlobalNode[n] >= 0)
    {
      const Id origin = band.BeforeLayer->GlobalNode[band.NodeOrigins[n].Index];
      inserted.push_back({ origin, band.Point[n] });
    }
  }
  return inserted;
}

PointFlags FlagSideOffBand(
  const HexMesh& mesh, const MeshBlocks& blocks, const TrimResult& result, NodeStatus side)
{
  PointFlags flags(mesh.NumberOfPoints + FindInsertedPoints(result).size());
  const auto& status = result.Nodes.Status;
  ForRuns(mesh.NumberOfPoints,
    [&](Id, Id begin, Id end)
    {
      std::transform(status.begin() + begin, status.begin() + end, flags.begin() + begin,
        [side](unsigned char own) { return static_cast<unsigned char>(own == side); });
    });
  std::fill(flags.begin() + mesh.NumberOfPoints, flags.end(), static_cast<unsigned char>(0));
  for (const Id p : blocks.UnusedNodes)
  {
    flags[p] = 0;
  }
  if (result.Near)
  {
    const Band& band = result.Near->Mesh;
    for (int e = 0; e < band.NumberOfElements(); ++e)
    {
      // Nodes of the halo alone have cells off the band too.
      for (int i = 0; !band.InHalo(e) && i < band.Elements[e].Count; ++i)
      {
        const Id p = band.GlobalNode[band.Elements[e].Node[i]];
        if (p >= 0)
        {
          flags[p] = 0;
        }
      }
    }
  }
  return flags;
}

namespace
{

/// Calls action(number, point) for the inserted points that are in the part, in their order.
template <typename Action>
void ForInserted(const GridPart& part, const Action& action)
{
  const std::size_t first = part.Number.size() - part.Inserted.size();
  for (std::size_t i = 0; i < part.Inserted.size(); ++i)
  {
    if (part.Number[first + i] >= 0)
    {
      action(part.Number[first + i], part.Inserted[i]);
    }
  }
}

/// Inserted points are listed by the input's points in whose places they are.
void NameInserted(GridPart& part)
{
  ForInserted(part,
    [&part](int number, const InsertedPoint& point) { part.Points.data()[number] = point.Origin; });
}

/// Gives inserted points the numbers behind those in whose places they are.
void InterleaveInserted(GridPart& part)
{
  const Id first = static_cast<Id>(part.Number.size() - part.Inserted.size());
  std::vector<std::pair<Id, Id>> inserted; // by origin
  for (std::size_t i = 0; i < part.Inserted.size(); ++i)
  {
    if (part.Number[first + i] >= 0)
    {
      inserted.emplace_back(part.Inserted[i].Origin, first + static_cast<Id>(i));
    }
  }
  std::sort(inserted.begin(), inserted.end());
  Id next = 0;
  const auto number = [&](Id own, Id listed)
  {
    part.Number[own] = static_cast<int>(next);
    part.Points.data()[next++] = listed;
  };
  auto at = inserted.begin();
  for (Id p = 0; p < first; ++p)
  {
    if (part.Number[p] >= 0)
    {
      number(p, p);
    }
    for (; at != inserted.end() && at->first == p; ++at)
    {
      number(at->second, p);
    }
  }
}

/// So many points are looked at at once.
constexpr Id ManyFlags = 32;

/// Whether so many points are all flagged or none of them is.
bool AreAlike(const unsigned char* flags)
{
  unsigned char differ = 0;
  for (Id k = 0; k < ManyFlags; ++k)
  {
    differ |= flags[k] ^ flags[0];
  }
  return differ == 0;
}

}

void NumberFlagged(const PointFlags& flags, GridPart& part)
{
  const auto count = static_cast<Id>(flags.size());
  const Id runs = NumberOfRuns(count, PartGrain);
  std::vector<Id> first(runs + 1, 0);
  ForRuns(count,
    [&](Id run, Id begin, Id end)
    { first[run + 1] = CountBytes<unsigned char>(flags.data() + begin, flags.data() + end, 1); });
  for (Id run = 0; run < runs; ++run)
  {
    first[run + 1] += first[run];
  }
  part.Points.Resize(first.back());
  part.Number.resize(count);
  ForRuns(count,
    [&](Id run, Id begin, Id end)
    {
      Id* const points = part.Points.data();
      int* const numbers = part.Number.data();
      Id next = first[run];
      for (Id p = begin; p < end; ++p)
      {
        const bool set = flags[p] != 0;
        if (p + ManyFlags <= end && AreAlike(&flags[p]))
        {
          for (Id k = 0; k < ManyFlags; ++k)
          {
            numbers[p + k] = set ? static_cast<int>(next + k) : -1;
          }
          for (Id k = 0; set && k < ManyFlags; ++k)
          {
            points[next++] = p + k;
          }
          p += ManyFlags - 1;
          continue;
        }
        numbers[p] = set ? static_cast<int>(next) : -1;
        if (set)
        {
          points[next++] = p;
        }
      }
    });
  if (!part.Inserted.empty())
  {
    InterleaveInserted(part);
  }
  TellRangeOfAscending(part.Points.Array()); // other numbers do not change it
}

std::vector<Vec3> PlacesIfInserted(const HexMesh& mesh, const GridPart& part)
{
  std::vector<Vec3> places;
  for (Id i = 0; !part.Inserted.empty() && i < part.Points.size(); ++i)
  {
    places.push_back(mesh.Point(part.Points[i]));
  }
  ForInserted(
    part, [&places](int number, const InsertedPoint& point) { places[number] = point.Place; });
  return places;
}

void TakeNumbers(const PageVector<int>& number, GridPart& part)
{
  const auto count = static_cast<Id>(part.Number.size());
  Id* points = part.Points.data();
  ForRuns(count,
    [&](Id, Id begin, Id end)
    {
      for (Id point = begin; point < end; ++point)
      {
        int& own = part.Number[point];
        if (own >= 0)
        {
          own = number[own];
          points[own] = point;
        }
      }
    });
  NameInserted(part);
}

void WritePoints(vtkUnstructuredGrid* input, const HexMesh& mesh, const GridPart& part,
  const MovedNodes& moved, vtkUnstructuredGrid* output)
{
  if (mesh.PointsDouble)
  {
    WriteCoordinates<vtkDoubleArray>(mesh.PointsDouble, part, moved, output);
  }
  else if (mesh.PointsFloat)
  {
    WriteCoordinates<vtkFloatArray>(mesh.PointsFloat, part, moved, output);
  }
  GatherAttributes(
    input->GetPointData(), part.Points.data(), part.Points.size(), output->GetPointData());
  GatherAttributes(
    input->GetCellData(), part.Cells.data(), part.Cells.size(), output->GetCellData());
  output->GetPointData()->AddArray(part.Points.Array());
  output->GetCellData()->AddArray(part.Cells.Array());
}

template <typename ArrayType>
void TakeElements(const GridPart& part, vtkSmartPointer<ArrayType> offsets,
  vtkSmartPointer<ArrayType> connectivity, vtkUnstructuredGrid* output)
{
  const Id count = part.Cells.size();
  const auto types = MakeArray<vtkUnsignedCharArray>(nullptr, count);
  ForRuns(count,
    [&](Id, Id begin, Id end)
    {
      unsigned char* const type = types->GetPointer(0);
      const auto* const offset = offsets->GetPointer(0);
      for (Id i = begin; i < end; ++i)
      {
        type[i] = offset[i + 1] - offset[i] == 8 ? VTK_HEXAHEDRON : VTK_WEDGE;
      }
    });
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output->SetCells(types, cells, nullptr, nullptr); // without a look for polyhedra
}

template void TakeElements(const GridPart& part, vtkSmartPointer<vtkTypeInt64Array> offsets,
  vtkSmartPointer<vtkTypeInt64Array> connectivity, vtkUnstructuredGrid* output);
template void TakeElements(const GridPart& part, vtkSmartPointer<vtkTypeInt32Array> offsets,
  vtkSmartPointer<vtkTypeInt32Array> connectivity, vtkUnstructuredGrid* output);

void ColourByStatus(vtkUnstructuredGrid* grid)
{
  if (!grid->GetPointData()->GetScalars() && !grid->GetCellData()->GetScalars())
  {
    grid->GetCellData()->SetActiveScalars(names::ElementStatus);
  }
}

void ForgetGlobalIds(vtkDataSetAttributes* data)
{
  data->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
}

void AddInserted(const TrimResult& result, const GridPart& part, vtkUnstructuredGrid* output)
{
  auto* distances =
    vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray(names::SignedDistance));
  const auto& known = result.Nodes.SignedDistances;
  std::vector<Id> points, cells;
  ForInserted(part,
    [&](int number, const InsertedPoint& point)
    {
      points.push_back(number);
      const auto distance = std::lower_bound(known.begin(), known.end(), point.Origin,
        [](const auto& node, Id id) { return node.first < id; });
      if (distance != known.end() && distance->first == point.Origin)
      {
        distances->SetValue(number, distance->second);
      }
    });
  part.ForInBand(0, part.Cells.size(),
    [&](Id i)
    {
      if (result.Near->Mesh.IsInserted(part.InBand[i]))
      {
        cells.push_back(i);
      }
    });
  const auto set = [](Id, unsigned char* value) { *value = 1; };
  AddSparseArray<vtkUnsignedCharArray>(
    names::Inserted, part.Points.size(), 1, points, set, output->GetPointData());
  AddSparseArray<vtkUnsignedCharArray>(
    names::Inserted, part.Cells.size(), 1, cells, set, output->GetCellData());
  if (result.Near && result.Near->Mesh.BeforeLayer)
  {
    ForgetGlobalIds(output->GetPointData());
    ForgetGlobalIds(output->GetCellData());
  }
}

void AddStatusesAndFindings(const TrimResult& result, const GridPart& part, const MovedNodes& moved,
  vtkUnstructuredGrid* output)
{
  AddPointStatuses(result, moved, part.PointIds(), output->GetPointData());
  AddCellStatuses(result, part.CellIds(), output->GetCellData());
  AddPointFindings(result.Found, part.PointIds(), output->GetPointData());
  AddCellFindings(result.Found, part.CellIds(), output->GetCellData());
  ColourByStatus(output);
}

}
