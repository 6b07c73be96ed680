/**
 * @file Parts.cxx
 * @brief Input grids that are no flat sheets: tubes, bars, balls, ribs.
 */
#include "Meshes.h"

#include "Plan.h"

#include <algorithm>
#include <cmath>

namespace judge
{
namespace
{
/// The last points become the first ones where a plan closes round.
void Close(RawMesh& raw, const std::vector<Id>& to)
{
  std::vector<Id> number(raw.Points.size(), -1);
  std::vector<Vec3> points;
  for (Element& element : raw.Elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      const Id node = to[element.Node[i]];
      if (number[node] < 0)
      {
        number[node] = static_cast<Id>(points.size());
        points.push_back(raw.Points[node]);
      }
      element.Node[i] = number[node];
    }
  }
  raw.Points = points;
}

Mesh Solid(const std::string& name, const RawMesh& raw, const MeshOptions& options)
{
  Mesh mesh = Finish(name, raw, BoxOf(raw, 1), options);
  mesh.Flat = mesh.Sheet = false;
  return mesh;
}

/// A plan in x and z, extruded along y.
RawMesh Beam(const Plan& plan, int n)
{
  return Extrude(plan, n, n, [](const Vec2& p, double z) { return Vec3(p[0], -z, p[1]); });
}
}

Mesh Tube(int round, int along, int nz, const MeshOptions& options)
{
  const double radius = round / (2 * M_PI);
  const Plan plan = GridPlan(along, round, 1, 1);
  RawMesh raw = Extrude(plan, nz, 0.4 * nz,
    [radius](const Vec2& p, double z)
    {
      const double a = p[1] / radius;
      return Vec3(p[0], (radius + z) * -std::sin(a), (radius + z) * std::cos(a));
    });
  for (Element& e : raw.Elements)
  {
    std::swap_ranges(e.Node.begin(), e.Node.begin() + 4, e.Node.begin() + 4);
  }
  std::vector<Id> to;
  const Id row = along + 1, layer = row * (round + 1);
  for (Id p = 0; p < static_cast<Id>(raw.Points.size()); ++p)
  {
    to.push_back(p % layer >= row * round ? p - row * round : p);
  }
  Close(raw, to);
  return Solid("tube", raw, options);
}

Mesh Bar(int n, int rings, int along, double turns, const MeshOptions& options)
{
  const RawMesh raw = Extrude(BlankPlan(n, rings), along, along,
    [=](const Vec2& p, double z)
    {
      const double a = 2 * M_PI * turns * z / along;
      return Vec3(
        std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], z);
    });
  return Solid("bar", raw, options);
}

Mesh Twist(int n, int along, double turns, const MeshOptions& options)
{
  const RawMesh raw = Extrude(GridPlan(n, n, 1, 1), along, along,
    [=](const Vec2& q, double z)
    {
      const Vec2 p = q - 0.5 * n * Vec2::Ones();
      const double a = 2 * M_PI * turns * z / along;
      return Vec3(
        std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], z);
    });
  return Solid("twist", raw, options);
}

Mesh Ball(int n, const MeshOptions& options)
{
  RawMesh raw = Extrude(GridPlan(n, n, 1, 1), n, n, Flat());
  for (Vec3& p : raw.Points)
  {
    const Vec3 q = 2.0 / n * (p - 0.5 * n * Vec3(1, 1, 0));
    const double a = q.cwiseAbs().maxCoeff();
    if (a > 0)
    {
      const Vec3 r(std::tan(q[0] / a * M_PI / 4), std::tan(q[1] / a * M_PI / 4),
        std::tan(q[2] / a * M_PI / 4));
      p = 0.5 * n * ((1 - a * a * 0.6) * q + a * a * 0.6 * 1.2 * a * r.normalized());
    }
    else
    {
      p = Vec3::Zero();
    }
  }
  return Solid("ball", raw, options);
}

Mesh Tee(int n, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(n, n, 1, 0.5);
  plan.Keep(
    [n, nz](const Vec2& c) { return c[1] < 0.5 * nz || std::abs(c[0] - 0.5 * n) < 0.5 * nz; });
  return Solid("tee", Beam(plan, n), options);
}

Mesh Angle(int n, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(n, n, 1, 1);
  plan.Keep([nz](const Vec2& c) { return c.minCoeff() < nz; });
  return Solid("angle", Beam(plan, n), options);
}

Mesh Tailored(int nx, int ny, int nz, const MeshOptions& options)
{
  const RawMesh raw = Extrude(GridPlan(nx, ny, 1, 1), nz, nz,
    [nx](const Vec2& p, double z)
    {
      const double x = p[0] / nx;
      return Vec3(p[0], p[1], z * (x < 0.4 ? 0.2 : x < 0.6 ? 0.2 + 1.5 * (x - 0.4) : 0.5));
    });
  return Solid("tailored", raw, options);
}

Mesh Wave(int nx, int ny, int nz, const MeshOptions& options)
{
  const RawMesh raw = Extrude(GridPlan(nx, ny, 1, 1), nz, 0.4 * nz,
    [](const Vec2& p, double z)
    { return Vec3(p[0], p[1], z + 1.2 * std::sin(0.6 * p[0]) * std::cos(0.35 * p[1])); });
  return Solid("wave", raw, options);
}

}
