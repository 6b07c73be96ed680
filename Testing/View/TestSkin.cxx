/**
 * @file TestSkin.cxx
 * @brief vtkHexahedralSkinFilter against ParaView's own geometry filter: the same facets, on the
 * same places, with the same arrays, which know their ranges.
 */
#include "Expect.h"
#include "Meshes.h"
#include "RunTrim.h"
#include "Surfaces.h"
#include "vtkHexahedralSkinFilter.h"

#include <Eigen/Geometry>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationInformationVectorKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace judge;

namespace
{
vtkSmartPointer<vtkPolyData> Extract(vtkPVGeometryFilter* filter, vtkUnstructuredGrid* grid)
{
  // As vtkGeometryRepresentation sets it.
  filter->SetUseOutline(0);
  filter->SetTriangulate(0);
  filter->SetNonlinearSubdivisionLevel(1);
  filter->SetPassThroughCellIds(1);
  filter->SetPassThroughPointIds(1);
  filter->SetInputDataObject(grid);
  filter->Update();
  vtkSmartPointer<vtkPolyData> copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(filter->GetOutputDataObject(0));
  return copy;
}

vtkIdTypeArray* Ids(vtkDataSetAttributes* attributes, const char* name)
{
  return vtkIdTypeArray::SafeDownCast(attributes->GetArray(name));
}

/// An element and its facet's nodes in ascending order.
using Facet = std::pair<vtkIdType, std::vector<vtkIdType>>;

std::map<Facet, vtkIdType> Facets(vtkPolyData* skin)
{
  std::map<Facet, vtkIdType> facets;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType i = 0; i < skin->GetNumberOfCells(); ++i)
  {
    skin->GetCellPoints(i, nodes);
    Facet facet{ Ids(skin->GetCellData(), "vtkOriginalCellIds")->GetValue(i), {} };
    for (const vtkIdType node : *nodes)
    {
      facet.second.push_back(Ids(skin->GetPointData(), "vtkOriginalPointIds")->GetValue(node));
    }
    std::sort(facet.second.begin(), facet.second.end());
    facets[facet] = i;
  }
  return facets;
}

/// Where each id of one lies in the other.
std::vector<vtkIdType> Match(vtkIdTypeArray* from, vtkIdTypeArray* to)
{
  std::map<vtkIdType, vtkIdType> places;
  for (vtkIdType i = 0; i < to->GetNumberOfValues(); ++i)
  {
    places[to->GetValue(i)] = i;
  }
  std::vector<vtkIdType> matches;
  for (vtkIdType i = 0; i < from->GetNumberOfValues(); ++i)
  {
    const auto place = places.find(from->GetValue(i));
    matches.push_back(place == places.end() ? -1 : place->second);
  }
  return matches;
}

bool SameTuples(vtkDataArray* a, vtkDataArray* b, const std::vector<vtkIdType>& matches)
{
  for (std::size_t i = 0; i < matches.size(); ++i)
  {
    for (int c = 0; c < a->GetNumberOfComponents(); ++c)
    {
      const double x = a->GetComponent(static_cast<vtkIdType>(i), c);
      const double y = b->GetComponent(matches[i], c);
      if (x != y && !(std::isnan(x) && std::isnan(y)))
      {
        return false;
      }
    }
  }
  return true;
}

/// What VTK finds in an array that forgot its ranges is what it was told.
void CheckRanges(vtkDataArray* array, const std::string& what)
{
  Expect(array->HasInformation() && array->GetInformation()->Has(vtkAbstractArray::PER_COMPONENT()),
    what + " does not know its ranges");
  auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  copy->DeepCopy(array);
  copy->Modified();
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    double told[2], found[2];
    array->GetRange(told, c);
    copy->GetRange(found, c);
    Expect(told[0] == found[0] && told[1] == found[1], what + " was told a wrong range");
  }
}

void CheckArrays(vtkDataSetAttributes* ours, vtkDataSetAttributes* theirs,
  const std::vector<vtkIdType>& matches, const std::string& what)
{
  for (int i = 0; i < theirs->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* expected = theirs->GetArray(i);
    if (!expected)
    {
      continue;
    }
    const std::string name = what + ", array " + expected->GetName();
    vtkDataArray* array = ours->GetArray(expected->GetName());
    Expect(array != nullptr, name + " is missing");
    if (array)
    {
      Expect(array->GetDataType() == expected->GetDataType() &&
          array->GetNumberOfComponents() == expected->GetNumberOfComponents(),
        name + " is of another kind");
      Expect(SameTuples(array, expected, matches), name + " has other values");
      CheckRanges(array, name);
    }
  }
}

bool IsAnywhere(vtkIdType match)
{
  return match >= 0;
}

void Check(vtkUnstructuredGrid* grid, const std::string& what)
{
  vtkNew<vtkHexahedralSkinFilter> filter;
  vtkNew<vtkPVGeometryFilter> reference;
  const auto ours = Extract(filter, grid);
  const auto theirs = Extract(reference, grid);
  const auto facets = Facets(ours);
  const auto expected = Facets(theirs);
  Expect(!expected.empty() && facets.size() == expected.size() &&
      static_cast<vtkIdType>(facets.size()) == ours->GetNumberOfCells() &&
      std::equal(facets.begin(), facets.end(), expected.begin(),
        [](const auto& a, const auto& b) { return a.first == b.first; }),
    what + ": other facets");
  const auto points = Match(Ids(ours->GetPointData(), "vtkOriginalPointIds"),
    Ids(theirs->GetPointData(), "vtkOriginalPointIds"));
  Expect(ours->GetNumberOfPoints() == theirs->GetNumberOfPoints() &&
      std::all_of(points.begin(), points.end(), IsAnywhere),
    what + ": other points");
  if (Wrong > 0)
  {
    return;
  }
  std::vector<vtkIdType> cells(facets.size());
  for (const auto& [facet, place] : facets)
  {
    cells[place] = expected.at(facet);
  }
  Expect(SameTuples(ours->GetPoints()->GetData(), theirs->GetPoints()->GetData(), points),
    what + ": points at other places");
  CheckRanges(ours->GetPoints()->GetData(), what + ": points");
  CheckArrays(ours->GetPointData(), theirs->GetPointData(), points, what);
  CheckArrays(ours->GetCellData(), theirs->GetCellData(), cells, what);
  Expect(ours->GetFieldData()->GetNumberOfArrays() == theirs->GetFieldData()->GetNumberOfArrays(),
    what + ": other field data");
}

/// Facets of hexahedra look outward: the whole is enclosed once.
void CheckOutward()
{
  const Mesh block = Block(3, 4, 5);
  vtkNew<vtkHexahedralSkinFilter> filter;
  const auto skin = Extract(filter, block.Grid);
  double volume = 0.0;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType i = 0; i < skin->GetNumberOfCells(); ++i)
  {
    skin->GetCellPoints(i, nodes);
    std::vector<Vec3> corner(nodes->GetNumberOfIds());
    for (std::size_t k = 0; k < corner.size(); ++k)
    {
      skin->GetPoint(nodes->GetId(static_cast<vtkIdType>(k)), corner[k].data());
      corner[k] -= block.Box.Centre;
    }
    for (std::size_t k = 2; k < corner.size(); ++k)
    {
      volume += corner[0].dot(corner[k - 1].cross(corner[k])) / 6.0;
    }
  }
  const double whole = 8.0 * block.Box.HalfX * block.Box.HalfY * block.Box.HalfZ;
  Expect(std::abs(volume - whole) < 1e-9 * whole, "the facets do not look outward");
}

/// What is not for this filter is left to ParaView's.
void CheckOthers()
{
  const Mesh block = Block(3, 3, 3);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(block.Grid->GetNumberOfCells());
  ghosts->FillValue(0);
  ghosts->SetValue(0, vtkDataSetAttributes::DUPLICATECELL);
  block.Grid->GetCellData()->AddArray(ghosts);
  vtkNew<vtkHexahedralSkinFilter> filter;
  vtkNew<vtkPVGeometryFilter> reference;
  Expect(
    Facets(Extract(filter, block.Grid)) == Facets(Extract(reference, block.Grid)), "ghost cells");
  vtkNew<vtkUnstructuredGrid> empty;
  Expect(Extract(filter, empty)->GetNumberOfCells() == 0, "an empty grid");
}
}

int main()
{
  for (const std::string& name : MeshNames())
  {
    const Mesh mesh = MakeMesh(name);
    Check(mesh.Grid, name);
    const Outcome outcome = RunTrim(mesh, MakeSurface("wavy", mesh.Box, Placement()), {});
    Check(outcome.Case.Trimmed, name + ", trimmed");
    Check(outcome.Case.Whole, name + ", statuses");
  }
  CheckOutward();
  CheckOthers();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
