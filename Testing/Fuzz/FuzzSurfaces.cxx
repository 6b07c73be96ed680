/**
 * @file FuzzSurfaces.cxx
 * @brief Random and damaged NURBS definitions on the filter's second input.
 *
 * FuzzSurfaces [count [seed [first [step]]]], as FuzzFiles.
 */
#include "Random.h"
#include "TrimVerdict.h"

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using fuzz::Random;
using judge::SplineSurface;
using judge::Vec2;
using judge::Vec3;

namespace
{
const std::vector<const char*> ArrayNames = { "NURBSDegrees", "NURBSControlNetSize",
  "NURBSControlPoints", "NURBSKnotsU", "NURBSKnotsV", "NURBSTrimLoops", "NURBSTrimLoopOffsets",
  "NURBSTolerance" };

const std::vector<double> Values = { 0, -0.0, 1, -1, 2, 0.5, -0.5, 3, 7, 25, 26, 1e-320, 1e-300,
  1e-20, 1e-9, 1e9, 1e20, 1e150, 1e300, 1.7e308, -1e300, 2147483647, -2147483648.0, 4294967296.0,
  std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
  -std::numeric_limits<double>::infinity() };

/// One of the arrays that the surface has; null if it has none left.
vtkDataArray* AnyArray(vtkFieldData* data, Random& random)
{
  return data->GetNumberOfArrays() > 0
    ? data->GetArray(static_cast<int>(random.Below(data->GetNumberOfArrays())))
    : nullptr;
}

void SetValue(vtkFieldData* data, Random& random)
{
  vtkDataArray* array = AnyArray(data, random);
  if (array && array->GetNumberOfValues() > 0)
  {
    array->SetComponent(static_cast<vtkIdType>(random.Below(array->GetNumberOfTuples())),
      static_cast<int>(random.Below(array->GetNumberOfComponents())), random.Pick(Values));
  }
}

/// All values of a component, or of an array, times or plus a number; or exchanged.
void ChangeAll(vtkFieldData* data, Random& random)
{
  vtkDataArray* array = AnyArray(data, random);
  const double value = random.Pick(Values);
  const size_t what = random.Below(4);
  const int only = random.OneIn(2) ? -1 : static_cast<int>(random.Below(4));
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const double old = array->GetComponent(i, c);
      const double all[4] = { value, value * old, value + old, -old };
      array->SetComponent(i, c, only < 0 || only == c ? all[what] : old);
    }
  }
}

void Resize(vtkFieldData* data, Random& random)
{
  if (vtkDataArray* array = AnyArray(data, random))
  {
    const vtkIdType before = array->GetNumberOfTuples();
    const vtkIdType count =
      random.OneIn(3) ? 0 : static_cast<vtkIdType>(random.Below(2 * before + 2));
    array->Resize(count);
    array->SetNumberOfTuples(count);
    for (vtkIdType i = before; i < count; ++i)
    {
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        array->SetComponent(i, c, random.Between(0, 1));
      }
    }
  }
}

/// The same values in an array of another type or other components; or text.
void Retype(vtkFieldData* data, Random& random)
{
  vtkDataArray* array = AnyArray(data, random);
  if (!array)
  {
    return;
  }
  vtkSmartPointer<vtkAbstractArray> other;
  switch (random.Below(7))
  {
    case 0:
      other = vtkSmartPointer<vtkFloatArray>::New();
      break;
    case 1:
      other = vtkSmartPointer<vtkUnsignedCharArray>::New();
      break;
    case 2:
      other = vtkSmartPointer<vtkBitArray>::New();
      break;
    case 3:
      other = vtkSmartPointer<vtkLongLongArray>::New();
      break;
    case 4:
      other = vtkSmartPointer<vtkStringArray>::New();
      break;
    case 5:
      other = vtkSmartPointer<vtkIntArray>::New();
      break;
    default:
      other = vtkSmartPointer<vtkDoubleArray>::New();
  }
  other->SetName(array->GetName());
  const int components =
    random.OneIn(2) ? array->GetNumberOfComponents() : static_cast<int>(random.Below(6)) + 1;
  other->SetNumberOfComponents(components);
  other->SetNumberOfTuples(array->GetNumberOfValues() / components);
  for (vtkIdType i = 0; i < other->GetNumberOfValues(); ++i)
  {
    const int n = array->GetNumberOfComponents();
    const double value = array->GetComponent(i / n, static_cast<int>(i % n));
    // Out of range and NaN are not for whole numbers: the conversion would be undefined here.
    const bool tame = std::abs(value) < 100;
    other->SetVariantValue(i, vtkVariant(tame ? value : 1.0));
  }
  data->RemoveArray(array->GetName());
  data->AddArray(other);
}

void Remove(vtkFieldData* data, Random& random)
{
  data->RemoveArray(random.Pick(ArrayNames));
}

/// Two arrays exchange their names.
void Rename(vtkFieldData* data, Random& random)
{
  vtkDataArray* a = AnyArray(data, random);
  vtkDataArray* b = AnyArray(data, random);
  if (a && b && a->GetName() && b->GetName())
  {
    const std::string first = a->GetName();
    const std::string second = b->GetName();
    a->SetName(second.c_str());
    b->SetName(first.c_str());
  }
}

/// Loops that cross themselves, lie on each other, have no area, or are not divided rightly.
void AddLoops(vtkFieldData* data, Random& random)
{
  vtkNew<vtkDoubleArray> points;
  points->SetName("NURBSTrimLoops");
  points->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> offsets;
  offsets->SetName("NURBSTrimLoopOffsets");
  offsets->InsertNextValue(0);
  for (size_t loop = 1 + random.Below(4); loop > 0; --loop)
  {
    const size_t count = random.OneIn(8) ? 2000 : random.Below(12);
    const double size = random.OneIn(4) ? 1e-9 : random.Between(0, 0.5);
    Vec2 at(random.Between(0, 1), random.Between(0, 1));
    for (size_t i = 0; i < count; ++i)
    {
      const Vec2 step(
        random.Between(-size, size), random.OneIn(5) ? 0 : random.Between(-size, size));
      at = random.OneIn(10) ? at : Vec2(at + step);
      at = random.OneIn(30) ? at : Vec2(at.cwiseMax(0).cwiseMin(1));
      points->InsertNextTuple(at.data());
    }
    offsets->InsertNextValue(static_cast<int>(points->GetNumberOfTuples()));
  }
  data->AddArray(points);
  data->AddArray(offsets);
}

std::vector<double> RandomKnots(int count, int degree, Random& random)
{
  std::vector<double> knots;
  const bool repeats = random.OneIn(2);
  for (int i = 0; i < count + degree + 1; ++i)
  {
    knots.push_back(repeats ? static_cast<double>(random.Below(4)) : random.Between(0, 1));
  }
  std::sort(knots.begin(), knots.end());
  if (random.OneIn(2))
  {
    std::fill(knots.begin(), knots.begin() + degree + 1, knots.front());
    std::fill(knots.end() - degree - 1, knots.end(), knots.back());
  }
  return knots;
}

double RandomWeight(Random& random)
{
  return random.OneIn(20)
    ? random.Pick(Values)
    : std::pow(10.0, random.OneIn(8) ? random.Between(-12, 12) : random.Between(-1, 1));
}

/// Any surface over the mesh: a wild one, a point, a line, a fold.
vtkSmartPointer<vtkPolyData> WildSurface(const judge::Frame& frame, Random& random)
{
  SplineSurface surface;
  const int most = random.OneIn(10) ? 26 : 5;
  surface.DegreeU = 1 + static_cast<int>(random.Below(most));
  surface.DegreeV = 1 + static_cast<int>(random.Below(most));
  surface.CountU = surface.DegreeU + 1 + static_cast<int>(random.Below(5));
  surface.CountV = surface.DegreeV + 1 + static_cast<int>(random.Below(5));
  surface.KnotsU = RandomKnots(surface.CountU, surface.DegreeU, random);
  surface.KnotsV = RandomKnots(surface.CountV, surface.DegreeV, random);
  const bool weighted = random.OneIn(3);
  const double noise = random.OneIn(3) ? 1.0 : 0.05;
  const size_t collapsed = random.Below(12);
  const double reach = random.OneIn(10) ? 1e6 : 1.5;
  for (int j = 0; j < surface.CountV; ++j)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      const double u = 2.0 * i / (surface.CountU - 1) - 1;
      const double v = 2.0 * j / (surface.CountV - 1) - 1;
      Vec3 local(0.3 * frame.HalfX, reach * u * frame.HalfY, reach * v * (frame.HalfZ + 1));
      local += noise * frame.HalfX *
        Vec3(random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1));
      local = collapsed == 0 ? Vec3(Vec3::Zero()) : collapsed == 1 ? Vec3(0, local[1], 0) : local;
      const Vec3 point = frame.Centre + frame.Axes * local;
      surface.Control.emplace_back(
        point[0], point[1], point[2], weighted ? RandomWeight(random) : 1.0);
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  // A tessellation is not needed, and of a wild surface not to be had.
  SplineSurface plain = surface;
  plain.DegreeU = plain.DegreeV = 1;
  plain.CountU = plain.CountV = 2;
  plain.KnotsU = plain.KnotsV = { 0, 0, 1, 1 };
  plain.Control.assign(4, Eigen::Vector4d(0, 0, 0, 1));
  data->DeepCopy(judge::ToPolyData(plain));
  const auto put = [&data](const char* name, const std::vector<double>& values, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    data->GetFieldData()->AddArray(array);
  };
  put("NURBSDegrees", { 1.0 * surface.DegreeU, 1.0 * surface.DegreeV }, 2);
  put("NURBSControlNetSize", { 1.0 * surface.CountU, 1.0 * surface.CountV }, 2);
  put("NURBSKnotsU", surface.KnotsU, 1);
  put("NURBSKnotsV", surface.KnotsV, 1);
  std::vector<double> control;
  for (const Eigen::Vector4d& point : surface.Control)
  {
    control.insert(control.end(), point.data(), point.data() + 4);
  }
  put("NURBSControlPoints", control, 4);
  return data;
}

using Change = void (*)(vtkFieldData*, Random&);
struct NamedChange
{
  const char* Name;
  Change Apply;
};
const std::vector<NamedChange> Changes = { { "value", SetValue }, { "all values", ChangeAll },
  { "size", Resize }, { "type", Retype }, { "removed", Remove }, { "renamed", Rename },
  { "loops", AddLoops } };

/// Puts surfaces, and things that are none, into composites of every kind.
vtkSmartPointer<vtkDataObject> Nest(vtkDataObject* data, const judge::Mesh& mesh, Random& random)
{
  switch (random.Below(6))
  {
    case 0:
    {
      auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
      blocks->SetNumberOfBlocks(3);
      blocks->SetBlock(static_cast<unsigned>(random.Below(3)), data);
      if (random.OneIn(3))
      {
        blocks->SetBlock(static_cast<unsigned>(random.Below(3)), mesh.Grid);
      }
      return blocks;
    }
    case 1:
    {
      auto outer = vtkSmartPointer<vtkMultiBlockDataSet>::New();
      outer->SetBlock(static_cast<unsigned>(random.Below(3)), Nest(data, mesh, random));
      return outer;
    }
    case 2:
    {
      auto sets = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
      sets->SetPartition(
        static_cast<unsigned>(random.Below(3)), static_cast<unsigned>(random.Below(3)), data);
      return sets;
    }
    case 3:
    {
      auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
      blocks->SetBlock(0, data);
      blocks->SetBlock(1, data);
      return blocks;
    }
    case 4:
      return random.OneIn(2) ? vtkSmartPointer<vtkDataObject>(mesh.Grid)
                             : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
    default:
      return data;
  }
}

/// A copy of one face, or of all; faces of a shell are damaged one by one.
vtkSmartPointer<vtkDataObject> Copy(vtkDataObject* data)
{
  auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  copy->DeepCopy(data);
  return copy;
}

vtkFieldData* FieldDataOf(vtkDataObject* data, Random& random)
{
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
  {
    return blocks->GetBlock(static_cast<unsigned>(random.Below(blocks->GetNumberOfBlocks())))
      ->GetFieldData();
  }
  return data->GetFieldData();
}

fuzz::Trial MakeTrial(Random& random)
{
  fuzz::Trial trial;
  trial.Mesh = random.Pick(fuzz::SmallMeshes());
  trial.Surface = fuzz::SoundSurface(trial.Mesh, 0.5, random);
  vtkSmartPointer<vtkDataObject> data = trial.Surface.Data;
  trial.Kind = "wild";
  if (random.OneIn(4))
  {
    data = WildSurface(trial.Mesh.Box, random);
  }
  else
  {
    data = Copy(data);
    const NamedChange& change = random.Pick(Changes);
    trial.Kind = change.Name;
    for (size_t times = 1 + random.Below(2); times > 0; --times)
    {
      change.Apply(FieldDataOf(data, random), random);
    }
  }
  if (random.OneIn(10))
  {
    trial.Kind = "nested";
    data = Nest(data, trial.Mesh, random);
  }
  trial.Surface.Data = data;
  trial.What = trial.Kind + " on " + trial.Mesh.Name;
  return trial;
}
}

int main(int argc, char* argv[])
{
  return fuzz::RunSeries(argc, argv, 1000, "surface", MakeTrial);
}
