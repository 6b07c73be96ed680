#include "DegenerateHexahedra.h"

#include "GhostCells.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <vector>

namespace trim
{
namespace
{

/// The corners of a face in their order, and behind them those that edges join to them.
constexpr std::array<std::array<int, 8>, 6> FacesAndOpposite = { { { 0, 1, 2, 3, 4, 5, 6, 7 },
  { 4, 5, 6, 7, 0, 1, 2, 3 }, { 0, 1, 5, 4, 3, 2, 6, 7 }, { 3, 2, 6, 7, 0, 1, 5, 4 },
  { 1, 2, 6, 5, 0, 3, 7, 4 }, { 0, 3, 7, 4, 1, 2, 6, 5 } } };

bool AreDistinct(std::array<vtkIdType, 6> nodes)
{
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

/// @return whether a hexahedron is a wedge, with the wedge's nodes.
template <typename T>
bool IsWedge(const T* nodes, std::array<vtkIdType, 6>& wedge)
{
  for (const auto& corners : FacesAndOpposite)
  {
    for (int turn = 0; turn < 2; ++turn)
    {
      const auto face = [&](int i) { return nodes[corners[(i + turn) % 4]]; };
      const auto opposite = [&](int i) { return nodes[corners[4 + (i + turn) % 4]]; };
      if (face(0) == face(1) && face(2) == face(3))
      {
        wedge = { face(0), opposite(0), opposite(1), face(3), opposite(3), opposite(2) };
        return AreDistinct(wedge);
      }
    }
  }
  return false;
}

/// Whether the nodes of a cell are those of a hexahedron and lie within the connectivity.
template <typename T>
bool HasEightNodes(const T* offsets, vtkIdType size, vtkIdType c)
{
  return offsets[c] >= 0 && offsets[c] <= size - 8 && offsets[c + 1] == offsets[c] + 8;
}

/// The nodes of hexahedra that are wedges, by ascending cell.
struct Wedges
{
  std::vector<vtkIdType> Cells;
  std::vector<std::array<vtkIdType, 6>> Nodes;
};

struct FindWedges
{
  template <typename State>
  void operator()(State& state, const unsigned char* types, Wedges& found) const
  {
    const auto* const nodes = state.GetConnectivity()->GetPointer(0);
    const auto* const offsets = state.GetOffsets()->GetPointer(0);
    const vtkIdType size = state.GetConnectivity()->GetNumberOfValues();
    std::array<vtkIdType, 6> wedge;
    for (vtkIdType c = 0; c < state.GetNumberOfCells(); ++c)
    {
      if (types[c] == VTK_HEXAHEDRON && HasEightNodes(offsets, size, c) &&
        IsWedge(nodes + offsets[c], wedge))
      {
        found.Cells.push_back(c);
        found.Nodes.push_back(wedge);
      }
    }
  }
};

/// Whether the cells of a grid can be gone through at all.
bool HasCells(vtkUnstructuredGrid* grid)
{
  return grid->GetNumberOfCells() > 0 &&
    grid->GetCellTypesArray()->GetNumberOfValues() >= grid->GetNumberOfCells();
}

/// Of cells, those that are trimmed: several ranks may have copies of the others.
vtkIdType CountOwn(const std::vector<vtkIdType>& cells, vtkUnsignedCharArray* flags)
{
  return std::count_if(cells.begin(), cells.end(),
    [flags](vtkIdType c)
    { return !flags || c >= flags->GetNumberOfValues() || !IsLeftOut(flags->GetValue(c)); });
}

/// Whether each cell ends where the next one begins.
struct AreInOrder
{
  template <typename State>
  bool operator()(State& state) const
  {
    const auto* const offsets = state.GetOffsets()->GetPointer(0);
    const vtkIdType count = state.GetNumberOfCells();
    return offsets[0] >= 0 && std::is_sorted(offsets, offsets + count + 1) &&
      offsets[count] <= state.GetConnectivity()->GetNumberOfValues();
  }
};

}

vtkSmartPointer<vtkUnstructuredGrid> WithWedges(vtkUnstructuredGrid* grid, vtkIdType& count)
{
  count = 0;
  if (!HasCells(grid))
  {
    return grid;
  }
  vtkCellArray* const given = grid->GetCells();
  Wedges wedges;
  given->Visit(FindWedges{}, grid->GetCellTypesArray()->GetPointer(0), wedges);
  if (wedges.Cells.empty() || !given->Visit(AreInOrder{}))
  {
    return grid;
  }
  count = CountOwn(wedges.Cells, grid->GetCellGhostArray());
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(given->GetNumberOfCells(), given->GetNumberOfConnectivityIds());
  vtkNew<vtkUnsignedCharArray> types;
  types->DeepCopy(grid->GetCellTypesArray());
  auto next = wedges.Cells.begin();
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < given->GetNumberOfCells(); ++c)
  {
    if (next != wedges.Cells.end() && *next == c)
    {
      cells->InsertNextCell(6, wedges.Nodes[next - wedges.Cells.begin()].data());
      types->SetValue(c, VTK_WEDGE);
      ++next;
    }
    else
    {
      given->GetCellAtId(c, nodes);
      cells->InsertNextCell(nodes);
    }
  }
  auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
  copy->ShallowCopy(grid);
  copy->SetCells(types, cells);
  return copy;
}

}
