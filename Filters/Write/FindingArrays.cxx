#include "FindingArrays.h"

#include "ArrayNames.h"
#include "SparseArray.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
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
  std::vector<Id> places;
  std::vector<Stored> values;
  for (const auto& item : listed)
  {
    ids.ForPlaces(item.first,
      [&](Id place)
      {
        places.push_back(place);
        values.push_back(static_cast<Stored>(item.second));
      });
  }
  AddSparseArray<Array>(
    name, ids.size(), 1, places, [&](Id i, Stored* value) { *value = values[i]; }, data);
}

/// An array of zeros, but ones for the ids that are listed.
void AddFlags(
  const char* name, const std::vector<Id>& listed, const Selection& ids, vtkDataSetAttributes* data)
{
  std::vector<std::pair<Id, int>> ones;
  for (const Id id : listed)
  {
    ones.emplace_back(id, 1);
  }
  AddListed<vtkUnsignedCharArray>(name, ones, ids, data);
}

}

void AddPointFindings(const Findings& findings, const Selection& ids, vtkPointData* pointData)
{
  AddListed<vtkFloatArray>(names::DistanceLeft, findings.DistancesLeft, ids, pointData);
  AddFlags(names::NewBoundary, findings.NewBoundary, ids, pointData);
  AddFlags(names::CornerLost, findings.CornersLost, ids, pointData);
}

void AddCellFindings(const Findings& findings, const Selection& ids, vtkCellData* cellData)
{
  AddListed<vtkUnsignedCharArray>(names::Feasibility, findings.Feasibilities, ids, cellData);
}

void AddShortfalls(std::vector<std::pair<Id, Shortfall>> found, Id cells, vtkCellData* cellData)
{
  const auto atOnePlace = [](const auto& a, const auto& b) { return a.first == b.first; };
  std::sort(found.begin(), found.end(), ComesBefore<Id>);
  found.erase(std::unique(found.begin(), found.end(), atOnePlace), found.end());
  std::vector<Id> places;
  std::vector<unsigned char> values;
  for (const auto& item : found)
  {
    if (item.first >= 0)
    {
      places.push_back(item.first);
      values.push_back(static_cast<unsigned char>(item.second));
    }
  }
  const auto set = [&values](Id i, unsigned char* value) { *value = values[i]; };
  AddSparseArray<vtkUnsignedCharArray>(names::Shortfall, cells, 1, places, set, cellData);
}

}
