#include "WritePart.h"

#include <vtkFieldData.h>
#include <vtkUnstructuredGrid.h>

namespace trim
{

void MeasurePart(const WriteInput& from, const GridPart& part, const BandShapes& shapes,
  Summary& summary, vtkUnstructuredGrid* output)
{
  AddScaledJacobians(from.Mesh, part, shapes, from.Options.QualityOfAllElements, output);
  summary.Volume = VolumeOfPart(from.Blocks, part, shapes, from.All);
  SummariseTouched(shapes, summary);
  output->GetFieldData()->ShallowCopy(from.Grid->GetFieldData());
}

}
