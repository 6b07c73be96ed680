/**
 * @file Parts.cxx
 * @brief Input grids that are no flat sheets: tubes, bars, balls, ribs.
 */
#include "Meshes.h"

#include "Plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <stdexcept>

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

Mesh Solid(const std::string& name, const RawMesh& raw)
{
  Mesh mesh = Finish(name, raw, BoxOf(raw, 1), MeshOptions());
  mesh.Flat = mesh.Sheet = false;
  return mesh;
}

/// A plan in x and z, extruded along y.
RawMesh Beam(const Plan& plan, int n)
{
  return Extrude(plan, n, n, [](const Vec2& p, double z) { return Vec3(p[0], -z, p[1]); });
}

/// A tube along x, closed round it, of nz layers.
Mesh Tube(int round, int along, int nz)
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
  return Solid("tube", raw);
}

/// A hollow square section along z, of walls of one element that meet without a radius.
Mesh Section(int n, int along, double length)
{
  RawMesh raw = Extrude(GridPlan(n, n, 1, 1), along, along * length, Flat());
  const auto isVoid = [&raw, n](const Element& element)
  {
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < element.Size; ++i)
    {
      middle += raw.Points[element.Node[i]] / element.Size;
    }
    return (middle.head<2>() - 0.5 * n * Vec2::Ones()).lpNorm<Eigen::Infinity>() < 0.5 * n - 1;
  };
  raw.Elements.erase(
    std::remove_if(raw.Elements.begin(), raw.Elements.end(), isVoid), raw.Elements.end());
  std::vector<Id> to(raw.Points.size());
  std::iota(to.begin(), to.end(), 0);
  Close(raw, to); // drops the points within
  Mesh mesh = Solid("section", raw);
  mesh.Flat = true;
  return mesh;
}

/// A round bar along z.
Mesh Bar(int n, int rings, int along)
{
  return Solid("bar", Extrude(BlankPlan(n, rings), along, along, Flat()));
}

/// A square bar along z, twisted.
Mesh Twist(int n, int along, double turns)
{
  const RawMesh raw = Extrude(GridPlan(n, n, 1, 1), along, along,
    [=](const Vec2& q, double z)
    {
      const Vec2 p = q - 0.5 * n * Vec2::Ones();
      const double a = 2 * M_PI * turns * z / along;
      return Vec3(
        std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], z);
    });
  return Solid("twist", raw);
}

/// A block blown up most of the way to a ball.
Mesh Ball(int n)
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
  return Solid("ball", raw);
}

/// A plate of nz layers with a rib on it.
Mesh Tee(int n, int nz)
{
  Plan plan = GridPlan(n, n, 1, 0.5);
  plan.Keep(
    [n, nz](const Vec2& c) { return c[1] < 0.5 * nz || std::abs(c[0] - 0.5 * n) < 0.5 * nz; });
  return Solid("tee", Beam(plan, n));
}

/// Two thick plates at a right angle.
Mesh Angle(int n, int nz)
{
  Plan plan = GridPlan(n, n, 1, 1);
  plan.Keep([nz](const Vec2& c) { return c.minCoeff() < nz; });
  return Solid("angle", Beam(plan, n));
}

/// A sheet of nz layers cut off along a zigzag of elements, as wide and as deep as these.
Mesh Zigzag(int nx, int ny, int nz)
{
  Plan plan = GridPlan(nx, ny, 1, 1);
  plan.Keep([nx](const Vec2& c) { return c.sum() < nx; });
  return Solid("zigzag", Extrude(plan, nz, 0.4 * nz, Flat()));
}

/// A block with a sharp ridge along x on its top that ends half way.
Mesh FadingRidge(int nx, int ny, int nz)
{
  const RawMesh raw = Extrude(GridPlan(nx, ny, 1, 1), nz, nz,
    [=](const Vec2& p, double z)
    {
      const bool isRaised = z > 0.49 * nz && 2 * p[0] <= nx && 2 * p[1] == ny;
      return Vec3(p[0], p[1], z + (isRaised ? 0.6 : 0.0));
    });
  return Solid("fading-ridge", raw);
}

/// A sheet of nz layers thicker at one end.
Mesh Tailored(int nx, int ny, int nz)
{
  const RawMesh raw = Extrude(GridPlan(nx, ny, 1, 1), nz, nz,
    [nx](const Vec2& p, double z)
    {
      const double x = p[0] / nx;
      return Vec3(p[0], p[1], z * (x < 0.4 ? 0.2 : x < 0.6 ? 0.2 + 1.5 * (x - 0.4) : 0.5));
    });
  return Solid("tailored", raw);
}

/// A sheet with hills and valleys, its columns upright.
Mesh Wave(int nx, int ny, int nz)
{
  const RawMesh raw = Extrude(GridPlan(nx, ny, 1, 1), nz, 0.4 * nz,
    [](const Vec2& p, double z)
    { return Vec3(p[0], p[1], z + 1.2 * std::sin(0.6 * p[0]) * std::cos(0.35 * p[1])); });
  return Solid("wave", raw);
}

Mesh Patched()
{
  Mesh mesh = PatchedSheet(20, 16, 2);
  mesh.Flat = false;
  return mesh;
}

}

Mesh BlocksJoinedAtEdges(int n)
{
  RawMesh raw = Extrude(GridPlan(2 * n, 2 * n, 1, 1), 2 * n, 2 * n,
    [n](const Vec2& p, double z) { return Vec3(p[0] - n, p[1] - n, z); });
  // Where two planes that bound blocks meet there is one node, elsewhere one for each block.
  std::map<std::pair<Id, int>, Id> nodes;
  std::vector<Vec3> points;
  for (Element& element : raw.Elements)
  {
    Vec3 centre = Vec3::Zero();
    for (int i = 0; i < element.Size; ++i)
    {
      centre += raw.Points[element.Node[i]] / element.Size;
    }
    const int block = (centre[0] > 0) + 2 * (centre[1] > 0) + 4 * (centre[2] > 0);
    for (int i = 0; i < element.Size; ++i)
    {
      const Vec3& p = raw.Points[element.Node[i]];
      const auto planes = (p.array() == 0 || p.array().abs() == n).count();
      const auto [node, isNew] = nodes.emplace(
        std::make_pair(element.Node[i], planes < 2 ? block : -1), static_cast<Id>(points.size()));
      if (isNew)
      {
        points.push_back(p);
      }
      element.Node[i] = node->second;
    }
  }
  raw.Points = points;
  return Solid("blocks joined at edges", raw);
}

namespace
{
struct Part
{
  const char* Name;
  Mesh (*Make)();
};

/// No part of the campaign, whose series would be others with them.
const Part OddParts[] = { { "zigzag", [] { return Zigzag(16, 12, 2); } },
  { "fading-ridge", [] { return FadingRidge(12, 8, 4); } },
  { "section", [] { return Section(12, 16, 2); } } };

const Part Parts[] = { { "tube", [] { return Tube(28, 16, 2); } },
  { "bar", [] { return Bar(4, 2, 14); } }, { "twist", [] { return Twist(5, 20, 0.25); } },
  { "ball", [] { return Ball(10); } }, { "tee", [] { return Tee(14, 2); } },
  { "angle", [] { return Angle(12, 3); } }, { "tailored", [] { return Tailored(20, 16, 2); } },
  { "wave", [] { return Wave(20, 16, 2); } }, { "patched", Patched } };
}

Mesh MakePart(const std::string& name)
{
  const Part* found = nullptr;
  const auto look = [&](const Part& part) { found = name == part.Name ? &part : found; };
  std::for_each(std::begin(Parts), std::end(Parts), look);
  std::for_each(std::begin(OddParts), std::end(OddParts), look);
  if (found)
  {
    return found->Make();
  }
  throw std::invalid_argument("no mesh called " + name);
}

std::vector<std::string> AllMeshNames()
{
  std::vector<std::string> names = MeshNames();
  for (const Part& part : Parts)
  {
    names.emplace_back(part.Name);
  }
  return names;
}

}
