#include "NURBSTessellation.h"

#include "NURBSFieldData.h"
#include "TrimmedParameterGrid.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
/**
 * Parameter values that divide the domain: every distinct knot, and between knots evenly, so
 * that there are at least `resolution` strips. Kinks of the surface thus lie on polygon edges.
 */
std::vector<double> ParameterLines(
  const std::vector<double>& knots, int degree, int count, int resolution)
{
  const double first = knots[degree];
  const double last = knots[count];
  std::vector<double> lines{ first };
  for (int k = degree; k < count; ++k)
  {
    const double width = knots[k + 1] - knots[k];
    if (!(width > 1e-12 * (last - first)))
    {
      continue;
    }
    // Two strips at least where the span may be curved.
    const int least = degree > 1 ? 2 : 1;
    const int share = static_cast<int>(std::ceil(resolution * width / (last - first) - 1e-9));
    const int strips = std::max(least, share);
    for (int i = 1; i <= strips; ++i)
    {
      lines.push_back(i == strips ? knots[k + 1] : knots[k] + width * i / strips);
    }
  }
  return lines;
}

/// Unit normal along S_u x S_v; where the surface is collapsed, that of a point close by.
Vec3 UnitNormal(const NurbsSurface& surface, double u, double v)
{
  const double middleU = 0.5 * (surface.FirstU() + surface.LastU());
  const double middleV = 0.5 * (surface.FirstV() + surface.LastV());
  for (double step : { 0.0, 1e-6, 1e-3 })
  {
    const SurfaceJet jet = EvaluateJet(surface, u + step * (middleU - u), v + step * (middleV - v));
    const Vec3 normal = jet.Su.cross(jet.Sv);
    if (normal.norm() > 1e-9 * jet.Su.norm() * jet.Sv.norm() && normal.norm() > 0.0)
    {
      return normal.normalized();
    }
  }
  return Vec3::Zero();
}

/// Points, normals and texture coordinates of the given parameters.
void FillPoints(
  const NurbsSurface& surface, const std::vector<Vec2>& parameters, vtkPolyData* output)
{
  const vtkIdType count = static_cast<vtkIdType>(parameters.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  vtkNew<vtkFloatArray> textures;
  textures->SetName("TCoords");
  textures->SetNumberOfComponents(2);
  textures->SetNumberOfTuples(count);

  const double sizeU = surface.LastU() - surface.FirstU();
  const double sizeV = surface.LastV() - surface.FirstV();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double u = std::clamp(parameters[i].x(), surface.FirstU(), surface.LastU());
    const double v = std::clamp(parameters[i].y(), surface.FirstV(), surface.LastV());
    points->SetPoint(i, Evaluate(surface, u, v).data());
    normals->SetTuple(i, UnitNormal(surface, u, v).data());
    textures->SetTuple2(i, (u - surface.FirstU()) / sizeU, (v - surface.FirstV()) / sizeV);
  }
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->SetTCoords(textures);
}
}

//------------------------------------------------------------------------------
void TessellateNURBS(const NurbsSurface& surface, int resolution, vtkPolyData* output)
{
  resolution = std::max(1, resolution);
  const std::vector<double> linesU =
    ParameterLines(surface.KnotsU, surface.DegreeU, surface.CountU, resolution);
  const std::vector<double> linesV =
    ParameterLines(surface.KnotsV, surface.DegreeV, surface.CountV, resolution);

  // A trim loop follows its curve to 1e-6 of the size; the eye needs less.
  const Vec2 strip((surface.LastU() - surface.FirstU()) / (linesU.size() - 1),
    (surface.LastV() - surface.FirstV()) / (linesV.size() - 1));
  const ParameterPolygons mesh = surface.TrimLoops.empty()
    ? DivideRectangle(linesU, linesV)
    : DivideTrimmedRectangle(linesU, linesV, ThinLoops(surface.TrimLoops, strip, 0.003));

  vtkNew<vtkCellArray> polygons;
  for (const std::vector<int>& polygon : mesh.Polygons)
  {
    polygons->InsertNextCell(static_cast<int>(polygon.size()));
    for (int id : polygon)
    {
      polygons->InsertCellPoint(id);
    }
  }

  output->Initialize();
  FillPoints(surface, mesh.Points, output);
  output->SetPolys(polygons);
  WriteNURBSFieldData(surface, output->GetFieldData());
}
}
