#include "FindingArrays.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace trim
{
namespace
{

/// An array of zeros but for the ids that are listed (ascending).
template <typename Array, typename Value>
void AddListed(const char* name, const std::vector<std::pair<Id, Value>>& listed,
  const std::vector<Id>& ids, vtkDataSetAttributes* data)
{
  using Stored = typename Array::ValueType;
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<Id>(ids.size()));
  Stored* values = array->GetPointer(0);
  std::fill_n(values, ids.size(), Stored(0));
  for (std::size_t i = 0; i < ids.size() && !listed.empty(); ++i)
  {
    const auto at = std::lower_bound(listed.begin(), listed.end(), ids[i],
      [](const std::pair<Id, Value>& item, Id id) { return item.first < id; });
    if (at != listed.end() && at->first == ids[i])
    {
      values[i] = static_cast<Stored>(at->second);
    }
  }
  data->AddArray(array);
}

}

void AddPointFindings(const Findings& findings, const std::vector<Id>& ids, vtkPointData* pointData)
{
  AddListed<vtkFloatArray>("DistanceLeft", findings.DistancesLeft, ids, pointData);
}

void AddCellFindings(const Findings& findings, const std::vector<Id>& ids, vtkCellData* cellData)
{
  AddListed<vtkUnsignedCharArray>("Feasibility", findings.Feasibilities, ids, cellData);
  AddListed<vtkUnsignedCharArray>("Shortfall", findings.Shortfalls, ids, cellData);
}

}
