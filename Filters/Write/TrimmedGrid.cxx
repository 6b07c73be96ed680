#include "TrimmedGrid.h"

#include "FindingArrays.h"
#include "GridPart.h"
#include "MapValues.h"
#include "PartQuality.h"
#include "Rescue.h"
#include "Status.h"
#include "StatusArrays.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <numeric>

namespace trim
{
namespace
{

/// Nodes of a kept cell at the cut, in input ids, with edges dropped where it became a wedge.
int NodesAtCut(
  const HexMesh& mesh, const TrimResult& result, Id cell, int bandElement, std::array<Id, 8>& nodes)
{
  const auto& near = *result.Near;
  if (const ReplacedElement* wedge = FindWedge(near.Trimmed.Treated, bandElement))
  {
    for (int i = 0; i < 6; ++i)
    {
      nodes[i] = near.Mesh.GlobalNode[wedge->Node[i]];
    }
    return 6;
  }
  return mesh.OrientedCell(cell, nodes);
}

/// The kept cells from begin to end; `place`: where the first of them is listed.
void ListCells(const TrimResult& result, const std::vector<int>& band, Id begin, Id end, Id place,
  GridPart& kept)
{
  const auto cellOf = [&result](int element) { return result.Near->Mesh.Elements[element].Global; };
  auto next = std::lower_bound(band.begin(), band.end(), begin,
    [&cellOf](int element, Id cell) { return cellOf(element) < cell; });
  Id inBand = next == band.end() ? Id(-1) : cellOf(*next);
  Id* cells = kept.Cells.data();
  for (Id c = begin; c < end; ++c)
  {
    if (result.Kept[c])
    {
      cells[place] = c;
      kept.InBand[place] = c == inBand ? *next : -1;
      ++place;
    }
    if (c == inBand)
    {
      ++next;
      inBand = next == band.end() ? Id(-1) : cellOf(*next);
    }
  }
}

void CollectCells(const HexMesh& mesh, const TrimResult& result, GridPart& kept)
{
  const Id runs = NumberOfRuns(mesh.NumberOfCells, PartGrain);
  std::vector<Id> first(runs + 1, 0);
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) {
      first[run + 1] = std::count(result.Kept.begin() + begin, result.Kept.begin() + end, char(1));
    });
  std::partial_sum(first.begin(), first.end(), first.begin());
  kept.Cells.Resize(first.back());
  kept.InBand.resize(first.back());
  const auto band = result.Near ? result.Near->Mesh.ElementsByCell() : std::vector<int>();
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) { ListCells(result, band, begin, end, first[run], kept); });
}

/// Largest distance to the surface over the nodes of the new boundary.
double LargestDistance(const TrimResult& result, const nurbs::TrimmingSurface& surface)
{
  const auto& near = *result.Near;
  const std::vector<char> onCut = FindBoundaryNodes(near.Mesh, near.Trimmed);
  const std::vector<int> users = CountUsers(near.Mesh, near.Trimmed);
  std::vector<double> distances(near.Mesh.NumberOfNodes(), 0.0);
  ForAll(near.Mesh.NumberOfNodes(),
    [&](int n)
    {
      if (onCut[n] && users[n] > 0)
      {
        distances[n] = surface.ClosestPoint(near.Trimmed.NodeMoves.Position[n]).Distance;
      }
    });
  return distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end());
}

/// By elements where they were relaxed, by columns elsewhere: these go or stay as one.
void CountRescues(const TrimResult& result, Summary& summary)
{
  const auto& trimmed = result.Near->Trimmed;
  for (int e = 0; e < result.Near->Mesh.NumberOfElements(); ++e)
  {
    summary.RescuedByRelaxation += RescueOf(*result.Near, e) == Rescue::Relaxation;
  }
  for (const Rung rung : trimmed.RescuedBy)
  {
    const Rescue rescue = RescueBy(rung);
    summary.RescuedByTreatment += rescue == Rescue::Treatment;
    summary.RescuedByCorrection += rescue == Rescue::Correction;
    summary.RescuedByFate += rescue == Rescue::Fate;
    summary.RescuedByLeaving += rescue == Rescue::Left;
  }
}

void Summarise(const Ranks& ranks, const TrimResult& result, const GridPart& kept,
  const nurbs::TrimmingSurface& surface, Summary& summary)
{
  summary.Kept = ranks.Sum(kept.Cells.size());
  summary.Eliminated = ranks.Sum(static_cast<Id>(result.Kept.size())) - summary.Kept;
  const Id treated =
    std::count(result.ElementStatus.begin(), result.ElementStatus.end(), ElementToTreat);
  summary.Treated = ranks.Sum(treated);
  // The band, and all that is counted in it, is the same on every rank.
  if (result.Near)
  {
    summary.MovedNodes = static_cast<Id>(MovedNodesOfKept(result).Nodes.size());
    summary.Pentahedra = result.Near->Trimmed.Treated.Count;
    summary.Wedges = static_cast<Id>(result.Near->Trimmed.Treated.Wedges.size());
    summary.MaximumDistanceToSurface = LargestDistance(result, surface);
    CountRescues(result, summary);
  }
}

}

void WriteTrimmedGrid(vtkUnstructuredGrid* input, const HexMesh& mesh, const MeshBlocks& blocks,
  const Ranks& ranks, const TrimResult& result, const nurbs::TrimmingSurface& surface,
  const WriteOptions& options, const Progress& progress, vtkUnstructuredGrid* output)
{
  GridPart kept;
  CollectCells(mesh, result, kept);
  const auto nodesOf = [&](Id i, std::array<Id, 8>& nodes)
  {
    const int element = kept.InBand[i];
    return element < 0 ? mesh.OrientedCell(kept.Cells[i], nodes)
                       : NodesAtCut(mesh, result, kept.Cells[i], element, nodes);
  };
  NumberPoints(mesh, blocks, result, NodeKeep, kept, nodesOf);
  if (options.RenumberNodes && !progress(0.65))
  {
    RenumberPart(mesh, progress, kept, nodesOf);
  }
  if (ranks.Any(progress(0.85)))
  {
    return;
  }
  const MovedNodes moved = MovedNodesOfKept(result);
  Summary summary;
  summary.NodeBandwidth = ranks.Largest(WriteElements(mesh, kept, nodesOf, output));
  WritePoints(input, mesh, kept, moved, output);
  const BandShapes shapes = ShapesOfKept(result);
  if (options.MapValues)
  {
    MapValues(input, ranks, kept, moved, shapes, output);
  }
  AddStatusesAndFindings(result, kept, moved, result.Found, output);
  AddRescues(result, kept.CellIds(), output->GetCellData());
  AddScaledJacobians(mesh, kept, shapes, options.QualityOfAllElements, output);
  summary.Volume = VolumeOfPart(blocks, kept, shapes, ranks);
  SummariseTouched(shapes, summary);
  Summarise(ranks, result, kept, surface, summary);
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  summary.AddTo(output->GetFieldData());
  progress(0.95);
}

void WriteStatusGrid(
  vtkUnstructuredGrid* input, const TrimResult& result, vtkUnstructuredGrid* output)
{
  output->ShallowCopy(input);
  const auto points = Selection::All(input->GetNumberOfPoints());
  AddPointStatuses(result, MovedNodesOfKept(result), points, output->GetPointData());
  AddPointFindings(result.Found, points, output->GetPointData());
  const auto cells = Selection::All(input->GetNumberOfCells());
  AddCellStatuses(result, cells, output->GetCellData());
  AddRescues(result, cells, output->GetCellData());
  AddCellFindings(result.Found, cells, output->GetCellData());
  ColourByStatus(output);
}

}
