#include "Summary.h"

#include "ArrayNames.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>

namespace trim
{
namespace
{

template <typename Array, typename Value>
void AddEntry(vtkFieldData* fieldData, const char* name, Value value)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fieldData->AddArray(array);
}

}

void Summary::AddTo(vtkFieldData* fieldData) const
{
  vtkNew<vtkFieldData> entries;
  const auto count = [&entries](const char* name, Id value)
  { AddEntry<vtkIdTypeArray>(entries, name, value); };
  const auto measure = [&entries](const char* name, double value)
  { AddEntry<vtkDoubleArray>(entries, name, value); };
  count(names::Kept, this->Kept);
  count(names::Eliminated, this->Eliminated);
  count(names::Treated, this->Treated);
  count(names::MovedNodes, this->MovedNodes);
  count(names::Pentahedra, this->Pentahedra);
  count(names::Wedges, this->Wedges);
  count(names::TouchedElements, this->TouchedElements);
  count(names::CertifiedElements, this->CertifiedElements);
  count(names::RescuedByRelaxation, this->RescuedByRelaxation);
  count(names::RescuedByTreatment, this->RescuedByTreatment);
  count(names::RescuedByCorrection, this->RescuedByCorrection);
  count(names::RescuedByFate, this->RescuedByFate);
  count(names::RescuedByLeaving, this->RescuedByLeaving);
  count(names::InsertedElements, this->InsertedElements);
  count(names::NodeBandwidth, this->NodeBandwidth);
  measure(names::MinimumScaledJacobian, this->MinimumScaledJacobian);
  measure(names::MinimumIntegrationPointJacobian, this->MinimumIntegrationPointJacobian);
  measure(names::MaximumDistanceToSurface, this->MaximumDistanceToSurface);
  measure(names::Volume, this->Volume);
  PutFirst(entries, fieldData);
}

void Summary::RemoveFrom(vtkFieldData* fieldData)
{
  vtkNew<vtkFieldData> entries;
  Summary().AddTo(entries);
  for (int i = 0; i < entries->GetNumberOfArrays(); ++i)
  {
    fieldData->RemoveArray(entries->GetArrayName(i));
  }
}

void PutFirst(vtkFieldData* arrays, vtkFieldData* fieldData)
{
  vtkNew<vtkFieldData> others;
  others->ShallowCopy(fieldData);
  fieldData->Initialize();
  for (vtkFieldData* const data : { arrays, others.Get() })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      fieldData->AddArray(data->GetAbstractArray(i));
    }
  }
}

}
