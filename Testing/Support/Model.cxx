#include "Model.h"

#include <Eigen/Geometry>

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>

namespace judge
{
namespace
{
// Shape functions and their derivatives, rows r, s, t of the derivative matrix.
void Shapes(int size, const Vec3& x, double n[8], double d[3][8])
{
  const double r = x[0], s = x[1], t = x[2];
  if (size == 6)
  {
    const double plane[3] = { 1 - r - s, r, s };
    const double planeR[3] = { -1, 1, 0 };
    const double planeS[3] = { -1, 0, 1 };
    for (int i = 0; i < 6; ++i)
    {
      const int k = i % 3;
      const double across = i < 3 ? 1 - t : t;
      n[i] = plane[k] * across;
      d[0][i] = planeR[k] * across;
      d[1][i] = planeS[k] * across;
      d[2][i] = i < 3 ? -plane[k] : plane[k];
    }
    return;
  }
  static const int at[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
    { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
  for (int i = 0; i < 8; ++i)
  {
    const double a = at[i][0] ? r : 1 - r, da = at[i][0] ? 1 : -1;
    const double b = at[i][1] ? s : 1 - s, db = at[i][1] ? 1 : -1;
    const double c = at[i][2] ? t : 1 - t, dc = at[i][2] ? 1 : -1;
    n[i] = a * b * c;
    d[0][i] = da * b * c;
    d[1][i] = a * db * c;
    d[2][i] = a * b * dc;
  }
}

// Values of a quadratic at 0, 1/2, 1 to its Bernstein coefficients.
void ToBernstein(double f0, double& f1, double f2)
{
  f1 = 2 * f1 - 0.5 * (f0 + f2);
}
}

Model::Model(vtkUnstructuredGrid* grid)
{
  const vtkIdType points = grid->GetNumberOfPoints();
  this->Points.resize(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    grid->GetPoint(i, this->Points[i].data());
  }
  vtkNew<vtkIdList> ids;
  const vtkIdType cells = grid->GetNumberOfCells();
  this->Elements.resize(cells);
  for (vtkIdType c = 0; c < cells; ++c)
  {
    grid->GetCellPoints(c, ids);
    const int type = grid->GetCellType(c);
    Element& element = this->Elements[c];
    element.Size = static_cast<int>(ids->GetNumberOfIds());
    const bool known =
      (type == VTK_HEXAHEDRON && element.Size == 8) || (type == VTK_WEDGE && element.Size == 6);
    if (!known)
    {
      this->BadCell = this->BadCell < 0 ? c : this->BadCell;
      element.Size = 0;
      continue;
    }
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] = ids->GetId(i);
    }
  }
}

double Model::Diagonal() const
{
  if (this->Points.empty())
  {
    return 0;
  }
  Vec3 low = this->Points[0], high = this->Points[0];
  for (const Vec3& p : this->Points)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

std::array<Vec3, 8> Model::Corners(Id e) const
{
  std::array<Vec3, 8> corners;
  corners.fill(Vec3::Zero());
  const Element& element = this->Elements[e];
  for (int i = 0; i < element.Size; ++i)
  {
    corners[i] = this->Points[element.Node[i]];
  }
  return corners;
}

std::vector<Facet> FacetsOf(const Element& element, Id owner)
{
  static const int hex[6][4] = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 }, { 3, 7, 6, 2 },
    { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  static const int wedge[5][4] = { { 0, 2, 1, -1 }, { 3, 4, 5, -1 }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 },
    { 2, 0, 3, 5 } };
  std::vector<Facet> facets;
  const int count = element.Size == 8 ? 6 : element.Size == 6 ? 5 : 0;
  for (int f = 0; f < count; ++f)
  {
    Facet facet;
    facet.Owner = owner;
    for (int i = 0; i < 4; ++i)
    {
      const int local = element.Size == 8 ? hex[f][i] : wedge[f][i];
      facet.Node[i] = local < 0 ? -1 : element.Node[local];
    }
    facets.push_back(facet);
  }
  return facets;
}

std::array<Id, 4> FacetKey(const Facet& facet)
{
  std::array<Id, 4> key = facet.Node;
  std::sort(key.begin(), key.end());
  return key;
}

Vec3 PositionAt(const std::array<Vec3, 8>& corners, int size, const Vec3& natural)
{
  double n[8], d[3][8];
  Shapes(size, natural, n, d);
  Vec3 p = Vec3::Zero();
  for (int i = 0; i < size; ++i)
  {
    p += n[i] * corners[i];
  }
  return p;
}

double JacobianAt(const std::array<Vec3, 8>& corners, int size, const Vec3& natural)
{
  double n[8], d[3][8];
  Shapes(size, natural, n, d);
  Vec3 column[3] = { Vec3::Zero(), Vec3::Zero(), Vec3::Zero() };
  for (int i = 0; i < size; ++i)
  {
    // Relative to the first corner: far from the origin the digits are needed.
    const Vec3 p = corners[i] - corners[0];
    for (int k = 0; k < 3; ++k)
    {
      column[k] += d[k][i] * p;
    }
  }
  return column[0].dot(column[1].cross(column[2]));
}

std::vector<double> IntegrationPointJacobians(const std::array<Vec3, 8>& corners, int size)
{
  const double low = 0.5 - 0.5 / std::sqrt(3.0), high = 1 - low;
  std::vector<double> values;
  for (double t : { low, high })
  {
    if (size == 6)
    {
      const double a = 1.0 / 6, b = 2.0 / 3;
      values.push_back(JacobianAt(corners, size, Vec3(a, a, t)));
      values.push_back(JacobianAt(corners, size, Vec3(b, a, t)));
      values.push_back(JacobianAt(corners, size, Vec3(a, b, t)));
      continue;
    }
    for (double s : { low, high })
    {
      for (double r : { low, high })
      {
        values.push_back(JacobianAt(corners, size, Vec3(r, s, t)));
      }
    }
  }
  return values;
}

double VolumeOf(const std::array<Vec3, 8>& corners, int size)
{
  double sum = 0;
  for (double value : IntegrationPointJacobians(corners, size))
  {
    sum += value;
  }
  return size == 8 ? sum / 8 : size == 6 ? sum / 12 : 0;
}

double VolumeOf(const Model& model)
{
  double volume = 0;
  for (Id e = 0; e < static_cast<Id>(model.Elements.size()); ++e)
  {
    volume += VolumeOf(model.Corners(e), model.Elements[e].Size);
  }
  return volume;
}

std::vector<double> BezierJacobians(const std::array<Vec3, 8>& corners, int size)
{
  std::vector<double> c;
  if (size == 6)
  {
    for (const Vec2& node : { Vec2(0, 0), Vec2(1, 0), Vec2(0, 1) })
    {
      double f[3];
      for (int k = 0; k < 3; ++k)
      {
        f[k] = JacobianAt(corners, size, Vec3(node[0], node[1], 0.5 * k));
      }
      ToBernstein(f[0], f[1], f[2]);
      c.insert(c.end(), f, f + 3);
    }
    return c;
  }
  c.resize(27);
  for (int i = 0; i < 27; ++i)
  {
    c[i] = JacobianAt(corners, size, 0.5 * Vec3(i % 3, (i / 3) % 3, i / 9));
  }
  for (int i = 0; i < 9; ++i)
  {
    ToBernstein(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
  }
  for (int i = 0; i < 9; ++i)
  {
    const int first = (i / 3) * 9 + i % 3;
    ToBernstein(c[first], c[first + 3], c[first + 6]);
  }
  for (int i = 0; i < 9; ++i)
  {
    ToBernstein(c[i], c[i + 9], c[i + 18]);
  }
  return c;
}

}
