/**
 * @file TestTrimRounding.cxx
 * @brief Neither the number of elements, nor rounding, nor where the model lies decides a trim:
 * sheets and blocks of any length and depth, places stored as floats, read from a file's digits or
 * far from the origin, cuts along mesh lines, ties.
 */
#include "RunTrim.h"
#include "SplineData.h"

#include <Eigen/Geometry>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

using namespace judge;

namespace
{
int Wrong = 0;

void Expect(bool holds, const std::string& what)
{
  if (!holds)
  {
    std::printf("FAIL %s\n", what.c_str());
    ++Wrong;
  }
}

double Entry(const Outcome& outcome, const char* name)
{
  vtkDataArray* array = outcome.Case.Trimmed->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : std::nan("");
}

// The elements of a column fall together in a sheet of any length.
void TestColumnsOfAnyNumber()
{
  MeshOptions bare;
  bare.Data = false;
  constexpr int layers = 3;
  for (const int nx : { 199, 200, 201, 400 })
  {
    const Mesh mesh = Sheet(nx, 12, layers, Vec3(1, 1, 0.5), bare);
    const Outcome outcome =
      RunTrim(mesh, PlaneThrough(Vec3(0, 6.2, 0), Vec3(0, 1, 0.8), 2.0 * nx), TrimOptions());
    std::map<std::array<long, 2>, int> kept; // by column
    vtkDataArray* origins = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
    for (vtkIdType c = 0; c < origins->GetNumberOfTuples(); ++c)
    {
      double box[6];
      mesh.Grid->GetCellBounds(static_cast<vtkIdType>(origins->GetComponent(c, 0)), box);
      ++kept[{ std::lround(2 * box[0]), std::lround(2 * box[2]) }];
    }
    int broken = 0;
    for (const auto& column : kept)
    {
      broken += column.second != layers;
    }
    Expect(outcome.Clean() && broken == 0 && !kept.empty(),
      std::to_string(nx) + " elements: columns in parts: " + std::to_string(broken));
  }
}

using Moved = std::function<Vec3(const Vec3&)>;

Mesh MoveNodes(const Mesh& mesh, bool asFloats, const Moved& moved)
{
  Mesh other = mesh;
  other.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  other.Grid->ShallowCopy(mesh.Grid);
  vtkNew<vtkPoints> points;
  points->SetDataType(asFloats ? VTK_FLOAT : VTK_DOUBLE);
  for (vtkIdType i = 0; i < mesh.Grid->GetNumberOfPoints(); ++i)
  {
    points->InsertNextPoint(moved(Vec3(mesh.Grid->GetPoint(i))).data());
  }
  other.Grid->SetPoints(points);
  return other;
}

// The same cuts of the same sheet, turned, stored and placed in other ways.
void TestSameTrim()
{
  MeshOptions bare;
  bare.Data = false;
  const Mesh mesh = Sheet(14, 14, 2, Vec3(1, 1, 0.5), bare);
  const Eigen::Matrix3d turn =
    (Eigen::AngleAxisd(0.5, Vec3::UnitZ()) * Eigen::AngleAxisd(0.7, Vec3::UnitX()))
      .toRotationMatrix();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> any(-1, 1);
  struct Way
  {
    const char* Name;
    bool AsFloats;
    double Shift, Noise;
    int Left = 0, Relaxed = 0;
  };
  Way ways[] = { { "doubles", false, 0, 0 }, { "floats", true, 0, 0 },
    { "far away", false, 1e7, 0 }, { "noise", false, 0, 3e-9 }, { "digits", false, 0, 1e-6 } };
  for (int cut = 0; cut < 24; ++cut)
  {
    const Vec3 normal = Vec3(any(random), any(random), 0.3 * any(random)).normalized();
    const Vec3 through(7 + 4 * any(random), 7 + 4 * any(random), 0.2);
    for (Way& way : ways)
    {
      const Vec3 shift = Vec3::Constant(way.Shift);
      std::mt19937 noise(7);
      const Mesh other = MoveNodes(mesh, way.AsFloats,
        [&](const Vec3& p)
        {
          const Vec3 off = way.Noise * Vec3(any(noise), any(noise), any(noise));
          return Vec3(turn * (p + off) + shift);
        });
      const Outcome outcome =
        RunTrim(other, PlaneThrough(turn * through + shift, turn * normal, 60), TrimOptions());
      Expect(outcome.Clean(), std::string(way.Name) + ": an error");
      way.Left += CountLeft(outcome.Case.Trimmed);
      way.Relaxed += Entry(outcome, "RescuedByRelaxation") > 0;
    }
  }
  for (const Way& way : ways)
  {
    std::printf("%s: %d nodes left, relaxed in %d trims\n", way.Name, way.Left, way.Relaxed);
    Expect(way.Left <= ways[0].Left && way.Relaxed >= ways[0].Relaxed,
      std::string(way.Name) + ": more nodes are left off");
  }
  Expect(ways[0].Relaxed > 1, "none of the cuts needs relaxation");
}

// Far from the origin type II projects as it does near it.
void TestProjectionFarAway()
{
  MeshOptions bare;
  bare.Data = false;
  for (const double edge : { 1.0, 0.02, 0.001 })
  {
    const Vec3 shift(1e6, 1e6, 0);
    bare.Scale = edge;
    bare.Shift = shift;
    const Mesh mesh = Sheet(20, 20, 2, Vec3(1, 1, 0.5), bare);
    const Vec3 centre = mesh.Box.Centre;
    const Outcome outcome =
      RunTrim(mesh, PlaneThrough(centre - Vec3(0, 0.3 * edge, 0), Vec3(-4, 15, 0), 60 * edge), {});
    vtkDataArray* applied = outcome.Case.Trimmed->GetPointData()->GetArray("CorrectionApplied");
    int projected = 0, slid = 0;
    for (vtkIdType i = 0; i < applied->GetNumberOfTuples(); ++i)
    {
      projected += applied->GetComponent(i, 0) == 2;
      slid += applied->GetComponent(i, 0) == 3;
    }
    Expect(
      outcome.Clean() && CountLeft(outcome.Case.Trimmed) == 0 && projected > 5 * slid && slid > 0,
      "edges of " + std::to_string(edge) + " far away: " + std::to_string(projected) +
        " nodes projected, " + std::to_string(slid) + " slid");
  }
}

// A cut through the middle of a row of elements keeps all of them.
void TestHalves()
{
  MeshOptions bare;
  bare.Data = false;
  const Mesh mesh = Sheet(20, 16, 2, Vec3(1, 1, 0.4), bare);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(900, 700, 200);
  for (const bool asFloats : { false, true })
  {
    const Mesh other =
      MoveNodes(mesh, asFloats, [&](const Vec3& p) { return Vec3(turn * p + shift); });
    const Surface plane = PlaneThrough(turn * Vec3(7.5, 8, 0) + shift, turn * Vec3::UnitX(), 200);
    Expect(Entry(RunTrim(other, plane, TrimOptions()), "Kept") == 8 * 16 * 2,
      std::string("halves of ") + (asFloats ? "floats" : "doubles") + " are not all kept");
  }
}

// Columns follow a leaning cut through many layers, as long as their nodes reach it.
void TestDeepColumns()
{
  MeshOptions bare;
  bare.Data = false;
  struct Deep
  {
    int Nx, Ny, Nz;
    Vec3 Normal;
    double Scale = 1;
  };
  // More layers than 65; shifts of one to three elements; sides of 2 to 3 exactly.
  const Deep blocks[] = { { 12, 30, 65, { 0.3, 1, 0.005 } }, { 12, 30, 66, { 0.3, 1, 0.005 } },
    { 12, 30, 40, { 0.3, 1, 0.03 } }, { 12, 30, 40, { 0.3, 1, 0.034 } },
    { 12, 30, 40, { 0.3, 1, 0.05 } }, { 40, 40, 8, { 0.3, 1, 0.3 } },
    { 40, 40, 8, { 0.3, 1, 0.4 } }, { 8, 12, 12, { 0.4, 1, 0.05 }, 1 },
    { 8, 12, 12, { 0.4, 1, 0.05 }, 1e-3 }, { 8, 12, 12, { 0.4, 1, 0.05 }, 0.1 } };
  for (const Deep& deep : blocks)
  {
    bare.Scale = deep.Scale;
    const Mesh mesh = Sheet(deep.Nx, deep.Ny, deep.Nz, Vec3::Ones(), bare);
    const Outcome outcome =
      RunTrim(mesh, PlaneThrough(mesh.Box.Centre, deep.Normal, 200 * deep.Scale), TrimOptions());
    const int left = CountLeft(outcome.Case.Trimmed);
    const double quality = Entry(outcome, "MinimumScaledJacobian");
    Expect(outcome.Clean() && left == 0 && quality > 0.5,
      std::to_string(deep.Nz) + " layers, " + std::to_string(deep.Normal[2]) + ", scaled by " +
        std::to_string(deep.Scale) + ": " + std::to_string(left) + " nodes left, quality " +
        std::to_string(quality));
  }
}

// What is said of a hole does not depend on where it lies: of radii of two elements exactly, of
// nodes that went behind the cut onto the surface.
void TestSameWarnings()
{
  MeshOptions bare;
  bare.Data = false;
  for (const double radius : { 2.0, 2.27, 5.5 })
  {
    std::vector<std::string> first;
    for (const Vec3& shift : { Vec3(0, 0, 0), Vec3(0, 12, 0), Vec3(216, 0, 0), Vec3(37, 21, 0) })
    {
      bare.Shift = shift;
      const Mesh mesh = Sheet(20, 20, 3, Vec3::Ones(), bare);
      Placement at;
      at.X = at.Y = 0.03;
      at.Lean = radius == 2.0 ? 0 : 0.5;
      at.Size = radius / mesh.Box.HalfX;
      const Outcome outcome = RunTrim(mesh, MakeSurface("cylinder", mesh.Box, at), TrimOptions());
      std::vector<std::string> counts;
      for (const std::string& warning : outcome.Warnings)
      {
        const std::size_t start = warning.find("): ");
        counts.push_back(warning.substr(start, warning.find(" The first") - start));
      }
      first = shift.isZero() ? counts : first;
      Expect(counts == first, "radius " + std::to_string(radius) + ": other warnings elsewhere");
    }
  }
}

/// The walls of an upright hole with straight sides.
Surface Hole(const std::vector<Vec2>& corners)
{
  SplineSurface walls;
  walls.CountU = static_cast<int>(corners.size()) + 1;
  walls.CountV = 2;
  walls.KnotsU = UniformKnots(walls.CountU, 1);
  walls.KnotsV = UniformKnots(2, 1);
  for (const double z : { -5.0, 5.0 })
  {
    for (int i = 0; i < walls.CountU; ++i)
    {
      const Vec2& corner = corners[i % corners.size()];
      walls.Control.emplace_back(corner[0], corner[1], z, 1);
    }
  }
  Surface surface;
  surface.Name = "hole";
  surface.Data = ToPolyData(walls);
  return surface;
}

// Slots of whole elements between mesh lines: all nodes of theirs may be on the surface.
void TestSlots()
{
  MeshOptions bare;
  bare.Data = false;
  const Mesh mesh = Sheet(10, 10, 2, Vec3(1, 1, 0.5), bare);
  struct Slot
  {
    std::vector<Vec2> Corners;
    int Elements; ///< in each layer
  };
  const Slot slots[] = { { { { 4, 2 }, { 5, 2 }, { 5, 8 }, { 4, 8 } }, 6 },
    { { { 4, 2 }, { 5, 2 }, { 5, 3 }, { 4, 3 } }, 1 },
    { { { 4, 2 }, { 6, 2 }, { 6, 8 }, { 4, 8 } }, 12 },
    { { { 4, -3 }, { 5, -3 }, { 5, 3 }, { 4, 3 } }, 3 } };
  for (const Slot& slot : slots)
  {
    const Surface hole = Hole(slot.Corners);
    TrimOptions options;
    const double one = Entry(RunTrim(mesh, hole, options), "Kept");
    options.InvertSide = true;
    const double other = Entry(RunTrim(mesh, hole, options), "Kept");
    Expect(std::min(one, other) == 2 * slot.Elements && one + other == 200,
      "slot of " + std::to_string(slot.Elements) + ": kept " + std::to_string(one) + " and " +
        std::to_string(other));
  }
}
}

int main()
{
  TestColumnsOfAnyNumber();
  TestSameTrim();
  TestProjectionFarAway();
  TestHalves();
  TestDeepColumns();
  TestSameWarnings();
  TestSlots();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
