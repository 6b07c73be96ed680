#include "GhostCells.h"

#include "ArrayNames.h"
#include "GatherAttributes.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace trim
{
namespace
{

constexpr unsigned char CopyFlag = vtkDataSetAttributes::DUPLICATECELL;
constexpr unsigned char HiddenFlags =
  vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;

bool HasFlags(vtkUnsignedCharArray* ghosts)
{
  if (!ghosts)
  {
    return false;
  }
  const unsigned char* flags = ghosts->GetPointer(0);
  return std::any_of(
    flags, flags + ghosts->GetNumberOfValues(), [](unsigned char flag) { return flag != 0; });
}

void FindOwn(const HexMesh& mesh, vtkUnsignedCharArray* ghosts, OwnCells& own)
{
  std::vector<char> used(mesh.NumberOfPoints, 0);
  std::array<Id, 8> nodes;
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    const unsigned char flags = ghosts ? ghosts->GetPointer(0)[c] : 0;
    if (IsLeftOut(flags))
    {
      ++(flags & CopyFlag ? own.Copies : own.Hidden);
      continue;
    }
    own.Cells.push_back(c);
    const int count = mesh.Cell(c, nodes);
    for (int i = 0; i < count; ++i)
    {
      used[nodes[i]] = 1;
    }
  }
  for (Id p = 0; p < mesh.NumberOfPoints; ++p)
  {
    if (used[p])
    {
      own.Points.push_back(p);
    }
  }
}

template <typename Array, typename Value>
void CopyPoints(const Value* from, const std::vector<Id>& ids, vtkUnstructuredGrid* grid)
{
  vtkNew<Array> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<Id>(ids.size()));
  Value* to = coordinates->GetPointer(0);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    std::copy_n(from + 3 * ids[i], 3, to + 3 * i);
  }
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  grid->SetPoints(points);
}

void CopyCells(
  const HexMesh& mesh, const OwnCells& own, vtkUnsignedCharArray* types, vtkUnstructuredGrid* grid)
{
  std::vector<Id> number(mesh.NumberOfPoints, -1);
  for (std::size_t i = 0; i < own.Points.size(); ++i)
  {
    number[own.Points[i]] = static_cast<Id>(i);
  }
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> ownTypes;
  std::array<Id, 8> nodes;
  for (const Id c : own.Cells)
  {
    const int count = mesh.Cell(c, nodes);
    std::transform(
      nodes.begin(), nodes.begin() + count, nodes.begin(), [&](Id node) { return number[node]; });
    cells->InsertNextCell(count, nodes.data());
    ownTypes->InsertNextValue(types->GetValue(c));
  }
  grid->SetCells(ownTypes, cells);
}

void RemoveFlags(vtkUnstructuredGrid* grid)
{
  grid->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  grid->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
}

/// The grid itself, or one that is the same but for arrays which flag nothing.
vtkSmartPointer<vtkUnstructuredGrid> WithoutFlags(vtkUnstructuredGrid* grid)
{
  if (!grid->GetCellGhostArray() && !grid->GetPointGhostArray())
  {
    return grid;
  }
  auto plain = vtkSmartPointer<vtkUnstructuredGrid>::New();
  plain->ShallowCopy(grid);
  RemoveFlags(plain);
  return plain;
}

}

bool IsLeftOut(unsigned char flags)
{
  return (flags & (CopyFlag | HiddenFlags)) != 0;
}

bool HasGhosts(vtkUnstructuredGrid* grid)
{
  return grid->GetNumberOfCells() > 0 &&
    (HasFlags(grid->GetCellGhostArray()) || HasFlags(grid->GetPointGhostArray()));
}

OwnCells TakeOwnCells(vtkUnstructuredGrid* input, const HexMesh& mesh)
{
  OwnCells own;
  if (!HasGhosts(input))
  {
    own.Grid = WithoutFlags(input);
    return own;
  }
  own.Selected = true;
  FindOwn(mesh, input->GetCellGhostArray(), own);
  vtkNew<vtkUnstructuredGrid> grid;
  if (mesh.PointsDouble)
  {
    CopyPoints<vtkDoubleArray>(mesh.PointsDouble, own.Points, grid);
  }
  else
  {
    CopyPoints<vtkFloatArray>(mesh.PointsFloat, own.Points, grid);
  }
  CopyCells(mesh, own, input->GetCellTypesArray(), grid);
  GatherAttributes(input->GetPointData(), own.Points.data(), static_cast<Id>(own.Points.size()),
    grid->GetPointData());
  GatherAttributes(
    input->GetCellData(), own.Cells.data(), static_cast<Id>(own.Cells.size()), grid->GetCellData());
  RemoveFlags(grid);
  grid->GetFieldData()->ShallowCopy(input->GetFieldData());
  own.Grid = grid;
  return own;
}

void RestoreOriginalIds(const OwnCells& own, vtkUnstructuredGrid* grid)
{
  const auto restore = [](vtkDataSetAttributes* data, const char* name, const std::vector<Id>& ids)
  {
    auto* array = vtkIdTypeArray::SafeDownCast(data->GetAbstractArray(name));
    if (!array)
    {
      return;
    }
    for (Id i = 0; i < array->GetNumberOfValues(); ++i)
    {
      array->SetValue(i, ids[array->GetValue(i)]);
    }
    array->Modified(); // it was told the range of the ids before
  };
  if (own.Selected)
  {
    restore(grid->GetPointData(), names::OriginalPoints, own.Points);
    restore(grid->GetCellData(), names::OriginalCells, own.Cells);
  }
}

}
