#include "vtkTrimRepresentation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkTrimRepresentation);

//------------------------------------------------------------------------------
void vtkTrimRepresentation::AddRepresentation(const char* key, vtkPVDataRepresentation* repr)
{
  this->RemoveRepresentation(key);
  this->Superclass::AddRepresentation(key, repr);
}
