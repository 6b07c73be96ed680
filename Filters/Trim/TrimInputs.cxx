#include "TrimInputs.h"

#include "DegenerateHexahedra.h"
#include "GatherAttributes.h"
#include "InputScale.h"
#include "NURBSFieldData.h"
#include "SharedBounds.h"
#include "SharedSurface.h"
#include "ShownSurface.h"
#include "SurfaceGaps.h"
#include "SurplusTuples.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkCompositeDataSetRange.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// What to do with a data set of another kind than an unstructured grid.
const char* AdviceFor(vtkDataObject* other)
{
  if (other->IsA("vtkPolyData"))
  {
    return "give an unstructured grid; the trimming surface is the other input.";
  }
  if (other->IsA("vtkStructuredGrid"))
  {
    return "Append Datasets makes it an unstructured grid.";
  }
  if (other->IsA("vtkImageData") || other->IsA("vtkRectilinearGrid"))
  {
    return "Transform and, of that, Append Datasets make it an unstructured grid.";
  }
  return "give an unstructured grid.";
}

/// The grid itself, or that of a composite which has one alone; null with an error else, without
/// one where there is no input.
/// @param none stands for that of a composite which has none: other ranks may have it.
vtkUnstructuredGrid* TakeOnlyGrid(
  vtkDataObject* input, vtkUnstructuredGrid* none, std::string& error)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  vtkDataObject* only = composite ? none : input;
  int count = 0;
  if (composite)
  {
    for (vtkDataObject* leaf : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      if (leaf->GetNumberOfElements(vtkDataObject::CELL) > 0)
      {
        ++count;
        only = leaf;
      }
    }
  }
  if (count > 1)
  {
    error = "The input grid comes in " + std::to_string(count) +
      " blocks, which have to be trimmed as one mesh: make it one by Merge Blocks first.";
    return nullptr;
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(only);
  if (only && !grid)
  {
    error = "The input holds a " + std::string(only->GetClassName()) +
      ", but a grid of hexahedra is needed: " + AdviceFor(only);
  }
  return grid;
}

/// Whether a surface has neither points to be seen nor a definition, as on ranks that have no part
/// of it, or behind a source that failed.
bool IsEmpty(vtkDataObject* surface)
{
  if (surface->GetNumberOfElements(vtkDataObject::POINT) > 0)
  {
    return false;
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(surface);
  if (!composite)
  {
    return !nurbs::HasNURBSFieldData(surface->GetFieldData());
  }
  const auto leaves = vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes);
  return std::none_of(leaves.begin(), leaves.end(),
    [](vtkDataObject* leaf) { return nurbs::HasNURBSFieldData(leaf->GetFieldData()); });
}

/// Places of the faces among the blocks, the same on all ranks, as those that a rank was not given
/// are there, but empty.
std::vector<Id> BlocksOf(vtkDataObject* surface)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(surface);
  if (!composite)
  {
    return { 0 };
  }
  std::vector<Id> blocks;
  for (const auto leaf : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
  {
    blocks.push_back(leaf.GetFlatIndex());
  }
  return blocks;
}

/// The grid itself, or, where its points are in another layout than one array, as numpy and
/// simulations hand them over, one that is the same but for that.
vtkSmartPointer<vtkUnstructuredGrid> WithPointsInOneArray(vtkUnstructuredGrid* grid)
{
  vtkDataArray* given = grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr;
  if (!given || given->HasStandardMemoryLayout())
  {
    return grid;
  }
  auto array =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(given->GetDataType()));
  array->DeepCopy(given);
  vtkNew<vtkPoints> points;
  points->SetData(array);
  auto copy = vtkSmartPointer<vtkUnstructuredGrid>::New();
  copy->ShallowCopy(grid);
  copy->SetPoints(points);
  return copy;
}

/// The grid itself, or, where no cell has its points, as on ranks that got no cells of a mesh, one
/// with nothing but the names of its arrays.
vtkSmartPointer<vtkUnstructuredGrid> WithoutLonePoints(vtkUnstructuredGrid* grid)
{
  if (grid->GetNumberOfCells() > 0 || grid->GetNumberOfPoints() == 0)
  {
    return grid;
  }
  auto empty = vtkSmartPointer<vtkUnstructuredGrid>::New();
  GatherAttributes(grid->GetPointData(), nullptr, 0, empty->GetPointData());
  GatherAttributes(grid->GetCellData(), nullptr, 0, empty->GetCellData());
  empty->GetFieldData()->ShallowCopy(grid->GetFieldData());
  return empty;
}

/// The global ids as VTK's own type of ids; null if there are none that are whole numbers.
vtkSmartPointer<vtkIdTypeArray> GlobalIdsOf(vtkPointData* data)
{
  vtkDataArray* given = data->GetGlobalIds();
  if (!given || given->GetDataType() == VTK_FLOAT || given->GetDataType() == VTK_DOUBLE)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkIdTypeArray> ids = vtkIdTypeArray::SafeDownCast(given);
  if (!ids)
  {
    ids = vtkSmartPointer<vtkIdTypeArray>::New();
    ids->DeepCopy(given);
  }
  return ids;
}

/// What is to be said of cells that are left out by their flags; empty: nothing. Collective.
std::string DescribeLeftOut(const OwnCells& own, const Ranks& ranks)
{
  // Several ranks trim the cells that are copied, too.
  const Id count = ranks.Sum(own.Hidden) + (ranks.Alone() ? own.Copies : 0);
  return count > 0 ? std::to_string(count) +
      " cells of the grid are flagged as hidden, refined or copies of others (vtkGhostType), and "
      "left out of the result: to trim them, too, take that array away, e.g. by Pass Arrays."
                   : "";
}

/// Of the cells: fewer that are inside out are defects of the mesh, which a trim leaves as they
/// are. More are a part that has its nodes in the other order.
constexpr double LeastInsideOut = 0.05;

/// What is to be said of hexahedra that are turned.
std::string DescribeInsideOut(Id count)
{
  return std::to_string(count) +
    " hexahedra of the grid are inside out, as in a mesh that was mirrored by Transform, and get "
    "their nodes in the right order in the result: data that goes by the order of an element's "
    "nodes is not turned. Reflect mirrors a mesh without that.";
}

/// What is to be said of hexahedra that are wedges; empty: nothing. Collective.
std::string DescribeWedges(Id own, const Ranks& ranks)
{
  const Id count = ranks.Sum(own);
  return count > 0 ? std::to_string(count) +
      " hexahedra of the grid have two pairs of corners in one node each, and come as the wedges "
      "that they are: data that goes by the order of an element's nodes is not turned."
                   : "";
}

/// What is to be said of arrays that are too long; empty: nothing. Collective.
std::string DescribeSurplus(const std::string& own, const Ranks& ranks)
{
  const std::string arrays = ranks.FirstText(own);
  return arrays.empty() ? ""
                        : "Arrays of the grid have more tuples than it has points or cells, of "
                          "which the first are taken: " +
      arrays + ". If these are not theirs, rewrite the grid or remove the arrays.";
}

/// The diagonal of the box of all control points.
double SizeOf(const std::vector<nurbs::NurbsSurface>& faces)
{
  nurbs::Box3 box;
  for (const auto& face : faces)
  {
    box.extend(nurbs::BoxOf(face));
  }
  return box.diagonal().norm();
}

}

const Id* TrimInputs::GlobalIds() const
{
  return this->TheGlobalIds ? this->TheGlobalIds->GetPointer(0) : nullptr;
}

void TrimInputs::ForgetOtherRanks()
{
  this->Grid = nullptr; // what is known of it is to be found anew
  this->TheSurface = nullptr;
}

bool TrimInputs::TakeChecked(vtkUnstructuredGrid* grid, std::string& error)
{
  if (!ViewGrid(grid, this->TheMesh, error))
  {
    return false;
  }
  this->TheOwn = TakeOwnCells(grid, this->TheMesh);
  if (this->TheOwn.Selected && !ViewGrid(this->TheOwn.Grid, this->TheMesh, error))
  {
    return false;
  }
  this->TheBlocks = BuildMeshBlocks(this->TheMesh);
  return true;
}

bool TrimInputs::TakeGrid(vtkUnstructuredGrid* grid, std::string& error)
{
  if (this->Grid == grid && this->StateOfGrid == nurbs::StateOf(grid))
  {
    return true;
  }
  this->Grid = nullptr;
  this->Joined = false;
  this->OwnWedges = 0;
  const auto plain =
    WithoutSurplus(WithPointsInOneArray(WithoutLonePoints(grid)), this->OwnSurplus);
  // Most grids have no defect: only others are looked at for which is the first.
  if (!HasGhosts(plain) && ViewUnchecked(plain, this->TheMesh) &&
    ScanMesh(this->TheMesh, this->TheBlocks))
  {
    this->TheOwn = TakeOwnCells(plain, this->TheMesh);
  }
  else if (!this->TakeChecked(WithWedges(plain, this->OwnWedges), error))
  {
    return false;
  }
  this->OwnInsideOut = this->TheBlocks.SomeInsideOut ? this->TheMesh.CountInsideOut() : 0;
  this->Grid = grid;
  this->StateOfGrid = nurbs::StateOf(grid);
  return true;
}

bool TrimInputs::JoinPieces(const Ranks& ranks, std::string& error)
{
  if (!ranks.Any(!this->Joined))
  {
    return true;
  }
  if (this->Joined)
  {
    this->TheBlocks = BuildMeshBlocks(this->TheMesh); // they know of the pieces of before
    this->Joined = false;
  }
  const Id cells = ranks.Sum(this->TheMesh.NumberOfCells);
  if (cells == 0)
  {
    error = "The input grid has no cells: connect a grid of hexahedra.";
    return false;
  }
  const auto ids = ranks.Alone() ? nullptr : GlobalIdsOf(this->TheOwn.Grid->GetPointData());
  const bool lacksIds = ranks.Any(this->TheMesh.NumberOfPoints > 0 && !ids);
  this->TheGlobalIds = lacksIds ? nullptr : ids;
  const Id insideOut = ranks.Sum(this->OwnInsideOut);
  this->TheMesh.TurnsInsideOut = insideOut > LeastInsideOut * cells;
  this->GridRemarks = { DescribeLeftOut(this->TheOwn, ranks),
    lacksIds && ranks.Any(ids != nullptr)
      ? "Some pieces of the grid have global ids of their points and others have none, so nodes "
        "of several pieces are known by their places: make new ones, e.g. with Generate Global Ids."
      : "",
    DescribeSurplus(this->OwnSurplus, ranks),
    this->TheMesh.TurnsInsideOut ? DescribeInsideOut(insideOut) : "",
    DescribeWedges(this->OwnWedges, ranks) };
  if (!FindSharedNodes(
        this->TheMesh, this->TheBlocks, this->GlobalIds(), ranks, this->TheShared, error))
  {
    return false;
  }
  ShareBounds(ranks, this->TheBlocks);
  this->Joined = true;
  return true;
}

bool TrimInputs::TakeSurface(vtkDataObject* data, std::string& error)
{
  auto states = nurbs::StatesOf(data);
  if (this->SurfaceData == data && this->SurfaceStates == states)
  {
    return true;
  }
  this->SurfaceData = nullptr;
  this->TheSurface = nullptr;
  if (IsEmpty(data))
  {
    this->OwnFaces.clear(); // other ranks may have the surface
    this->BlocksOfFaces.clear();
  }
  else if (!nurbs::ReadTrimmingSurface(data, this->OwnFaces, error))
  {
    error = "The trimming surface is not valid: " + error + ".";
    return false;
  }
  else
  {
    this->BlocksOfFaces = BlocksOf(data);
  }
  this->Shown = SamplePolygons(data);
  this->SurfaceData = data;
  this->SurfaceStates = std::move(states);
  return true;
}

bool TrimInputs::JoinFaces(
  const Ranks& ranks, std::vector<nurbs::NurbsSurface>& faces, std::string& error)
{
  if (!ranks.Any(!this->TheSurface))
  {
    return true;
  }
  this->TheSurface = nullptr;
  faces = ShareFaces(ranks, this->OwnFaces, this->BlocksOfFaces);
  if (faces.empty())
  {
    error = "The trimming surface is empty: see the error of its source, or connect a CAD Surface "
            "Reader, Trim Line Source or NURBS Surface Source.";
    return false;
  }
  this->SizeOfFaces = SizeOf(faces);
  return true;
}

void TrimInputs::MakeSurface(const Ranks& ranks, std::vector<nurbs::NurbsSurface> faces)
{
  const double grid = this->TheBlocks.Bounds.diagonal().norm();
  const double size = nurbs::SizeForGaps(this->SizeOfFaces, grid);
  if (this->TheSurface && size == this->SizeOfGaps)
  {
    return;
  }
  if (this->TheSurface) // the grid is another one; which shells are there twice goes by it
  {
    faces = ShareFaces(ranks, this->OwnFaces, this->BlocksOfFaces);
  }
  const double widest = nurbs::FindWidestGap(faces, size);
  this->TheSurface =
    std::make_unique<nurbs::TrimmingSurface>(std::move(faces), nurbs::GapShare * size, widest);
  this->SizeOfGaps = size;
  this->SurfaceRemark = ranks.FirstText(FindShift(this->Shown, *this->TheSurface));
}

bool TrimInputs::Take(
  vtkDataObject* grid, vtkDataObject* surface, const Ranks& ranks, std::string& error)
{
  vtkUnstructuredGrid* only = TakeOnlyGrid(grid, this->NoGrid, error);
  if (!only)
  {
    error = error.empty() ? "No grid is connected to the first input: connect a grid of hexahedra."
                          : error;
  }
  else if (!surface)
  {
    error = "No trimming surface is connected to the second input: connect a CAD Surface Reader, "
            "Trim Line Source or NURBS Surface Source.";
  }
  else if (this->TakeGrid(only, error) && this->TakeSurface(surface, error))
  {
    error.clear();
  }
  if (!ranks.Alone() && !error.empty())
  {
    error = "Rank " + std::to_string(ranks.Rank()) + ": " + error;
  }
  error = ranks.FirstText(error);
  if (!error.empty())
  {
    return false;
  }
  std::vector<nurbs::NurbsSurface> faces;
  if (!this->JoinFaces(ranks, faces, error) || !this->JoinPieces(ranks, error))
  {
    return false;
  }
  this->MakeSurface(ranks, std::move(faces));
  const nurbs::Box3& bounds = this->TheBlocks.Bounds;
  error = FindGridScaleDefect(bounds);
  error = error.empty() ? FindSurfaceScaleDefect(bounds, this->TheSurface->Bounds()) : error;
  return error.empty();
}

std::vector<std::string> TrimInputs::Remarks() const
{
  std::vector<std::string> remarks = this->GridRemarks;
  remarks.push_back(this->SurfaceRemark);
  remarks.erase(std::remove(remarks.begin(), remarks.end(), std::string()), remarks.end());
  return remarks;
}

}
