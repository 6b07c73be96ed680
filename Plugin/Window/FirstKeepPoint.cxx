#include "FirstKeepPoint.h"

#include "TrimSelection.h"

#include "pqOutputPort.h"
#include "pqPipelineFilter.h"

#include "vtkBoundingBox.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

void SetFirstKeepPoint(pqPipelineSource* source)
{
  auto* filter = qobject_cast<pqPipelineFilter*>(source);
  if (!filter || !IsTrim(filter->getProxy()))
  {
    return;
  }
  const pqOutputPort* mesh = filter->getInput("Input", 0);
  double bounds[6];
  if (!mesh || !mesh->getDataInformation())
  {
    return;
  }
  mesh->getDataInformation()->GetBounds(bounds);
  const vtkBoundingBox box(bounds);
  if (!box.IsValid())
  {
    return;
  }
  double middle[3];
  box.GetCenter(middle);
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter->getProxy());
  vtkSMPropertyHelper(filter->getProxy(), "KeepPoint").Set(middle, 3);
  filter->getProxy()->UpdateVTKObjects();
}
