#include "OffcutGrid.h"

#include "GridPart.h"
#include "OrderlessSum.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// The offcut in the making.
struct OffcutMesh : GridPart
{
  std::vector<int> BandPart; ///< of each cell its place in Offcut::Elements, -1 away from the cut
};

/// The offcut's elements within each element of the band: first of them, and one more.
std::vector<int> FirstParts(const TrimBand& near)
{
  std::vector<int> first(near.Mesh.NumberOfElements() + 1, 0);
  for (const auto& part : near.Rest.Elements)
  {
    ++first[part.Element + 1];
  }
  for (std::size_t e = 1; e < first.size(); ++e)
  {
    first[e] += first[e - 1];
  }
  return first;
}

OffcutMesh CollectCells(const HexMesh& mesh, const TrimResult& result)
{
  OffcutMesh part;
  std::vector<Id> cells;
  const auto add = [&part, &cells](Id cell, int bandPart)
  {
    cells.push_back(cell);
    part.BandPart.push_back(bandPart);
  };
  const auto elements = result.Near ? result.Near->Mesh.ElementsByCell() : std::vector<int>();
  const auto first = result.Near ? FirstParts(*result.Near) : std::vector<int>();
  auto next = elements.begin();
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    if (next == elements.end() || result.Near->Mesh.Elements[*next].Global != c)
    {
      if (!result.Kept[c])
      {
        add(c, -1);
      }
      continue;
    }
    for (int bandPart = first[*next]; bandPart < first[*next + 1]; ++bandPart)
    {
      add(c, bandPart);
    }
    ++next;
  }
  part.Cells.Resize(static_cast<Id>(cells.size()));
  std::copy(cells.begin(), cells.end(), part.Cells.data());
  return part;
}

int NodesOf(
  const HexMesh& mesh, const TrimResult& result, Id cell, int bandPart, std::array<Id, 8>& nodes)
{
  if (bandPart < 0)
  {
    return mesh.OrientedCell(cell, nodes);
  }
  const auto& part = result.Near->Rest.Elements[bandPart];
  for (int i = 0; i < part.Count; ++i)
  {
    nodes[i] = result.Near->Mesh.GlobalNode[part.Node[i]];
  }
  return part.Count;
}

ElementPoints PointsOfCell(
  const HexMesh& mesh, const TrimResult& result, Id cell, int bandPart, int& count)
{
  if (bandPart >= 0)
  {
    const auto& part = result.Near->Rest.Elements[bandPart];
    count = part.Count;
    return PointsOf(result.Near->Rest, part);
  }
  ElementPoints points;
  count = trim::PointsOfCell(mesh, cell, points);
  return points;
}

/// ScaledJacobian; returns the volume of each cell.
std::vector<double> AddQuality(const HexMesh& mesh, const TrimResult& result,
  const OffcutMesh& part, bool allElements, vtkUnstructuredGrid* output)
{
  vtkNew<vtkFloatArray> scaled;
  scaled->SetName("ScaledJacobian");
  scaled->SetNumberOfValues(part.Cells.size());
  float* values = scaled->GetPointer(0);
  std::vector<double> volume(part.Cells.size());
  for (Id i = 0; i < part.Cells.size(); ++i)
  {
    int count = 0;
    const auto points = PointsOfCell(mesh, result, part.Cells[i], part.BandPart[i], count);
    const bool touched = part.BandPart[i] >= 0 &&
      IsTouched(result.Near->Mesh, result.Near->Rest, result.Near->Rest.Elements[part.BandPart[i]]);
    values[i] = touched || allElements ? static_cast<float>(ScaledJacobian(points, count))
                                       : std::numeric_limits<float>::quiet_NaN();
    volume[i] = std::abs(VolumeOf(points, count));
  }
  output->GetCellData()->AddArray(scaled);
  return volume;
}

/// Of the elements in the band, which all ranks have.
void SummariseTouched(const TrimBand& near, Summary& summary)
{
  for (const auto& element : near.Rest.Elements)
  {
    if (!IsTouched(near.Mesh, near.Rest, element))
    {
      continue;
    }
    const ElementPoints points = PointsOf(near.Rest, element);
    const auto range = MeasureJacobian(points, element.Count);
    ++summary.TouchedElements;
    summary.CertifiedElements += range.Bezier > 0.0;
    summary.MinimumScaledJacobian =
      std::fmin(summary.MinimumScaledJacobian, ScaledJacobian(points, element.Count));
    summary.MinimumIntegrationPointJacobian =
      std::fmin(summary.MinimumIntegrationPointJacobian, range.IntegrationPoint / range.Mean);
  }
}

void AddFieldData(const Summary& summary, vtkUnstructuredGrid* output)
{
  vtkNew<vtkFieldData> all;
  summary.AddTo(all);
  for (const char* name : { "TouchedElements", "CertifiedElements", "MinimumScaledJacobian",
         "MinimumIntegrationPointJacobian", "Volume", "NodeBandwidth" })
  {
    output->GetFieldData()->AddArray(all->GetAbstractArray(name));
  }
}

}

void WriteOffcutGrid(vtkUnstructuredGrid* input, const HexMesh& mesh, const MeshBlocks& blocks,
  const Ranks& ranks, const TrimResult& result, const WriteOptions& options,
  const Progress& progress, vtkUnstructuredGrid* output)
{
  OffcutMesh part = CollectCells(mesh, result);
  const auto isInBand = [&part](Id i) { return part.BandPart[i] >= 0; };
  const auto nodesOf = [&](Id i, std::array<Id, 8>& nodes)
  { return NodesOf(mesh, result, part.Cells[i], part.BandPart[i], nodes); };
  NumberPoints(mesh, blocks, result, NodeEliminate, part, isInBand, nodesOf);
  if (options.RenumberNodes && !part.Cells.empty())
  {
    RenumberPart(mesh, progress, part, nodesOf);
  }
  if (ranks.Any(progress(0.97)))
  {
    return;
  }
  const MovedNodes moved = MovedNodesOfOffcut(result);
  Summary summary;
  summary.NodeBandwidth = ranks.Largest(WriteElements(mesh, part, nodesOf, output));
  WritePoints(input, mesh, part, moved, output);
  Findings found = result.Found;
  found.Shortfalls = result.Found.ShortfallsOfOffcut;
  AddStatusesAndFindings(result, part, moved, found, output);
  const auto volume = AddQuality(mesh, result, part, options.QualityOfAllElements, output);
  summary.Volume = OrderlessSum(
    part.Cells.size(), [&volume](Id i) { return volume[i]; }, ranks);
  if (result.Near)
  {
    SummariseTouched(*result.Near, summary);
  }
  AddFieldData(summary, output);
}

}
