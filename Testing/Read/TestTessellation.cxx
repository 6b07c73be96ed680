/**
 * Tessellations: points on the surface, normals along S_u x S_v, polygons that cover what lies
 * inside the trim loops and nothing else, without cracks.
 */
#include "NURBSFieldData.h"
#include "NURBSTessellation.h"
#include "ReadTesting.h"

#include "vtkCell.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>

using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec3;

namespace
{
const double Pi = 3.14159265358979323846;

/// A quarter of a cylinder of radius 2 about z, v along z from 0 to 3; normals outwards.
NurbsSurface QuarterCylinder()
{
  NurbsSurface surface;
  surface.DegreeU = 2;
  surface.DegreeV = 1;
  surface.CountU = 3;
  surface.CountV = 2;
  surface.KnotsU = { 0, 0, 0, 1, 1, 1 };
  surface.KnotsV = { 0, 0, 1, 1 };
  for (double z : { 0.0, 3.0 })
  {
    surface.ControlPoints.emplace_back(2, 0, z, 1);
    surface.ControlPoints.emplace_back(2, 2, z, std::sqrt(0.5));
    surface.ControlPoints.emplace_back(0, 2, z, 1);
  }
  return surface;
}

NurbsSurface Plane()
{
  NurbsSurface surface;
  surface.CountU = surface.CountV = 2;
  surface.KnotsU = surface.KnotsV = { 0, 0, 1, 1 };
  for (int k = 0; k < 4; ++k)
  {
    surface.ControlPoints.emplace_back(k % 2, k / 2, 0, 1);
  }
  return surface;
}

std::vector<Vec2> Circle(const Vec2& centre, double radius, int n)
{
  std::vector<Vec2> loop;
  for (int i = 0; i < n; ++i)
  {
    const double angle = 2.0 * Pi * i / n;
    loop.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return loop;
}

Vec3 PointOf(vtkPolyData* data, vtkIdType id)
{
  return Vec3(data->GetPoint(id));
}

/// Vector area of a polygon.
Vec3 VectorArea(vtkPolyData* data, vtkIdList* ids)
{
  Vec3 area = Vec3::Zero();
  const Vec3 origin = PointOf(data, ids->GetId(0));
  for (vtkIdType k = 1; k + 1 < ids->GetNumberOfIds(); ++k)
  {
    area += 0.5 *
      (PointOf(data, ids->GetId(k)) - origin).cross(PointOf(data, ids->GetId(k + 1)) - origin);
  }
  return area;
}

/// Checks points and normals; orientation, area and border of the polygons.
void CheckMesh(const std::string& name, const NurbsSurface& surface, int resolution, double area,
  double tolerance, double border)
{
  vtkNew<vtkPolyData> data;
  nurbs::TessellateNURBS(surface, resolution, data);
  vtkDataArray* normals = data->GetPointData()->GetNormals();
  vtkDataArray* textures = data->GetPointData()->GetTCoords();
  CHECK(normals && textures, name);
  double off = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double u =
      surface.FirstU() + textures->GetComponent(i, 0) * (surface.LastU() - surface.FirstU());
    const double v =
      surface.FirstV() + textures->GetComponent(i, 1) * (surface.LastV() - surface.FirstV());
    // Texture coordinates are single precision.
    off = std::max(off, (PointOf(data, i) - nurbs::Evaluate(surface, u, v)).norm());
    off = std::max(off, (Vec3(normals->GetTuple3(i)) - UnitNormal(surface, u, v)).norm());
  }
  CHECK(off < 1e-5, name << ": points or normals are off by " << off);

  double total = 0.0;
  int turned = 0;
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    vtkIdList* ids = data->GetCell(c)->GetPointIds();
    const Vec3 polygon = VectorArea(data, ids);
    total += polygon.norm();
    turned += polygon.dot(Vec3(normals->GetTuple3(ids->GetId(0)))) < -1e-12;
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      ++edges[{ ids->GetId(k), ids->GetId((k + 1) % ids->GetNumberOfIds()) }];
    }
  }
  CHECK(turned == 0, name << ": " << turned << " polygons are turned round");
  CHECK(std::abs(total - area) < tolerance * area, name << ": area " << total << ", not " << area);
  // Edges without a partner are the border: their length shows cracks.
  double length = 0.0;
  for (const auto& edge : edges)
  {
    CHECK(edge.second == 1, name << ": an edge is used twice in one direction");
    if (!edges.count({ edge.first.second, edge.first.first }))
    {
      length += (PointOf(data, edge.first.first) - PointOf(data, edge.first.second)).norm();
    }
  }
  CHECK(std::abs(length - border) < tolerance * border,
    name << ": border " << length << ", not " << border);
  NurbsSurface read;
  std::string error;
  CHECK(nurbs::ReadNURBSFieldData(data->GetFieldData(), read, error), name << ": " << error);
  CHECK(read.TrimLoops == surface.TrimLoops, name << ": the loops are not carried as they are");
}

void TestTrimmedPlane()
{
  NurbsSurface plane = Plane();
  CheckMesh("plane", plane, 8, 1.0, 1e-12, 4.0);
  const double round = 2.0 * Pi * 0.3;
  plane.TrimLoops = { Circle(Vec2(0.5, 0.5), 0.3, 500) };
  for (int resolution : { 1, 2, 7, 32, 100 })
  {
    CheckMesh("disc", plane, resolution, Pi * 0.09, 0.02, round);
  }
  plane.TrimLoops.push_back(Circle(Vec2(0.55, 0.45), 0.1, 300));
  CheckMesh("ring", plane, 16, Pi * 0.08, 0.002, round + 2.0 * Pi * 0.1);
  // An island in the hole, smaller than a cell.
  plane.TrimLoops.push_back(Circle(Vec2(0.55, 0.45), 0.001, 10));
  CheckMesh("island", plane, 16, Pi * 0.08, 0.002, round + 2.0 * Pi * 0.101);
}

/// Loops along the border and along the grid's own lines, and corners on them.
void TestCoincidences()
{
  NurbsSurface plane = Plane();
  plane.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1) },
    { Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.75, 0.75), Vec2(0.25, 0.75) } };
  for (int resolution : { 1, 4, 8, 16 })
  {
    CheckMesh("frame", plane, resolution, 0.75, 1e-9, 6.0);
  }
  plane.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 0.5), Vec2(0.5, 0.5), Vec2(0.5, 1),
    Vec2(0, 1) } };
  CheckMesh("corner", plane, 8, 0.75, 1e-9, 4.0);
  plane.TrimLoops = { { Vec2(0.5, 0), Vec2(1, 0.5), Vec2(0.5, 1), Vec2(0, 0.5) } };
  CheckMesh("diamond", plane, 8, 0.5, 1e-9, 4.0 * std::sqrt(0.5));
}

void TestCylinder()
{
  NurbsSurface cylinder = QuarterCylinder();
  CheckMesh("cylinder", cylinder, 64, 3.0 * Pi, 1e-3, 2.0 * 3.0 + 2.0 * Pi);
  cylinder.TrimLoops = { { Vec2(0, 0.25), Vec2(1, 0.25), Vec2(1, 0.75), Vec2(0, 0.75) } };
  CheckMesh("band", cylinder, 64, 1.5 * Pi, 1e-3, 3.0 + 2.0 * Pi);
}

/// A surface that shrinks to a point along one side has no normal there, but gets one.
void TestCollapsedEdge()
{
  NurbsSurface plane = Plane();
  plane.ControlPoints[2].head<2>() = Vec2(0.5, 1.0);
  plane.ControlPoints[3].head<2>() = Vec2(0.5, 1.0);
  vtkNew<vtkPolyData> data;
  nurbs::TessellateNURBS(plane, 8, data);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const double z = data->GetPointData()->GetNormals()->GetComponent(i, 2);
    CHECK(std::abs(z - 1.0) < 1e-6, "normal " << z);
  }
}

/// Random star-shaped loops with many corners at random resolutions.
void TestRandomLoops()
{
  unsigned int state = 12345;
  auto random = [&state]()
  {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 16777216.0;
  };
  for (int run = 0; run < 200; ++run)
  {
    NurbsSurface plane = Plane();
    std::vector<Vec2> loop;
    const int n = 3 + static_cast<int>(60 * random());
    double area = 0.0;
    double border = 0.0;
    for (int i = 0; i < n; ++i)
    {
      const double radius = 0.1 + 0.4 * random();
      const double angle = 2.0 * Pi * i / n;
      loop.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
    }
    for (int i = 0; i < n; ++i)
    {
      const Vec2& a = loop[i];
      const Vec2& b = loop[(i + 1) % n];
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
      border += (b - a).norm();
    }
    plane.TrimLoops = { loop };
    CheckMesh("star " + std::to_string(run), plane, 1 + static_cast<int>(40 * random()), area, 0.02,
      border);
  }
}
}

int main()
{
  TestTrimmedPlane();
  TestCoincidences();
  TestCylinder();
  TestCollapsedEdge();
  TestRandomLoops();
  return Failures != 0;
}
