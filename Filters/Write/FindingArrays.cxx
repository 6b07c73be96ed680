#include "FindingArrays.h"

#include "SparseArray.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

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
  SparseArray<Array> array(name, ids.size(), 1, listed.size());
  for (const auto& item : listed)
  {
    const auto value = static_cast<Stored>(item.second);
    ids.ForPlaces(item.first, [&array, value](Id place) { *array.At(place) = value; });
  }
  array.AddTo(data);
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
