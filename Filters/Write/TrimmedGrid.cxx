#include "TrimmedGrid.h"

#include "FindingArrays.h"
#include "GridPart.h"
#include "OrderlessSum.h"
#include "Rescue.h"
#include "Status.h"
#include "StatusArrays.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace trim
{
namespace
{

/// The kept part of the mesh in the making.
struct KeptMesh : GridPart
{
  PageVector<int> BandElement; ///< of each kept cell, -1 away from the cut
};

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
  KeptMesh& kept)
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
      kept.BandElement[place] = c == inBand ? *next : -1;
      ++place;
    }
    if (c == inBand)
    {
      ++next;
      inBand = next == band.end() ? Id(-1) : cellOf(*next);
    }
  }
}

/// Calls action(i) for all items of the band, by all threads.
template <typename Action>
void ForAll(int count, const Action& action)
{
  vtkSMPTools::For(0, count, 256,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        action(static_cast<int>(i));
      }
    });
}

void CollectCells(const HexMesh& mesh, const TrimResult& result, KeptMesh& kept)
{
  const Id runs = NumberOfRuns(mesh.NumberOfCells, PartGrain);
  std::vector<Id> first(runs + 1, 0);
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) {
      first[run + 1] = std::count(result.Kept.begin() + begin, result.Kept.begin() + end, char(1));
    });
  std::partial_sum(first.begin(), first.end(), first.begin());
  kept.Cells.Resize(first.back());
  kept.BandElement.resize(first.back());
  const auto band = result.Near ? result.Near->Mesh.ElementsByCell() : std::vector<int>();
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) { ListCells(result, band, begin, end, first[run], kept); });
}

/// A kept element at its new position, and whether the trim touched it.
FinalElement ShapeOfKept(const HexMesh& mesh, const TrimResult& result, const KeptMesh& kept, Id i)
{
  if (kept.BandElement[i] >= 0)
  {
    return FinalShape(result.Near->Mesh, result.Near->Trimmed, kept.BandElement[i]);
  }
  FinalElement element;
  element.Count = PointsOfCell(mesh, kept.Cells[i], element.Points);
  return element;
}

/// ScaledJacobian of touched elements, and what the summary says of quality and volume.
void AddQuality(const HexMesh& mesh, const MeshBlocks& blocks, const Ranks& ranks,
  const TrimResult& result, const KeptMesh& kept, bool allElements, Summary& summary,
  vtkUnstructuredGrid* output)
{
  const Id count = kept.Cells.size();
  const auto scaled = MakeArray<vtkFloatArray>("ScaledJacobian", count);
  float* values = scaled->GetPointer(0);
  // Volumes of the elements at the cut; those of all others are known with the mesh.
  std::vector<double> volume(result.Near ? result.Near->Mesh.NumberOfElements() : 0);
  vtkSMPTools::For(0, count, 10000,
    [&](Id begin, Id end)
    {
      std::fill(values + begin, values + end, std::numeric_limits<float>::quiet_NaN());
      for (Id i = begin; i < end; ++i)
      {
        if (kept.BandElement[i] < 0 && !allElements)
        {
          continue;
        }
        const FinalElement element = ShapeOfKept(mesh, result, kept, i);
        if (element.Touched || allElements)
        {
          values[i] = static_cast<float>(ScaledJacobian(element.Points, element.Count));
        }
        if (kept.BandElement[i] >= 0)
        {
          volume[kept.BandElement[i]] = std::abs(VolumeOf(element.Points, element.Count));
        }
      }
    });
  const auto volumeOf = [&](Id i)
  {
    const int element = kept.BandElement[i];
    return element >= 0 ? volume[element] : blocks.Volumes[kept.Cells[i]];
  };
  summary.Volume = OrderlessSum(count, volumeOf, ranks);
  output->GetCellData()->AddArray(scaled);
}

/// A kept element with a moved node.
struct MovedElement
{
  double Scaled;
  JacobianRange Range;
};

std::optional<MovedElement> MeasureIfMoved(const TrimBand& near, int e)
{
  if (!near.Trimmed.Kept[e])
  {
    return std::nullopt;
  }
  const auto final = FinalShape(near.Mesh, near.Trimmed, e);
  const bool moved = std::any_of(final.Node.begin(), final.Node.begin() + final.Count,
    [&near](int n) { return near.Trimmed.NodeMoves.Applied[n] != Correction::None; });
  return moved ? std::optional<MovedElement>({ ScaledJacobian(final.Points, final.Count),
                   MeasureJacobian(final.Points, final.Count) })
               : std::nullopt;
}

void SummariseTouched(const TrimResult& result, Summary& summary)
{
  const auto& near = *result.Near;
  std::vector<std::optional<MovedElement>> elements(near.Mesh.NumberOfElements());
  ForAll(near.Mesh.NumberOfElements(), [&](int e) { elements[e] = MeasureIfMoved(near, e); });
  for (const auto& element : elements)
  {
    if (element)
    {
      const JacobianRange& range = element->Range;
      ++summary.TouchedElements;
      summary.MinimumScaledJacobian = std::fmin(summary.MinimumScaledJacobian, element->Scaled);
      summary.CertifiedElements += range.Bezier > 0.0;
      summary.MinimumIntegrationPointJacobian =
        std::fmin(summary.MinimumIntegrationPointJacobian, range.IntegrationPoint / range.Mean);
    }
  }
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

void Summarise(const Ranks& ranks, const TrimResult& result, const KeptMesh& kept,
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
    SummariseTouched(result, summary);
    CountRescues(result, summary);
  }
}

}

void WriteTrimmedGrid(vtkUnstructuredGrid* input, const HexMesh& mesh, const MeshBlocks& blocks,
  const Ranks& ranks, const TrimResult& result, const nurbs::TrimmingSurface& surface,
  const WriteOptions& options, const Progress& progress, vtkUnstructuredGrid* output)
{
  KeptMesh kept;
  CollectCells(mesh, result, kept);
  const auto nodesOf = [&](Id i, std::array<Id, 8>& nodes)
  {
    const int element = kept.BandElement[i];
    return element < 0 ? mesh.OrientedCell(kept.Cells[i], nodes)
                       : NodesAtCut(mesh, result, kept.Cells[i], element, nodes);
  };
  const auto isInBand = [&kept](Id i) { return kept.BandElement[i] >= 0; };
  NumberPoints(mesh, blocks, result, NodeKeep, kept, isInBand, nodesOf);
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
  AddStatusesAndFindings(result, kept, moved, result.Found, output);
  AddRescues(result, kept.CellIds(), output->GetCellData());
  AddQuality(mesh, blocks, ranks, result, kept, options.QualityOfAllElements, summary, output);
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
