#include "ShownSurface.h"

#include "PlaceText.h"

#include <vtkCompositeDataSet.h>
#include <vtkCompositeDataSetRange.h>
#include <vtkPolyData.h>

#include <sstream>

namespace trim
{
namespace
{

using nurbs::Vec3;

constexpr vtkIdType Samples = 16;
/// How far polygons may lie beside the surface, in diagonals of its box, and still show it.
constexpr double LargestShift = 0.01;

std::vector<vtkPolyData*> PolygonsOf(vtkDataObject* data)
{
  std::vector<vtkPolyData*> list;
  const auto add = [&list](vtkDataObject* leaf)
  {
    auto* polygons = vtkPolyData::SafeDownCast(leaf);
    if (polygons && polygons->GetNumberOfPolys() + polygons->GetNumberOfStrips() > 0)
    {
      list.push_back(polygons);
    }
  };
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    add(data);
    return list;
  }
  for (vtkDataObject* leaf : vtk::Range(composite, vtk::CompositeDataSetOptions::SkipEmptyNodes))
  {
    add(leaf);
  }
  return list;
}

}

std::vector<Vec3> SamplePolygons(vtkDataObject* data)
{
  const auto polygons = PolygonsOf(data);
  vtkIdType count = 0;
  for (vtkPolyData* leaf : polygons)
  {
    count += leaf->GetNumberOfPoints();
  }
  std::vector<Vec3> points;
  vtkIdType before = 0; // points of the leaves before
  for (vtkPolyData* leaf : polygons)
  {
    const vtkIdType end = before + leaf->GetNumberOfPoints();
    for (auto next = static_cast<vtkIdType>(points.size());
         next < Samples && (next * count) / Samples < end; ++next)
    {
      points.emplace_back(leaf->GetPoint((next * count) / Samples - before));
    }
    before = end;
  }
  return points;
}

std::string FindShift(const std::vector<Vec3>& shown, const nurbs::TrimmingSurface& surface)
{
  double farthest = 0.0;
  Vec3 place = Vec3::Zero();
  for (const Vec3& point : shown)
  {
    const double distance = surface.ClosestPoint(point).Distance;
    if (distance > farthest)
    {
      farthest = distance;
      place = point;
    }
  }
  if (!(farthest > LargestShift * surface.Bounds().diagonal().norm()))
  {
    return "";
  }
  std::ostringstream text;
  text
    << "The polygons of the trimming surface do not lie on it: one at " << nurbs::PlaceText(place)
    << " is " << farthest
    << " away. Filters like Transform, Calculator and Append Geometry change the polygons alone, "
       "and the trim is along the surface as its source has made it: change it there, move the "
       "grid instead, or put several surfaces together by Group Datasets.";
  return text.str();
}

}
