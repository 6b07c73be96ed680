#include "Surfaces.h"

#include <Eigen/Geometry>

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace judge
{
namespace
{
const double Pi = std::acos(-1.0);

struct Curve
{
  int Degree = 1;
  std::vector<double> Knots;
  std::vector<Vec3> Control; ///< x y w in the profile's plane
};

/// The local axes of a placement: E1 across the surface, E2 along it, Sweep through the sheet.
struct Local
{
  Vec3 Origin, E1, E2, Sweep;
  double Reach;   ///< beyond anything of the mesh
  double Smaller; ///< smaller half size in the plane
};

Local LocalAxes(const Frame& frame, const Placement& at)
{
  const Vec3 ex = frame.Axes.col(0), ey = frame.Axes.col(1), ez = frame.Axes.col(2);
  const Vec3 across = std::cos(at.Angle) * ex + std::sin(at.Angle) * ey;
  Local local;
  local.Origin = frame.Centre + at.X * frame.HalfX * ex + at.Y * frame.HalfY * ey;
  local.E1 = std::cos(at.Lean) * across - std::sin(at.Lean) * ez;
  local.E2 = -std::sin(at.Angle) * ex + std::cos(at.Angle) * ey;
  local.Sweep = local.E1.cross(local.E2);
  local.Reach = 3 * (frame.HalfX + frame.HalfY + frame.HalfZ);
  local.Smaller = std::min(frame.HalfX, frame.HalfY);
  return local;
}

SplineSurface Extrude(const Curve& curve, const Local& local, double low, double high)
{
  SplineSurface s;
  s.DegreeU = curve.Degree;
  s.KnotsU = curve.Knots;
  s.CountU = static_cast<int>(curve.Control.size());
  s.DegreeV = 1;
  s.CountV = 2;
  s.KnotsV = { 0, 0, 1, 1 };
  for (double z : { low, high })
  {
    for (const Vec3& c : curve.Control)
    {
      Eigen::Vector4d p;
      p << local.Origin + c[0] * local.E1 + c[1] * local.E2 + z * local.Sweep, c[2];
      s.Control.push_back(p);
    }
  }
  return s;
}

Curve Segment(const Vec2& a, const Vec2& b)
{
  return { 1, { 0, 0, 1, 1 }, { Vec3(a[0], a[1], 1), Vec3(b[0], b[1], 1) } };
}

// Rational quadratic arcs, counter-clockwise, one for each quarter at most (NURBS Book, 7.3).
Curve Arc(const Vec2& centre, double radius, double from, double to)
{
  const int count = static_cast<int>(std::ceil((to - from) / (Pi / 2) - 1e-9));
  const double step = (to - from) / count, weight = std::cos(step / 2);
  Curve arc;
  arc.Degree = 2;
  arc.Knots = { 0, 0, 0 };
  for (int i = 0; i <= count; ++i)
  {
    const double a = from + i * step;
    arc.Control.emplace_back(centre[0] + radius * std::cos(a), centre[1] + radius * std::sin(a), 1);
    if (i < count)
    {
      const double m = a + step / 2, r = radius / weight;
      arc.Control.emplace_back(centre[0] + r * std::cos(m), centre[1] + r * std::sin(m), weight);
    }
    if (i > 0 && i < count)
    {
      arc.Knots.insert(arc.Knots.end(), 2, double(i) / count);
    }
  }
  if (std::abs(to - from - 2 * Pi) < 1e-12)
  {
    arc.Control.back() = arc.Control.front();
  }
  arc.Knots.insert(arc.Knots.end(), 3, 1.0);
  return arc;
}

Curve Spline(const std::vector<Vec2>& control, const std::vector<double>& knots, int degree)
{
  Curve curve;
  curve.Degree = degree;
  curve.Knots = knots;
  for (const Vec2& c : control)
  {
    curve.Control.emplace_back(c[0], c[1], 1);
  }
  return curve;
}

std::shared_ptr<Oracle> Swept(const Local& local, std::shared_ptr<Profile> profile)
{
  return std::make_shared<SweptOracle>(local.Origin, local.E1, local.E2, std::move(profile));
}

void SetSpline(Surface& surface, const Local& local, const std::vector<Vec2>& control,
  const std::vector<double>& knots, int degree, std::vector<SplineSurface>& faces)
{
  auto profile = std::make_shared<SplineProfile>(knots, degree, control);
  surface.MinimumRadius = profile->MinimumRadius();
  surface.Truth = Swept(local, profile);
  faces.push_back(Extrude(Spline(control, knots, degree), local, -local.Reach, local.Reach));
}

void SetPlane(Surface& surface, const Local& local)
{
  surface.Truth = Swept(local, std::make_shared<LineProfile>());
  surface.HasPlane = true;
  surface.PlanePoint = local.Origin;
  surface.PlaneNormal = local.E1;
}

void MakePlane(Surface& surface, const Local& local, bool loops, std::vector<SplineSurface>& faces)
{
  const double r = local.Reach;
  faces.push_back(Extrude(Segment(Vec2(0, -r), Vec2(0, r)), local, -r, r));
  SetPlane(surface, local);
  if (loops)
  {
    faces[0].Loops = { { Vec2(0.05, 0.05), Vec2(0.95, 0.05), Vec2(0.95, 0.95), Vec2(0.05, 0.95) },
      { Vec2(0.06, 0.06), Vec2(0.06, 0.09), Vec2(0.09, 0.09) } };
  }
}

void MakeWavy(Surface& surface, const Frame& frame, const Local& local, unsigned seed,
  std::vector<SplineSurface>& faces)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  SplineSurface s;
  s.DegreeU = s.DegreeV = 3;
  s.CountU = 12;
  s.CountV = 6;
  s.KnotsU = UniformKnots(s.CountU, 3);
  s.KnotsV = UniformKnots(s.CountV, 3);
  const double halfY = 2.2 * std::hypot(frame.HalfX, frame.HalfY) + 2 * frame.HalfZ;
  const double halfZ = 3 * std::max(frame.HalfZ, 2 * frame.ElementSize);
  const double height = std::min(0.1 * local.Smaller, 0.25 * halfZ);
  const auto gu = GrevilleAbscissae(s.KnotsU, 3), gv = GrevilleAbscissae(s.KnotsV, 3);
  SplineSurface heights = s;
  for (int j = 0; j < s.CountV; ++j)
  {
    for (int i = 0; i < s.CountU; ++i)
    {
      const double x = height * any(random);
      const double y = (2 * gu[i] - 1) * halfY, z = (2 * gv[j] - 1) * halfZ;
      Eigen::Vector4d p, h;
      p << local.Origin + x * local.E1 + y * local.E2 + z * local.Sweep, 1;
      h << x, 0, 0, 1;
      s.Control.push_back(p);
      heights.Control.push_back(h);
    }
  }
  Eigen::Matrix3d axes;
  axes << local.E1, local.E2, local.Sweep;
  surface.Truth = std::make_shared<GraphOracle>(local.Origin, axes, heights, halfY, halfZ);
  const double space = 2 * std::min(halfY / 9, halfZ / 3);
  surface.MinimumRadius = space * space / (4 * height);
  faces.push_back(s);
}

void MakeCone(Surface& surface, const Frame& frame, const Local& local, double radius,
  std::vector<SplineSurface>& faces)
{
  const double half = std::min(15 * Pi / 180, std::atan(radius / (2 * frame.HalfZ + radius)));
  const double toApex = radius / std::tan(half);
  SplineSurface s = Extrude(Arc(Vec2::Zero(), 1, 0, 2 * Pi), local, 0, 0);
  for (int i = 0; i < static_cast<int>(s.Control.size()); ++i)
  {
    const double z = i < s.CountU ? -2 * toApex : 0.8 * toApex;
    const Vec3 flat = s.Control[i].head<3>() - local.Origin;
    s.Control[i].head<3>() = local.Origin + flat * (toApex - z) * std::tan(half) + z * local.Sweep;
  }
  surface.Truth =
    std::make_shared<ConeOracle>(local.Origin + toApex * local.Sweep, -local.Sweep, half);
  surface.MinimumRadius = 0.8 * radius;
  faces.push_back(s);
}

void MakeContour(Surface& surface, const Local& local, double radius, unsigned seed,
  std::vector<SplineSurface>& faces)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.8, 1.2);
  const int count = 10;
  std::vector<Vec2> control;
  for (int i = 0; i < count; ++i)
  {
    const double a = 2 * Pi * i / count, r = radius * any(random);
    control.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  for (int i = 0; i < 3; ++i)
  {
    control.push_back(control[i]);
  }
  // Not clamped: a periodic curve as drawing programs write it.
  std::vector<double> knots;
  for (int i = 0; i < count + 7; ++i)
  {
    knots.push_back(i);
  }
  SetSpline(surface, local, control, knots, 3, faces);
}

void MakeSCurve(Surface& surface, const Frame& frame, const Local& local, unsigned seed,
  std::vector<SplineSurface>& faces)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1, 1);
  const int count = 14;
  const auto knots = UniformKnots(count, 3);
  const double half = 2.2 * std::hypot(frame.HalfX, frame.HalfY) + 2 * frame.HalfZ;
  std::vector<Vec2> control;
  for (double g : GrevilleAbscissae(knots, 3))
  {
    control.emplace_back(0.3 * local.Smaller * any(random), (2 * g - 1) * half);
  }
  SetSpline(surface, local, control, knots, 3, faces);
}

void MakeSlot(
  Surface& surface, const Frame& frame, const Local& local, std::vector<SplineSurface>& faces)
{
  const double w = 1.7 * frame.ElementSize;
  const double far = 2 * std::hypot(frame.HalfX, frame.HalfY) + 2 * frame.HalfZ;
  std::vector<Vec2> control;
  for (int i = 0; i <= 6; ++i)
  {
    control.emplace_back(-w, far - i * far / 3);
  }
  control.emplace_back(-w, -far - w);
  control.emplace_back(w, -far - w);
  for (int i = 6; i >= 0; --i)
  {
    control.emplace_back(w, far - i * far / 3);
  }
  SetSpline(surface, local, control, UniformKnots(static_cast<int>(control.size()), 3), 3, faces);
  surface.MinimumRadius = std::numeric_limits<double>::infinity(); // bends outside the grid
}

void MakeRoundRectangle(
  Surface& surface, const Local& local, double size, std::vector<SplineSurface>& faces)
{
  const double hx = 1.3 * size, hy = size, r = 0.4 * size, z = local.Reach;
  const double a = hx - r, b = hy - r;
  const std::vector<Curve> curves = { Segment(Vec2(-a, -hy), Vec2(a, -hy)),
    Arc(Vec2(a, -b), r, -Pi / 2, 0), Segment(Vec2(hx, -b), Vec2(hx, b)),
    Arc(Vec2(a, b), r, 0, Pi / 2), Segment(Vec2(a, hy), Vec2(-a, hy)),
    Arc(Vec2(-a, b), r, Pi / 2, Pi), Segment(Vec2(-hx, b), Vec2(-hx, -b)),
    Arc(Vec2(-a, -b), r, Pi, 1.5 * Pi) };
  for (int i = 0; i < 8; ++i)
  {
    SplineSurface s = Extrude(curves[i], local, -z, z);
    // The two largest faces decide and stay; others are written as files may have them.
    faces.push_back(i % 4 == 0 ? s : i % 3 == 1 ? ReversedU(s) : i % 3 == 2 ? Transposed(s) : s);
  }
  // The order of the faces in a file says nothing either.
  std::swap(faces[0], faces[5]);
  std::swap(faces[2], faces[7]);
  surface.Truth = Swept(local, std::make_shared<RoundedRectangleProfile>(hx, hy, r));
  surface.MinimumRadius = r;
}

/// A profile (distance from the axis, height, weight) revolved round the sweep direction.
SplineSurface Revolve(const Curve& profile, const Local& local)
{
  const Curve circle = Arc(Vec2::Zero(), 1, 0, 2 * Pi);
  SplineSurface s;
  s.DegreeU = circle.Degree;
  s.KnotsU = circle.Knots;
  s.CountU = static_cast<int>(circle.Control.size());
  s.DegreeV = profile.Degree;
  s.KnotsV = profile.Knots;
  s.CountV = static_cast<int>(profile.Control.size());
  for (const Vec3& c : profile.Control)
  {
    for (const Vec3& d : circle.Control)
    {
      Eigen::Vector4d p;
      p << local.Origin + c[0] * (d[0] * local.E1 + d[1] * local.E2) + c[1] * local.Sweep,
        c[2] * d[2];
      s.Control.push_back(p);
    }
  }
  return s;
}

SplineSurface SphereOf(const Local& local, double radius, Surface& surface)
{
  surface.Truth = std::make_shared<TorusOracle>(local.Origin, local.Sweep, 0, radius);
  surface.MinimumRadius = radius;
  return Revolve(Arc(Vec2::Zero(), radius, -Pi / 2, Pi / 2), local);
}

void MakeSphere(
  Surface& surface, Local local, double size, unsigned seed, std::vector<SplineSurface>& faces)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-0.6, 0.6);
  local.Origin += any(random) * size * local.Sweep;
  faces.push_back(SphereOf(local, size, surface));
}

void MakeTorus(Surface& surface, const Local& local, double size, std::vector<SplineSurface>& faces)
{
  const double tube = 0.45 * size;
  faces.push_back(Revolve(Arc(Vec2(size, 0), tube, 0, 2 * Pi), local));
  surface.Truth = std::make_shared<TorusOracle>(local.Origin, local.Sweep, size, tube);
  surface.MinimumRadius = tube;
}

void MakeRectangle(
  Surface& surface, const Local& local, double size, std::vector<SplineSurface>& faces)
{
  const Vec2 a(-1.3 * size, -size), c = -a, b(c[0], a[1]), d(a[0], c[1]);
  for (const Curve& side : { Segment(a, b), Segment(b, c), Segment(c, d), Segment(d, a) })
  {
    faces.push_back(Extrude(side, local, -local.Reach, local.Reach));
  }
  surface.Truth = Swept(local, std::make_shared<RoundedRectangleProfile>(c[0], c[1], 0));
  surface.MinimumRadius = 0;
}

void Pack(Surface& surface, std::vector<SplineSurface>& faces, const Placement& at)
{
  if (at.Reversed)
  {
    surface.Sign = -1;
    for (SplineSurface& face : faces)
    {
      face = at.Seed % 2 ? ReversedU(face) : Transposed(face);
    }
  }
  if (faces.size() == 1)
  {
    surface.Data = ToPolyData(faces[0]);
    return;
  }
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned i = 0; i < faces.size(); ++i)
  {
    blocks->SetBlock(i, ToPolyData(faces[i]));
  }
  surface.Data = blocks;
}
}

std::vector<std::string> SurfaceKinds()
{
  return { "plane", "wavy", "cylinder", "cone", "arc", "scurve", "contour", "roundrect", "slot",
    "trimmedface" };
}

std::vector<std::string> AllSurfaceKinds()
{
  std::vector<std::string> kinds = SurfaceKinds();
  kinds.insert(kinds.end(), { "sphere", "torus", "rectangle" });
  return kinds;
}

Surface MakeSurface(const std::string& kind, const Frame& frame, const Placement& at)
{
  const Local local = LocalAxes(frame, at);
  const double size = at.Size * local.Smaller;
  Surface surface;
  surface.Name = kind;
  std::vector<SplineSurface> faces;
  if (kind == "plane" || kind == "trimmedface")
  {
    MakePlane(surface, local, kind == "trimmedface", faces);
  }
  else if (kind == "wavy")
  {
    MakeWavy(surface, frame, local, at.Seed, faces);
  }
  else if (kind == "cylinder")
  {
    faces.push_back(Extrude(Arc(Vec2::Zero(), size, 0, 2 * Pi), local, -local.Reach, local.Reach));
    surface.Truth = Swept(local, std::make_shared<CircleProfile>(Vec2::Zero(), size));
    surface.MinimumRadius = size;
  }
  else if (kind == "cone")
  {
    MakeCone(surface, frame, local, size, faces);
  }
  else if (kind == "arc")
  {
    const double r = 2.5 * (frame.HalfX + frame.HalfY);
    faces.push_back(Extrude(Arc(Vec2(-r, 0), r, -1.8, 1.8), local, -local.Reach, local.Reach));
    surface.Truth = Swept(local, std::make_shared<CircleProfile>(Vec2(-r, 0), r));
    surface.MinimumRadius = r;
  }
  else if (kind == "scurve")
  {
    MakeSCurve(surface, frame, local, at.Seed, faces);
  }
  else if (kind == "contour")
  {
    MakeContour(surface, local, size, at.Seed, faces);
  }
  else if (kind == "roundrect")
  {
    MakeRoundRectangle(surface, local, size, faces);
  }
  else if (kind == "slot")
  {
    MakeSlot(surface, frame, local, faces);
  }
  else if (kind == "sphere")
  {
    MakeSphere(surface, local, size, at.Seed, faces);
  }
  else if (kind == "torus")
  {
    MakeTorus(surface, local, size, faces);
  }
  else if (kind == "rectangle")
  {
    MakeRectangle(surface, local, size, faces);
  }
  else
  {
    throw std::invalid_argument("no surface called " + kind);
  }
  Pack(surface, faces, at);
  return surface;
}

Surface EndingPlane(const Frame& frame, const Placement& at)
{
  const Local local = LocalAxes(frame, at);
  const double r = local.Reach;
  Surface surface;
  surface.Name = "endingplane";
  surface.Data =
    ToPolyData(Extrude(Segment(Vec2(0, -r), Vec2(0, 0.2 * frame.HalfY)), local, -r, r));
  SetPlane(surface, local);
  return surface;
}

Surface EndingTrimLoop(const Frame& frame, const Placement& at)
{
  const Local local = LocalAxes(frame, at);
  const double r = local.Reach;
  Surface surface;
  surface.Name = "endingtrimloop";
  SplineSurface s = Extrude(Segment(Vec2(0, -r), Vec2(0, r)), local, -r, r);
  s.Loops = { { Vec2(0.02, 0.02), Vec2(0.5, 0.02), Vec2(0.5, 0.98), Vec2(0.02, 0.98) } };
  surface.Data = ToPolyData(s);
  SetPlane(surface, local);
  return surface;
}

Surface PlaneThrough(const Vec3& point, const Vec3& normal, double halfSize)
{
  Local local;
  local.Origin = point;
  local.E1 = normal.normalized();
  const Vec3 other = std::abs(local.E1[2]) < 0.9 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitX());
  local.E2 = other.cross(local.E1).normalized();
  local.Sweep = local.E1.cross(local.E2);
  const double r = halfSize;
  Surface surface;
  surface.Name = "plane";
  surface.Data = ToPolyData(Extrude(Segment(Vec2(0, -r), Vec2(0, r)), local, -r, r));
  SetPlane(surface, local);
  return surface;
}

Surface SphereAt(const Vec3& centre, double radius)
{
  Local local;
  local.Origin = centre;
  local.E1 = Vec3::UnitX();
  local.E2 = Vec3::UnitY();
  local.Sweep = Vec3::UnitZ();
  Surface surface;
  surface.Name = "sphere";
  surface.Data = ToPolyData(SphereOf(local, radius, surface));
  return surface;
}

Surface Polyline(const std::vector<Vec2>& corners)
{
  std::vector<Vec2> line = corners;
  line.push_back(corners.front());
  Surface surface;
  surface.Data = ToPolyData(Wall(line));
  return surface;
}

Surface RoundHole(const Mesh& sheet, double x, double y, double radius, double lean)
{
  Placement at;
  at.X = (x - sheet.Box.Centre[0]) / sheet.Box.HalfX;
  at.Y = (y - sheet.Box.Centre[1]) / sheet.Box.HalfY;
  at.Angle = 0;
  at.Lean = lean;
  at.Size = radius / sheet.Box.HalfY;
  at.Reversed = true;
  return MakeSurface("cylinder", sheet.Box, at);
}

Surface StripAndHole(const Mesh& sheets)
{
  const Vec3 first(sheets.Grid->GetPoint(0));
  Surface both = Together(PlaneThrough(first + Vec3(9.3, 0, 0), Vec3::UnitX(), 100).Data,
    RoundHole(sheets, 4, 5, 0.45).Data);
  both.Name = "strip and hole";
  return both;
}

Surface Together(vtkDataObject* one, vtkDataObject* other)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, one);
  blocks->SetBlock(1, other);
  Surface both;
  both.Data = blocks;
  return both;
}

SplineSurface ReadSpline(vtkPolyData* data)
{
  const auto values = [data](const char* name)
  {
    std::vector<double> v;
    vtkDataArray* array = data->GetFieldData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i)
    {
      const int n = array->GetNumberOfComponents();
      v.push_back(array->GetComponent(i / n, static_cast<int>(i % n)));
    }
    return v;
  };
  SplineSurface s;
  const auto degrees = values("NURBSDegrees"), size = values("NURBSControlNetSize");
  s.DegreeU = static_cast<int>(degrees.at(0));
  s.DegreeV = static_cast<int>(degrees.at(1));
  s.CountU = static_cast<int>(size.at(0));
  s.CountV = static_cast<int>(size.at(1));
  s.KnotsU = values("NURBSKnotsU");
  s.KnotsV = values("NURBSKnotsV");
  const auto control = values("NURBSControlPoints");
  for (std::size_t i = 0; i + 3 < control.size(); i += 4)
  {
    s.Control.emplace_back(control[i], control[i + 1], control[i + 2], control[i + 3]);
  }
  return s;
}

}
