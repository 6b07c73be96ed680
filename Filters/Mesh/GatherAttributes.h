/**
 * @file GatherAttributes.h
 * @brief Takes point and cell data along to a part of the mesh: every array, with its name,
 * components, information and attribute roles.
 */
#ifndef GatherAttributes_h
#define GatherAttributes_h

#include <vtkType.h>

class vtkDataSetAttributes;

namespace trim
{

/// target gets, for each array of source, the tuples at the `count` `ids`, in this order.
void GatherAttributes(vtkDataSetAttributes* source, const vtkIdType* ids, vtkIdType count,
  vtkDataSetAttributes* target);

}

#endif
