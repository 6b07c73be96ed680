#include "NURBSFieldData.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace nurbs
{
namespace
{
const char* const DegreesName = "NURBSDegrees";
const char* const NetSizeName = "NURBSControlNetSize";
const char* const ControlPointsName = "NURBSControlPoints";
const char* const KnotsUName = "NURBSKnotsU";
const char* const KnotsVName = "NURBSKnotsV";
const char* const TrimLoopsName = "NURBSTrimLoops";
const char* const TrimLoopOffsetsName = "NURBSTrimLoopOffsets";
const char* const ToleranceName = "NURBSTolerance";

void AddPair(vtkFieldData* fieldData, const char* name, int first, int second)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(2);
  array->InsertNextTuple2(first, second);
  fieldData->AddArray(array);
}

void AddScalars(vtkFieldData* fieldData, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  fieldData->AddArray(array);
}

void WriteTrimLoops(const NurbsSurface& surface, vtkFieldData* fieldData)
{
  vtkNew<vtkDoubleArray> loops;
  loops->SetName(TrimLoopsName);
  loops->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> offsets;
  offsets->SetName(TrimLoopOffsetsName);
  offsets->InsertNextValue(0);
  for (const std::vector<Vec2>& loop : surface.TrimLoops)
  {
    for (const Vec2& uv : loop)
    {
      loops->InsertNextTuple(uv.data());
    }
    offsets->InsertNextValue(static_cast<int>(loops->GetNumberOfTuples()));
  }
  fieldData->AddArray(loops);
  fieldData->AddArray(offsets);
}

/// The array of that name with exactly these tuples and components; tuples < 0: any number.
vtkDataArray* FindArray(
  vtkFieldData* fieldData, const char* name, vtkIdType tuples, int components, std::string& error)
{
  std::ostringstream message;
  vtkAbstractArray* any = fieldData->GetAbstractArray(name);
  vtkDataArray* array = vtkDataArray::SafeDownCast(any);
  if (!any)
  {
    message << "there is no field array \"" << name
            << "\"; the poly data of a NURBS surface has to carry it in its field data";
  }
  else if (!array)
  {
    message << "field array \"" << name << "\" does not hold numbers; make it a numeric array";
  }
  else if (array->GetNumberOfComponents() != components ||
    (tuples >= 0 && array->GetNumberOfTuples() != tuples))
  {
    message << "field array \"" << name << "\" has " << array->GetNumberOfTuples() << " tuples of "
            << array->GetNumberOfComponents() << " components, but ";
    if (tuples >= 0)
    {
      message << tuples << " tuples of ";
    }
    message << components << " components are needed";
    if (tuples > 1)
    {
      message << " by the degrees and the control net size";
    }
  }
  else
  {
    return array;
  }
  error = message.str();
  return nullptr;
}

/// A component that has to be a whole number within the range of int.
bool ReadInteger(
  vtkDataArray* array, vtkIdType tuple, int component, int& value, std::string& error)
{
  const double real = array->GetComponent(tuple, component);
  if (!(std::abs(real) <= std::numeric_limits<int>::max()) || real != std::floor(real))
  {
    std::ostringstream message;
    message << "field array \"" << array->GetName() << "\" holds " << real << " at tuple " << tuple
            << ", component " << component << "; a whole number is needed";
    error = message.str();
    return false;
  }
  value = static_cast<int>(real);
  return true;
}

bool ReadPair(
  vtkFieldData* fieldData, const char* name, int& first, int& second, std::string& error)
{
  vtkDataArray* array = FindArray(fieldData, name, 1, 2, error);
  return array && ReadInteger(array, 0, 0, first, error) && ReadInteger(array, 0, 1, second, error);
}

/// Degrees and net size within bounds that make the array sizes below computable.
bool CheckSizes(const NurbsSurface& surface, std::string& error)
{
  std::ostringstream message;
  if (surface.DegreeU < 1 || surface.DegreeV < 1 || surface.DegreeU > MaximumDegree ||
    surface.DegreeV > MaximumDegree)
  {
    message << "field array \"" << DegreesName << "\" holds degrees " << surface.DegreeU << " and "
            << surface.DegreeV << "; they have to be 1 to " << MaximumDegree;
  }
  else if (surface.CountU <= surface.DegreeU || surface.CountV <= surface.DegreeV)
  {
    message << "field array \"" << NetSizeName << "\" holds a net of " << surface.CountU << " x "
            << surface.CountV << " control points; degrees " << surface.DegreeU << " and "
            << surface.DegreeV << " need at least " << surface.DegreeU + 1 << " x "
            << surface.DegreeV + 1;
  }
  error = message.str();
  return error.empty();
}

bool ReadScalars(vtkFieldData* fieldData, const char* name, vtkIdType tuples,
  std::vector<double>& values, std::string& error)
{
  vtkDataArray* array = FindArray(fieldData, name, tuples, 1, error);
  if (!array)
  {
    return false;
  }
  values.resize(static_cast<size_t>(tuples));
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    values[i] = array->GetComponent(i, 0);
  }
  return true;
}

bool ReadControlPoints(vtkFieldData* fieldData, NurbsSurface& surface, std::string& error)
{
  const vtkIdType count = static_cast<vtkIdType>(surface.CountU) * surface.CountV;
  vtkDataArray* array = FindArray(fieldData, ControlPointsName, count, 4, error);
  if (!array)
  {
    return false;
  }
  surface.ControlPoints.resize(static_cast<size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->GetTuple(i, surface.ControlPoints[i].data());
  }
  return true;
}

bool ReadTrimLoops(vtkFieldData* fieldData, NurbsSurface& surface, std::string& error)
{
  surface.TrimLoops.clear();
  if (!fieldData->HasArray(TrimLoopsName) && !fieldData->HasArray(TrimLoopOffsetsName))
  {
    return true;
  }
  vtkDataArray* points = FindArray(fieldData, TrimLoopsName, -1, 2, error);
  vtkDataArray* offsets =
    points ? FindArray(fieldData, TrimLoopOffsetsName, -1, 1, error) : nullptr;
  if (!offsets)
  {
    return false;
  }
  const vtkIdType loops = offsets->GetNumberOfTuples() - 1;
  int begin = 0;
  bool sound = loops >= 0 && ReadInteger(offsets, 0, 0, begin, error) && begin == 0;
  for (vtkIdType i = 0; sound && i < loops; ++i)
  {
    int end = 0;
    sound = ReadInteger(offsets, i + 1, 0, end, error) && end >= begin &&
      end <= points->GetNumberOfTuples();
    std::vector<Vec2> loop;
    for (; sound && begin < end; ++begin)
    {
      loop.emplace_back(points->GetComponent(begin, 0), points->GetComponent(begin, 1));
    }
    surface.TrimLoops.push_back(std::move(loop));
  }
  if (!sound || begin != points->GetNumberOfTuples())
  {
    std::ostringstream message;
    message << "field array \"" << TrimLoopOffsetsName << "\" does not divide the "
            << points->GetNumberOfTuples() << " points of \"" << TrimLoopsName
            << "\"; it has to rise from 0 to that number, one value more than there are loops";
    error = message.str();
    return false;
  }
  return true;
}

bool ReadTolerance(vtkFieldData* fieldData, NurbsSurface& surface, std::string& error)
{
  surface.Tolerance = 0.0;
  if (!fieldData->HasArray(ToleranceName))
  {
    return true;
  }
  vtkDataArray* array = FindArray(fieldData, ToleranceName, 1, 1, error);
  if (array)
  {
    surface.Tolerance = array->GetComponent(0, 0);
  }
  return array != nullptr;
}

/// block 3 "Face 3" of block 0 "Door": how an error names a place in a composite.
std::string BlockName(unsigned int index, vtkInformation* metaData, const std::string& parent)
{
  std::ostringstream name;
  name << "block " << index;
  if (metaData && metaData->Has(vtkCompositeDataSet::NAME()))
  {
    name << " \"" << metaData->Get(vtkCompositeDataSet::NAME()) << "\"";
  }
  if (!parent.empty())
  {
    name << " of " << parent;
  }
  return name.str();
}

/// Appends the surfaces of one data object and all below it; null is passed over.
bool AppendSurfaces(vtkDataObject* data, const std::string& name,
  std::vector<NurbsSurface>& surfaces, std::string& error)
{
  auto prefix = [&name]() { return name.empty() ? std::string() : name + ": "; };
  if (!data)
  {
    return true;
  }
  if (auto polyData = vtkPolyData::SafeDownCast(data))
  {
    NurbsSurface surface;
    if (!ReadNURBSFieldData(polyData->GetFieldData(), surface, error))
    {
      error = prefix() + error;
      return false;
    }
    surfaces.push_back(std::move(surface));
    return true;
  }
  bool good = true;
  if (auto blocks = vtkMultiBlockDataSet::SafeDownCast(data))
  {
    for (unsigned int i = 0; good && i < blocks->GetNumberOfBlocks(); ++i)
    {
      vtkInformation* metaData = blocks->HasMetaData(i) ? blocks->GetMetaData(i) : nullptr;
      good = AppendSurfaces(blocks->GetBlock(i), BlockName(i, metaData, name), surfaces, error);
    }
    return good;
  }
  if (auto sets = vtkPartitionedDataSetCollection::SafeDownCast(data))
  {
    for (unsigned int i = 0; good && i < sets->GetNumberOfPartitionedDataSets(); ++i)
    {
      vtkInformation* metaData = sets->HasMetaData(i) ? sets->GetMetaData(i) : nullptr;
      good = AppendSurfaces(
        sets->GetPartitionedDataSet(i), BlockName(i, metaData, name), surfaces, error);
    }
    return good;
  }
  if (auto parts = vtkPartitionedDataSet::SafeDownCast(data))
  {
    const unsigned int count = parts->GetNumberOfPartitions();
    for (unsigned int i = 0; good && i < count; ++i)
    {
      const std::string part = count == 1 && !name.empty()
        ? name
        : BlockName(i, parts->HasMetaData(i) ? parts->GetMetaData(i) : nullptr, name);
      good = AppendSurfaces(parts->GetPartitionAsDataObject(i), part, surfaces, error);
    }
    return good;
  }
  error = prefix() + "a " + data->GetClassName() +
    " is no NURBS surface; poly data with the NURBS field arrays is needed";
  return false;
}
}

//------------------------------------------------------------------------------
void WriteNURBSFieldData(const NurbsSurface& surface, vtkFieldData* fieldData)
{
  AddPair(fieldData, DegreesName, surface.DegreeU, surface.DegreeV);
  AddPair(fieldData, NetSizeName, surface.CountU, surface.CountV);

  vtkNew<vtkDoubleArray> points;
  points->SetName(ControlPointsName);
  points->SetNumberOfComponents(4);
  points->SetNumberOfTuples(static_cast<vtkIdType>(surface.ControlPoints.size()));
  for (size_t i = 0; i < surface.ControlPoints.size(); ++i)
  {
    points->SetTypedTuple(static_cast<vtkIdType>(i), surface.ControlPoints[i].data());
  }
  fieldData->AddArray(points);

  AddScalars(fieldData, KnotsUName, surface.KnotsU);
  AddScalars(fieldData, KnotsVName, surface.KnotsV);

  fieldData->RemoveArray(TrimLoopsName);
  fieldData->RemoveArray(TrimLoopOffsetsName);
  if (!surface.TrimLoops.empty())
  {
    WriteTrimLoops(surface, fieldData);
  }

  fieldData->RemoveArray(ToleranceName);
  if (surface.Tolerance > 0.0)
  {
    AddScalars(fieldData, ToleranceName, { surface.Tolerance });
  }
}

//------------------------------------------------------------------------------
bool ReadNURBSFieldData(vtkFieldData* fieldData, NurbsSurface& surface, std::string& error)
{
  surface = NurbsSurface();
  if (!HasNURBSFieldData(fieldData))
  {
    error = std::string("there is no NURBS definition; the field data has to hold \"") +
      DegreesName + "\" and its companions, as the CAD surface reader writes them";
    return false;
  }
  if (!ReadPair(fieldData, DegreesName, surface.DegreeU, surface.DegreeV, error) ||
    !ReadPair(fieldData, NetSizeName, surface.CountU, surface.CountV, error) ||
    !CheckSizes(surface, error) || !ReadControlPoints(fieldData, surface, error))
  {
    return false;
  }
  const vtkIdType knotsU = static_cast<vtkIdType>(surface.CountU) + surface.DegreeU + 1;
  const vtkIdType knotsV = static_cast<vtkIdType>(surface.CountV) + surface.DegreeV + 1;
  if (!ReadScalars(fieldData, KnotsUName, knotsU, surface.KnotsU, error) ||
    !ReadScalars(fieldData, KnotsVName, knotsV, surface.KnotsV, error) ||
    !ReadTrimLoops(fieldData, surface, error) || !ReadTolerance(fieldData, surface, error))
  {
    return false;
  }
  error = FindDefect(surface);
  return error.empty();
}

//------------------------------------------------------------------------------
bool HasNURBSFieldData(vtkFieldData* fieldData)
{
  if (fieldData)
  {
    for (const char* name : { DegreesName, NetSizeName, ControlPointsName, KnotsUName, KnotsVName })
    {
      if (fieldData->HasArray(name))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool ReadTrimmingSurface(
  vtkDataObject* data, std::vector<NurbsSurface>& surfaces, std::string& error)
{
  surfaces.clear();
  error.clear();
  if (!AppendSurfaces(data, std::string(), surfaces, error))
  {
    surfaces.clear();
    return false;
  }
  if (surfaces.empty())
  {
    error = "there is no surface; poly data with the NURBS field arrays, or a composite of such, "
            "is needed";
    return false;
  }
  return true;
}
}
