#include "GatherAttributes.h"

#include "FollowingIds.h"
#include "FreshArray.h"
#include "Team.h"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkLookupTable.h>

#include <cstring>
#include <numeric>

namespace trim
{
namespace
{

/// Whole tuples by memory copy: Debian's VTK copies value by value and is not optimised. In memory
/// of our own: where there is none Debian's VTK ends the process.
void GatherRaw(vtkDataArray* source, const vtkIdType* ids, vtkIdType count, vtkDataArray* target)
{
  const std::size_t size = static_cast<std::size_t>(source->GetNumberOfComponents()) *
    static_cast<std::size_t>(source->GetDataTypeSize());
  const ArrayMemory own = AllocatePagesForArray(size * static_cast<std::size_t>(count));
  target->SetVoidArray(own.Memory, count * source->GetNumberOfComponents(), 0,
    vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  target->SetArrayFreeFunction(own.Free);
  const char* from = static_cast<const char*>(source->GetVoidPointer(0));
  char* to = static_cast<char*>(own.Memory);
  ParallelFor(0, count, 50000,
    [&](vtkIdType begin, vtkIdType end)
    {
      ForFollowing(ids, begin, end,
        [&](vtkIdType i, vtkIdType id, auto tuples)
        { std::memcpy(to + size * i, from + size * id, size * tuples); });
    });
}

vtkSmartPointer<vtkAbstractArray> GatherTuples(
  vtkAbstractArray* source, const vtkIdType* ids, vtkIdType count)
{
  auto target = vtkSmartPointer<vtkAbstractArray>::Take(source->NewInstance());
  target->SetName(source->GetName());
  target->SetNumberOfComponents(source->GetNumberOfComponents());
  target->CopyComponentNames(source);
  target->CopyInformation(source->GetInformation());
  auto* data = vtkDataArray::SafeDownCast(source);
  if (data && data->GetLookupTable())
  {
    vtkDataArray::SafeDownCast(target)->SetLookupTable(data->GetLookupTable());
  }
  if (count > 0 && data && data->HasStandardMemoryLayout() && data->GetDataType() != VTK_BIT)
  {
    GatherRaw(data, ids, count, vtkDataArray::SafeDownCast(target));
    return target;
  }
  target->SetNumberOfTuples(count);
  // Not GetTuples: that of VTK 9.2's string arrays forgets all components but the first.
  for (vtkIdType i = 0; i < count; ++i)
  {
    target->SetTuple(i, ids[i], source);
  }
  return target;
}

}

std::vector<int> RolesOf(vtkDataSetAttributes* data, vtkAbstractArray* array)
{
  std::vector<int> roles;
  for (int role = 0; role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role)
  {
    if (data->GetAbstractAttribute(role) == array)
    {
      roles.push_back(role);
    }
  }
  return roles;
}

void AddInRolesOf(vtkAbstractArray* other, vtkDataSetAttributes* ofOther, vtkAbstractArray* array,
  vtkDataSetAttributes* data)
{
  const int index = data->AddArray(array);
  for (const int role : RolesOf(ofOther, other))
  {
    data->SetActiveAttribute(index, role);
  }
}

vtkSmartPointer<vtkAbstractArray> FirstTuples(vtkAbstractArray* source, vtkIdType count)
{
  std::vector<vtkIdType> first(count);
  std::iota(first.begin(), first.end(), vtkIdType(0));
  return GatherTuples(source, first.data(), count);
}

void GatherAttributes(
  vtkDataSetAttributes* source, const vtkIdType* ids, vtkIdType count, vtkDataSetAttributes* target)
{
  for (int i = 0; i < source->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = source->GetAbstractArray(i);
    AddInRolesOf(array, source, GatherTuples(array, ids, count), target);
  }
}

}
