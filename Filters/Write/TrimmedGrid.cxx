#include "TrimmedGrid.h"

#include "FindingArrays.h"
#include "GatherAttributes.h"
#include "NodeOrdering.h"
#include "OrderlessSum.h"
#include "Rescue.h"
#include "Status.h"
#include "StatusArrays.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSMPTools.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// The kept part of the mesh in the making: which cells and points stay, and in which order.
struct KeptMesh
{
  std::vector<Id> Cells;        ///< input ids, ascending
  std::vector<Id> Points;       ///< input ids, by new number
  NodeGraph Graph;              ///< the elements, in new numbers
  std::vector<int> BandElement; ///< of each kept cell, -1 away from the cut
};

/// What ParaView colours by at first, unless the input has active scalars of its own.
void ColourByStatus(vtkUnstructuredGrid* grid)
{
  if (!grid->GetPointData()->GetScalars() && !grid->GetCellData()->GetScalars())
  {
    grid->GetCellData()->SetActiveScalars("ElementStatus");
  }
}

/// Nodes of a kept cell in input ids, with edges dropped where it became a wedge.
int NodesOfKept(
  const HexMesh& mesh, const TrimResult& result, Id cell, int bandElement, std::array<Id, 8>& nodes)
{
  if (bandElement >= 0)
  {
    const auto& near = *result.Near;
    if (const ReplacedElement* wedge = FindWedge(near.Trimmed, bandElement))
    {
      for (int i = 0; i < 6; ++i)
      {
        nodes[i] = near.Mesh.GlobalNode[wedge->Node[i]];
      }
      return 6;
    }
  }
  return mesh.Cell(cell, nodes);
}

void CollectCells(const HexMesh& mesh, const TrimResult& result, KeptMesh& kept)
{
  const std::vector<int> band =
    result.Near ? result.Near->Mesh.ElementsByCell() : std::vector<int>();
  auto next = band.begin();
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    const bool inBand = next != band.end() && result.Near->Mesh.Elements[*next].Global == c;
    if (result.Kept[c])
    {
      kept.Cells.push_back(c);
      kept.BandElement.push_back(inBand ? *next : -1);
    }
    next += inBand;
  }
}

/// Points in use, ascending, and the connectivity in their numbers.
void CollectPoints(const HexMesh& mesh, const TrimResult& result, KeptMesh& kept)
{
  std::vector<int> number(mesh.NumberOfPoints, -1);
  std::array<Id, 8> nodes;
  auto& graph = kept.Graph;
  graph.Offset.resize(kept.Cells.size() + 1);
  graph.Offset[0] = 0;
  graph.Connectivity.reserve(8 * kept.Cells.size());
  for (std::size_t i = 0; i < kept.Cells.size(); ++i)
  {
    const int count = NodesOfKept(mesh, result, kept.Cells[i], kept.BandElement[i], nodes);
    for (int k = 0; k < count; ++k)
    {
      number[nodes[k]] = 0;
    }
    graph.Offset[i + 1] = graph.Offset[i] + count;
  }
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (number[p] == 0)
    {
      number[p] = static_cast<int>(kept.Points.size());
      kept.Points.push_back(p);
    }
  }
  graph.NumberOfNodes = static_cast<int>(kept.Points.size());
  for (std::size_t i = 0; i < kept.Cells.size(); ++i)
  {
    const int count = NodesOfKept(mesh, result, kept.Cells[i], kept.BandElement[i], nodes);
    for (int k = 0; k < count; ++k)
    {
      graph.Connectivity.push_back(number[nodes[k]]);
    }
  }
}

void Renumber(const HexMesh& mesh, const Progress& progress, KeptMesh& kept)
{
  const auto number = OrderNodes(
    kept.Graph, [&](int i) { return mesh.Point(kept.Points[i]); },
    [&progress] { return progress(-1.0); });
  std::vector<Id> points(kept.Points.size());
  for (std::size_t i = 0; i < number.size(); ++i)
  {
    points[number[i]] = kept.Points[i];
  }
  kept.Points = std::move(points);
  for (int& node : kept.Graph.Connectivity)
  {
    node = number[node];
  }
}

template <typename ArrayType>
void WriteCells(const KeptMesh& kept, vtkUnstructuredGrid* output)
{
  const Id count = static_cast<Id>(kept.Cells.size());
  vtkNew<ArrayType> offsets;
  vtkNew<ArrayType> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(static_cast<Id>(kept.Graph.Connectivity.size()));
  std::copy(kept.Graph.Offset.begin(), kept.Graph.Offset.end(), offsets->GetPointer(0));
  std::copy(
    kept.Graph.Connectivity.begin(), kept.Graph.Connectivity.end(), connectivity->GetPointer(0));
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(count);
  unsigned char* type = types->GetPointer(0);
  for (Id i = 0; i < count; ++i)
  {
    type[i] = kept.Graph.Offset[i + 1] - kept.Graph.Offset[i] == 8 ? VTK_HEXAHEDRON : VTK_WEDGE;
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  output->SetCells(types, cells);
}

/// Coordinates in the precision of the input; those of unmoved points bit by bit.
template <typename ArrayType, typename Value>
void WritePoints(
  const Value* from, const KeptMesh& kept, const TrimResult& result, vtkUnstructuredGrid* output)
{
  vtkNew<ArrayType> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<Id>(kept.Points.size()));
  Value* to = coordinates->GetPointer(0);
  for (std::size_t i = 0; i < kept.Points.size(); ++i)
  {
    std::copy_n(from + 3 * kept.Points[i], 3, to + 3 * i);
  }
  const auto moved = MovedBandNodes(result);
  if (!moved.empty())
  {
    std::vector<std::pair<Id, int>> byGlobal;
    for (const int n : moved)
    {
      byGlobal.emplace_back(result.Near->Mesh.GlobalNode[n], n);
    }
    std::sort(byGlobal.begin(), byGlobal.end());
    for (std::size_t i = 0; i < kept.Points.size(); ++i)
    {
      const auto it =
        std::lower_bound(byGlobal.begin(), byGlobal.end(), std::make_pair(kept.Points[i], -1));
      if (it != byGlobal.end() && it->first == kept.Points[i])
      {
        const Vec3& p = result.Near->Trimmed.NodeMoves.Position[it->second];
        for (int k = 0; k < 3; ++k)
        {
          to[3 * i + k] = static_cast<Value>(p[k]);
        }
      }
    }
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  output->SetPoints(points);
}

void AddOriginalIds(const KeptMesh& kept, vtkUnstructuredGrid* output)
{
  const auto add = [](const char* name, const std::vector<Id>& ids, vtkDataSetAttributes* data)
  {
    vtkNew<vtkIdTypeArray> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<Id>(ids.size()));
    std::copy(ids.begin(), ids.end(), array->GetPointer(0));
    data->AddArray(array);
  };
  add("vtkOriginalPointIds", kept.Points, output->GetPointData());
  add("vtkOriginalCellIds", kept.Cells, output->GetCellData());
}

ElementPoints PointsOfKept(
  const HexMesh& mesh, const TrimResult& result, const KeptMesh& kept, Id i, int& count)
{
  ElementPoints points;
  if (kept.BandElement[i] >= 0)
  {
    const auto final = FinalShape(result.Near->Mesh, result.Near->Trimmed, kept.BandElement[i]);
    count = final.Count;
    return final.Points;
  }
  std::array<Id, 8> nodes;
  count = mesh.Cell(kept.Cells[i], nodes);
  for (int k = 0; k < count; ++k)
  {
    points[k] = mesh.Point(nodes[k]);
  }
  return points;
}

/// ScaledJacobian of touched elements, and what the summary says of quality and volume.
void AddQuality(const HexMesh& mesh, const Ranks& ranks, const TrimResult& result,
  const KeptMesh& kept, bool allElements, Summary& summary, vtkUnstructuredGrid* output)
{
  const Id count = static_cast<Id>(kept.Cells.size());
  vtkNew<vtkFloatArray> scaled;
  scaled->SetName("ScaledJacobian");
  scaled->SetNumberOfValues(count);
  float* values = scaled->GetPointer(0);
  std::vector<double> volume(count);
  vtkSMPTools::For(0, count, 10000,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        int nodes = 0;
        const ElementPoints points = PointsOfKept(mesh, result, kept, i, nodes);
        const bool touched = kept.BandElement[i] >= 0 &&
          FinalShape(result.Near->Mesh, result.Near->Trimmed, kept.BandElement[i]).Touched;
        values[i] = touched || allElements ? static_cast<float>(ScaledJacobian(points, nodes))
                                           : std::numeric_limits<float>::quiet_NaN();
        volume[i] = std::abs(VolumeOf(points, nodes));
      }
    });
  summary.Volume = OrderlessSum(volume, ranks);
  output->GetCellData()->AddArray(scaled);
}

/// Rescue: the rung of the validity ladder that saved the element.
void AddRescue(const TrimResult& result, const KeptMesh& kept, vtkUnstructuredGrid* output)
{
  const Id count = static_cast<Id>(kept.Cells.size());
  vtkNew<vtkUnsignedCharArray> rescue;
  rescue->SetName("Rescue");
  rescue->SetNumberOfValues(count);
  unsigned char* values = rescue->GetPointer(0);
  for (Id i = 0; i < count; ++i)
  {
    values[i] = kept.BandElement[i] < 0
      ? static_cast<unsigned char>(Rescue::None)
      : static_cast<unsigned char>(RescueOf(*result.Near, kept.BandElement[i]));
  }
  output->GetCellData()->AddArray(rescue);
}

void SummariseTouched(const TrimResult& result, Summary& summary)
{
  const auto& near = *result.Near;
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (!near.Trimmed.Kept[e])
    {
      continue;
    }
    const auto final = FinalShape(near.Mesh, near.Trimmed, e);
    const bool moved = std::any_of(final.Node.begin(), final.Node.begin() + final.Count,
      [&near](int n) { return near.Trimmed.NodeMoves.Applied[n] != Correction::None; });
    if (!moved)
    {
      continue;
    }
    const auto range = MeasureJacobian(final.Points, final.Count);
    ++summary.TouchedElements;
    summary.MinimumScaledJacobian =
      std::fmin(summary.MinimumScaledJacobian, ScaledJacobian(final.Points, final.Count));
    summary.CertifiedElements += range.Bezier > 0.0;
    summary.MinimumIntegrationPointJacobian =
      std::fmin(summary.MinimumIntegrationPointJacobian, range.IntegrationPoint / range.Mean);
  }
}

/// Largest distance to the surface over the nodes of the new boundary.
double LargestDistance(const TrimResult& result, const nurbs::TrimmingSurface& surface)
{
  const auto& near = *result.Near;
  const std::vector<char> onCut = FindCutNodes(near.Mesh, near.Trimmed.Kept);
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  double largest = 0.0;
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    if (onCut[n] && users[n] > 0)
    {
      largest =
        std::max(largest, surface.ClosestPoint(near.Trimmed.NodeMoves.Position[n]).Distance);
    }
  }
  return largest;
}

/// By elements where they were relaxed, by columns elsewhere: these go or stay as one.
void CountRescues(const TrimResult& result, Summary& summary)
{
  const auto& trimmed = result.Near->Trimmed;
  summary.RescuedByRelaxation = std::count(trimmed.Relaxed.begin(), trimmed.Relaxed.end(), char(1));
  for (const Rung rung : trimmed.RescuedBy)
  {
    const Rescue rescue = RescueBy(rung);
    summary.RescuedByTreatment += rescue == Rescue::Treatment;
    summary.RescuedByCorrection += rescue == Rescue::Correction;
    summary.RescuedByFate += rescue == Rescue::Fate;
    summary.RescuedByLeaving += rescue == Rescue::Left;
  }
}

void Summarise(const Ranks& ranks, const TrimResult& result, const KeptMesh& kept,
  const nurbs::TrimmingSurface& surface, Summary& summary)
{
  summary.Kept = ranks.Sum(static_cast<Id>(kept.Cells.size()));
  summary.Eliminated = ranks.Sum(static_cast<Id>(result.Kept.size())) - summary.Kept;
  const Id treated =
    std::count(result.ElementStatus.begin(), result.ElementStatus.end(), ElementToTreat);
  summary.Treated = ranks.Sum(treated);
  std::vector<int> identity(kept.Points.size());
  std::iota(identity.begin(), identity.end(), 0);
  summary.NodeBandwidth = ranks.Largest(NodeBandwidth(kept.Graph, identity));
  // The band, and all that is counted in it, is the same on every rank.
  if (result.Near)
  {
    summary.MovedNodes = static_cast<Id>(MovedBandNodes(result).size());
    summary.Pentahedra = result.Near->Trimmed.Treated.Count;
    summary.Wedges = static_cast<Id>(result.Near->Trimmed.Treated.Wedges.size());
    summary.MaximumDistanceToSurface = LargestDistance(result, surface);
    SummariseTouched(result, summary);
    CountRescues(result, summary);
  }
}

}

void WriteTrimmedGrid(vtkUnstructuredGrid* input, const HexMesh& mesh, const Ranks& ranks,
  const TrimResult& result, const nurbs::TrimmingSurface& surface, const WriteOptions& options,
  const Progress& progress, vtkUnstructuredGrid* output)
{
  KeptMesh kept;
  CollectCells(mesh, result, kept);
  CollectPoints(mesh, result, kept);
  if (options.RenumberNodes && !progress(0.65))
  {
    Renumber(mesh, progress, kept);
  }
  if (ranks.Any(progress(0.85)))
  {
    return;
  }
  if (mesh.PointsDouble)
  {
    WritePoints<vtkDoubleArray>(mesh.PointsDouble, kept, result, output);
  }
  else if (mesh.PointsFloat)
  {
    WritePoints<vtkFloatArray>(mesh.PointsFloat, kept, result, output);
  }
  if (mesh.Offsets64)
  {
    WriteCells<vtkTypeInt64Array>(kept, output);
  }
  else
  {
    WriteCells<vtkTypeInt32Array>(kept, output);
  }
  GatherAttributes(input->GetPointData(), kept.Points, output->GetPointData());
  GatherAttributes(input->GetCellData(), kept.Cells, output->GetCellData());
  AddPointStatuses(result, kept.Points, output->GetPointData());
  AddCellStatuses(result, kept.Cells, output->GetCellData());
  AddPointFindings(result.Found, kept.Points, output->GetPointData());
  AddCellFindings(result.Found, kept.Cells, output->GetCellData());
  ColourByStatus(output);
  AddOriginalIds(kept, output);

  AddRescue(result, kept, output);
  Summary summary;
  AddQuality(mesh, ranks, result, kept, options.QualityOfAllElements, summary, output);
  Summarise(ranks, result, kept, surface, summary);
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  summary.AddTo(output->GetFieldData());
  progress(0.95);
}

void WriteStatusGrid(
  vtkUnstructuredGrid* input, const TrimResult& result, vtkUnstructuredGrid* output)
{
  output->ShallowCopy(input);
  std::vector<Id> ids(input->GetNumberOfPoints());
  std::iota(ids.begin(), ids.end(), Id(0));
  AddPointStatuses(result, ids, output->GetPointData());
  AddPointFindings(result.Found, ids, output->GetPointData());
  ids.resize(input->GetNumberOfCells());
  std::iota(ids.begin(), ids.end(), Id(0));
  AddCellStatuses(result, ids, output->GetCellData());
  AddCellFindings(result.Found, ids, output->GetCellData());
  ColourByStatus(output);
}

}
