/**
 * @file FuzzGrids.cxx
 * @brief Corrupt and degenerate grids on the filter's first input.
 *
 * FuzzGrids [count [seed [first [step]]]], as FuzzFiles.
 */
#include "Random.h"
#include "TrimVerdict.h"

#include <vtkBitArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using fuzz::Random;
using judge::Vec3;

namespace
{
/// A grid taken apart, so that its parts need not fit.
struct Parts
{
  std::vector<Vec3> Points;
  std::vector<vtkTypeInt64> Connectivity;
  std::vector<vtkTypeInt64> Offsets;
  std::vector<unsigned char> Types;
};

// Not 1e9 and the like: the judge's tolerance goes by the size of the grid.
const std::vector<double> Values = { 0, 1e-300, 1e-9, 1e4, 1e20, 1e150, 1e308, -1e308,
  std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
  -std::numeric_limits<double>::infinity() };

Parts TakeApart(vtkUnstructuredGrid* grid)
{
  Parts parts;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    parts.Points.emplace_back(grid->GetPoint(i));
  }
  vtkNew<vtkCellArray> cells;
  cells->DeepCopy(grid->GetCells());
  cells->ConvertTo64BitStorage();
  vtkTypeInt64Array* connectivity = cells->GetConnectivityArray64();
  parts.Connectivity.assign(
    connectivity->GetPointer(0), connectivity->GetPointer(connectivity->GetNumberOfValues()));
  vtkTypeInt64Array* offsets = cells->GetOffsetsArray64();
  parts.Offsets.assign(offsets->GetPointer(0), offsets->GetPointer(offsets->GetNumberOfValues()));
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    parts.Types.push_back(static_cast<unsigned char>(grid->GetCellType(i)));
  }
  return parts;
}

template <typename Array>
vtkSmartPointer<Array> ToArray(const std::vector<vtkTypeInt64>& values)
{
  auto array = vtkSmartPointer<Array>::New();
  for (vtkTypeInt64 value : values)
  {
    array->InsertNextValue(static_cast<typename Array::ValueType>(value));
  }
  return array;
}

vtkSmartPointer<vtkUnstructuredGrid> Assemble(const Parts& parts, Random& random)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(random.OneIn(4) ? VTK_FLOAT : random.OneIn(20) ? VTK_INT : VTK_DOUBLE);
  for (const Vec3& point : parts.Points)
  {
    const bool whole = points->GetDataType() == VTK_INT && !(point.cwiseAbs().maxCoeff() < 1e6);
    const bool large =
      points->GetDataType() == VTK_FLOAT && std::isfinite(point.sum()) && point.norm() > 1e38;
    points->InsertNextPoint(whole || large ? Vec3(Vec3::Zero()).data() : point.data());
  }
  grid->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  if (random.OneIn(3))
  {
    cells->SetData(ToArray<vtkTypeInt32Array>(parts.Offsets).Get(),
      ToArray<vtkTypeInt32Array>(parts.Connectivity).Get());
  }
  else
  {
    cells->SetData(ToArray<vtkTypeInt64Array>(parts.Offsets).Get(),
      ToArray<vtkTypeInt64Array>(parts.Connectivity).Get());
  }
  vtkNew<vtkUnsignedCharArray> types;
  for (unsigned char type : parts.Types)
  {
    types->InsertNextValue(type);
  }
  // This form, as the other one follows the faces of polyhedra, and VTK does not check them.
  grid->SetCells(types, cells, nullptr, nullptr);
  return grid;
}

size_t Some(Random& random)
{
  return random.OneIn(3) ? 1 : 1 + random.Below(6);
}

/// Node numbers out of range, exchanged, repeated, or of another place.
void ChangeConnectivity(Parts& parts, Random& random)
{
  const auto count = static_cast<vtkTypeInt64>(parts.Points.size());
  const std::vector<vtkTypeInt64> wild = { -1, count, count + 1, 1000000000, 2147483647,
    -2147483648LL };
  for (size_t times = Some(random); times > 0; --times)
  {
    vtkTypeInt64& node = parts.Connectivity[random.Below(parts.Connectivity.size())];
    vtkTypeInt64& other = parts.Connectivity[random.Below(parts.Connectivity.size())];
    switch (random.Below(4))
    {
      case 0:
        node = random.Pick(wild);
        break;
      case 1:
        std::swap(node, *(&node == &parts.Connectivity.back() ? &node - 1 : &node + 1));
        break;
      case 2:
        node = other;
        break;
      default:
        node = static_cast<vtkTypeInt64>(random.Below(parts.Points.size()));
    }
  }
}

void ChangeOffsets(Parts& parts, Random& random)
{
  for (size_t times = Some(random); times > 0; --times)
  {
    vtkTypeInt64& offset = parts.Offsets[random.Below(parts.Offsets.size())];
    const std::vector<vtkTypeInt64> values = { 0, -1, offset + 1, offset - 1, offset + 8,
      1000000000, 2147483647, -2147483648LL };
    offset = random.Pick(values);
  }
}

void ChangeTypes(Parts& parts, Random& random)
{
  const std::vector<int> types = { VTK_WEDGE, VTK_HEXAHEDRON, VTK_TETRA, VTK_VOXEL, VTK_EMPTY_CELL,
    VTK_QUADRATIC_HEXAHEDRON, VTK_POLYHEDRON, 255 };
  for (size_t times = Some(random); times > 0; --times)
  {
    parts.Types[random.Below(parts.Types.size())] = static_cast<unsigned char>(random.Pick(types));
  }
}

/// Coordinates of a few nodes: not finite, huge, or where other nodes are.
void ChangePoints(Parts& parts, Random& random)
{
  for (size_t times = Some(random); times > 0; --times)
  {
    Vec3& point = parts.Points[random.Below(parts.Points.size())];
    switch (random.Below(3))
    {
      case 0:
        point[static_cast<int>(random.Below(3))] = random.Pick(Values);
        break;
      case 1:
        point = random.Pick(parts.Points);
        break;
      default:
        point += 2 * Vec3(random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1));
    }
  }
}

/// The whole model: huge, tiny, far away, flat, turned inside out, or rough.
void ChangeShape(Parts& parts, Random& random)
{
  const size_t what = random.Below(6);
  const double scale = std::pow(10.0, random.Between(-200, 200));
  const double small = std::pow(10.0, random.Between(-20, 20));
  const double rough = random.Between(0, 0.8);
  const int axis = static_cast<int>(random.Below(3));
  for (Vec3& point : parts.Points)
  {
    const Vec3 noise(random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1));
    const Vec3 results[6] = { scale * point, small * point, point + Vec3::Constant(small), point,
      point, point + rough * noise };
    point = results[what];
    point[axis] *= what == 3 ? 0 : what == 4 ? -1 : 1;
  }
}

/// Elements lost, doubled, turned inside out, flattened; or made of any eight nodes.
void ChangeElements(Parts& parts, Random& random)
{
  for (size_t times = Some(random); times > 0; --times)
  {
    const size_t cell = random.Below(parts.Types.size());
    const auto begin = parts.Connectivity.begin() + parts.Offsets[cell];
    const auto end = parts.Connectivity.begin() + parts.Offsets[cell + 1];
    const std::vector<vtkTypeInt64> nodes(begin, end);
    switch (random.Below(4))
    {
      case 0:
        parts.Connectivity.insert(parts.Connectivity.end(), nodes.begin(), nodes.end());
        parts.Offsets.push_back(static_cast<vtkTypeInt64>(parts.Connectivity.size()));
        parts.Types.push_back(parts.Types[cell]);
        break;
      case 1:
        std::rotate(begin, begin + static_cast<std::ptrdiff_t>(nodes.size() / 2), end);
        break;
      case 2:
        for (size_t i = 0; i < nodes.size() / 2; ++i)
        {
          parts.Points[nodes[i]] = parts.Points[nodes[i + nodes.size() / 2]];
        }
        break;
      default:
        for (auto node = begin; node != end; ++node)
        {
          *node = static_cast<vtkTypeInt64>(random.Below(parts.Points.size()));
        }
    }
  }
}

/// Numbers of points, cells, types and offsets that do not fit; or nothing at all.
void ChangeSizes(Parts& parts, Random& random)
{
  switch (random.Below(7))
  {
    case 0:
      parts.Points.resize(random.Below(parts.Points.size()));
      break;
    case 1:
      parts.Points.resize(parts.Points.size() + 1 + random.Below(50), Vec3(1e3, 0, 0));
      break;
    case 2:
      parts.Connectivity.resize(random.Below(parts.Connectivity.size()));
      break;
    case 3:
      parts.Types.resize(random.Below(parts.Types.size()));
      break;
    case 4:
      parts.Types.resize(parts.Types.size() + 1 + random.Below(50), VTK_HEXAHEDRON);
      break;
    case 5:
      parts.Offsets.resize(1 + random.Below(parts.Offsets.size() - 1));
      break;
    default:
      parts.Connectivity.clear();
      parts.Offsets.assign(1, 0);
      parts.Types.clear();
      parts.Points.resize(random.OneIn(2) ? 0 : parts.Points.size());
  }
}

/// Arrays on the sound grid that have not one tuple for each point or cell, or odd types.
void AddArrays(vtkUnstructuredGrid* grid, Random& random)
{
  for (size_t times = Some(random); times > 0; --times)
  {
    const bool onCells = random.OneIn(2);
    vtkDataSetAttributes* data = onCells ? static_cast<vtkDataSetAttributes*>(grid->GetCellData())
                                         : static_cast<vtkDataSetAttributes*>(grid->GetPointData());
    const vtkIdType count = onCells ? grid->GetNumberOfCells() : grid->GetNumberOfPoints();
    vtkSmartPointer<vtkAbstractArray> array;
    switch (random.Below(4))
    {
      case 0:
        array = vtkSmartPointer<vtkStringArray>::New();
        break;
      case 1:
        array = vtkSmartPointer<vtkBitArray>::New();
        break;
      case 2:
        array = vtkSmartPointer<vtkUnsignedCharArray>::New();
        break;
      default:
        array = vtkSmartPointer<vtkDoubleArray>::New();
    }
    const bool named = !random.OneIn(5);
    array->SetName(named ? "extra" : nullptr);
    array->SetNumberOfComponents(1 + static_cast<int>(random.Below(10)));
    const vtkIdType tuples =
      random.OneIn(3) ? count : static_cast<vtkIdType>(random.Below(2 * count));
    array->SetNumberOfTuples(tuples);
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      array->SetVariantValue(i, vtkVariant(1));
    }
    data->AddArray(array);
  }
}

using Change = void (*)(Parts&, Random&);
struct NamedChange
{
  const char* Name;
  Change Apply;
};
const std::vector<NamedChange> Changes = { { "nodes", ChangeConnectivity },
  { "offsets", ChangeOffsets }, { "types", ChangeTypes }, { "points", ChangePoints },
  { "shape", ChangeShape }, { "elements", ChangeElements }, { "sizes", ChangeSizes } };

fuzz::Trial MakeTrial(Random& random)
{
  fuzz::Trial trial;
  trial.Mesh = random.Pick(fuzz::SmallMeshes());
  trial.Surface = fuzz::SoundSurface(trial.Mesh, 0, random);
  trial.Kind = "arrays";
  const size_t what = random.Below(Changes.size() + 1);
  if (what == Changes.size())
  {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->DeepCopy(trial.Mesh.Grid);
    trial.Mesh.Grid = grid;
    AddArrays(grid, random);
  }
  else
  {
    trial.Kind = Changes[what].Name;
    Parts parts = TakeApart(trial.Mesh.Grid);
    Changes[what].Apply(parts, random);
    trial.Mesh.Grid = Assemble(parts, random);
  }
  trial.What = trial.Kind + " of " + trial.Mesh.Name + ", " + trial.Surface.Name;
  return trial;
}
}

int main(int argc, char* argv[])
{
  return fuzz::RunSeries(argc, argv, 1500, "grid", MakeTrial);
}
