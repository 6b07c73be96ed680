#include "NURBSTessellation.h"

#include "LoopThinning.h"
#include "NURBSFieldData.h"
#include "SurfaceConstruction.h"
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
/// How far the lines of the surface turn between two parameters u, in radians: the most of a few
/// lines of constant v.
double TurnAlongU(const NurbsSurface& surface, double first, double last)
{
  const int steps = 8;
  double most = 0.0;
  for (double t : { 0.0, 0.5, 1.0 })
  {
    const double v = surface.FirstV() + t * (surface.LastV() - surface.FirstV());
    double turn = 0.0;
    Vec3 point = Evaluate(surface, first, v);
    Vec3 before = Vec3::Zero();
    for (int i = 1; i <= steps; ++i)
    {
      const Vec3 next = Evaluate(surface, first + (last - first) * i / steps, v);
      const Vec3 chord = next - point;
      turn += std::atan2(before.cross(chord).norm(), before.dot(chord));
      before = chord;
      point = next;
    }
    most = std::max(most, turn);
  }
  return most;
}

/**
 * Parameter values that divide the domain along u: every distinct knot, so that kinks lie on
 * polygon edges, and between knots evenly: at least `resolution` strips in all, and none that
 * turns by more than seven and a half degrees.
 */
std::vector<double> LinesAlongU(const NurbsSurface& surface, int resolution)
{
  const double longest = M_PI / 24.0;
  const int most = 64; // for one span, whatever it does
  const double size = surface.LastU() - surface.FirstU();
  std::vector<double> lines{ surface.FirstU() };
  for (int k = surface.DegreeU; k < surface.CountU; ++k)
  {
    const double first = surface.KnotsU[k];
    const double last = surface.KnotsU[k + 1];
    if (!(last - first > 1e-12 * size))
    {
      continue;
    }
    const double share = std::ceil(resolution * (last - first) / size - 1e-9);
    const double needed = std::ceil(TurnAlongU(surface, first, last) / longest);
    const int strips = static_cast<int>(std::max({ 1.0, share, std::min<double>(most, needed) }));
    for (int i = 1; i <= strips; ++i)
    {
      lines.push_back(i == strips ? last : first + (last - first) * i / strips);
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
  const std::vector<double> linesU = LinesAlongU(surface, resolution);
  const std::vector<double> linesV = LinesAlongU(Transpose(surface), resolution);

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
