#include "vtkTrimHexahedralGrid.h"

#include "MeshBlocks.h"
#include "NURBSFieldData.h"
#include "TrimPipeline.h"
#include "TrimmedGrid.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkWeakPointer.h"

#include <algorithm>

namespace
{

/// When the surface changed last: a composite does not ask its blocks.
vtkMTimeType TimeOf(vtkDataObject* data)
{
  vtkMTimeType time = data->GetMTime();
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      time = std::max(time, it->GetCurrentDataObject()->GetMTime());
    }
  }
  return time;
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
  return std::make_unique<nurbs::TrimmingSurface>(
    std::move(faces), trim::GapShare * box.diagonal().norm());
}

}

/// What depends on one input alone is kept until that input changes.
struct vtkTrimHexahedralGrid::Cache
{
  vtkWeakPointer<vtkUnstructuredGrid> Grid;
  vtkMTimeType GridTime = 0;
  trim::HexMesh Mesh;
  trim::MeshBlocks Blocks;

  vtkWeakPointer<vtkDataObject> SurfaceData;
  vtkMTimeType SurfaceTime = 0;
  std::unique_ptr<nurbs::TrimmingSurface> Surface;

  bool TakeGrid(vtkUnstructuredGrid* grid, std::string& error)
  {
    if (this->Grid == grid && this->GridTime == grid->GetMTime())
    {
      return true;
    }
    this->Grid = nullptr;
    if (grid->GetNumberOfCells() == 0)
    {
      error = "The input grid has no cells: connect a grid of hexahedra.";
      return false;
    }
    if (!trim::ViewGrid(grid, this->Mesh, error))
    {
      return false;
    }
    this->Blocks = trim::BuildMeshBlocks(this->Mesh);
    this->Grid = grid;
    this->GridTime = grid->GetMTime();
    return true;
  }

  bool TakeSurface(vtkDataObject* data, std::string& error)
  {
    if (this->SurfaceData == data && this->SurfaceTime == TimeOf(data))
    {
      return true;
    }
    this->SurfaceData = nullptr;
    std::vector<nurbs::NurbsSurface> faces;
    if (!nurbs::ReadTrimmingSurface(data, faces, error))
    {
      return false;
    }
    this->Surface = MakeSurface(std::move(faces));
    this->SurfaceData = data;
    this->SurfaceTime = TimeOf(data);
    return true;
  }
};

vtkStandardNewMacro(vtkTrimHexahedralGrid);

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::vtkTrimHexahedralGrid()
  : Kept(new Cache)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::~vtkTrimHexahedralGrid() = default;

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that a missing one is reported by RequestData, with the remedy.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
    return 1;
  }
  // This order: with vtkDataSet alone the executive would loop over the blocks of a composite.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::Refuse(const std::string& error)
{
  vtkErrorMacro(<< error);
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
  return options;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  vtkDataObject* surfaceData = vtkDataObject::GetData(inputVector[1]);
  if (!input)
  {
    return this->Refuse("No grid is connected to the first input: connect a grid of hexahedra.");
  }
  if (!surfaceData)
  {
    return this->Refuse("No trimming surface is connected to the second input: connect a CAD "
                        "Surface Reader or a NURBS Surface Source.");
  }
  std::string error;
  if (!this->Kept->TakeGrid(input, error) || !this->Kept->TakeSurface(surfaceData, error))
  {
    return this->Refuse(error);
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
  if (progress(0.05))
  {
    return 1;
  }
  const trim::HexMesh& mesh = this->Kept->Mesh;
  nurbs::TrimmingSurface& surface = *this->Kept->Surface;
  const trim::TrimResult result =
    trim::Trim(mesh, this->Kept->Blocks, surface, this->Options(), progress);
  if (!result.Error.empty())
  {
    return this->Refuse(result.Error);
  }
  if (result.Aborted)
  {
    return 1;
  }
  vtkUnstructuredGrid* trimmed = vtkUnstructuredGrid::GetData(outputVector, 0);
  vtkUnstructuredGrid* statuses = vtkUnstructuredGrid::GetData(outputVector, 1);
  trim::WriteOptions write;
  write.RenumberNodes = this->RenumberNodes;
  write.QualityOfAllElements = this->QualityOfAllElements;
  trim::WriteTrimmedGrid(input, mesh, result, surface, write, progress, trimmed);
  trim::WriteStatusGrid(input, result, statuses);
  if (progress(1.0))
  {
    trimmed->Initialize();
    statuses->Initialize();
    return 1;
  }
  for (const auto& warning : result.Warnings)
  {
    vtkWarningMacro(<< warning);
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
  os << indent << "Tolerance: " << this->Tolerance << endl;
}
