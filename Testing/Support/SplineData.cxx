#include "SplineData.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>

namespace judge
{
namespace
{
template <typename Array>
void Add(vtkPolyData* data, const char* name, int components,
  const std::vector<typename Array::ValueType>& values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->GetFieldData()->AddArray(array);
}

void Tessellate(const SplineSurface& s, vtkPolyData* data)
{
  const int nu = 24, nv = 8;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> quads;
  for (int j = 0; j <= nv; ++j)
  {
    for (int i = 0; i <= nu; ++i)
    {
      const double u0 = s.KnotsU[s.DegreeU], u1 = s.KnotsU[s.CountU];
      const double v0 = s.KnotsV[s.DegreeV], v1 = s.KnotsV[s.CountV];
      const Vec3 p = EvaluateAt(s, u0 + (u1 - u0) * i / nu, v0 + (v1 - v0) * j / nv);
      points->InsertNextPoint(p.data());
      if (i < nu && j < nv)
      {
        const vtkIdType a = i + j * (nu + 1);
        const vtkIdType quad[4] = { a, a + 1, a + nu + 2, a + nu + 1 };
        quads->InsertNextCell(4, quad);
      }
    }
  }
  data->SetPoints(points);
  data->SetPolys(quads);
}
}

std::vector<double> UniformKnots(int count, int degree)
{
  std::vector<double> knots(count + degree + 1);
  for (int i = 0; i < static_cast<int>(knots.size()); ++i)
  {
    knots[i] = std::clamp((i - degree) / double(count - degree), 0.0, 1.0);
  }
  return knots;
}

std::vector<double> GrevilleAbscissae(const std::vector<double>& knots, int degree)
{
  std::vector<double> g(knots.size() - degree - 1);
  for (std::size_t i = 0; i < g.size(); ++i)
  {
    double sum = 0;
    for (int k = 1; k <= degree; ++k)
    {
      sum += knots[i + k];
    }
    g[i] = sum / degree;
  }
  return g;
}

std::vector<double> Basis(const std::vector<double>& knots, int degree, int count, double t)
{
  std::vector<double> n(count + degree, 0.0);
  // The span that holds t; the last one that is not empty for t at the end.
  int span = degree;
  while (span < count - 1 && t >= knots[span + 1])
  {
    ++span;
  }
  n[span] = 1;
  for (int k = 1; k <= degree; ++k)
  {
    for (int i = span - k; i <= span; ++i)
    {
      double value = 0;
      if (knots[i + k] > knots[i] && n[i] != 0)
      {
        value += (t - knots[i]) / (knots[i + k] - knots[i]) * n[i];
      }
      if (i + 1 <= span && knots[i + k + 1] > knots[i + 1])
      {
        value += (knots[i + k + 1] - t) / (knots[i + k + 1] - knots[i + 1]) * n[i + 1];
      }
      n[i] = value;
    }
  }
  n.resize(count);
  return n;
}

Vec3 EvaluateAt(const SplineSurface& s, double u, double v)
{
  const auto a = Basis(s.KnotsU, s.DegreeU, s.CountU, u);
  const auto b = Basis(s.KnotsV, s.DegreeV, s.CountV, v);
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (int j = 0; j < s.CountV; ++j)
  {
    for (int i = 0; i < s.CountU; ++i)
    {
      const Eigen::Vector4d& c = s.Control[i + j * s.CountU];
      sum += a[i] * b[j] * c[3] * c.head<3>();
      weight += a[i] * b[j] * c[3];
    }
  }
  return sum / weight;
}

SplineSurface Wall(const std::vector<Vec2>& line, const Vec3& origin)
{
  SplineSurface wall;
  wall.CountU = static_cast<int>(line.size());
  wall.CountV = 2;
  wall.KnotsU = UniformKnots(wall.CountU, 1);
  wall.KnotsV = UniformKnots(wall.CountV, 1);
  for (const double z : { -9.0, 9.0 })
  {
    for (const Vec2& p : line)
    {
      const Vec3 corner = origin + Vec3(p[0], p[1], z);
      wall.Control.emplace_back(corner[0], corner[1], corner[2], 1);
    }
  }
  return wall;
}

vtkSmartPointer<vtkPolyData> ToPolyData(const SplineSurface& s)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  Tessellate(s, data);
  Add<vtkIntArray>(data, "NURBSDegrees", 2, { s.DegreeU, s.DegreeV });
  Add<vtkIntArray>(data, "NURBSControlNetSize", 2, { s.CountU, s.CountV });
  std::vector<double> control;
  for (const auto& c : s.Control)
  {
    control.insert(control.end(), c.data(), c.data() + 4);
  }
  Add<vtkDoubleArray>(data, "NURBSControlPoints", 4, control);
  Add<vtkDoubleArray>(data, "NURBSKnotsU", 1, s.KnotsU);
  Add<vtkDoubleArray>(data, "NURBSKnotsV", 1, s.KnotsV);
  if (!s.Loops.empty())
  {
    std::vector<double> points;
    std::vector<int> offsets{ 0 };
    for (const auto& loop : s.Loops)
    {
      for (const Vec2& p : loop)
      {
        points.insert(points.end(), p.data(), p.data() + 2);
      }
      offsets.push_back(static_cast<int>(points.size() / 2));
    }
    Add<vtkDoubleArray>(data, "NURBSTrimLoops", 2, points);
    Add<vtkIntArray>(data, "NURBSTrimLoopOffsets", 1, offsets);
  }
  return data;
}

SplineSurface ReversedU(const SplineSurface& s)
{
  SplineSurface r = s;
  const double sum = s.KnotsU.front() + s.KnotsU.back();
  std::reverse(r.KnotsU.begin(), r.KnotsU.end());
  for (double& k : r.KnotsU)
  {
    k = sum - k;
  }
  for (int j = 0; j < s.CountV; ++j)
  {
    std::reverse(r.Control.begin() + j * s.CountU, r.Control.begin() + (j + 1) * s.CountU);
  }
  for (auto& loop : r.Loops)
  {
    for (Vec2& p : loop)
    {
      p[0] = sum - p[0];
    }
  }
  return r;
}

SplineSurface Transposed(const SplineSurface& s)
{
  SplineSurface r = s;
  std::swap(r.DegreeU, r.DegreeV);
  std::swap(r.CountU, r.CountV);
  std::swap(r.KnotsU, r.KnotsV);
  for (int j = 0; j < s.CountV; ++j)
  {
    for (int i = 0; i < s.CountU; ++i)
    {
      r.Control[j + i * r.CountU] = s.Control[i + j * s.CountU];
    }
  }
  for (auto& loop : r.Loops)
  {
    for (Vec2& p : loop)
    {
      std::swap(p[0], p[1]);
    }
  }
  return r;
}

}
