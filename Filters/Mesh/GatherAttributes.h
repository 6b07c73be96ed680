/**
 * @file GatherAttributes.h
 * @brief Takes point and cell data along to a part of the mesh: every array, with its name,
 * components, information and attribute roles.
 */
#ifndef GatherAttributes_h
#define GatherAttributes_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;

namespace trim
{

/// What an array is to its data set: active scalars, global ids...; VTK's own IsArrayAnAttribute
/// knows of one role alone.
std::vector<int> RolesOf(vtkDataSetAttributes* data, vtkAbstractArray* array);

/// Adds an array in the roles that another one has in its data.
void AddInRolesOf(vtkAbstractArray* other, vtkDataSetAttributes* ofOther, vtkAbstractArray* array,
  vtkDataSetAttributes* data);

/// An array that is the same but for the tuples behind the first `count`.
vtkSmartPointer<vtkAbstractArray> FirstTuples(vtkAbstractArray* source, vtkIdType count);

/// target gets, for each array of source, the tuples at the `count` `ids`, in this order.
void GatherAttributes(vtkDataSetAttributes* source, const vtkIdType* ids, vtkIdType count,
  vtkDataSetAttributes* target);

}

#endif
