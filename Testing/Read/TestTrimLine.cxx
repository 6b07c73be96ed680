/**
 * vtkTrimLineSource: the surface is the curve of vtkParametricSpline, which the spline widget
 * draws, swept; orientation, files of points, and bad input.
 */
#include "NURBSFieldData.h"
#include "ReadTesting.h"
#include "Shortage.h"
#include "vtkTrimLineSource.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkParametricSpline.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <sys/stat.h>
#include <unistd.h>
#include <vector>

using nurbs::NurbsSurface;
using nurbs::Vec3;

namespace
{
using Points = std::vector<Vec3>;

void Give(vtkTrimLineSource* source, const Points& points, bool closed)
{
  source->SetNumberOfPoints(static_cast<int>(points.size()));
  for (size_t i = 0; i < points.size(); ++i)
  {
    source->SetPoint(static_cast<int>(i), points[i].x(), points[i].y(), points[i].z());
  }
  source->SetClosed(closed);
}

NurbsSurface SurfaceOf(vtkTrimLineSource* source)
{
  NurbsSurface surface;
  std::string error;
  source->Update();
  CHECK(nurbs::ReadNURBSFieldData(source->GetOutput()->GetFieldData(), surface, error), error);
  return surface;
}

/// Uneven chords, out of any plane; round an axis, so that a closed line encloses something.
Points RandomPoints(int count, std::mt19937& random)
{
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Points points;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * (i + 0.8 * share(random)) / count;
    const double radius = 20.0 + 10.0 * share(random);
    points.emplace_back(
      100.0 + radius * std::cos(angle), radius * std::sin(angle), 3.0 * share(random));
  }
  return points;
}

/// The largest distance of S(u, middle) from vtkParametricSpline, relative to the line's size.
double LargestDeviation(const NurbsSurface& surface, const Points& points, bool closed)
{
  vtkNew<vtkPoints> given;
  given->SetDataTypeToDouble();
  for (const Vec3& point : points)
  {
    given->InsertNextPoint(point.data());
  }
  vtkNew<vtkParametricSpline> spline;
  spline->SetPoints(given);
  spline->SetClosed(closed);
  double largest = 0.0;
  double backwards = 0.0;
  const int places = 1000;
  for (int i = 0; i <= places; ++i)
  {
    double u[3] = { static_cast<double>(i) / places, 0.0, 0.0 }, unused[9];
    Vec3 expected;
    spline->Evaluate(u, expected.data(), unused);
    const double size = surface.LastU() - surface.FirstU();
    const Vec3 found = nurbs::Evaluate(surface, surface.FirstU() + u[0] * size, 0.0);
    const Vec3 other = nurbs::Evaluate(surface, surface.LastU() - u[0] * size, 0.0);
    largest = std::max(largest, (found - expected).norm());
    backwards = std::max(backwards, (other - expected).norm());
  }
  // A closed line may run the other way round.
  return (closed ? std::min(largest, backwards) : largest) / 100.0;
}

void TestCurve()
{
  std::mt19937 random(7);
  for (int count = 2; count <= 20; ++count)
  {
    for (bool closed : { false, true })
    {
      if (closed && count < 3)
      {
        continue;
      }
      const Points points = RandomPoints(count, random);
      vtkNew<vtkTrimLineSource> source;
      Give(source, points, closed);
      source->SetLength(7.0);
      const NurbsSurface surface = SurfaceOf(source);
      const double deviation = LargestDeviation(surface, points, closed);
      CHECK(deviation < 1e-9, count << " points, closed " << closed << ": off by " << deviation);
      CHECK(surface.DegreeU == 3 && surface.DegreeV == 1, "degrees");
      CHECK(surface.CountU == count + 2 + closed, "simple knots: " << surface.CountU);
    }
  }
}

/// Chords of very different lengths: the conversion must not lose digits.
void TestUnevenChords()
{
  const Points points{ { 0, 0, 0 }, { 50, 0, 0 }, { 50.001, 0.0005, 0 }, { 50.002, 0.002, 0 },
    { 80, 60, 0 }, { 80, 60.001, 0 }, { 0, 90, 0 } };
  for (bool closed : { false, true })
  {
    vtkNew<vtkTrimLineSource> source;
    Give(source, points, closed);
    const double deviation = LargestDeviation(SurfaceOf(source), points, closed);
    CHECK(deviation < 1e-9, "closed " << closed << ": off by " << deviation);
  }
}

void TestSweep()
{
  const Vec3 direction = Vec3(1, 2, 4).normalized();
  vtkNew<vtkTrimLineSource> source;
  const Points points{ { 0, 0, 0 }, { 3, 1, 0 }, { 5, -1, 1 } };
  Give(source, points, false);
  source->SetDirection(0.1, 0.2, 0.4);
  source->SetLength(2.5);
  const NurbsSurface surface = SurfaceOf(source);
  for (double u : { 0.0, 0.4, 1.0 })
  {
    const double at = surface.FirstU() + u * (surface.LastU() - surface.FirstU());
    const Vec3 middle = nurbs::Evaluate(surface, at, 0.0);
    const Vec3 low = nurbs::Evaluate(surface, at, surface.FirstV());
    const Vec3 high = nurbs::Evaluate(surface, at, surface.LastV());
    CHECK((low - middle + 2.5 * direction).norm() < 1e-12, "lower end");
    CHECK((high - middle - 2.5 * direction).norm() < 1e-12, "upper end");
  }
  CHECK((nurbs::Evaluate(surface, surface.FirstU(), 0.0) - points[0]).norm() < 1e-12, "first");
  CHECK((nurbs::Evaluate(surface, surface.LastU(), 0.0) - points[2]).norm() < 1e-12, "last");
  CHECK(source->GetOutput()->GetNumberOfPolys() >= 64, "tessellation");
  source->SetResolution(200);
  source->Update();
  CHECK(source->GetOutput()->GetNumberOfPolys() >= 200, "resolution");
}

void TestOrientation()
{
  const Points square{ { 1, 1, 0 }, { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 } };
  const Points reverse(square.rbegin(), square.rend());
  for (const Points& points : { square, reverse })
  {
    for (double sign : { 1.0, -1.0 })
    {
      vtkNew<vtkTrimLineSource> source;
      Give(source, points, true);
      source->SetDirection(0.2, 0, sign);
      const NurbsSurface surface = SurfaceOf(source);
      const double size = surface.LastU() - surface.FirstU();
      for (double u : { 0.1, 0.3, 0.6, 0.9 })
      {
        const double at = surface.FirstU() + u * size;
        const Vec3 place = nurbs::Evaluate(surface, at, 0.0);
        CHECK(UnitNormal(surface, at, 0.0).dot(place) < 0.0, "the normal points inwards");
      }
    }
  }
  vtkNew<vtkTrimLineSource> open;
  Give(open, { { 0, 0, 0 }, { 1, 0, 0 } }, false);
  const NurbsSurface surface = SurfaceOf(open);
  CHECK(UnitNormal(surface, 0.5, 0.0).y() < -0.99, "the normal of an open line points right");
  const Vec3 corner = UnitNormal(surface, 1e-3, 0.0);
  CHECK(corner.y() < -0.99, "near the end, too");
}

/// A polyline is its points, with straight pieces between them.
void TestPolyline()
{
  const Points points{ { 0, 0, 1 }, { 4, 0, 0.5 }, { 4, 3, 0 }, { -1, 3, 0 } };
  for (bool closed : { false, true })
  {
    vtkNew<vtkTrimLineSource> source;
    Give(source, points, closed);
    source->SetLineType(vtkTrimLineSource::POLYLINE);
    source->SetDirection(0, 0, 1);
    source->SetLength(2.0);
    const NurbsSurface surface = SurfaceOf(source);
    CHECK(surface.DegreeU == 1 && surface.CountU == 4 + closed, "degree and count");
    double u = 0.0;
    for (size_t i = 0; i + !closed < points.size(); ++i)
    {
      const Vec3 a = points[i], b = points[(i + 1) % points.size()];
      const double at = closed ? surface.LastU() - u : u; // drawn outwards: run backwards
      const double step = (closed ? -0.25 : 0.25) * (b - a).norm();
      CHECK((nurbs::Evaluate(surface, at, 0.0) - a).norm() < 1e-14, "corner " << i);
      CHECK((nurbs::Evaluate(surface, at + step, 0.0) - 0.75 * a - 0.25 * b).norm() < 1e-14,
        "between " << i);
      u += (b - a).norm();
    }
  }
}

double FieldValue(vtkTrimLineSource* source, const char* name, int component = 0)
{
  source->Update();
  vtkDataArray* array = source->GetOutput()->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, component) : std::numeric_limits<double>::quiet_NaN();
}

Vec3 UsedDirection(vtkTrimLineSource* source)
{
  return Vec3(FieldValue(source, "Direction", 0), FieldValue(source, "Direction", 1),
    FieldValue(source, "Direction", 2));
}

/// Without a mesh: the normal of what a closed line encloses, z for an open one.
void TestAutomaticByLine()
{
  const Vec3 normal = Vec3(-2, 1, -3).normalized();
  const Vec3 a = normal.unitOrthogonal(), b = normal.cross(a);
  Points points;
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * i / 12;
    points.push_back(Vec3(4, 5, 6) + 3.0 * std::cos(angle) * a + 2.0 * std::sin(angle) * b);
  }
  vtkNew<vtkTrimLineSource> source;
  Give(source, points, true);
  CHECK((UsedDirection(source) + normal).norm() < 1e-12, "its largest coordinate is positive");
  source->SetClosed(0);
  CHECK(UsedDirection(source) == Vec3::UnitZ(), "an open line goes along z");
  Give(source, { { 0, 0, 0 }, { 3, 4, 0 }, { 6, 8, 0 } }, false);
  CHECK(std::abs(FieldValue(source, "Length") - 10.0) < 1e-12, "as long as the line is large");
  source->SetDirection(0, 5, 5);
  source->SetLength(2.5);
  CHECK((UsedDirection(source) - Vec3(0, 1, 1).normalized()).norm() < 1e-15, "direction as given");
  CHECK(FieldValue(source, "Length") == 2.5, "length as given");
}

/// A sheet of 20 x 12 x 2 elements, bent by `shape`. Where i + j is odd elements are two wedges,
/// one of them with its nodes in the order of vtkWedge, the other in the reverse order.
vtkSmartPointer<vtkUnstructuredGrid> MakeSheet(const std::function<Vec3(const Vec3&)>& shape)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k <= 2; ++k)
  {
    for (int j = 0; j <= 12; ++j)
    {
      for (int i = 0; i <= 20; ++i)
      {
        points->InsertNextPoint(shape(Vec3(i, j, 0.4 * k)).data());
      }
    }
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  const auto id = [](int i, int j, int k) -> vtkIdType { return i + 21 * (j + 13 * k); };
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < 12; ++j)
    {
      for (int i = 0; i < 20; ++i)
      {
        const vtkIdType n[8] = { id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k),
          id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1) };
        const vtkIdType up[6] = { n[0], n[1], n[2], n[4], n[5], n[6] };
        const vtkIdType down[6] = { n[4], n[6], n[7], n[0], n[2], n[3] };
        if ((i + j) % 2 == 0)
        {
          grid->InsertNextCell(VTK_HEXAHEDRON, 8, n);
        }
        else
        {
          grid->InsertNextCell(VTK_WEDGE, 6, up);
          grid->InsertNextCell(VTK_WEDGE, 6, down);
        }
      }
    }
  }
  return grid;
}

/// With a mesh: the normal of its skin, and through the whole of it.
void TestAutomaticBySheet()
{
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 0.5).normalized());
  const auto placed = [&turn](const Vec3& p) { return Vec3(turn * p + Vec3(100, 20, 3)); };
  const auto flat = MakeSheet(placed);
  const Vec3 normal = turn * Vec3::UnitZ();
  // Inside, across the rims, and along a rim in the middle plane, where the nearest nodes have
  // normals that lie in the sheet.
  for (const Points& points : { Points{ { 5, 5, 0.4 }, { 9, 8, 0.8 }, { 14, 4, 0.2 } },
         Points{ { 7, -3, 0.8 }, { 9, 5, 0.8 }, { 7, 15, 0.8 } },
         Points{ { 0, -2, 0.4 }, { 0, 5, 0.4 }, { 0, 14, 0.4 } } })
  {
    Points given;
    for (const Vec3& point : points)
    {
      given.push_back(placed(point));
    }
    vtkNew<vtkTrimLineSource> source;
    source->SetInputData(flat);
    Give(source, given, false);
    CHECK((UsedDirection(source) - normal).norm() < 1e-9, "normal " << UsedDirection(source));
    const NurbsSurface surface = SurfaceOf(source);
    const double length = surface.LastV();
    double bounds[6];
    flat->GetBounds(bounds);
    for (const Vec3& point : given)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        const Vec3 far(
          bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2)]);
        CHECK(std::abs((far - point).dot(normal)) < length, "does not pass through the part");
      }
    }
  }

  // An angle profile: a line on one leg goes by that leg.
  const auto angle = MakeSheet(
    [](const Vec3& p) { return p.x() <= 10.0 ? p : Vec3(10.0 + p.z(), p.y(), -(p.x() - 10.0)); });
  vtkNew<vtkTrimLineSource> source;
  source->SetInputData(angle);
  Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 }, { 1, 7, 0.8 } }, true);
  CHECK((UsedDirection(source) - Vec3::UnitZ()).norm() < 1e-9, "lying leg");
  Give(source, { { 10.8, 3, -9 }, { 10.8, 7, -9 }, { 10.8, 5, -6 } }, true);
  CHECK((UsedDirection(source) - Vec3::UnitX()).norm() < 1e-9, "standing leg");

  // A mesh that changes is looked at again; so is one that is taken away.
  Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 }, { 1, 7, 0.8 } }, true);
  CHECK(FieldValue(source, "Length") > 10.0, "through the standing leg");
  source->SetInputData(MakeSheet([](const Vec3& p) { return p; }));
  CHECK(FieldValue(source, "Length") < 1.0, "the new mesh is flat");
  source->SetInputData(nullptr);
  CHECK(FieldValue(source, "Length") > 4.0, "no mesh any more");

  // A block that changes in its place.
  const auto block = MakeSheet([](const Vec3& p) { return p; });
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, block);
  source->SetInputData(blocks);
  CHECK(FieldValue(source, "Length") < 1.0, "a block");
  block->GetPoints()->SetPoint(0, 0, 0, -30);
  block->Modified();
  source->Modified();
  CHECK(FieldValue(source, "Length") > 4.0, "the block has changed");
}

/// A grid that gets other cells, which VTK counts as no change of it.
void TestOtherCells()
{
  const auto angle = MakeSheet(
    [](const Vec3& p) { return p.x() <= 10.0 ? p : Vec3(10.0 + p.z(), p.y(), -(p.x() - 10.0)); });
  const vtkSmartPointer<vtkCellArray> all = angle->GetCells();
  const vtkSmartPointer<vtkUnsignedCharArray> types = angle->GetCellTypesArray();
  vtkNew<vtkCellArray> one;
  one->InsertNextCell(angle->GetCell(0));
  angle->SetCells(angle->GetCellType(0), one);
  vtkNew<vtkTrimLineSource> source;
  Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 }, { 1, 7, 0.8 } }, true);
  source->SetInputData(angle);
  CHECK(FieldValue(source, "Length") < 1.0, "through an element of the lying leg");
  angle->SetCells(types, all);
  source->Modified();
  CHECK(FieldValue(source, "Length") > 10.0, "through the standing leg that came since");
}

/// Cells with nodes that are not there: one error.
void TestCorruptSheet()
{
  for (const vtkIdType node : { 819, 2000000000, -3 })
  {
    vtkNew<vtkTrimLineSource> source;
    Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 } }, false);
    const auto sheet = MakeSheet([](const Vec3& p) { return p; });
    vtkNew<vtkIdList> nodes;
    sheet->GetCellPoints(7, nodes);
    nodes->SetId(2, node);
    sheet->GetCells()->ReplaceCellAtId(7, nodes);
    CheckRefusal(source, "Cell 7 of the sheet", [&] { source->SetInputData(sheet); });
  }
}

/// Warnings for a line with a sheet.
size_t CountWarnings(vtkUnstructuredGrid* sheet, double length)
{
  vtkNew<vtkTrimLineSource> source;
  Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 } }, false);
  source->SetInputData(sheet);
  source->SetDirection(0, 0, length);
  source->SetLength(length);
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  source->Update();
  CHECK(capture->Errors.empty() && source->GetOutput()->GetNumberOfPoints() > 0, "no line");
  for (const std::string& warning : capture->Warnings)
  {
    CHECK(warning.find("no hexahedra or wedges") != std::string::npos, warning);
  }
  return capture->Warnings.size();
}

/// A sheet with flags for its first cell only: what lies behind them in memory is none of them.
void TestFewFlags()
{
  const auto sheet = MakeSheet([](const Vec3& p) { return p; });
  std::vector<unsigned char> memory(sheet->GetNumberOfCells(), vtkDataSetAttributes::DUPLICATECELL);
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetArray(memory.data(), 1, 1);
  sheet->GetCellData()->AddArray(flags);
  CHECK(CountWarnings(sheet, 0.0) == 0, "a sheet with few flags");
}

/// A sheet of other cells is of no use, which is said if it is asked.
void TestUselessSheet()
{
  vtkNew<vtkPoints> points;
  for (double x : { 0.0, 1.0, 2.0, 3.0 })
  {
    points->InsertNextPoint(x, x * x, x == 3.0);
  }
  vtkNew<vtkUnstructuredGrid> tetrahedra;
  tetrahedra->SetPoints(points);
  const vtkIdType nodes[4] = { 0, 1, 2, 3 };
  tetrahedra->InsertNextCell(VTK_TETRA, 4, nodes);
  CHECK(CountWarnings(tetrahedra, 0.0) == 1, "a sheet of tetrahedra");
  CHECK(CountWarnings(tetrahedra, 1.0) == 0, "a sheet that is not asked");
  CHECK(CountWarnings(MakeSheet([](const Vec3& p) { return p; }), 0.0) == 0, "a good sheet");
}

/// Points that no element has do not lengthen the sweep.
void TestUnusedPoints()
{
  double lengths[2];
  for (const bool unused : { false, true })
  {
    const auto sheet = MakeSheet([](const Vec3& p) { return p; });
    if (unused)
    {
      sheet->GetPoints()->InsertNextPoint(0, 0, 1e6);
    }
    vtkNew<vtkTrimLineSource> source;
    Give(source, { { 1, 3, 0.8 }, { 4, 5, 0.8 }, { 3, 8, 0.8 } }, false);
    source->SetInputData(sheet);
    lengths[unused] = FieldValue(source, "Length");
  }
  CHECK(lengths[0] == lengths[1], "points without elements: a length of " << lengths[1]);
}

void TestModified()
{
  const Points points{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 } };
  vtkNew<vtkTrimLineSource> source;
  Give(source, points, false);
  const vtkMTimeType before = source->GetMTime();
  Give(source, points, false);
  CHECK(source->GetMTime() == before, "the same values modify the source");
  source->SetPoint(1, 1, 1, 0);
  CHECK(source->GetMTime() > before, "a new point does not");
}

void TestFile()
{
  const Points points{ { 0, 0, 0 }, { 4, 0, 0.5 }, { 4, 3, 0 }, { -1e1, 3, 0 } };
  vtkNew<vtkTrimLineSource> given;
  Give(given, points, true);
  const NurbsSurface expected = SurfaceOf(given);
  for (const std::string text : { "x,y,z\n0,0,0\n4,0,0.5\n4,3,0\n-1e1,3,0\n0,0,0\n",
         "\xEF\xBB\xBF"
         "0,0,0\n4,0,0.5\n4,3,0\n-10,3,0\n",
         "0,0,0\r4,0,0.5\r4,3,0\r-10,3,0\r\x1A",
         "# contour\r\n0; 0; 0\r\n+4;0;.5\r\n\r\n4 3\t0\r\n-10 3 0",
         "\"0\",\"0\",\"0\"\n\"4\",\"0\",\"0.5\"\n4,3,0\n-10,3,0\n0.0001,0,0\n",
         "\"Point ID\",\"Points:0\",\"Points:1\",\"Points:2\",\"Points_Magnitude\"\n0,0,0,0,0\n"
         "1,4,0,0.5,4.03\n2,4,3,0,5\n3,-10,3,0,10.44\n",
         "Z_coord,Y_coord,X_coord\n0,0,0\n0.5,0,4\n0,3,4\n0,3,-10\n",
         "Pos Z;Next X;Pos Y;Pos X\n0;9;0;0\n0.5;9;0;4\n0;9;3;4\n0;9;3;-10\n",
         "max_z,max_y,max_x\n0,0,0\n0.5,0,4\n0,3,4\n0,3,-10\n",
         "Z Y X\n0 0 0\n0.5 0 4\n0 3 4\n0 3 -10\n",
         "t (s);X [mm];Y[mm];Z(mm)\n9;0;0;0\n9;4;0;0.5\n9;4;3;0\n9;-10;3;0\n",
         "x [mm] y [mm] z [mm]\n0 0 0\n4 0 0.5\n4 3 0\n-10 3 0\n",
         "Point ID,x,y,z\n0,0,0,0\n1,4,0,0.5\n2,4,3,0\n3,-10,3,0\n",
         ",x,y,z,\"note, if any\"\n0,0,0,0,first\n1,4,0,0.5,\n2,4,3,0,\"a, b\"\n3,-10,3,0,\n",
         "0,0;0,0;0,0\n4;0;0,5\n4,00;3;0\n-1,0e1;3;0\n",
         "Punkt Nr.;x;y;z\n1,5;0;0;0\n2;4;0;0,5\n3;4;3;0\n4;-10,0;3,0;0\n",
         "0,0\t0,0\t0,0\r\n4,0\t0\t0,5\r\n4\t3\t0\r\n-10 3,0 0\r\n",
         "0,0,0\n\n4,0,0.5\n\n4,3,0\n\n-10,3,0\n\n" })
  {
    const std::string path = OutputPath("line.csv");
    WriteText(path, text);
    vtkNew<vtkTrimLineSource> source;
    source->SetClosed(1);
    source->SetFileName(path.c_str());
    const NurbsSurface surface = SurfaceOf(source);
    CHECK(surface.KnotsU == expected.KnotsU, "knots from a file");
    CHECK(surface.ControlPoints == expected.ControlPoints, "control points from a file");
  }
}

/// Three points are closed by a fourth one where the first is.
void TestTriangleInFile()
{
  vtkNew<vtkTrimLineSource> given;
  Give(given, { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 3, 0 } }, true);
  const std::string path = OutputPath("triangle.csv");
  WriteText(path, "0,0,0\n4,0,0\n0,3,0\n0,0,0\n");
  vtkNew<vtkTrimLineSource> source;
  source->SetFileName(path.c_str());
  CHECK(SurfaceOf(source).ControlPoints == SurfaceOf(given).ControlPoints, "a closed triangle");
}

/// A long line in steps along a direction.
void CheckLongLine(
  const Vec3& along, const Vec3& across, int count, vtkTrimLineSource::LineTypes type)
{
  Points points;
  for (int i = 0; i < count; ++i)
  {
    points.push_back(i * along + 0.1 * std::sin(7.0 * i) * across);
  }
  vtkNew<vtkTrimLineSource> source;
  Give(source, points, false);
  source->SetLineType(type);
  source->SetDirection(0, 0, 1);
  source->SetLength(1.0);
  source->SetResolution(1);
  const NurbsSurface surface = SurfaceOf(source);
  CHECK(surface.CountU >= count || surface.CountV >= count, "a line of " << count << " points");
}

/// Looking for crossings takes not every pair of pieces, whatever the direction of a line, and a
/// spline no matrix of all its points: nobody would wait for these.
void TestLongLines()
{
  CheckLongLine(Vec3::UnitX(), Vec3::UnitY(), 400000, vtkTrimLineSource::POLYLINE);
  CheckLongLine(Vec3::UnitY(), Vec3::UnitX(), 400000, vtkTrimLineSource::POLYLINE);
  CheckLongLine(Vec3::UnitX(), Vec3::UnitY(), 100000, vtkTrimLineSource::SPLINE);
}

using Source = vtkTrimLineSource;

void CheckError(const std::string& part, const std::function<void(Source*)>& spoil)
{
  vtkNew<Source> source;
  Give(source, { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 }, { 0, 3, 0 } }, false);
  CheckRefusal(source, part, [&] { spoil(source); });
}

void CheckFileError(const std::string& part, const std::string& text)
{
  const std::string path = OutputPath("bad-line.csv");
  WriteText(path, text);
  CheckError(part, [path](Source* s) { s->SetFileName(path.c_str()); });
}

void TestBadInput()
{
  CheckFileError("bad-line.csv\" holds no points", "");
  CheckFileError("bad-line.csv\" holds no points", "x,y,z\n# none\n");
  CheckFileError("line 2 is \"1,2?\"; expected", "0,0,0\n1,2\f\n");
  CheckFileError("several lists of points, parted by blank lines as line 4 is",
    "0,0,0\n1,0,0\n2,1,0\n\n5,0,0\n6,0,0\n7,1,0\n");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  CheckError("has 1 points", [](Source* s) { s->SetNumberOfPoints(1); });
  CheckError("has 0 points", [](Source* s) { s->SetNumberOfPoints(-4); });
  CheckError("at least 3",
    [](Source* s)
    {
      s->SetNumberOfPoints(2);
      s->SetClosed(1);
    });
  CheckError("points 0 and 1 coincide", [](Source* s) { s->SetPoint(1, 0, 1e-12, 0); });
  CheckError("points 3 and 0 coincide",
    [](Source* s)
    {
      s->SetClosed(1);
      s->SetPoint(3, 0, 0, 0);
    });
  CheckError("point 2 is not finite", [nan](Source* s) { s->SetPoint(2, 0, nan, 0); });
  CheckError("it ends where it begins; set Closed", [](Source* s) { s->SetPoint(3, 0, 0, 0); });
  // Hardly open, or going on to where it began; the narrow slot beside them is open.
  const auto ends = [](double x, double y)
  {
    return [x, y](Source* s)
    {
      s->SetLineType(vtkTrimLineSource::POLYLINE);
      Give(s, { { 0, 0, 0 }, { 50, 0, 0 }, { 50, 40, 0 }, { 0, 40, 0 }, { x, y, 0 } }, false);
    };
  };
  CheckError("it ends 0.1 from where it begins, and is open", ends(-0.1, 0));
  CheckError("it ends 2 from where it begins, and is open", ends(0, 2));
  vtkNew<Source> slot;
  Give(slot, { { 0, 0, 0 }, { 90, 0, 0 }, { 90, 3, 0 }, { 0, 3, 0 } }, false);
  slot->Update();
  CHECK(slot->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) > 0, "a slot");
  CheckError("not finite", [infinity](Source* s) { s->SetDirection(0, infinity, 0); });
  CheckError("Direction is along the line at (0, 0, 0)",
    [](Source* s) {
      Give(s, { { 0, 0, 0 }, { 0, 0, 2 } }, false);
    });
  CheckError("Length is -2; it must be positive and reach through the part, or 0 to have it found.",
    [](Source* s) { s->SetLength(-2); });
  CheckError("Length is nan", [nan](Source* s) { s->SetLength(nan); });
  CheckError("LineType is 2: give a number from 0 to 1.", [](Source* s) { s->SetLineType(2); });
  CheckError(
    "LengthUnit is -1: give a number from 0 to 5.", [](Source* s) { s->SetLengthUnit(-1); });
  CheckError("encloses no area",
    [](Source* s) {
      Give(s, { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, true);
    });
  // Round the wall of a tube, whose skin faces everywhere.
  CheckError("Direction was not given and found to be",
    [](Source* s)
    {
      const auto onTube = [](const Vec3& p)
      {
        const double angle = 0.1 * M_PI * p.x();
        return Vec3((6 + p.z()) * std::cos(angle), (6 + p.z()) * std::sin(angle), p.y());
      };
      s->SetInputData(MakeSheet(onTube));
      Points circle;
      for (int i = 0; i < 20; ++i)
      {
        circle.push_back(onTube(Vec3(i, 6, 0.4)));
      }
      Give(s, circle, true);
    });
  // An eight, whose lobes cross where the chords do by symmetry; a polyline over itself, and one
  // that goes back the way it came.
  CheckError("crosses itself at (0, 0, 0)",
    [](Source* s) {
      Give(s, { { -2, -1, 0 }, { 2, 1, 0 }, { 2, -1, 0 }, { -2, 1, 0 } }, true);
    });
  CheckError("crosses itself at (3, 0, 0)",
    [](Source* s)
    {
      s->SetLineType(vtkTrimLineSource::POLYLINE);
      Give(s, { { 0, 0, 0 }, { 5, 0, 0 }, { 5, 4, 0 }, { 3, 4, 0 }, { 3, -2, 0 } }, false);
    });
  CheckError("turns back on itself at (5, 1, 0)",
    [](Source* s)
    {
      s->SetLineType(vtkTrimLineSource::POLYLINE);
      Give(s, { { 0, 0, 0 }, { 5, 1, 0 }, { 2.5, 0.5, 0 } }, false);
    });
  CheckError("cannot be read", [](Source* s) { s->SetFileName("/nowhere/line.csv"); });
  CheckError("cannot be read", [](Source* s) { s->SetFileName("/tmp"); });
  // To which nobody writes.
  const std::string pipe = OutputPath("pipe.csv");
  mkfifo(pipe.c_str(), 0600);
  CheckError("is no ordinary file", [pipe](Source* s) { s->SetFileName(pipe.c_str()); });
  unlink(pipe.c_str());
  CheckFileError("is in UTF-16; save it as CSV in UTF-8",
    std::string("\xFF\xFE"
                "0\0,\0",
      6));
  CheckFileError("is in UTF-16; save it as CSV in UTF-8",
    std::string("\xFE\xFF"
                "\0000\0,",
      6));
  // Of two sets of axes neither is meant.
  CheckFileError(
    "line 2 is \"0,0,0,1,1,1\"; expected three", "x_in,y_in,z_in,x_out,y_out,z_out\n0,0,0,1,1,1\n");
  CheckFileError("is cut short", "ISO-10303-21;\nHEADER;\n");
  CheckFileError("line 3 is \"1,2\"; expected three", "x,y,z\n0,0,0\n1,2\n");
  CheckFileError("line 2", "0,0,0\n1,2,3,4\n");
  CheckFileError("line 2 is \"0,1,2,3\"; expected three", "id,x,y\n0,1,2,3\n");
  CheckFileError("line 3", "id,x,y,z\n0,1,2,3\n1,2,3\n");
  CheckFileError("line 2", "0,0,0\nx,y,z\n");
  CheckFileError("line 1", "0,0,nan\n1,2,3\n");
  CheckFileError("line 2", "0,0,0\n1,2,3mm\n");
  CheckFileError("line 2 is \"1,5;2\"; expected three", "0,5;2;1\n1,5;2\n");
  CheckFileError("line 1", "1.000,5;2;1\n");
  // Two columns with decimal commas, a line with a value missing, and one that is parted otherwise.
  CheckFileError("line 1 is \"0,5 0\"; expected three finite numbers x, y, z, or a header",
    "0,5 0\n1,5 1\n2,5 4\n");
  CheckFileError("line 2 is \"1,5 2\"; expected three", "0,5 0,5 0\n1,5 2\n");
  CheckFileError(
    "line 2 is \"1,5,2\"; expected three finite numbers x, y, z, parted as", "0,5 0,5 0\n1,5,2\n");
}

/// Numbers that would take all memory: an error each, and the source stays as it was.
void TestAbsurdNumbers()
{
  vtkNew<vtkTrimLineSource> source;
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  const vtkMTimeType before = source->GetMTime();
  source->SetPoint(2147483647, 1, 2, 3);
  source->SetNumberOfPoints(2147483647);
  CHECK(capture->Errors.size() == 2, capture->Errors.size() << " errors");
  CHECK(source->GetMTime() == before, "an absurd number modifies the source");
}

// Whichever piece of memory is refused: one error, and nothing comes out; afterwards all is well.
void TestShortage()
{
  const auto sheet = MakeSheet([](const Vec3& p) { return p; });
  vtkNew<vtkTrimLineSource> source;
  source->SetInputData(sheet);
  Give(source, { { 5, 5, 0.4 }, { 9, 8, 0.8 }, { 14, 4, 0.2 } }, false);
  source->SetResolution(30);
  const judge::Shortage shortage;
  constexpr std::size_t smallest = 2000;
  const auto updateAnew = [&]
  {
    sheet->Modified();
    source->Modified();
    source->Update();
  };
  judge::Shortage::Plan({ -1, false, smallest });
  updateAnew();
  const long pieces = judge::Shortage::Seen();
  CHECK(pieces > 10, pieces << " pieces of memory");
  int ofSheet = 0;
  for (long piece = 0; piece < pieces; ++piece)
  {
    vtkNew<ErrorCapture> messages;
    messages->Watch(source);
    judge::Shortage::Plan({ piece, true, smallest });
    updateAnew();
    judge::Shortage::Plan({});
    const bool one = messages->Errors.size() == 1 &&
      messages->Errors[0].find("more memory than there is") != std::string::npos;
    CHECK(one, messages->Errors.size() << " errors without piece " << piece);
    ofSheet += one && messages->Errors[0].find("skin of Sheet") != std::string::npos;
    CHECK(vtkDataSet::SafeDownCast(source->GetOutputDataObject(0))->GetNumberOfPoints() == 0,
      "something comes out without piece " << piece);
    if (one)
    {
      source->Update(); // nothing has changed
      source->Modified();
      source->Update();
      CHECK(source->GetOutput()->GetNumberOfPoints() > 0, "nothing comes out afterwards");
    }
  }
  CHECK(ofSheet > 0, "the skin took no memory");
}
}

int main()
{
  TestCurve();
  TestUnevenChords();
  TestSweep();
  TestOrientation();
  TestPolyline();
  TestAutomaticByLine();
  TestAutomaticBySheet();
  TestOtherCells();
  TestCorruptSheet();
  TestFewFlags();
  TestUselessSheet();
  TestUnusedPoints();
  TestModified();
  TestAbsurdNumbers();
  TestFile();
  TestTriangleInFile();
  TestLongLines();
  TestBadInput();
  TestShortage();
  return Failures != 0;
}
