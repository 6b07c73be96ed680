/**
 * @file TestTrimCorners.cxx
 * @brief Sharp edges of the trimming surface: the new boundary has a node there on each layer, and
 * does not cut across.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "SplineData.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>

#include <cmath>
#include <cstdio>

using namespace judge;

namespace
{
struct Line
{
  Vec3 A, B;

  double DistanceTo(const Vec3& p) const
  {
    const Vec3 along = (this->B - this->A).normalized();
    return (p - this->A - along * along.dot(p - this->A)).norm();
  }
  Vec3 AtHeight(double z) const
  {
    return this->A + (z - this->A[2]) / (this->B[2] - this->A[2]) * (this->B - this->A);
  }
};

/// The lines that the faces of a rectangle begin with, one for each face.
std::vector<Line> EdgesOf(const Surface& rectangle)
{
  std::vector<Line> edges;
  auto* faces = vtkCompositeDataSet::SafeDownCast(rectangle.Data);
  auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(faces->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkFieldData* data = it->GetCurrentDataObject()->GetFieldData();
    auto* control = data->GetArray("NURBSControlPoints");
    const auto along = static_cast<int>(data->GetArray("NURBSControlNetSize")->GetComponent(0, 0));
    const auto point = [control](int i)
    {
      return Vec3(
        control->GetComponent(i, 0), control->GetComponent(i, 1), control->GetComponent(i, 2));
    };
    edges.push_back({ point(0), point(along) });
  }
  return edges;
}

bool IsIn(const Mesh& mesh, const Vec3& p)
{
  const Frame& box = mesh.Box;
  const double x = std::abs(p[0] - box.Centre[0]) / box.HalfX;
  const double y = std::abs(p[1] - box.Centre[1]) / box.HalfY;
  const bool isRound = mesh.Name == "dome";
  return isRound ? std::hypot(x, y) < 0.9 : std::max(x, y) < 0.98;
}

int CountNodesOn(vtkUnstructuredGrid* grid, const Line& line)
{
  int count = 0;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    count += line.DistanceTo(Vec3(grid->GetPoint(i))) < 1e-8;
  }
  return count;
}

struct Tally
{
  int Edges = 0, Followed = 0;
};

/// Trims with a rectangle; a followed edge has a node on each layer.
Tally TrimWithRectangle(const Mesh& mesh, const Placement& at, const TrimOptions& options)
{
  const Surface surface = MakeSurface("rectangle", mesh.Box, at);
  Report report("corners, " + mesh.Name + (options.InvertSide ? ", inverted" : ""));
  const Outcome outcome = RunAndJudge(mesh, surface, options, report);
  Expect(report.Failures() == 0, "the trim is not as it should be");
  Tally tally;
  double area = 0.0;
  const std::vector<Line> edges = EdgesOf(surface);
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const Vec3 a = edges[i].AtHeight(mesh.Box.Centre[2]);
    const Vec3 b = edges[(i + 1) % edges.size()].AtHeight(mesh.Box.Centre[2]);
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    if (IsIn(mesh, a))
    {
      const int nodes = CountNodesOn(outcome.Case.Trimmed, edges[i]);
      ++tally.Edges;
      tally.Followed += nodes > 0;
      Expect(nodes == 0 || mesh.Nz == 0 || nodes == mesh.Nz + 1, "not all layers are at an edge");
    }
  }
  // Between planes that meet in nodes the part has the very shape of the rectangle.
  if (mesh.Regular && at.Lean == 0.0 && tally.Edges == 4 && tally.Followed == 4)
  {
    const double inside = std::abs(area) * 2 * mesh.Box.HalfZ;
    const double whole = 8 * mesh.Box.HalfX * mesh.Box.HalfY * mesh.Box.HalfZ;
    const double volume = Number(outcome.Case.Trimmed, "Volume");
    Expect(std::min(std::abs(volume - inside), std::abs(volume - (whole - inside))) < 1e-9 * whole,
      "the volume is not that of the rectangle");
    Expect(CountWarned(outcome, "where the surface has an edge") == 0 &&
        CountWarned(outcome, "crosses more than once") == 0,
      "a warning of an edge that is followed");
  }
  return tally;
}

void CheckRectangles()
{
  for (const char* name : { "sheet1", "sheet2", "sheet3", "perturbed", "irregular", "dome" })
  {
    const Mesh mesh = MakeMesh(name);
    Tally sum;
    for (int i = 0; i < 10; ++i)
    {
      Placement at;
      at.X = 0.05 * i - 0.2;
      at.Y = 0.13 - 0.03 * i;
      at.Angle = 0.16 * i + 0.05;
      at.Size = 0.35 + 0.02 * i;
      at.Lean = i % 4 == 3 ? 0.2 : 0.0;
      TrimOptions options;
      options.CorrectionType = 2 + i % 2;
      for (const bool invert : { false, true })
      {
        options.InvertSide = invert;
        const Tally tally = TrimWithRectangle(mesh, at, options);
        sum.Edges += tally.Edges;
        sum.Followed += tally.Followed;
      }
    }
    std::printf("%s: nodes on %d of %d sharp edges\n", name, sum.Followed, sum.Edges);
    Expect(sum.Edges >= 60, "too few sharp edges");
    // On the dome two columns that a corner leaves a bit more than half of stay, and their nodes
    // do not reach it.
    Expect(sum.Followed >= 0.97 * sum.Edges, "sharp edges are cut across");
  }
}

/// One face that turns, as a line drawn point by point makes it.
void CheckPolyline()
{
  const Mesh mesh = MakeMesh("sheet2");
  const Vec3& c = mesh.Box.Centre;
  const double r = 3 * (mesh.Box.HalfX + mesh.Box.HalfY);
  SplineSurface face;
  face.CountU = 3;
  face.CountV = 2;
  face.KnotsU = { 0, 0, 0.4, 1, 1 };
  face.KnotsV = { 0, 0, 1, 1 };
  const Vec3 corner = c + Vec3(0.13 * mesh.Box.HalfX, -0.21 * mesh.Box.HalfY, 0);
  for (const double z : { -r, r })
  {
    for (const Vec3& p :
      { Vec3(corner + Vec3(-r, -0.3 * r, 0)), corner, Vec3(corner + Vec3(-0.1 * r, r, 0)) })
    {
      face.Control.emplace_back(p[0], p[1], z, 1);
    }
  }
  Surface surface;
  surface.Data = ToPolyData(face);
  const Line edge{ corner - Vec3(0, 0, r), corner + Vec3(0, 0, r) };
  TrimOptions plain, noFloor, offcut, layer;
  noFloor.MinimumScaledJacobian = 0.0;
  offcut.ProduceOffcut = true;
  layer.InsertLayer = true; // not needed, so that none is
  for (const TrimOptions& options : { plain, noFloor, offcut, layer })
  {
    const Outcome outcome = RunTrim(mesh, surface, options);
    Expect(outcome.Clean(), "the polyline does not trim");
    const int nodes = CountNodesOn(outcome.Case.Trimmed, edge);
    const bool follows = options.MinimumScaledJacobian > 0.0;
    std::printf("polyline, floor %g%s%s: %d nodes at the corner\n", options.MinimumScaledJacobian,
      options.ProduceOffcut ? ", offcut" : "", options.InsertLayer ? ", layer" : "", nodes);
    Expect(nodes == (follows ? mesh.Nz + 1 : 0), "nodes at the corner of a polyline");
    if (options.ProduceOffcut)
    {
      Expect(CountNodesOn(outcome.Offcut, edge) == nodes, "the offcut misses the corner");
    }
  }
}

}

int main()
{
  CheckRectangles();
  CheckPolyline();
  return Wrong != 0;
}
