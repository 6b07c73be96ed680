#include "SheetTrim.h"

#include "SplineData.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace benchmark
{
namespace
{

constexpr int Layers = 2;
constexpr double Thickness = 0.4;

/// Numbers 0 .. count - 1, in order or at random.
std::vector<vtkIdType> Numbers(vtkIdType count, bool shuffled, unsigned seed)
{
  std::vector<vtkIdType> numbers(count);
  std::iota(numbers.begin(), numbers.end(), vtkIdType(0));
  if (shuffled)
  {
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937_64(seed));
  }
  return numbers;
}

vtkSmartPointer<vtkPoints> MakePoints(int side, const std::vector<vtkIdType>& numbers)
{
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()));
  double* to = coordinates->GetPointer(0);
  std::size_t next = 0;
  for (int k = 0; k <= Layers; ++k)
  {
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i, ++next)
      {
        double* point = to + 3 * numbers[next];
        point[0] = i;
        point[1] = j;
        point[2] = Thickness * k;
      }
    }
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

}

int SideOfSheet(vtkIdType cells)
{
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(cells) / Layers)));
}

vtkSmartPointer<vtkUnstructuredGrid> MakeSheet(vtkIdType cells, bool shuffled)
{
  const int side = SideOfSheet(cells);
  const vtkIdType row = side + 1;
  const vtkIdType plane = row * row;
  const vtkIdType count = static_cast<vtkIdType>(side) * side * Layers;
  const auto node = Numbers(plane * (Layers + 1), shuffled, 1);
  const auto cell = Numbers(count, shuffled, 2);
  vtkNew<vtkTypeInt64Array> offsets, connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(8 * count);
  for (vtkIdType c = 0; c <= count; ++c)
  {
    offsets->GetPointer(0)[c] = 8 * c;
  }
  vtkTypeInt64* to = connectivity->GetPointer(0);
  for (vtkIdType c = 0; c < count; ++c)
  {
    const vtkIdType i = c % side, j = c / side % side, k = c / side / side;
    const vtkIdType first = i + row * j + plane * k;
    const vtkIdType corners[4] = { first, first + 1, first + 1 + row, first + row };
    for (int n = 0; n < 4; ++n)
    {
      to[8 * cell[c] + n] = node[corners[n]];
      to[8 * cell[c] + n + 4] = node[corners[n] + plane];
    }
  }
  vtkNew<vtkUnsignedCharArray> types;
  types->SetNumberOfValues(count);
  std::fill_n(types->GetPointer(0), count, static_cast<unsigned char>(VTK_HEXAHEDRON));
  vtkNew<vtkCellArray> array;
  array->SetData(offsets, connectivity);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(MakePoints(side, node));
  grid->SetCells(types, array);
  return grid;
}

namespace
{

/// A bicubic across the middle of the sheet, so high, with so many control points; `wave` gives x
/// by the indices and the parameters of a control point, along the cut and through the sheet.
template <typename Wave>
vtkSmartPointer<vtkPolyData> MakeCut(
  vtkIdType cells, double height, int countU, int countV, const Wave& wave)
{
  const double side = SideOfSheet(cells);
  judge::SplineSurface cut;
  cut.DegreeU = cut.DegreeV = 3;
  cut.CountU = countU;
  cut.CountV = countV;
  cut.KnotsU = judge::UniformKnots(countU, cut.DegreeU);
  cut.KnotsV = judge::UniformKnots(countV, cut.DegreeV);
  const auto u = judge::GrevilleAbscissae(cut.KnotsU, cut.DegreeU);
  const auto v = judge::GrevilleAbscissae(cut.KnotsV, cut.DegreeV);
  for (int j = 0; j < countV; ++j)
  {
    for (int i = 0; i < countU; ++i)
    {
      const double x = wave(i, j, u[i], v[j]);
      const double y = side * (1.1 * u[i] - 0.05);
      const double z = 0.5 * Thickness * Layers + height * (v[j] - 0.5);
      cut.Control.emplace_back(x, y, z, 1.0);
    }
  }
  return judge::ToPolyData(cut);
}

}

vtkSmartPointer<vtkPolyData> MakeWave(vtkIdType cells, double shift)
{
  const double side = SideOfSheet(cells);
  return MakeCut(cells, 3.0 * Thickness * Layers, 12, 8,
    [=](int i, int j, double, double)
    { return side * (0.5 + shift + 0.04 * std::sin(2.1 * i)) + 0.02 * std::sin(1.7 * j); });
}

vtkSmartPointer<vtkPolyData> MakeFineWave(vtkIdType cells, double shift, int count)
{
  const double side = SideOfSheet(cells);
  return MakeCut(cells, 0.1 * side, count, count,
    [=](int, int, double u, double v)
    { return side * (0.5 + shift + 0.04 * std::sin(12.0 * u)) + 0.02 * std::sin(12.0 * v); });
}

AnalyticTrim TrimByPlane(vtkUnstructuredGrid* grid, double limit)
{
  const vtkIdType points = grid->GetNumberOfPoints();
  const vtkIdType cells = grid->GetNumberOfCells();
  const double* x = vtkDoubleArray::SafeDownCast(grid->GetPoints()->GetData())->GetPointer(0);
  const vtkTypeInt64* offsets =
    reinterpret_cast<const vtkTypeInt64*>(grid->GetCells()->GetOffsetsArray64()->GetPointer(0));
  const vtkTypeInt64* nodes = reinterpret_cast<const vtkTypeInt64*>(
    grid->GetCells()->GetConnectivityArray64()->GetPointer(0));
  const unsigned char* types = grid->GetCellTypesArray()->GetPointer(0);

  const std::unique_ptr<unsigned char[]> beyond(new unsigned char[points]);
  for (vtkIdType p = 0; p < points; ++p)
  {
    beyond[p] = x[3 * p] > limit;
  }
  // Count first, so that the arrays have their final size from the beginning.
  AnalyticTrim trim;
  vtkIdType size = 0;
  const std::unique_ptr<unsigned char[]> kept(new unsigned char[cells]);
  const std::unique_ptr<vtkTypeInt32[]> number(new vtkTypeInt32[points]);
  std::fill_n(number.get(), points, -1);
  for (vtkIdType c = 0; c < cells; ++c)
  {
    vtkIdType count = 0;
    for (vtkTypeInt64 n = offsets[c]; n < offsets[c + 1]; ++n)
    {
      count += beyond[nodes[n]];
    }
    kept[c] = 2 * count <= offsets[c + 1] - offsets[c];
    if (kept[c])
    {
      ++trim.NumberOfCells;
      size += offsets[c + 1] - offsets[c];
      for (vtkTypeInt64 n = offsets[c]; n < offsets[c + 1]; ++n)
      {
        number[nodes[n]] = 0;
      }
    }
  }
  for (vtkIdType p = 0; p < points; ++p)
  {
    if (number[p] == 0)
    {
      number[p] = static_cast<vtkTypeInt32>(trim.NumberOfPoints++);
    }
  }
  trim.Points.reset(new double[3 * trim.NumberOfPoints]);
  trim.Offsets.reset(new vtkTypeInt64[trim.NumberOfCells + 1]);
  trim.Connectivity.reset(new vtkTypeInt64[size]);
  trim.Types.reset(new unsigned char[trim.NumberOfCells]);
  for (vtkIdType p = 0; p < points; ++p)
  {
    if (number[p] >= 0)
    {
      std::copy_n(x + 3 * p, 3, trim.Points.get() + 3 * number[p]);
    }
  }
  vtkTypeInt64 end = 0;
  vtkIdType next = 0;
  trim.Offsets[0] = 0;
  for (vtkIdType c = 0; c < cells; ++c)
  {
    if (kept[c])
    {
      for (vtkTypeInt64 n = offsets[c]; n < offsets[c + 1]; ++n)
      {
        trim.Connectivity[end++] = number[nodes[n]];
      }
      trim.Types[next] = types[c];
      trim.Offsets[++next] = end;
    }
  }
  return trim;
}

}
