#include "SampleSurfaces.h"

#include <algorithm>
#include <cmath>

namespace samples
{

std::vector<double> UniformKnots(int degree, int count)
{
  std::vector<double> knots;
  for (int i = 0; i < count + degree + 1; ++i)
  {
    const int k = std::clamp(i - degree, 0, count - degree);
    knots.push_back(static_cast<double>(k) / (count - degree));
  }
  return knots;
}

NurbsSurface FromNet(
  int p, int q, int countU, int countV, const std::function<Vec4(double u, double v)>& point)
{
  NurbsSurface surface;
  surface.DegreeU = p;
  surface.DegreeV = q;
  surface.CountU = countU;
  surface.CountV = countV;
  surface.KnotsU = UniformKnots(p, countU);
  surface.KnotsV = UniformKnots(q, countV);
  for (int j = 0; j < countV; ++j)
  {
    for (int i = 0; i < countU; ++i)
    {
      surface.ControlPoints.push_back(
        point(static_cast<double>(i) / (countU - 1), static_cast<double>(j) / (countV - 1)));
    }
  }
  return surface;
}

NurbsSurface Wavy(int count, double height)
{
  return FromNet(3, 3, count, count,
    [=](double u, double v)
    { return Vec4(u, v, height * std::sin(6 * u + 1) * std::cos(5 * v), 1); });
}

NurbsSurface Plane(const Vec3& origin, const Vec3& u, const Vec3& v)
{
  return FromNet(1, 1, 2, 2,
    [&](double a, double b)
    {
      Vec4 x;
      x << origin + a * u + b * v, 1;
      return x;
    });
}

NurbsSurface Bilinear()
{
  return FromNet(
    1, 1, 2, 2, [](double u, double v) { return Vec4(u, v + 0.2 * u, u == v ? 0.5 : -0.3, 1); });
}

NurbsSurface Revolve(int degree, const std::vector<double>& knots,
  const std::vector<Eigen::Vector3d>& profile, int quarters)
{
  NurbsSurface surface;
  surface.DegreeU = 2;
  surface.DegreeV = degree;
  surface.CountU = 2 * quarters + 1;
  surface.CountV = static_cast<int>(profile.size());
  surface.KnotsV = knots;
  surface.KnotsU.assign(3, 0.0);
  for (int k = 1; k <= quarters; ++k)
  {
    surface.KnotsU.insert(surface.KnotsU.end(), k < quarters ? 2 : 3, double(k));
  }
  const double corner = std::sqrt(0.5);
  for (const auto& x : profile)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      const double angle = i * M_PI / 4, stretch = i % 2 ? 1 / corner : 1.0;
      surface.ControlPoints.push_back(Vec4(x[0] * stretch * std::cos(angle),
        x[0] * stretch * std::sin(angle), x[1], x[2] * (i % 2 ? corner : 1.0)));
    }
  }
  // A full turn ends exactly where it began.
  if (quarters == 4)
  {
    for (int j = 0; j < surface.CountV; ++j)
    {
      surface.ControlPoints[j * surface.CountU + 8] = surface.ControlPoints[j * surface.CountU];
    }
  }
  return surface;
}

NurbsSurface Cylinder(double radius, double height, int quarters)
{
  return Revolve(1, { 0, 0, 1, 1 }, { { radius, 0, 1 }, { radius, height, 1 } }, quarters);
}

NurbsSurface Sphere(double r)
{
  const double w = std::sqrt(0.5);
  return Revolve(2, { 0, 0, 0, 1, 1, 2, 2, 2 },
    { { 0, -r, 1 }, { r, -r, w }, { r, 0, 1 }, { r, r, w }, { 0, r, 1 } });
}

NurbsSurface Torus(double major, double minor)
{
  const double w = std::sqrt(0.5), a = major, b = minor;
  return Revolve(2, { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 },
    { { a + b, 0, 1 }, { a + b, b, w }, { a, b, 1 }, { a - b, b, w }, { a - b, 0, 1 },
      { a - b, -b, w }, { a, -b, 1 }, { a + b, -b, w }, { a + b, 0, 1 } });
}

NurbsSurface Cone(double radius, double height)
{
  return Revolve(1, { 0, 0, 1, 1 }, { { radius, 0, 1 }, { 0, height, 1 } });
}

NurbsSurface HighDegree(int p, int q)
{
  return FromNet(p, q, p + 3, q + 2,
    [](double u, double v)
    {
      return Vec4(u + 0.05 * std::sin(9 * v), v + 0.05 * std::cos(8 * u),
        0.4 * std::sin(5 * u) * std::cos(4 * v), 1 + 0.5 * std::sin(3 * u + 2 * v));
    });
}

NurbsSurface Creased()
{
  NurbsSurface surface = FromNet(3, 2, 10, 8,
    [](double u, double v)
    { return Vec4(u, v, 0.3 * std::abs(std::fmod(3 * u, 1.0) - 0.5) + 0.2 * std::sin(7 * v), 1); });
  surface.KnotsU = { 0, 0, 0, 0, 0.3, 0.3, 0.3, 0.7, 0.7, 0.7, 1, 1, 1, 1 };
  surface.KnotsV = { 0, 0, 0, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1 };
  return surface;
}

NurbsSurface Weighted()
{
  int k = 0;
  return FromNet(3, 3, 7, 6,
    [&k](double u, double v)
    {
      const double w = std::pow(10.0, 2 * std::sin(12.9898 * ++k));
      return Vec4(u, v, 0.25 * std::sin(6 * u) * std::sin(5 * v), w);
    });
}

NurbsSurface Unclamped()
{
  NurbsSurface surface = FromNet(3, 2, 8, 7,
    [](double u, double v) { return Vec4(u, v, 0.3 * std::sin(6 * u + 3 * v), 1 + 0.5 * u * v); });
  for (std::size_t i = 0; i < surface.KnotsU.size(); ++i)
  {
    surface.KnotsU[i] = i + 0.2 * std::sin(3.0 * i);
  }
  for (std::size_t i = 0; i < surface.KnotsV.size(); ++i)
  {
    surface.KnotsV[i] = 0.5 * i;
  }
  return surface;
}

NurbsSurface Curled()
{
  return FromNet(3, 3, 12, 4,
    [](double u, double v)
    { return Vec4(0.5 * std::sin(4 * M_PI * u) + 0.1 * u, u + 0.1 * v, v, 1); });
}

NurbsSurface Slit()
{
  // A hairpin: up, round a tight bend, and down again 0.02 beside.
  const double x[9] = { 0, 0, 0, 0, 0.01, 0.02, 0.02, 0.02, 0.02 };
  const double z[9] = { 0, 0.4, 0.8, 1.0, 1.02, 1.0, 0.8, 0.4, 0 };
  return FromNet(3, 2, 9, 3,
    [&](double u, double v)
    {
      const int i = static_cast<int>(std::lround(u * 8));
      return Vec4(x[i], v, z[i], 1);
    });
}

NurbsSurface Linear()
{
  return FromNet(1, 1, 5, 4,
    [](double u, double v)
    { return Vec4(u + 0.1 * std::sin(20 * v), v, 0.3 * std::sin(40 * u + 30 * v), 1); });
}

NurbsSurface Jump()
{
  NurbsSurface surface = FromNet(2, 2, 6, 4,
    [](double u, double v)
    { return Vec4(u, v, (u > 0.5 ? 0.5 : 0.0) + 0.2 * std::sin(6 * u + 2 * v), 1); });
  surface.KnotsU = { 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1 };
  return surface;
}

/// A long tube whose axis leans against its circles.
NurbsSurface LeaningTube()
{
  constexpr double turn = 6.283185307179586, height = 40;
  return FromNet(3, 1, 24, 2,
    [](double u, double v)
    {
      const double x = 0.5 * height * (v - 0.5), y = 0.3 * height * (v - 0.5);
      return Vec4(std::cos(turn * u) + x, std::sin(turn * u) + y, height * (v - 0.5), 1);
    });
}

std::vector<Named> All()
{
  return { { "wavy bicubic", Wavy() }, { "cylinder", Cylinder(1, 2) },
    { "half cylinder", Cylinder(1, 2, 2) }, { "sphere", Sphere(1) }, { "torus", Torus(1, 0.4) },
    { "cone", Cone(1, 1.5) },
    { "plane", Plane(Vec3(0, 0, 0), Vec3(1, 0.2, 0.1), Vec3(0.3, 1, -0.2)) },
    { "bilinear", Bilinear() }, { "high degree", HighDegree(7, 6) }, { "creased", Creased() },
    { "weights", Weighted() }, { "unclamped", Unclamped() }, { "curled", Curled() },
    { "slit", Slit() }, { "linear", Linear() }, { "jump", Jump() },
    { "leaning tube", LeaningTube() } };
}

NurbsSurface Transformed(NurbsSurface surface, const Eigen::Matrix3d& linear, const Vec3& shift)
{
  for (Vec4& point : surface.ControlPoints)
  {
    const Vec3 moved = linear * point.head<3>() + shift;
    point.head<3>() = moved;
  }
  return surface;
}

NurbsSurface ReversedU(const NurbsSurface& given)
{
  NurbsSurface surface = given;
  const double sum = given.FirstU() + given.LastU();
  for (std::size_t i = 0; i < given.KnotsU.size(); ++i)
  {
    surface.KnotsU[i] = sum - given.KnotsU[given.KnotsU.size() - 1 - i];
  }
  for (int j = 0; j < given.CountV; ++j)
  {
    for (int i = 0; i < given.CountU; ++i)
    {
      surface.ControlPoints[i + j * given.CountU] =
        given.ControlPoints[given.CountU - 1 - i + j * given.CountU];
    }
  }
  for (auto& loop : surface.TrimLoops)
  {
    for (Vec2& x : loop)
    {
      x.x() = sum - x.x();
    }
  }
  return surface;
}

std::vector<NurbsSurface> BoxShell(const Vec3& low, const Vec3& high)
{
  const Vec3 d = high - low, x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
  return { Plane(low, y, x), Plane(low + z, x, y), Plane(low, x, z), Plane(low + y, z, x),
    Plane(low, z, y), Plane(low + x, y, z) };
}

std::vector<NurbsSurface> RoundedShell(double a, double b, double r, double height)
{
  const Vec3 up(0, 0, height);
  std::vector<NurbsSurface> shell = { Plane(Vec3(-a + r, -b, 0), Vec3(2 * (a - r), 0, 0), up),
    Plane(Vec3(a, -b + r, 0), Vec3(0, 2 * (b - r), 0), up),
    Plane(Vec3(a - r, b, 0), Vec3(-2 * (a - r), 0, 0), up),
    Plane(Vec3(-a, b - r, 0), Vec3(0, -2 * (b - r), 0), up) };
  for (int k = 0; k < 4; ++k)
  {
    const double angle = k * M_PI / 2;
    Eigen::Matrix3d turn;
    turn << std::round(std::cos(angle)), -std::round(std::sin(angle)), 0,
      std::round(std::sin(angle)), std::round(std::cos(angle)), 0, 0, 0, 1;
    const Vec3 center((k == 0 || k == 3 ? 1 : -1) * (a - r), (k < 2 ? 1 : -1) * (b - r), 0);
    shell.push_back(Transformed(Cylinder(r, height, 1), turn, center));
  }
  return shell;
}

}
