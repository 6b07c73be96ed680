/**
 * @file GatherAttributes.h
 * @brief Takes point and cell data along to a part of the mesh: every array, with its name,
 * components, information and attribute roles.
 */
#ifndef GatherAttributes_h
#define GatherAttributes_h

#include <vtkType.h>

#include <vector>

class vtkDataSetAttributes;

namespace trim
{

/// target gets, for each array of source, the tuples at `ids`, in this order.
void GatherAttributes(
  vtkDataSetAttributes* source, const std::vector<vtkIdType>& ids, vtkDataSetAttributes* target);

}

#endif
