#include "OffcutGrid.h"

#include "ArrayNames.h"
#include "FindingArrays.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <optional>

namespace trim
{
namespace
{

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

GridPart CollectCells(const HexMesh& mesh, const TrimResult& result)
{
  GridPart part;
  std::vector<Id> cells;
  const auto add = [&part, &cells](Id cell, int inBand)
  {
    cells.push_back(cell);
    part.InBand.push_back(inBand);
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
    for (int inBand = first[*next]; inBand < first[*next + 1]; ++inBand)
    {
      add(c, inBand);
    }
    ++next;
  }
  part.Cells.Resize(static_cast<Id>(cells.size()));
  std::copy(cells.begin(), cells.end(), part.Cells.data());
  return part;
}

/// Nodes of a cell of the offcut, in input ids.
int NodesOf(
  const HexMesh& mesh, const TrimResult& result, Id cell, int inBand, std::array<Id, 8>& nodes)
{
  if (inBand < 0)
  {
    return mesh.OrientedCell(cell, nodes);
  }
  const auto& element = result.Near->Rest.Elements[inBand];
  for (int i = 0; i < element.Count; ++i)
  {
    nodes[i] = result.Near->Mesh.GlobalNode[element.Node[i]];
  }
  return element.Count;
}

/// True if an element is there in several parts, on any rank: all of them know the whole band.
bool IsDivided(const TrimResult& result)
{
  const auto sameElement = [](const OffcutElement& a, const OffcutElement& b)
  { return a.Element == b.Element; };
  return result.Near &&
    std::adjacent_find(result.Near->Rest.Elements.begin(), result.Near->Rest.Elements.end(),
      sameElement) != result.Near->Rest.Elements.end();
}

/// By place in the offcut.
std::vector<std::pair<Id, Shortfall>> ShortfallsOfCells(
  const TrimResult& result, const GridPart& part)
{
  std::vector<std::pair<Id, Shortfall>> found;
  for (Id i = 0; i < part.Cells.size(); ++i)
  {
    if (part.InBand[i] >= 0)
    {
      const auto& list = result.Near->ShortfallsOfRest;
      const int element = result.Near->Rest.Elements[part.InBand[i]].Element;
      const auto at = std::lower_bound(
        list.begin(), list.end(), element, [](const auto& item, int e) { return item.first < e; });
      if (at != list.end() && at->first == element)
      {
        found.emplace_back(i, at->second);
      }
    }
  }
  return found;
}

void AddFieldData(const Summary& summary, vtkUnstructuredGrid* output)
{
  vtkNew<vtkFieldData> all, told;
  summary.AddTo(all);
  for (const char* name :
    { names::TouchedElements, names::CertifiedElements, names::MinimumScaledJacobian,
      names::MinimumIntegrationPointJacobian, names::Volume, names::NodeBandwidth })
  {
    told->AddArray(all->GetAbstractArray(name));
  }
  PutFirst(told, output->GetFieldData());
}

}

void WriteOffcutGrid(const WriteInput& from, vtkUnstructuredGrid* output)
{
  const HexMesh& mesh = from.Mesh;
  const TrimResult& result = from.Result;
  GridPart part = CollectCells(mesh, result);
  const auto nodesOf = [&](Id i, std::array<Id, 8>& nodes)
  { return NodesOf(mesh, result, part.Cells[i], part.InBand[i], nodes); };
  NumberPoints(mesh, from.Blocks, result, NodeEliminate, part, nodesOf);
  std::optional<Renumbering> renumbered;
  if (from.Options.RenumberNodes && !part.Cells.empty())
  {
    renumbered = RenumberPart(mesh, from.Blocks, from.Tell, part, nodesOf);
  }
  if (from.All.Any(from.Tell(0.97)))
  {
    return;
  }
  const BandShapes shapes = ShapesOfOffcut(result);
  Summary summary;
  WritePart(from, part, MovedNodesOfOffcut(result), shapes, nodesOf, renumbered, summary, output);
  AddShortfalls(ShortfallsOfCells(result, part), part.Cells.size(), output->GetCellData());
  if (IsDivided(result))
  {
    ForgetGlobalIds(output->GetCellData());
  }
  MeasurePart(from, part, shapes, summary, output);
  AddFieldData(summary, output);
}

}
