#include "Meshes.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkShortArray.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <random>

namespace judge
{
namespace
{
template <typename ArrayT>
vtkSmartPointer<ArrayT> Random(const char* name, int components, vtkIdType tuples, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 250);
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples * components; ++i)
  {
    array->SetValue(i, static_cast<typename ArrayT::ValueType>(any(random)));
  }
  return array;
}

vtkSmartPointer<vtkIdTypeArray> Ids(const char* name, vtkIdType tuples, vtkIdType first)
{
  auto array = vtkSmartPointer<vtkIdTypeArray>::New();
  array->SetName(name);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->InsertNextValue(first + 3 * i);
  }
  return array;
}

vtkSmartPointer<vtkStringArray> Strings(const char* name, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    array->InsertNextValue("steel " + std::to_string(i));
  }
  return array;
}

/// What an array is drawn and read with.
void AddUnitAndColours(vtkDataArray* array, const char* unit)
{
  array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
  array->SetLookupTable(vtkNew<vtkLookupTable>());
}
}

void MovePoints(vtkPointSet* data, const std::function<Vec3(const Vec3&)>& to)
{
  vtkPoints* const points = data->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, to(Vec3(points->GetPoint(i))).data());
  }
  points->Modified();
}

void FoldElements(vtkPointSet* sheet)
{
  MovePoints(sheet,
    [](const Vec3& p)
    {
      const bool stays = std::lround(p[0]) % 2 == 0 && std::lround(p[1]) % 2 == 0;
      return Vec3(p[0], p[1], stays ? 0.3 * p[2] : -p[2]);
    });
}

void AddData(vtkUnstructuredGrid* grid, unsigned seed)
{
  const vtkIdType points = grid->GetNumberOfPoints(), cells = grid->GetNumberOfCells();
  vtkPointData* pd = grid->GetPointData();
  auto colour = Random<vtkUnsignedCharArray>("Colour", 4, points, seed + 1);
  colour->SetComponentName(0, "red");
  colour->SetComponentName(3, "opacity");
  auto temperature = Random<vtkFloatArray>("Temperature", 1, points, seed + 2);
  AddUnitAndColours(temperature, "K");
  pd->SetScalars(temperature);
  pd->SetVectors(Random<vtkDoubleArray>("Velocity", 3, points, seed + 3));
  pd->SetNormals(Random<vtkFloatArray>("Normals", 3, points, seed + 4));
  pd->SetTensors(Random<vtkDoubleArray>("Stretch", 9, points, seed + 5));
  pd->SetTCoords(Random<vtkFloatArray>("Texture", 2, points, seed + 6));
  pd->SetGlobalIds(Ids("NodeNumbers", points, 1000));
  pd->AddArray(colour);
  pd->AddArray(Random<vtkIntArray>("Zone", 1, points, seed + 7));
  pd->AddArray(Random<vtkLongLongArray>("Long", 2, points, seed + 8));

  vtkCellData* cd = grid->GetCellData();
  auto stress = Random<vtkDoubleArray>("Stress", 6, cells, seed + 9);
  stress->SetComponentName(0, "XX");
  stress->SetComponentName(5, "XZ");
  AddUnitAndColours(stress, "MPa");
  cd->SetScalars(Random<vtkShortArray>("Part", 1, cells, seed + 10));
  cd->SetVectors(Random<vtkFloatArray>("Fibre", 3, cells, seed + 11));
  cd->SetGlobalIds(Ids("ElementNumbers", cells, 7));
  cd->AddArray(stress);
  cd->AddArray(Strings("Material", cells));

  grid->GetFieldData()->AddArray(Strings("Origin", 2));
  grid->GetFieldData()->AddArray(Random<vtkDoubleArray>("Step", 2, 3, seed + 12));
}

}
