#include "SheetSkin.h"

#include "AxisSense.h"
#include "ElementTopology.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkCompositeDataSetRange.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkMultiProcessController.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace nurbs
{
namespace
{
/// Area vectors that cancel each other but for this share belong to inner nodes.
constexpr double Cancelled = 1e-6;

struct NodeSums
{
  std::vector<Vec3> Points, Areas;
  std::vector<double> Sizes; ///< sums of the areas' sizes; zero: no element has the node
};

/// A fourth of a face's area vector: half the cross product of the diagonals makes the whole.
Vec3 FaceArea(const vtkIdType* ids, const trim::FaceNodes& face, const NodeSums& sums)
{
  const Vec3& a = sums.Points[ids[face.Node[0]]];
  const Vec3& b = sums.Points[ids[face.Node[1]]];
  const Vec3& c = sums.Points[ids[face.Node[2]]];
  const Vec3& d = face.Count == 3 ? a : sums.Points[ids[face.Node[3]]];
  return 0.125 * (c - a).cross(d - b);
}

void AddElement(const vtkIdType* ids, int corners, NodeSums& sums)
{
  const trim::ElementTopology& topology = trim::TopologyOf(corners);
  Vec3 centre = Vec3::Zero();
  for (int i = 0; i < corners; ++i)
  {
    centre += sums.Points[ids[i]] / corners;
  }
  // Wedges come in either order of their nodes: is the first face seen from outside?
  const trim::FaceNodes& first = topology.Faces[0];
  const Vec3 outwards = sums.Points[ids[first.Node[0]]] - centre;
  const double sign = FaceArea(ids, first, sums).dot(outwards) < 0.0 ? -1.0 : 1.0;
  for (int f = 0; f < topology.NumberOfFaces; ++f)
  {
    const trim::FaceNodes& face = topology.Faces[f];
    const Vec3 area = sign * FaceArea(ids, face, sums);
    const double size = area.norm();
    for (int i = 0; i < face.Count; ++i)
    {
      sums.Areas[ids[face.Node[i]]] += area;
      sums.Sizes[ids[face.Node[i]]] += size;
    }
  }
}

/// Cells of the grid before the first one that lacks a node; the number of all if none does.
vtkIdType AddElements(vtkUnstructuredGrid* grid, NodeSums& sums)
{
  vtkCellArray* cells = grid->GetCells();
  const unsigned char* types = grid->GetCellTypesArray()->GetPointer(0);
  const vtkIdType count =
    std::min(cells->GetNumberOfCells(), grid->GetCellTypesArray()->GetNumberOfValues());
  const auto numberOfPoints = static_cast<vtkIdType>(sums.Points.size());
  // Fewer flags than cells are none: the trim refuses such a grid.
  vtkUnsignedCharArray* ghosts = grid->GetCellGhostArray();
  const unsigned char* ghost =
    ghosts && ghosts->GetNumberOfValues() >= count ? ghosts->GetPointer(0) : nullptr;
  const auto add = [&](auto* offsets, auto* connectivity)
  {
    const auto at = vtk::DataArrayValueRange<1>(offsets);
    const auto nodes = vtk::DataArrayValueRange<1>(connectivity);
    vtkIdType ids[8];
    for (vtkIdType cell = 0; cell < count; ++cell)
    {
      const bool mine = !ghost || !(ghost[cell] & vtkDataSetAttributes::DUPLICATECELL);
      const int corners = !mine         ? 0
        : types[cell] == VTK_HEXAHEDRON ? 8
        : types[cell] == VTK_WEDGE      ? 6
                                        : 0;
      const auto first = static_cast<vtkIdType>(at[cell]);
      bool complete = first >= 0 && first <= static_cast<vtkIdType>(nodes.size()) - corners;
      for (int i = 0; i < corners && complete; ++i)
      {
        ids[i] = static_cast<vtkIdType>(nodes[first + i]);
        complete = ids[i] >= 0 && ids[i] < numberOfPoints;
      }
      if (!complete)
      {
        return cell;
      }
      if (corners > 0)
      {
        AddElement(ids, corners, sums);
      }
    }
    return count;
  };
  return cells->IsStorage64Bit() ? add(cells->GetOffsetsArray64(), cells->GetConnectivityArray64())
                                 : add(cells->GetOffsetsArray32(), cells->GetConnectivityArray32());
}

/// False with an error if the grid is corrupt.
bool AddGrid(vtkUnstructuredGrid* grid, SheetSkin& skin, std::string& error)
{
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    return true;
  }
  NodeSums sums;
  sums.Points.reserve(static_cast<size_t>(grid->GetNumberOfPoints()));
  if (grid->GetPoints())
  {
    for (const auto point : vtk::DataArrayTupleRange<3>(grid->GetPoints()->GetData()))
    {
      sums.Points.emplace_back(static_cast<double>(point[0]), static_cast<double>(point[1]),
        static_cast<double>(point[2]));
    }
  }
  sums.Areas.assign(sums.Points.size(), Vec3::Zero());
  sums.Sizes.assign(sums.Points.size(), 0.0);
  const vtkIdType added = AddElements(grid, sums);
  if (added < grid->GetNumberOfCells())
  {
    error = "Cell " + std::to_string(added) +
      " of the sheet uses a node that does not exist: the grid is corrupt, rewrite it";
    return false;
  }
  for (size_t i = 0; i < sums.Points.size(); ++i)
  {
    if (sums.Sizes[i] > 0.0 && sums.Points[i].allFinite())
    {
      skin.Box.extend(sums.Points[i]);
    }
    if (sums.Areas[i].norm() > Cancelled * sums.Sizes[i])
    {
      skin.Points.push_back(sums.Points[i]);
      skin.Areas.push_back(sums.Areas[i]);
    }
  }
  return true;
}
}

//------------------------------------------------------------------------------
void SheetSkin::Reduce(std::vector<double>& values, int operation) const
{
  if (this->Ranks && this->Ranks->GetNumberOfProcesses() > 1)
  {
    std::vector<double> reduced(values.size());
    this->Ranks->AllReduce(
      values.data(), reduced.data(), static_cast<vtkIdType>(values.size()), operation);
    values.swap(reduced);
  }
}

//------------------------------------------------------------------------------
bool SheetSkin::IsEmpty() const
{
  std::vector<double> count(1, static_cast<double>(this->Points.size()));
  this->Reduce(count, vtkCommunicator::SUM_OP);
  return count[0] == 0.0;
}

//------------------------------------------------------------------------------
bool SheetSkin::AllAgree(bool mine) const
{
  std::vector<double> agreed(1, mine ? 1.0 : 0.0);
  this->Reduce(agreed, vtkCommunicator::MIN_OP);
  return agreed[0] != 0.0;
}

//------------------------------------------------------------------------------
std::string SheetSkin::FirstText(const std::string& mine) const
{
  const int none = this->Ranks ? this->Ranks->GetNumberOfProcesses() : 1;
  if (none == 1)
  {
    return mine;
  }
  std::vector<double> teller(1, mine.empty() ? none : this->Ranks->GetLocalProcessId());
  this->Reduce(teller, vtkCommunicator::MIN_OP);
  const int rank = static_cast<int>(teller[0]);
  if (rank == none)
  {
    return {};
  }
  std::string text = rank > 0 ? mine + " (on rank " + std::to_string(rank) + ")" : mine;
  auto length = static_cast<vtkIdType>(text.size());
  this->Ranks->Broadcast(&length, 1, rank);
  text.resize(length);
  this->Ranks->Broadcast(text.data(), length, rank);
  return text;
}

//------------------------------------------------------------------------------
Eigen::AlignedBox3d SheetSkin::WholeBox() const
{
  std::vector<double> ends;
  for (int i = 0; i < 3; ++i)
  {
    ends.push_back(this->Box.min()[i]);
    ends.push_back(-this->Box.max()[i]);
  }
  this->Reduce(ends, vtkCommunicator::MIN_OP);
  return Eigen::AlignedBox3d(Vec3(ends[0], ends[2], ends[4]), Vec3(-ends[1], -ends[3], -ends[5]));
}

//------------------------------------------------------------------------------
void SheetSkin::DivideIntoBlocks()
{
  this->Blocks.assign((this->Points.size() + BlockSize - 1) / BlockSize, {});
  for (size_t i = 0; i < this->Points.size(); ++i)
  {
    this->Blocks[i / BlockSize].extend(this->Points[i]);
  }
}

//------------------------------------------------------------------------------
size_t SheetSkin::BlockEnd(size_t block) const
{
  return std::min(this->Points.size(), (block + 1) * BlockSize);
}

//------------------------------------------------------------------------------
double SheetSkin::NearestSquare(const Vec3& place) const
{
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t block = 0; block < this->Blocks.size(); ++block)
  {
    if (this->Blocks[block].squaredExteriorDistance(place) > nearest * (1.0 + 1e-9))
    {
      continue;
    }
    for (size_t i = block * BlockSize; i < this->BlockEnd(block); ++i)
    {
      nearest = std::min(nearest, (this->Points[i] - place).squaredNorm());
    }
  }
  return nearest;
}

//------------------------------------------------------------------------------
Vec3 SheetSkin::MeanNormal(const std::vector<Vec3>& places, double reach) const
{
  // The nearest nodes alone might be those of a rim, whose normals lie in the sheet.
  std::vector<double> limits; // squares of distances
  for (const Vec3& place : places)
  {
    limits.push_back(this->NearestSquare(place));
  }
  this->Reduce(limits, vtkCommunicator::MIN_OP);
  for (double& limit : limits)
  {
    limit = std::pow(std::sqrt(limit) + reach, 2);
  }
  std::vector<double> values(9, 0.0);
  Eigen::Map<Eigen::Matrix3d> sum(values.data());
  std::vector<size_t> near;
  for (size_t block = 0; block < this->Blocks.size(); ++block)
  {
    near.clear();
    for (size_t k = 0; k < places.size(); ++k)
    {
      // Rounding must not leave out a place.
      if (this->Blocks[block].squaredExteriorDistance(places[k]) <= limits[k] * (1.0 + 1e-9))
      {
        near.push_back(k);
      }
    }
    for (size_t i = block * BlockSize; i < this->BlockEnd(block); ++i)
    {
      const auto reaches = [&](size_t k)
      { return (this->Points[i] - places[k]).squaredNorm() <= limits[k]; };
      if (std::any_of(near.begin(), near.end(), reaches))
      {
        sum += this->Areas[i] * this->Areas[i].transpose() / this->Areas[i].norm();
      }
    }
  }
  this->Reduce(values, vtkCommunicator::SUM_OP);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
    Eigen::Map<Eigen::Matrix3d>(values.data()));
  return PositiveSense(solver.eigenvectors().col(2));
}

//------------------------------------------------------------------------------
bool BuildSheetSkin(vtkDataObject* data, SheetSkin& skin, std::string& error)
{
  skin = SheetSkin();
  bool complete = true;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    for (vtkDataObject* leaf : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
    {
      complete = complete && AddGrid(vtkUnstructuredGrid::SafeDownCast(leaf), skin, error);
    }
  }
  else
  {
    complete = AddGrid(vtkUnstructuredGrid::SafeDownCast(data), skin, error);
  }
  skin.DivideIntoBlocks();
  return complete;
}
}
