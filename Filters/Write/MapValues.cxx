#include "MapValues.h"

#include "SortUnique.h"
#include "ValueWeights.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace trim
{
namespace
{

/// What is mapped: rows, and where the items of the band are in input and output.
struct Mapping
{
  std::vector<ValueRow> Rows;
  std::vector<Id> Input;  ///< id of each node or element of the band; -1: another rank has it
  std::vector<Id> Output; ///< place of each row's target; -1: it is not in this rank's part
  bool KeepsRange;
};

/// What this rank has of that which rows are made of, by the band, ascending.
std::vector<int> FindSources(const Mapping& mapping)
{
  std::vector<int> sources;
  for (const ValueRow& row : mapping.Rows)
  {
    for (const auto& source : row.Sources)
    {
      if (mapping.Input[source.first] >= 0)
      {
        sources.push_back(source.first);
      }
    }
  }
  SortUnique(sources);
  return sources;
}

bool IsMapped(vtkDataSetAttributes* attributes, int index)
{
  vtkAbstractArray* array = attributes->GetAbstractArray(index);
  const int type = array->GetDataType();
  return array->GetName() && (type == VTK_FLOAT || type == VTK_DOUBLE) &&
    array != attributes->GetGlobalIds() && array != attributes->GetPedigreeIds();
}

/// The names of the arrays to map on any rank, ascending.
std::set<std::string> NamesToMap(vtkDataSetAttributes* attributes, const Ranks& ranks)
{
  std::vector<char> own;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (IsMapped(attributes, i))
    {
      const std::string name = attributes->GetArrayName(i);
      own.insert(own.end(), name.begin(), name.end());
      own.push_back('\0');
    }
  }
  std::set<std::string> names;
  const std::vector<char> all = ranks.Gather(own);
  for (auto name = all.begin(); name != all.end();)
  {
    const auto end = std::find(name, all.end(), '\0');
    names.emplace(name, end);
    name = end + 1;
  }
  return names;
}

/// Values of an array at all nodes or elements of the band that rows are made of, in the order of
/// the band; NaN elsewhere.
/// @param sources see FindSources.
std::vector<double> ValuesInBand(vtkDataArray* array, int components, const Mapping& mapping,
  const std::vector<int>& sources, const Ranks& ranks)
{
  std::vector<int> items = array ? sources : std::vector<int>();
  std::vector<double> values;
  for (const int item : items)
  {
    for (int c = 0; c < components; ++c)
    {
      values.push_back(array->GetComponent(mapping.Input[item], c));
    }
  }
  items = ranks.Gather(items);
  values = ranks.Gather(values);
  std::vector<double> inBand(
    mapping.Input.size() * components, std::numeric_limits<double>::quiet_NaN());
  // Backwards: what several ranks have is the first one's.
  for (std::size_t i = items.size(); i-- > 0;)
  {
    std::copy_n(values.begin() + i * components, components,
      inBand.begin() + static_cast<std::size_t>(items[i]) * components);
  }
  return inBand;
}

/// One component of a row; NaN if one of the values is not finite.
double ValueOf(
  const ValueRow& row, const std::vector<double>& values, int components, int c, bool keepsRange)
{
  double sum = 0.0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [source, weight] : row.Sources)
  {
    const double value = values[static_cast<std::size_t>(source) * components + c];
    sum += weight * value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return keepsRange && std::isfinite(sum) ? std::clamp(sum, low, high) : sum;
}

void Map(vtkDataSetAttributes* input, const Ranks& ranks, const Mapping& mapping,
  vtkDataSetAttributes* output)
{
  const std::vector<int> sources = FindSources(mapping);
  for (const std::string& name : NamesToMap(input, ranks))
  {
    int index = -1;
    const bool has = input->GetAbstractArray(name.c_str(), index) != nullptr;
    vtkDataArray* from = has && IsMapped(input, index) ? input->GetArray(index) : nullptr;
    vtkDataArray* to = from ? output->GetArray(name.c_str()) : nullptr;
    const int components = ranks.Largest(from ? from->GetNumberOfComponents() : 0);
    const bool fits = to ? from->GetNumberOfComponents() == components : !has;
    if (ranks.Any(!fits))
    {
      continue;
    }
    const std::vector<double> values = ValuesInBand(from, components, mapping, sources, ranks);
    for (std::size_t i = 0; to && i < mapping.Rows.size(); ++i)
    {
      for (int c = 0; c < components && mapping.Output[i] >= 0; ++c)
      {
        const double value = ValueOf(mapping.Rows[i], values, components, c, mapping.KeepsRange);
        if (std::isfinite(value))
        {
          to->SetComponent(mapping.Output[i], c, value);
        }
      }
    }
  }
}

Mapping OfNodes(const GridPart& part, const MovedNodes& moved)
{
  Mapping mapping{ WeightsOfNodes(moved), WithoutLayer(*moved.TheBand).GlobalNode, {}, false };
  for (const ValueRow& row : mapping.Rows)
  {
    const Id id = moved.TheBand->GlobalNode[row.Target];
    mapping.Output.push_back(id >= 0 ? part.Number[id] : -1);
  }
  return mapping;
}

Mapping OfElements(const GridPart& part, const Band& band, const BandShapes& shapes)
{
  Mapping mapping{ WeightsOfElements(band, shapes), {}, {}, true };
  for (const BandElement& element : WithoutLayer(band).Elements)
  {
    mapping.Input.push_back(element.Global);
  }
  const std::vector<Id> placeOf = PlacesInBand(part, shapes.Count);
  for (const ValueRow& row : mapping.Rows)
  {
    mapping.Output.push_back(placeOf[row.Target]);
  }
  return mapping;
}

}

void MapValues(vtkUnstructuredGrid* input, const Ranks& ranks, const GridPart& part,
  const MovedNodes& moved, const BandShapes& shapes, vtkUnstructuredGrid* output)
{
  if (!moved.TheBand)
  {
    return;
  }
  Map(input->GetPointData(), ranks, OfNodes(part, moved), output->GetPointData());
  Map(input->GetCellData(), ranks, OfElements(part, *moved.TheBand, shapes), output->GetCellData());
}

}
