#include "TrimmedGrid.h"

#include "ArrayRanges.h"
#include "CountBytes.h"
#include "FindingArrays.h"
#include "Rescue.h"
#include "Status.h"
#include "StatusArrays.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <tuple>

namespace trim
{
namespace
{

/// Nodes of a kept element at the cut, in input ids, with edges dropped where it became a wedge.
int NodesAtCut(
  const HexMesh& mesh, const TrimResult& result, Id cell, int bandElement, std::array<Id, 8>& nodes)
{
  const auto& near = *result.Near;
  const auto take = [&](const auto& own, int count)
  {
    std::transform(own.begin(), own.begin() + count, nodes.begin(),
      [&near](int n) { return near.Mesh.GlobalNode[n]; });
    return count;
  };
  if (const ReplacedElement* wedge = FindWedge(near.Trimmed.Treated, bandElement))
  {
    return take(wedge->Node, 6);
  }
  if (near.Mesh.BeforeLayer)
  {
    const BandElement& element = near.Mesh.Elements[bandElement];
    return take(element.Node, element.Count);
  }
  return mesh.OrientedCell(cell, nodes);
}

/// An element of the band, by the cell that it is, or on whose face it was inserted.
struct CellInBand
{
  Id Cell;
  bool Inserted;
  int Element;
  bool operator<(const CellInBand& other) const
  {
    return std::tie(this->Cell, this->Inserted, this->Element) <
      std::tie(other.Cell, other.Inserted, other.Element);
  }
};

/// Those of this rank's piece, ascending.
std::vector<CellInBand> CellsInBand(const TrimResult& result)
{
  std::vector<CellInBand> cells;
  if (result.Near && !result.Near->Mesh.BeforeLayer)
  {
    for (const int e : result.Near->Mesh.ElementsByCell())
    {
      cells.push_back({ result.Near->Mesh.Elements[e].Global, false, e });
    }
    return cells;
  }
  for (int e = 0; result.Near && e < result.Near->Mesh.NumberOfElements(); ++e)
  {
    const Id cell = CellOf(result.Near->Mesh, e);
    if (cell >= 0)
    {
      cells.push_back({ cell, result.Near->Mesh.IsInserted(e), e });
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// So many cells are looked at at once.
constexpr Id Eight = 8;

/// Lists eight cells off the band from c on if they have one fate, as most that follow each other
/// have; else returns false.
bool ListEight(const TrimResult& result, Id c, Id& place, GridPart& kept)
{
  constexpr std::uint64_t allKept = 0x0101010101010101;
  std::uint64_t fates;
  std::memcpy(&fates, &result.Kept[c], sizeof(fates));
  if (fates != allKept)
  {
    return fates == 0;
  }
  Id* const cells = kept.Cells.data() + place;
  int* const elements = &kept.InBand[place];
  for (Id k = 0; k < Eight; ++k)
  {
    cells[k] = c + k;
    elements[k] = -1;
  }
  place += Eight;
  return true;
}

/// The kept cells from begin to end; `place`: where the first of them is listed.
void ListCells(const TrimResult& result, const std::vector<CellInBand>& band, Id begin, Id end,
  Id place, GridPart& kept)
{
  auto next = std::lower_bound(band.begin(), band.end(), CellInBand{ begin, false, 0 });
  const auto cellInBand = [&] { return next == band.end() ? end : next->Cell; };
  Id inBand = cellInBand();
  Id* const cells = kept.Cells.data();
  const auto list = [&](Id cell, int element)
  {
    cells[place] = cell;
    kept.InBand[place] = element;
    ++place;
  };
  for (Id c = begin; c < end; ++c)
  {
    if (c + Eight <= std::min(inBand, end) && ListEight(result, c, place, kept))
    {
      c += Eight - 1;
      continue;
    }
    if (c != inBand)
    {
      if (result.Kept[c])
      {
        list(c, -1);
      }
      continue;
    }
    for (; next != band.end() && next->Cell == c; ++next)
    {
      if (result.Near->Trimmed.Kept[next->Element])
      {
        list(c, next->Element);
      }
    }
    inBand = cellInBand();
  }
}

void CollectCells(const HexMesh& mesh, const TrimResult& result, GridPart& kept)
{
  const Id runs = NumberOfRuns(mesh.NumberOfCells, PartGrain);
  std::vector<Id> first(runs + 1, 0);
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) {
      first[run + 1] = CountBytes(result.Kept.data() + begin, result.Kept.data() + end, char(1));
    });
  const std::vector<CellInBand> band = CellsInBand(result);
  for (const CellInBand& cell : band)
  {
    first[cell.Cell / PartGrain + 1] += cell.Inserted && result.Near->Trimmed.Kept[cell.Element];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  kept.Cells.Resize(first.back());
  kept.InBand.resize(first.back());
  ForRuns(mesh.NumberOfCells,
    [&](Id run, Id begin, Id end) { ListCells(result, band, begin, end, first[run], kept); });
  TellRangeOfAscending(kept.Cells.Array());
}

/// Largest distance to the surface over the nodes of the new boundary.
double LargestDistance(const TrimResult& result, const nurbs::TrimmingSurface& surface)
{
  const auto& near = *result.Near;
  const std::vector<int> nodes = ListBoundaryNodes(near.Mesh, near.Trimmed);
  std::vector<double> distances(nodes.size());
  ForAll(static_cast<int>(nodes.size()),
    [&](int i)
    { distances[i] = surface.ClosestPoint(near.Trimmed.NodeMoves.Position[nodes[i]]).Distance; });
  return distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end());
}

/// Of the input, by elements where they were relaxed, by columns elsewhere: these go or stay as
/// one.
void CountRescues(const TrimResult& result, Summary& summary)
{
  const auto& trimmed = result.Near->Trimmed;
  for (int e = 0; e < result.Near->Mesh.NumberOfElements(); ++e)
  {
    if (result.Near->Mesh.IsInserted(e))
    {
      continue;
    }
    summary.RescuedByRelaxation += RescueOf(*result.Near, e) == Rescue::Relaxation;
    const Rescue rescue = RescueOfColumn(trimmed, e);
    summary.RescuedByTreatment += rescue == Rescue::Treatment;
    summary.RescuedByCorrection += rescue == Rescue::Correction;
    summary.RescuedByFate += rescue == Rescue::Fate;
    summary.RescuedByLeaving += rescue == Rescue::Left;
  }
}

void Summarise(const Ranks& ranks, const TrimResult& result, const GridPart& kept,
  const MovedNodes& moved, const nurbs::TrimmingSurface& surface, Summary& summary)
{
  const auto isInserted = [&result](int element)
  { return element >= 0 && result.Near->Mesh.IsInserted(element); };
  const Id inserted = result.Near && result.Near->Mesh.BeforeLayer
    ? std::count_if(kept.InBand.begin(), kept.InBand.end(), isInserted)
    : 0;
  summary.InsertedElements = ranks.Sum(inserted);
  summary.Kept = ranks.Sum(kept.Cells.size()) - summary.InsertedElements;
  summary.Eliminated = ranks.Sum(static_cast<Id>(result.Kept.size())) - summary.Kept;
  summary.Treated = ranks.Sum(CountBytes(result.ElementStatus, ElementToTreat));
  // The band, and all that is counted in it, is the same on every rank.
  if (result.Near)
  {
    summary.MovedNodes = static_cast<Id>(moved.Nodes.size());
    summary.Pentahedra = result.Near->Trimmed.Treated.Count;
    summary.Wedges = static_cast<Id>(result.Near->Trimmed.Treated.Wedges.size());
    summary.MaximumDistanceToSurface = LargestDistance(result, surface);
    CountRescues(result, summary);
  }
}

/// Of each element of the band its cell; -1: it is none of this rank's.
std::vector<Id> CellsOfBand(const TrimResult& result)
{
  std::vector<Id> cells;
  for (int e = 0; result.Near && e < result.Near->Mesh.NumberOfElements(); ++e)
  {
    cells.push_back(result.Near->Mesh.Elements[e].Global);
  }
  return cells;
}

/// Of the elements of the band, by place in an output.
template <typename ToPlace>
std::vector<std::pair<Id, Shortfall>> ShortfallsAt(const TrimResult& result, const ToPlace& toPlace)
{
  std::vector<std::pair<Id, Shortfall>> found;
  if (result.Near)
  {
    for (const auto& item : result.Near->Shortfalls)
    {
      found.emplace_back(toPlace(item.first), item.second);
    }
  }
  return found;
}

}

void WriteTrimmedGrid(
  const WriteInput& from, const nurbs::TrimmingSurface& surface, vtkUnstructuredGrid* output)
{
  const HexMesh& mesh = from.Mesh;
  const TrimResult& result = from.Result;
  GridPart kept;
  CollectCells(mesh, result, kept);
  const auto nodesOf = [&](Id i, std::array<Id, 8>& nodes)
  {
    const int element = kept.InBand[i];
    return element < 0 ? mesh.OrientedCell(kept.Cells[i], nodes)
                       : NodesAtCut(mesh, result, kept.Cells[i], element, nodes);
  };
  NumberPoints(mesh, from.Blocks, result, NodeKeep, kept, nodesOf);
  std::optional<Renumbering> renumbered;
  if (from.Options.RenumberNodes && !from.Tell(0.65))
  {
    renumbered = RenumberPart(mesh, from.Blocks, from.Tell, kept, nodesOf);
  }
  if (from.All.Any(from.Tell(0.85)))
  {
    return;
  }
  const MovedNodes moved = MovedNodesOfKept(result);
  const BandShapes shapes = ShapesOfKept(result);
  Summary summary;
  WritePart(from, kept, moved, shapes, nodesOf, renumbered, summary, output);
  if (from.Options.InsertLayer)
  {
    AddInserted(result, kept, output);
  }
  const auto placeOf = PlacesInBand(kept, shapes.Count);
  AddRescues(result, kept.Cells.size(), placeOf, output->GetCellData());
  AddShortfalls(ShortfallsAt(result, [&placeOf](int e) { return placeOf[e]; }), kept.Cells.size(),
    output->GetCellData());
  MeasurePart(from, kept, shapes, summary, output);
  Summarise(from.All, result, kept, moved, surface, summary);
  summary.AddTo(output->GetFieldData());
  from.Tell(0.95);
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
  AddRescues(result, cells.size(), CellsOfBand(result), output->GetCellData());
  AddCellFindings(result.Found, cells, output->GetCellData());
  AddShortfalls(ShortfallsAt(result, [&result](int e) { return CellOf(result.Near->Mesh, e); }),
    cells.size(), output->GetCellData());
  ColourByStatus(output);
}

}
