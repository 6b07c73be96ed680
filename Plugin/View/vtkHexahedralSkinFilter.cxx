#include "vtkHexahedralSkinFilter.h"

#include "ArrayNames.h"
#include "ArrayRanges.h"
#include "ElementTopology.h"
#include "GatherAttributes.h"
#include "Skin.h"
#include "ThreadScope.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHexahedralSkinFilter);

namespace
{
using trim::Id;

/// Can the grid be taken here?
bool TakeGrid(vtkDataObject* input, trim::HexMesh& mesh)
{
  auto* grid = vtkUnstructuredGrid::SafeDownCast(input);
  std::string error;
  return grid && grid->GetNumberOfCells() > 0 &&
    grid->GetNumberOfPoints() <= std::numeric_limits<int>::max() &&
    !grid->GetCellData()->GetGhostArray() && !grid->GetPointData()->GetGhostArray() &&
    trim::ViewGrid(grid, mesh, error);
}

/// The nodes of the facets, as a point of the output each; ids are those of the input.
struct SkinPoints
{
  std::vector<Id> Ids;
  std::vector<int> NumberOf; ///< of a point of the input, -1: none

  SkinPoints(const trim::HexMesh& mesh, const std::vector<trim::SkinFacet>& skin)
    : NumberOf(mesh.NumberOfPoints, -1)
  {
    std::array<Id, 8> nodes = {};
    for (const trim::SkinFacet& facet : skin)
    {
      const auto& face = trim::TopologyOf(mesh.Cell(facet.Cell, nodes)).Faces[facet.Face];
      for (int i = 0; i < face.Count; ++i)
      {
        this->NumberOf[nodes[face.Node[i]]] = 0;
      }
    }
    for (Id i = 0; i < mesh.NumberOfPoints; ++i)
    {
      if (this->NumberOf[i] == 0)
      {
        this->NumberOf[i] = static_cast<int>(this->Ids.size());
        this->Ids.push_back(i);
      }
    }
  }
};

template <typename Array>
vtkSmartPointer<vtkPoints> GatherPoints(
  const typename Array::ValueType* from, const std::vector<Id>& ids)
{
  vtkNew<Array> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  auto* to = places->GetPointer(0);
  for (const Id id : ids)
  {
    to = std::copy_n(from + 3 * id, 3, to);
  }
  return trim::MakePoints(places);
}

/// So many have all their nodes counted by 32 bits.
constexpr std::size_t MostFacets = std::numeric_limits<vtkTypeInt32>::max() / 4;

vtkSmartPointer<vtkCellArray> MakePolygons(const trim::HexMesh& mesh,
  const std::vector<trim::SkinFacet>& skin, const std::vector<int>& numberOf)
{
  vtkNew<vtkCellArray::ArrayType32> offsets;
  vtkNew<vtkCellArray::ArrayType32> connectivity;
  offsets->SetNumberOfValues(static_cast<vtkIdType>(skin.size()) + 1);
  connectivity->SetNumberOfValues(4 * static_cast<vtkIdType>(skin.size()));
  auto* const first = connectivity->GetPointer(0);
  auto* offset = offsets->GetPointer(0);
  auto* node = first;
  *offset++ = 0;
  std::array<Id, 8> nodes = {};
  for (const trim::SkinFacet& facet : skin)
  {
    const auto& face = trim::TopologyOf(mesh.Cell(facet.Cell, nodes)).Faces[facet.Face];
    for (int i = 0; i < face.Count; ++i)
    {
      *node++ = numberOf[nodes[face.Node[i]]];
    }
    *offset++ = static_cast<vtkTypeInt32>(node - first);
  }
  connectivity->SetNumberOfValues(node - first);
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  polygons->SetData(offsets, connectivity);
  return polygons;
}

double FindLongestEdge(const trim::HexMesh& mesh, const std::vector<trim::SkinFacet>& skin)
{
  double square = 0.0;
  std::array<Id, 8> nodes = {};
  for (const trim::SkinFacet& facet : skin)
  {
    const auto& face = trim::TopologyOf(mesh.Cell(facet.Cell, nodes)).Faces[facet.Face];
    trim::Vec3 last = mesh.Point(nodes[face.Node[face.Count - 1]]);
    for (int i = 0; i < face.Count; ++i)
    {
      const trim::Vec3 next = mesh.Point(nodes[face.Node[i]]);
      square = std::max(square, (next - last).squaredNorm());
      last = next;
    }
  }
  return std::sqrt(square);
}

void AddIds(const char* name, const std::vector<Id>& ids, vtkDataSetAttributes* attributes)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), array->GetPointer(0));
  attributes->AddArray(array);
}

void MakeSkin(vtkUnstructuredGrid* grid, const trim::HexMesh& mesh,
  const std::vector<trim::SkinFacet>& skin, vtkPolyData* output)
{
  const SkinPoints points(mesh, skin);
  output->SetPoints(mesh.PointsDouble ? GatherPoints<vtkDoubleArray>(mesh.PointsDouble, points.Ids)
                                      : GatherPoints<vtkFloatArray>(mesh.PointsFloat, points.Ids));
  output->SetPolys(MakePolygons(mesh, skin, points.NumberOf));
  std::vector<Id> cells;
  cells.reserve(skin.size());
  for (const trim::SkinFacet& facet : skin)
  {
    cells.push_back(facet.Cell);
  }
  trim::GatherAttributes(grid->GetPointData(), points.Ids.data(),
    static_cast<vtkIdType>(points.Ids.size()), output->GetPointData());
  trim::GatherAttributes(
    grid->GetCellData(), cells.data(), static_cast<vtkIdType>(cells.size()), output->GetCellData());
  // In place of those of the input, which are ids in what the trim began with.
  AddIds(trim::names::OriginalPoints, points.Ids, output->GetPointData());
  AddIds(trim::names::OriginalCells, cells, output->GetCellData());
}
}

//------------------------------------------------------------------------------
int vtkHexahedralSkinFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0], 0);
  trim::HexMesh mesh;
  this->LongestEdge = 0.0;
  if (this->UseOutline || this->Triangulate || this->GenerateFeatureEdges || !TakeGrid(input, mesh))
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  auto* ranks = vtkMultiProcessController::GetGlobalController();
  std::vector<trim::SkinFacet> skin;
  trim::WithThreads(
    !ranks || ranks->GetNumberOfProcesses() == 1, [&]() { skin = trim::FindSkin(mesh); });
  if (skin.size() > MostFacets)
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  vtkPolyData* output = vtkPolyData::GetData(outputVector, 0);
  output->GetFieldData()->PassData(input->GetFieldData());
  this->OutlineFlag = 0;
  MakeSkin(vtkUnstructuredGrid::SafeDownCast(input), mesh, skin, output);
  this->LongestEdge = FindLongestEdge(mesh, skin);
  this->CleanupOutputData(output, 1);
  trim::TellRanges(output);
  return 1;
}

//------------------------------------------------------------------------------
void vtkHexahedralSkinFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LongestEdge: " << this->LongestEdge << endl;
}
