#include "ShownSurface.h"

#include "InputScale.h"
#include "PlaceText.h"

#include <vtkCompositeDataSet.h>
#include <vtkCompositeDataSetRange.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace trim
{
namespace
{

using nurbs::Vec3;

/// Of all polygons together; one more of each poly data.
constexpr vtkIdType Samples = 16;
/// How far polygons may lie beside the surface, in diagonals of its box, and still show it, where
/// their places are known as exactly.
constexpr double LargestShift = 1e-5;

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

struct Stray
{
  double Distance = 0.0;
  Vec3 Place = Vec3::Zero();
};

Stray FindFarthest(const std::vector<Vec3>& points, const nurbs::TrimmingSurface& surface)
{
  Stray farthest;
  for (const Vec3& point : points)
  {
    const double distance = surface.ClosestPoint(point).Distance;
    if (distance > farthest.Distance)
    {
      farthest = { distance, point };
    }
  }
  return farthest;
}

bool HasTrimLoops(const nurbs::TrimmingSurface& surface)
{
  for (int f = 0; f < surface.NumberOfFaces(); ++f)
  {
    if (!surface.Face(f).TrimLoops.empty())
    {
      return true;
    }
  }
  return false;
}

/// The whole faces: polygons may show more of them than the loops leave.
nurbs::TrimmingSurface WithoutTrimLoops(const nurbs::TrimmingSurface& surface)
{
  std::vector<nurbs::NurbsSurface> faces;
  for (int f = 0; f < surface.NumberOfFaces(); ++f)
  {
    faces.push_back(surface.Face(f));
    faces.back().TrimLoops.clear();
  }
  return nurbs::TrimmingSurface(std::move(faces), 0.0);
}

}

std::vector<Vec3> SamplePolygons(vtkDataObject* data)
{
  const auto polygons = PolygonsOf(data);
  vtkIdType all = 0;
  for (vtkPolyData* leaf : polygons)
  {
    all += leaf->GetNumberOfPoints();
  }
  std::vector<Vec3> points;
  for (vtkPolyData* leaf : polygons)
  {
    const vtkIdType own = leaf->GetNumberOfPoints();
    const vtkIdType samples = own > 0 ? 1 + Samples * own / all : 0;
    for (vtkIdType i = 0; i < samples; ++i)
    {
      points.emplace_back(leaf->GetPoint(i * own / samples));
    }
  }
  return points;
}

std::string FindShift(const std::vector<Vec3>& shown, const nurbs::TrimmingSurface& surface)
{
  const nurbs::Box3& box = surface.Bounds();
  const double allowed = std::max(LargestShift * box.diagonal().norm(),
    4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * LargestCoordinateOf(box));
  Stray stray = FindFarthest(shown, surface);
  if (stray.Distance > allowed && HasTrimLoops(surface))
  {
    stray = FindFarthest(shown, WithoutTrimLoops(surface));
  }
  if (!(stray.Distance > allowed))
  {
    return "";
  }
  std::ostringstream text;
  text
    << "The polygons of the trimming surface do not lie on it: one at "
    << nurbs::PlaceText(stray.Place) << " is " << stray.Distance
    << " away. Filters like Transform, Calculator and Append Geometry change the polygons alone, "
       "and the trim is along the surface as its source has made it: change it there, move the "
       "grid instead, or put several surfaces together by Group Datasets.";
  return text.str();
}

}
