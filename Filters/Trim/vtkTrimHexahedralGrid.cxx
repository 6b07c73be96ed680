#include "vtkTrimHexahedralGrid.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkTrimHexahedralGrid);

vtkTrimHexahedralGrid::vtkTrimHexahedralGrid()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkTrimHexahedralGrid::~vtkTrimHexahedralGrid() = default;

int vtkTrimHexahedralGrid::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  }
  else
  {
    // This order: with vtkDataSet alone the executive would loop over the blocks.
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  return 1;
}

int vtkTrimHexahedralGrid::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* input = vtkUnstructuredGrid::GetData(inputVector[0]);
  for (int port = 0; port < 2; ++port)
  {
    vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector, port);
    output->ShallowCopy(input);
    const vtkIdType points = input->GetNumberOfPoints();
    const vtkIdType cells = input->GetNumberOfCells();
    for (const char* name : { "NodeStatus", "CorrectionApplied" })
    {
      vtkNew<vtkUnsignedCharArray> array;
      array->SetName(name);
      array->SetNumberOfTuples(points);
      for (vtkIdType i = 0; i < points; ++i)
      {
        array->SetValue(i, static_cast<unsigned char>(i * 3 / points));
      }
      output->GetPointData()->AddArray(array);
    }
    vtkNew<vtkUnsignedCharArray> status;
    status->SetName("ElementStatus");
    status->SetNumberOfTuples(cells);
    for (vtkIdType i = 0; i < cells; ++i)
    {
      status->SetValue(i, static_cast<unsigned char>(i * 3 / cells));
    }
    output->GetCellData()->AddArray(status);
    output->GetCellData()->SetActiveScalars("ElementStatus");
    vtkNew<vtkIdTypeArray> kept;
    kept->SetName("Kept");
    kept->InsertNextValue(cells);
    output->GetFieldData()->AddArray(kept);
    this->UpdateProgress(0.5 * (port + 1));
  }
  return 1;
}

void vtkTrimHexahedralGrid::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
