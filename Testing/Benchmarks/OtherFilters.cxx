#include "OtherFilters.h"

#include <vtkExtractCells.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkSmartPointer.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkUnstructuredGrid.h>

#include <numeric>

namespace benchmark
{
namespace
{

template <typename Object>
std::shared_ptr<void> Hold(const vtkNew<Object>& object)
{
  return std::make_shared<vtkSmartPointer<Object>>(object.Get());
}

}

std::shared_ptr<void> CopyGrid(vtkUnstructuredGrid* grid)
{
  vtkNew<vtkUnstructuredGrid> copy;
  copy->DeepCopy(grid);
  return Hold(copy);
}

std::shared_ptr<void> ExtractCells(vtkUnstructuredGrid* grid, double share)
{
  vtkNew<vtkIdList> cells;
  cells->SetNumberOfIds(static_cast<vtkIdType>(share * grid->GetNumberOfCells()));
  std::iota(cells->GetPointer(0), cells->GetPointer(0) + cells->GetNumberOfIds(), vtkIdType(0));
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(grid);
  extract->SetCellList(cells);
  extract->Update();
  return Hold(extract);
}

std::shared_ptr<void> ClipByPlane(vtkUnstructuredGrid* grid, double limit)
{
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(limit, 0.0, 0.0);
  plane->SetNormal(1.0, 0.0, 0.0);
  vtkNew<vtkTableBasedClipDataSet> clip;
  clip->SetInputData(grid);
  clip->SetClipFunction(plane);
  clip->InsideOutOn();
  clip->Update();
  return Hold(clip);
}

}
