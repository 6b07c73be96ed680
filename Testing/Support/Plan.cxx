#include "Plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace judge
{
void Plan::Keep(const std::function<bool(const Vec2&)>& condition)
{
  std::vector<std::vector<Id>> kept;
  std::map<Id, Id> renumbered;
  std::vector<Vec2> points;
  for (auto& face : this->Faces)
  {
    Vec2 centre = Vec2::Zero();
    for (Id id : face)
    {
      centre += this->Points[id] / face.size();
    }
    if (!condition(centre))
    {
      continue;
    }
    for (Id& id : face)
    {
      const auto entry = renumbered.emplace(id, points.size());
      if (entry.second)
      {
        points.push_back(this->Points[id]);
      }
      id = entry.first->second;
    }
    kept.push_back(face);
  }
  this->Faces = kept;
  this->Points = points;
}

void Plan::Perturb(double size, unsigned seed)
{
  std::map<std::pair<Id, Id>, int> uses;
  for (const auto& face : this->Faces)
  {
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      ++uses[std::minmax(face[i], face[(i + 1) % face.size()])];
    }
  }
  std::set<Id> border;
  for (const auto& use : uses)
  {
    if (use.second == 1)
    {
      border.insert({ use.first.first, use.first.second });
    }
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-size, size);
  for (Id i = 0; i < static_cast<Id>(this->Points.size()); ++i)
  {
    const double dx = any(random), dy = any(random);
    if (border.count(i) == 0)
    {
      this->Points[i] += Vec2(dx, dy);
    }
  }
}

void Plan::SplitSome(double share, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<std::vector<Id>> faces;
  for (const auto& f : this->Faces)
  {
    if (f.size() == 3 || any(random) > share)
    {
      faces.push_back(f);
      continue;
    }
    faces.push_back({ f[0], f[1], f[2] });
    faces.push_back({ f[0], f[2], f[3] });
  }
  this->Faces = faces;
}

void Plan::Merge(double tolerance)
{
  std::map<std::array<long long, 2>, Id> known;
  std::vector<Id> to(this->Points.size());
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    const Vec2 q = this->Points[i] / tolerance + Vec2(0.37, 0.41);
    const auto entry = known.emplace(
      std::array<long long, 2>{ std::llround(q[0]), std::llround(q[1]) }, points.size());
    if (entry.second)
    {
      points.push_back(this->Points[i]);
    }
    to[i] = entry.first->second;
  }
  this->Points = points;
  for (auto& face : this->Faces)
  {
    for (Id& id : face)
    {
      id = to[id];
    }
  }
}

double Plan::Radius() const
{
  double radius = 0;
  for (const Vec2& p : this->Points)
  {
    radius = std::max(radius, p.norm());
  }
  return radius;
}

Plan GridPlan(int nx, int ny, double dx, double dy)
{
  Plan plan;
  for (int j = 0; j <= ny; ++j)
  {
    for (int i = 0; i <= nx; ++i)
    {
      plan.Points.emplace_back(i * dx, j * dy);
      if (i < nx && j < ny)
      {
        const Id a = i + j * (nx + 1);
        plan.Faces.push_back({ a, a + 1, a + nx + 2, a + nx + 1 });
      }
    }
  }
  return plan;
}

Plan BlankPlan(int n, int rings)
{
  const double radius = 0.5 * n + rings;
  // A square blown up part of the way to a circle, so that corner elements keep an angle.
  const auto core = [n](double x, double y)
  {
    const double a = std::max(std::abs(x), std::abs(y));
    const Vec2 square = 0.42 * n * Vec2(x, y);
    if (a == 0)
    {
      return square;
    }
    const Vec2 round = Vec2(std::tan(x / a * M_PI / 4), std::tan(y / a * M_PI / 4)).normalized();
    return Vec2(0.6 * square + 0.4 * 0.5 * n * a * round);
  };
  Plan plan;
  const auto quad = [&plan](const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
  {
    const Id first = static_cast<Id>(plan.Points.size());
    plan.Points.insert(plan.Points.end(), { a, b, c, d });
    plan.Faces.push_back({ first, first + 1, first + 2, first + 3 });
  };
  const auto at = [n](int i) { return 2.0 * i / n - 1; };
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      quad(core(at(i), at(j)), core(at(i + 1), at(j)), core(at(i + 1), at(j + 1)),
        core(at(i), at(j + 1)));
    }
  }
  // Corner k of the core's border, counter-clockwise; ring r of `rings`.
  const auto ring = [&](int k, int r)
  {
    const int side = k / n % 4, i = k % n;
    const double t = at(i);
    const Vec2 p = side == 0 ? Vec2(t, -1)
      : side == 1            ? Vec2(1, t)
      : side == 2            ? Vec2(-t, 1)
                             : Vec2(-1, -t);
    const double angle = (k % (4 * n)) * M_PI / (2 * n) - 0.75 * M_PI;
    const double f = double(r) / rings;
    return Vec2((1 - f) * core(p[0], p[1]) + f * radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  for (int k = 0; k < 4 * n; ++k)
  {
    for (int r = 0; r < rings; ++r)
    {
      quad(ring(k, r), ring(k, r + 1), ring(k + 1, r + 1), ring(k + 1, r));
    }
  }
  plan.Merge(1e-6);
  return plan;
}

Plan TriangleQuadPlan(int n, unsigned seed)
{
  Plan triangles = GridPlan(n, n, 2, 2);
  triangles.Perturb(0.25, seed);
  triangles.SplitSome(1, seed);
  Plan plan;
  for (const auto& t : triangles.Faces)
  {
    const Vec2 a = triangles.Points[t[0]], b = triangles.Points[t[1]], c = triangles.Points[t[2]];
    const Vec2 centre = (a + b + c) / 3;
    const Vec2 p[3] = { a, b, c };
    for (int i = 0; i < 3; ++i)
    {
      const Vec2 next = (p[i] + p[(i + 1) % 3]) / 2, last = (p[i] + p[(i + 2) % 3]) / 2;
      const Id first = static_cast<Id>(plan.Points.size());
      plan.Points.insert(plan.Points.end(), { p[i], next, centre, last });
      plan.Faces.push_back({ first, first + 1, first + 2, first + 3 });
    }
  }
  plan.Merge(1e-6);
  return plan;
}

Fold Flat()
{
  return [](const Vec2& p, double z) { return Vec3(p[0], p[1], z); };
}

RawMesh Extrude(const Plan& plan, int nz, double thickness, const Fold& fold)
{
  RawMesh raw;
  const Id layer = static_cast<Id>(plan.Points.size());
  for (int k = 0; k <= nz; ++k)
  {
    for (const Vec2& p : plan.Points)
    {
      raw.Points.push_back(fold(p, thickness * (double(k) / nz - 0.5)));
    }
  }
  for (int k = 0; k < nz; ++k)
  {
    for (const auto& f : plan.Faces)
    {
      const Id a = k * layer, b = a + layer;
      if (f.size() == 3)
      {
        raw.Add(6, { f[0] + a, f[1] + a, f[2] + a, f[0] + b, f[1] + b, f[2] + b });
        continue;
      }
      raw.Add(
        8, { f[0] + a, f[1] + a, f[2] + a, f[3] + a, f[0] + b, f[1] + b, f[2] + b, f[3] + b });
    }
  }
  return raw;
}

double Walk::Length() const
{
  double length = 0;
  for (const Piece& piece : this->Pieces)
  {
    length += piece.Length;
  }
  return length;
}

Vec3 Walk::At(double s, double height) const
{
  double x = 0, z = 0, angle = 0;
  for (std::size_t i = 0; i < this->Pieces.size(); ++i)
  {
    const Piece& piece = this->Pieces[i];
    const bool last = i + 1 == this->Pieces.size();
    const double l = last ? s : std::min(s, piece.Length);
    if (piece.Curvature == 0)
    {
      x += l * std::cos(angle);
      z += l * std::sin(angle);
    }
    else
    {
      const double next = angle + piece.Curvature * l;
      x += (std::sin(next) - std::sin(angle)) / piece.Curvature;
      z += (std::cos(angle) - std::cos(next)) / piece.Curvature;
      angle = next;
    }
    s -= l;
    if (s <= 0)
    {
      break;
    }
  }
  return Vec3(x - height * std::sin(angle), 0, z + height * std::cos(angle));
}

}
