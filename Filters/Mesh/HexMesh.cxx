#include "HexMesh.h"

#include "Jacobian.h"
#include "Team.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellTypes.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace trim
{
namespace
{

/// Lowest index that fails a test, found in parallel: the same for any number of threads.
template <typename Test>
Id FirstFailure(Id count, const Test& fails)
{
  std::atomic<Id> first{ count };
  ParallelFor(0, count, 100000,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        if (fails(i))
        {
          Id seen = first.load();
          while (i < seen && !first.compare_exchange_weak(seen, i))
          {
          }
          return;
        }
      }
    });
  return first.load();
}

bool TakePoints(vtkUnstructuredGrid* grid, HexMesh& mesh, std::string& error)
{
  vtkPoints* points = grid->GetPoints();
  mesh.NumberOfPoints = points ? points->GetNumberOfPoints() : 0;
  if (!points || mesh.NumberOfPoints == 0)
  {
    return true;
  }
  if (mesh.NumberOfPoints > std::numeric_limits<int>::max())
  {
    error = "The grid has " + std::to_string(mesh.NumberOfPoints) +
      " points, more than one rank can number: distribute it over several ranks.";
    return false;
  }
  if (auto* doubles = vtkDoubleArray::FastDownCast(points->GetData()))
  {
    mesh.PointsDouble = doubles->GetPointer(0);
  }
  else if (auto* floats = vtkFloatArray::FastDownCast(points->GetData()))
  {
    mesh.PointsFloat = floats->GetPointer(0);
  }
  else
  {
    error = std::string("The points of the grid are of type ") +
      points->GetData()->GetDataTypeAsString() +
      ", but must be float or double: convert them, e.g. with a Calculator.";
    return false;
  }
  return true;
}

bool CheckPoints(const HexMesh& mesh, std::string& error)
{
  const Id bad =
    FirstFailure(mesh.NumberOfPoints, [&mesh](Id i) { return !mesh.Point(i).allFinite(); });
  if (bad < mesh.NumberOfPoints)
  {
    error = "Point " + std::to_string(bad) +
      " of the grid has a coordinate that is not finite: repair the mesh before trimming.";
    return false;
  }
  return true;
}

/// Data arrays are taken along by node and cell: they have to hold a tuple for each.
bool CheckArrays(vtkDataSetAttributes* data, Id count, const char* what, std::string& error)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < count)
    {
      error = "The array \"" + std::string(array->GetName() ? array->GetName() : "") + "\" has " +
        std::to_string(array->GetNumberOfTuples()) + " tuples for " + std::to_string(count) + " " +
        what + ": the grid is corrupt, rewrite it or remove the array.";
      return false;
    }
  }
  return true;
}

bool CheckAttributes(vtkUnstructuredGrid* grid, const HexMesh& mesh, std::string& error)
{
  return mesh.NumberOfCells == 0 ||
    (CheckArrays(grid->GetPointData(), mesh.NumberOfPoints, "points", error) &&
      CheckArrays(grid->GetCellData(), mesh.NumberOfCells, "cells", error));
}

enum class CellDefect
{
  None,
  Type,
  Size,
  Range,
  Repeated
};

/// Node ids side by side, so that the processor compares four at once.
typedef int FourIds __attribute__((vector_size(16)));

bool AnyOf(const FourIds& test)
{
  std::array<std::uint64_t, 2> bits;
  std::memcpy(bits.data(), &test, sizeof(test));
  return (bits[0] | bits[1]) != 0;
}

/// Whether any two of eight ids are the same: each turn of a half meets four pairs more.
bool AnyRepeated(const FourIds& a, const FourIds& b)
{
  const auto turned = [](const FourIds& ids, int by) {
    return __builtin_shuffle(ids, (FourIds{ 0, 1, 2, 3 } + by) & 3);
  };
  return AnyOf((a == b) | (a == turned(b, 1)) | (a == turned(b, 2)) | (a == turned(b, 3)) |
    (a == turned(a, 1)) | (a == turned(a, 2)) | (b == turned(b, 1)) | (b == turned(b, 2)));
}

/// Whether a cell is a hexahedron without a defect: most are, and this asks no question twice. The
/// ends of cells are within the connectivity, and points fit in an int.
template <typename T>
bool IsGoodHexahedron(const T* nodes, Id numberOfPoints)
{
  bool inRange = true;
  std::array<int, 8> ids;
  for (int i = 0; i < 8; ++i)
  {
    inRange &= static_cast<std::make_unsigned_t<T>>(nodes[i]) <
      static_cast<std::make_unsigned_t<Id>>(numberOfPoints);
    ids[i] = static_cast<int>(nodes[i]);
  }
  FourIds a, b;
  std::memcpy(&a, ids.data(), sizeof(a));
  std::memcpy(&b, ids.data() + 4, sizeof(b));
  return inRange && !AnyRepeated(a, b);
}

/// Whether a cell is such a hexahedron.
template <typename T>
bool IsGoodHexahedron(const HexMesh& mesh, const T* connectivity, const T* offsets, Id c)
{
  return mesh.Types[c] == VTK_HEXAHEDRON && offsets[c] >= 0 &&
    offsets[c] <= mesh.ConnectivitySize - 8 && offsets[c + 1] == offsets[c] + 8 &&
    IsGoodHexahedron(connectivity + offsets[c], mesh.NumberOfPoints);
}

template <typename T>
CellDefect FindCellDefect(const HexMesh& mesh, const T* connectivity, const T* offsets, Id c)
{
  if (IsGoodHexahedron(mesh, connectivity, offsets, c))
  {
    return CellDefect::None;
  }
  const int expected = mesh.Types[c] == VTK_HEXAHEDRON ? 8 : mesh.Types[c] == VTK_WEDGE ? 6 : 0;
  if (expected == 0)
  {
    return CellDefect::Type;
  }
  // In this order, so that no difference overflows.
  const T first = offsets[c], last = offsets[c + 1];
  if (first < 0 || last < first || last > mesh.ConnectivitySize || last - first != expected)
  {
    return CellDefect::Size;
  }
  const T* nodes = connectivity + first;
  for (int i = 0; i < expected; ++i)
  {
    if (nodes[i] < 0 || nodes[i] >= mesh.NumberOfPoints)
    {
      return CellDefect::Range;
    }
  }
  for (int i = 0; i < expected; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      if (nodes[i] == nodes[j])
      {
        return CellDefect::Repeated;
      }
    }
  }
  return CellDefect::None;
}

CellDefect FindCellDefect(const HexMesh& mesh, Id c)
{
  return mesh.Offsets64 ? FindCellDefect(mesh, mesh.Connectivity64, mesh.Offsets64, c)
                        : FindCellDefect(mesh, mesh.Connectivity32, mesh.Offsets32, c);
}

/// Whether cells of a type are hexahedra or wedges written in another way, as with nodes on their
/// edges.
bool CanBeRewritten(int type)
{
  const char* const name = vtkCellTypes::GetClassNameFromTypeId(type);
  const auto isCalled = [name](const char* shape) { return name && std::strstr(name, shape); };
  return type == VTK_VOXEL ||
    (type != VTK_HEXAHEDRON && type != VTK_WEDGE && (isCalled("Hexahedron") || isCalled("Wedge")));
}

std::string Describe(CellDefect defect, Id c, const HexMesh& mesh)
{
  const std::string cell = "Cell " + std::to_string(c) + " of the grid ";
  switch (defect)
  {
    case CellDefect::Type:
    {
      const char* name = vtkCellTypes::GetClassNameFromTypeId(mesh.Types[c]);
      // Where such cells follow, those before them are shells or edges of the same mesh.
      const bool isRewritten = std::any_of(mesh.Types + c, mesh.Types + mesh.NumberOfCells,
        [](unsigned char type) { return CanBeRewritten(type); });
      return cell + "is a " + (name ? name : "cell of unknown type") +
        ", but only hexahedra and wedges can be trimmed: " +
        (isRewritten ? "write the mesh with cells of these types, hexahedra of eight nodes."
                     : "remove the other cells first, e.g. with Extract Cells By Type, or mesh the "
                       "part with hexahedra if it has none.");
    }
    case CellDefect::Size:
      return cell + "has not the number of nodes of its type: the grid is corrupt, rewrite it.";
    case CellDefect::Range:
      return cell + "uses a node that does not exist: the grid is corrupt, rewrite it.";
    default:
      return cell + "uses a node twice, and is no wedge by that: remove or repair it.";
  }
}

bool TakeCells(vtkUnstructuredGrid* grid, HexMesh& mesh, std::string& error)
{
  mesh.NumberOfCells = grid->GetNumberOfCells();
  if (mesh.NumberOfCells == 0)
  {
    return true;
  }
  vtkCellArray* cells = grid->GetCells();
  if (grid->GetCellTypesArray()->GetNumberOfValues() < mesh.NumberOfCells)
  {
    error = "The grid has " + std::to_string(mesh.NumberOfCells) + " cells, but the types of " +
      std::to_string(grid->GetCellTypesArray()->GetNumberOfValues()) +
      ": the grid is corrupt, rewrite it.";
    return false;
  }
  mesh.Types = grid->GetCellTypesArray()->GetPointer(0);
  mesh.ConnectivitySize = cells->GetNumberOfConnectivityIds();
  if (cells->IsStorage64Bit())
  {
    mesh.Connectivity64 =
      reinterpret_cast<const vtkTypeInt64*>(cells->GetConnectivityArray64()->GetPointer(0));
    mesh.Offsets64 =
      reinterpret_cast<const vtkTypeInt64*>(cells->GetOffsetsArray64()->GetPointer(0));
  }
  else
  {
    mesh.Connectivity32 = cells->GetConnectivityArray32()->GetPointer(0);
    mesh.Offsets32 = cells->GetOffsetsArray32()->GetPointer(0);
  }
  return true;
}

/// Without a question for each of them.
template <typename T>
bool AreHexahedra(const HexMesh& mesh, const T* offsets, const unsigned char* types, int count)
{
  using Unsigned = std::make_unsigned_t<T>; // which may overflow
  const Id size = 8 * static_cast<Id>(count);
  if (offsets[0] < 0 || offsets[0] > mesh.ConnectivitySize - size)
  {
    return false;
  }
  Unsigned differ = 0;
  int otherType = 0;
  for (int c = 0; c < count; ++c)
  {
    differ |= static_cast<Unsigned>(offsets[c + 1]) - static_cast<Unsigned>(offsets[c]) - 8;
    otherType |= types[c] ^ VTK_HEXAHEDRON;
  }
  return differ == 0 && otherType == 0;
}

bool CheckCells(const HexMesh& mesh, std::string& error)
{
  const Id bad = FirstFailure(
    mesh.NumberOfCells, [&mesh](Id c) { return FindCellDefect(mesh, c) != CellDefect::None; });
  if (bad < mesh.NumberOfCells)
  {
    error = Describe(FindCellDefect(mesh, bad), bad, mesh);
    return false;
  }
  return true;
}

}

void HexMesh::OrientWedge(std::array<Id, 8>& nodes) const
{
  std::array<Vec3, 6> p;
  std::transform(
    nodes.begin(), nodes.begin() + 6, p.begin(), [this](Id node) { return this->Point(node); });
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  if (normal.dot(p[3] + p[4] + p[5] - p[0] - p[1] - p[2]) < 0.0)
  {
    std::swap_ranges(nodes.begin(), nodes.begin() + 3, nodes.begin() + 3);
  }
}

bool HexMesh::OrientHexahedron(std::array<Id, 8>& nodes) const
{
  ElementPoints p;
  std::transform(
    nodes.begin(), nodes.end(), p.begin(), [this](Id node) { return this->Point(node); });
  const bool turned = IsInsideOut(p);
  if (turned)
  {
    std::swap_ranges(nodes.begin(), nodes.begin() + 4, nodes.begin() + 4);
  }
  return turned;
}

Id HexMesh::CountInsideOut() const
{
  std::atomic<Id> count{ 0 };
  ParallelFor(0, this->NumberOfCells, 100000,
    [&](Id begin, Id end)
    {
      std::array<Id, 8> nodes;
      Id own = 0;
      for (Id c = begin; c < end; ++c)
      {
        own += this->Cell(c, nodes) == 8 && this->OrientHexahedron(nodes);
      }
      count += own;
    });
  return count;
}

bool HexMesh::AreHexahedra(Id first, int count) const
{
  return this->Offsets64
    ? trim::AreHexahedra(*this, this->Offsets64 + first, this->Types + first, count)
    : trim::AreHexahedra(*this, this->Offsets32 + first, this->Types + first, count);
}

bool HexMesh::AreGood(Id begin, Id end) const
{
  for (Id c = begin; c < end; ++c)
  {
    if (FindCellDefect(*this, c) != CellDefect::None)
    {
      return false;
    }
  }
  return true;
}

bool ViewUnchecked(vtkUnstructuredGrid* grid, HexMesh& mesh)
{
  mesh = HexMesh{};
  std::string error;
  return TakePoints(grid, mesh, error) && TakeCells(grid, mesh, error) &&
    CheckAttributes(grid, mesh, error);
}

bool ViewGrid(vtkUnstructuredGrid* grid, HexMesh& mesh, std::string& error)
{
  mesh = HexMesh{};
  return TakePoints(grid, mesh, error) && CheckPoints(mesh, error) &&
    TakeCells(grid, mesh, error) && CheckCells(mesh, error) && CheckAttributes(grid, mesh, error);
}

}
