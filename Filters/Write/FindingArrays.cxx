#include "FindingArrays.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace trim
{
namespace
{

/// An array of zeros but for the ids that are listed.
template <typename Array, typename Value>
void AddListed(const char* name, const std::vector<std::pair<Id, Value>>& listed,
  const Selection& ids, vtkDataSetAttributes* data)
{
  using Stored = typename Array::ValueType;
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(ids.size());
  Stored* values = array->GetPointer(0);
  vtkSMPTools::For(0, ids.size(), 100000,
    [values](Id begin, Id end) { std::fill(values + begin, values + end, Stored(0)); });
  for (const auto& item : listed)
  {
    const auto value = static_cast<Stored>(item.second);
    ids.ForPlaces(item.first, [values, value](Id place) { values[place] = value; });
  }
  data->AddArray(array);
}

}

void AddPointFindings(const Findings& findings, const Selection& ids, vtkPointData* pointData)
{
  AddListed<vtkFloatArray>("DistanceLeft", findings.DistancesLeft, ids, pointData);
  AddListed<vtkUnsignedCharArray>("CornerLost", findings.CornersLost, ids, pointData);
}

void AddCellFindings(const Findings& findings, const Selection& ids, vtkCellData* cellData)
{
  AddListed<vtkUnsignedCharArray>("Feasibility", findings.Feasibilities, ids, cellData);
  AddListed<vtkUnsignedCharArray>("Shortfall", findings.Shortfalls, ids, cellData);
}

}
