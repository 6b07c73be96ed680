#include "GridPart.h"

#include "GatherAttributes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

namespace trim
{
namespace
{

/// Copies with conversion, by all threads.
template <typename From, typename To>
void CopyValues(const From* from, Id count, To* to)
{
  vtkSMPTools::For(0, count, 4 * PartGrain,
    [=](Id begin, Id end) { std::copy(from + begin, from + end, to + begin); });
}

template <typename ArrayType>
void WriteCells(const GridPart& part, vtkUnstructuredGrid* output)
{
  const auto& graph = part.Graph;
  const Id count = static_cast<Id>(part.Cells.size());
  const Id size = static_cast<Id>(graph.Connectivity.size());
  vtkNew<ArrayType> offsets;
  vtkNew<ArrayType> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(size);
  CopyValues(graph.Offset.data(), count + 1, offsets->GetPointer(0));
  CopyValues(graph.Connectivity.data(), size, connectivity->GetPointer(0));
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(count);
  unsigned char* type = types->GetPointer(0);
  for (Id i = 0; i < count; ++i)
  {
    type[i] = graph.Offset[i + 1] - graph.Offset[i] == 8 ? VTK_HEXAHEDRON : VTK_WEDGE;
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output->SetCells(types, cells);
}

/// Coordinates in the precision of the input; those of unmoved points bit by bit.
template <typename ArrayType, typename Value>
void WritePoints(
  const Value* from, const GridPart& part, const MovedNodes& moved, vtkUnstructuredGrid* output)
{
  const Id count = static_cast<Id>(part.Points.size());
  vtkNew<ArrayType> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  Value* to = coordinates->GetPointer(0);
  vtkSMPTools::For(0, count, PartGrain,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        const Value* point = from + 3 * part.Points[i];
        to[3 * i] = point[0];
        to[3 * i + 1] = point[1];
        to[3 * i + 2] = point[2];
      }
    });
  moved.ForPlaces(part.PointIds(),
    [&](Id place, int node)
    {
      for (int k = 0; k < 3; ++k)
      {
        to[3 * place + k] = static_cast<Value>(moved.NodeMoves->Position[node][k]);
      }
    });
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  output->SetPoints(points);
}

void AddOriginalIds(const GridPart& part, vtkUnstructuredGrid* output)
{
  const auto add = [](const char* name, const std::vector<Id>& ids, vtkDataSetAttributes* data)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<Id>(ids.size()));
    CopyValues(ids.data(), static_cast<Id>(ids.size()), array->GetPointer(0));
    data->AddArray(array);
  };
  add("vtkOriginalPointIds", part.Points, output->GetPointData());
  add("vtkOriginalCellIds", part.Cells, output->GetCellData());
}

}

void NumberFlagged(const std::atomic<unsigned char>* flags, Id count, GridPart& part)
{
  const auto isSet = [flags](Id p) { return flags[p].load(std::memory_order_relaxed) != 0; };
  const Id runs = (count + PartGrain - 1) / PartGrain;
  std::vector<Id> first(runs + 1, 0);
  const auto forRuns = [&](const auto& action)
  {
    vtkSMPTools::For(0, runs, 1,
      [&](Id begin, Id end)
      {
        for (Id run = begin; run < end; ++run)
        {
          action(run, run * PartGrain, std::min(count, (run + 1) * PartGrain));
        }
      });
  };
  forRuns(
    [&](Id run, Id begin, Id end)
    {
      Id set = 0;
      for (Id p = begin; p < end; ++p)
      {
        set += isSet(p);
      }
      first[run + 1] = set;
    });
  for (Id run = 0; run < runs; ++run)
  {
    first[run + 1] += first[run];
  }
  part.Points.resize(first.back());
  part.Number.resize(count);
  forRuns(
    [&](Id run, Id begin, Id end)
    {
      Id next = first[run];
      for (Id p = begin; p < end; ++p)
      {
        part.Number[p] = isSet(p) ? static_cast<int>(next) : -1;
        if (isSet(p))
        {
          part.Points[next++] = p;
        }
      }
    });
}

void RenumberPart(const HexMesh& mesh, const Progress& progress, GridPart& part)
{
  const auto number = OrderNodes(
    part.Graph, NodePlaces(mesh, part.Points.data()), [&progress] { return progress(-1.0); });
  for (const Id point : part.Points)
  {
    part.Number[point] = number[part.Number[point]];
  }
  for (std::size_t point = 0; point < part.Number.size(); ++point)
  {
    if (part.Number[point] >= 0)
    {
      part.Points[part.Number[point]] = static_cast<Id>(point);
    }
  }
  vtkSMPTools::For(0, static_cast<Id>(part.Graph.Connectivity.size()), 4 * PartGrain,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        part.Graph.Connectivity[i] = number[part.Graph.Connectivity[i]];
      }
    });
}

void WritePart(vtkUnstructuredGrid* input, const HexMesh& mesh, const GridPart& part,
  const MovedNodes& moved, vtkUnstructuredGrid* output)
{
  if (mesh.PointsDouble)
  {
    WritePoints<vtkDoubleArray>(mesh.PointsDouble, part, moved, output);
  }
  else if (mesh.PointsFloat)
  {
    WritePoints<vtkFloatArray>(mesh.PointsFloat, part, moved, output);
  }
  if (mesh.Offsets64)
  {
    WriteCells<vtkTypeInt64Array>(part, output);
  }
  else
  {
    WriteCells<vtkTypeInt32Array>(part, output);
  }
  GatherAttributes(input->GetPointData(), part.Points, output->GetPointData());
  GatherAttributes(input->GetCellData(), part.Cells, output->GetCellData());
  AddOriginalIds(part, output);
}

void ColourByStatus(vtkUnstructuredGrid* grid)
{
  if (!grid->GetPointData()->GetScalars() && !grid->GetCellData()->GetScalars())
  {
    grid->GetCellData()->SetActiveScalars("ElementStatus");
  }
}

}
