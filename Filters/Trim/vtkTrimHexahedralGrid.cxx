#include "vtkTrimHexahedralGrid.h"

#include "ArrayRanges.h"
#include "ChangeTime.h"
#include "ControllerRanks.h"
#include "GhostCells.h"
#include "InputScale.h"
#include "MeshBlocks.h"
#include "NURBSFieldData.h"
#include "NodeOrdering.h"
#include "OffcutGrid.h"
#include "SharedBounds.h"
#include "SharedNodes.h"
#include "SharedSurface.h"
#include "ThreadScope.h"
#include "TrimPipeline.h"
#include "TrimmedGrid.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cmath>
#include <new>
#include <string>
#include <utility>

namespace
{

/// The grid itself, or that of a composite which has one alone; null with an error else.
/// @param none stands for that of a composite which has none: other ranks may have it.
vtkUnstructuredGrid* TakeOnlyGrid(
  vtkDataObject* input, vtkUnstructuredGrid* none, std::string& error)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    return vtkUnstructuredGrid::SafeDownCast(input);
  }
  vtkDataObject* only = none;
  int count = 0;
  auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkDataObject* leaf = it->GetCurrentDataObject();
    if (leaf->GetNumberOfElements(vtkDataObject::CELL) > 0)
    {
      ++count;
      only = leaf;
    }
  }
  if (count > 1)
  {
    error = "The input grid comes in " + std::to_string(count) +
      " blocks, which have to be trimmed as one mesh: make it one by Merge Blocks first.";
    return nullptr;
  }
  auto* grid = vtkUnstructuredGrid::SafeDownCast(only);
  if (!grid)
  {
    error = "The input holds a " + std::string(only->GetClassName()) +
      ", but a grid of hexahedra is needed: give an unstructured grid.";
  }
  return grid;
}

/// The setters' limits let NaN through.
std::string FindOptionDefect(const trim::TrimOptions& options)
{
  const std::pair<const char*, double> shares[] = { { "EliminationFraction",
                                                      options.Ladder.EliminationFraction },
    { "MinimumScaledJacobian", options.Ladder.QualityFloor }, { "Tolerance", options.Tolerance } };
  for (const auto& share : shares)
  {
    if (!std::isfinite(share.second))
    {
      return std::string(share.first) + " is not a number: give one from 0 to 1.";
    }
  }
  const bool near = options.KeepPoint.cwiseAbs().maxCoeff() < trim::LargestCoordinate;
  return options.UseKeepPoint && !(options.KeepPoint.allFinite() && near)
    ? "KeepPoint has a coordinate that is not finite or too large: give a point in the part of the "
      "grid that is to stay."
    : "";
}

std::unique_ptr<nurbs::TrimmingSurface> MakeSurface(std::vector<nurbs::NurbsSurface> faces)
{
  nurbs::Box3 box;
  for (const auto& face : faces)
  {
    for (const auto& point : face.ControlPoints)
    {
      box.extend(nurbs::Vec3(point[0], point[1], point[2]));
    }
  }
  const double size = box.diagonal().norm();
  return std::make_unique<nurbs::TrimmingSurface>(
    std::move(faces), trim::GapShare * size, trim::WidestGapShare * size);
}

}

/// What depends on one input alone is kept until that input changes.
struct vtkTrimHexahedralGrid::Cache
{
  const vtkNew<vtkUnstructuredGrid> NoGrid; ///< see TakeOnlyGrid
  vtkWeakPointer<vtkUnstructuredGrid> Grid;
  vtkMTimeType GridTime = 0;
  trim::OwnCells Own;
  trim::HexMesh Mesh;
  trim::MeshBlocks Blocks;
  bool Joined = false; ///< Blocks and Shared know of the other ranks' pieces
  trim::SharedNodes Shared;

  vtkWeakPointer<vtkDataObject> SurfaceData;
  vtkMTimeType SurfaceTime = 0;
  std::vector<nurbs::NurbsSurface> OwnFaces;       ///< those that this rank was given
  std::unique_ptr<nurbs::TrimmingSurface> Surface; ///< of all ranks' faces; null: not made yet

  bool TakeGrid(vtkUnstructuredGrid* grid, std::string& error)
  {
    if (this->Grid == grid && this->GridTime == grid->GetMTime())
    {
      return true;
    }
    this->Grid = nullptr;
    this->Joined = false;
    if (!trim::ViewGrid(grid, this->Mesh, error))
    {
      return false;
    }
    this->Own = trim::TakeOwnCells(grid, this->Mesh);
    if (this->Own.Selected && !trim::ViewGrid(this->Own.Grid, this->Mesh, error))
    {
      return false;
    }
    this->Grid = grid;
    this->GridTime = grid->GetMTime();
    return true;
  }

  /// Collective: what the pieces have in common.
  bool JoinPieces(const trim::Ranks& ranks, std::string& error)
  {
    if (!ranks.Any(!this->Joined))
    {
      return true;
    }
    this->Joined = false;
    if (ranks.Sum(this->Mesh.NumberOfCells) == 0)
    {
      error = "The input grid has no cells: connect a grid of hexahedra.";
      return false;
    }
    auto* ids = vtkIdTypeArray::SafeDownCast(this->Own.Grid->GetPointData()->GetGlobalIds());
    const bool lacksIds = this->Mesh.NumberOfPoints > 0 && !ids;
    const bool useIds = !ranks.Any(lacksIds) && ids;
    this->Blocks = trim::BuildMeshBlocks(this->Mesh);
    if (!trim::FindSharedNodes(this->Mesh, this->Blocks, useIds ? ids->GetPointer(0) : nullptr,
          ranks, this->Shared, error))
    {
      return false;
    }
    trim::ShareBounds(ranks, this->Blocks);
    this->Joined = true;
    return true;
  }

  bool TakeSurface(vtkDataObject* data, std::string& error)
  {
    if (this->SurfaceData == data && this->SurfaceTime == nurbs::ChangeTime(data))
    {
      return true;
    }
    this->SurfaceData = nullptr;
    this->Surface = nullptr;
    if (data->GetNumberOfElements(vtkDataObject::POINT) == 0)
    {
      this->OwnFaces.clear(); // other ranks may have the surface
    }
    else if (!nurbs::ReadTrimmingSurface(data, this->OwnFaces, error))
    {
      error = "The trimming surface is not valid: " + error + ".";
      return false;
    }
    this->SurfaceData = data;
    this->SurfaceTime = nurbs::ChangeTime(data);
    return true;
  }

  /// Collective: the whole surface on each rank.
  bool JoinSurface(const trim::Ranks& ranks, std::string& error)
  {
    if (!ranks.Any(!this->Surface))
    {
      return true;
    }
    this->Surface = nullptr;
    auto faces = trim::ShareFaces(ranks, this->OwnFaces);
    if (faces.empty())
    {
      error =
        "The trimming surface is empty: see the error of its source, or connect a CAD Surface "
        "Reader, Trim Line Source or NURBS Surface Source.";
      return false;
    }
    this->Surface = MakeSurface(std::move(faces));
    return true;
  }

  /// @param outputs of ports 0 to 2.
  void Write(const trim::TrimResult& result, const trim::Ranks& ranks,
    const trim::WriteOptions& options, bool offcut, const trim::Progress& progress,
    const std::array<vtkUnstructuredGrid*, 3>& outputs) const
  {
    vtkUnstructuredGrid* own = this->Own.Grid;
    trim::WriteTrimmedGrid(
      own, this->Mesh, this->Blocks, ranks, result, *this->Surface, options, progress, outputs[0]);
    trim::RestoreOriginalIds(this->Own, outputs[0]);
    trim::WriteStatusGrid(own, result, outputs[1]);
    trim::Summary::RemoveFrom(outputs[1]->GetFieldData());
    if (offcut)
    {
      trim::WriteOffcutGrid(
        own, this->Mesh, this->Blocks, ranks, result, options, progress, outputs[2]);
      trim::RestoreOriginalIds(this->Own, outputs[2]);
    }
  }
};

vtkStandardNewMacro(vtkTrimHexahedralGrid);

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::vtkTrimHexahedralGrid()
  : Kept(new Cache)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::~vtkTrimHexahedralGrid()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Kept->Joined = false;
    this->Kept->Surface = nullptr;
  }
  vtkSetObjectBodyMacro(Controller, vtkMultiProcessController, controller);
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that a missing one is reported by RequestData, with the remedy.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  // This order: without composites the executive would loop over the blocks of one.
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkUnstructuredGrid" : "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::Refuse(const trim::Ranks& ranks, const std::string& error)
{
  if (ranks.Rank() == 0)
  {
    vtkErrorMacro(<< error);
  }
  return 1;
}

//------------------------------------------------------------------------------
trim::TrimOptions vtkTrimHexahedralGrid::Options() const
{
  trim::TrimOptions options;
  options.Ladder.CorrectionType = static_cast<trim::Correction>(this->CorrectionType);
  options.Ladder.Treatment = static_cast<trim::Optimization>(this->Optimization);
  options.Ladder.EliminationFraction = this->EliminationFraction;
  options.Ladder.QualityFloor = this->MinimumScaledJacobian;
  options.InvertSide = this->InvertSide;
  options.UseKeepPoint = this->UseKeepPoint;
  options.KeepPoint = trim::Vec3(this->KeepPoint[0], this->KeepPoint[1], this->KeepPoint[2]);
  options.Tolerance = this->Tolerance;
  options.ProduceOffcut = this->ProduceOffcut;
  return options;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (!this->Superclass::RequestUpdateExtent(request, inputVector, outputVector))
  {
    return 0;
  }
  if (vtkInformation* grid = inputVector[0]->GetInformationObject(0))
  {
    grid->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return 1;
}

//------------------------------------------------------------------------------
bool vtkTrimHexahedralGrid::TakeInputs(
  vtkDataObject* input, vtkDataObject* surface, const trim::Ranks& ranks, std::string& error)
{
  vtkUnstructuredGrid* grid = TakeOnlyGrid(input, this->Kept->NoGrid, error);
  if (!grid)
  {
    error = error.empty() ? "No grid is connected to the first input: connect a grid of hexahedra."
                          : error;
  }
  else if (!surface)
  {
    error = "No trimming surface is connected to the second input: connect a CAD Surface Reader, "
            "Trim Line Source or NURBS Surface Source.";
  }
  else if (this->Kept->TakeGrid(grid, error) && this->Kept->TakeSurface(surface, error))
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
  if (!this->Kept->JoinSurface(ranks, error) || !this->Kept->JoinPieces(ranks, error))
  {
    return false;
  }
  const nurbs::Box3& bounds = this->Kept->Blocks.Bounds;
  error = trim::FindGridScaleDefect(bounds);
  error =
    error.empty() ? trim::FindSurfaceScaleDefect(bounds, this->Kept->Surface->Bounds()) : error;
  return error.empty();
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const trim::ControllerRanks ranks(this->Controller);
  int success = 1;
  try
  {
    trim::WithThreads(
      ranks.Alone(), [&]() { success = this->Trim(inputVector, outputVector, ranks); });
  }
  catch (const std::bad_alloc&)
  {
    if (!ranks.Alone())
    {
      throw; // the other ranks would wait for this one
    }
    this->Kept = std::make_unique<Cache>();
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkUnstructuredGrid::GetData(outputVector, port)->Initialize();
    }
    return this->Refuse(ranks,
      "The trim needs more memory than there is: close other data, or distribute the grid over "
      "several ranks.");
  }
  return success;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::Trim(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, const trim::Ranks& ranks)
{
  const std::array<vtkUnstructuredGrid*, 3> outputs = { vtkUnstructuredGrid::GetData(
                                                          outputVector, 0),
    vtkUnstructuredGrid::GetData(outputVector, 1), vtkUnstructuredGrid::GetData(outputVector, 2) };
  for (vtkUnstructuredGrid* output : outputs)
  {
    // VTK has passed on the field data of the input already.
    trim::Summary::RemoveFrom(output->GetFieldData());
  }
  const trim::TrimOptions options = this->Options();
  std::string error = FindOptionDefect(options);
  if (!error.empty() ||
    !this->TakeInputs(
      vtkDataObject::GetData(inputVector[0]), vtkDataObject::GetData(inputVector[1]), ranks, error))
  {
    return this->Refuse(ranks, error);
  }

  // Asked from every thread, but only one of them looks; negative: no news of the progress.
  const trim::Progress progress = [this](double done)
  {
    if (!vtkSMPTools::IsParallelScope() || vtkSMPTools::GetSingleThread())
    {
      if (done >= 0.0)
      {
        this->UpdateProgress(done);
      }
      this->CheckAbort();
    }
    return this->GetAbortOutput() || this->GetAbortExecute();
  };
  if (ranks.Any(progress(0.05)))
  {
    return 1;
  }
  const trim::HexMesh& mesh = this->Kept->Mesh;
  const trim::TrimResult result = trim::Trim(mesh, this->Kept->Blocks,
    { ranks, this->Kept->Shared }, *this->Kept->Surface, options, progress);
  if (!result.Error.empty())
  {
    return this->Refuse(ranks, result.Error);
  }
  if (result.Aborted)
  {
    return 1;
  }
  const bool renumber = this->RenumberNodes && trim::CanOrderNodes(mesh.NumberOfCells);
  this->Kept->Write(result, ranks, { renumber, this->QualityOfAllElements, this->MapValues },
    this->ProduceOffcut, progress, outputs);
  if (ranks.Any(progress(1.0)))
  {
    for (vtkUnstructuredGrid* output : outputs)
    {
      output->Initialize();
    }
    return 1;
  }
  for (vtkUnstructuredGrid* output : outputs)
  {
    trim::TellRanges(output);
  }
  for (std::size_t i = 0; ranks.Rank() == 0 && i < result.Warnings.size(); ++i)
  {
    vtkWarningMacro(<< result.Warnings[i]);
  }
  if (this->RenumberNodes && !renumber)
  {
    vtkWarningMacro(<< "The nodes keep their order, as " << mesh.NumberOfCells
                    << " elements are too many to renumber at once: distribute the grid over "
                       "several ranks.");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CorrectionType: " << this->CorrectionType << endl;
  os << indent << "Optimization: " << this->Optimization << endl;
  os << indent << "InvertSide: " << this->InvertSide << endl;
  os << indent << "UseKeepPoint: " << this->UseKeepPoint << endl;
  os << indent << "KeepPoint: " << this->KeepPoint[0] << " " << this->KeepPoint[1] << " "
     << this->KeepPoint[2] << endl;
  os << indent << "EliminationFraction: " << this->EliminationFraction << endl;
  os << indent << "MinimumScaledJacobian: " << this->MinimumScaledJacobian << endl;
  os << indent << "RenumberNodes: " << this->RenumberNodes << endl;
  os << indent << "QualityOfAllElements: " << this->QualityOfAllElements << endl;
  os << indent << "MapValues: " << this->MapValues << endl;
  os << indent << "Tolerance: " << this->Tolerance << endl;
  os << indent << "ProduceOffcut: " << this->ProduceOffcut << endl;
  os << indent << "Controller: " << this->Controller << endl;
}
