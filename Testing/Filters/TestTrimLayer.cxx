/**
 * @file TestTrimLayer.cxx
 * @brief InsertLayer: blocks that are cut aslant to their elements end on the surface.
 *
 * TestTrimLayer [trial|all]
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace judge;

namespace
{
struct Tally
{
  int Left = 0, LeftWithLayer = 0, Taken = 0;
};

/// Of what lies on the kept side, by places spread evenly over all elements.
double VolumeInside(const Mesh& mesh, const Surface& surface)
{
  constexpr int Places = 4; // along each edge
  const Model model(mesh.Grid);
  double volume = 0;
  for (std::size_t e = 0; e < model.Elements.size(); ++e)
  {
    const auto corners = model.Corners(e);
    int inside = 0;
    for (int k = 0; k < Places * Places * Places; ++k)
    {
      const double u = (k % Places + 0.5) / Places, v = (k / Places % Places + 0.5) / Places,
                   w = (k / Places / Places + 0.5) / Places;
      const auto quad = [&](int i)
      {
        return (1 - v) * ((1 - u) * corners[i] + u * corners[i + 1]) +
          v * ((1 - u) * corners[i + 3] + u * corners[i + 2]);
      };
      inside += surface.Roughly((1 - w) * quad(0) + w * quad(4)) <= 0;
    }
    volume += VolumeOf(corners, 8) * inside / (Places * Places * Places);
  }
  return volume;
}

/// Judged without and with a layer, which is taken only where it leaves less.
void Compare(const std::string& trial, const Mesh& mesh, const Surface& surface,
  double largestError, Tally& tally)
{
  TrimOptions options;
  const Outcome without = RunTrim(mesh, surface, options);
  Expect(Number(without.Case.Trimmed, "InsertedElements") == 0, trial + ": elements unasked for");
  Expect(!without.Case.Trimmed->GetCellData()->GetArray("Inserted") &&
      !without.Case.Trimmed->GetPointData()->GetArray("Inserted"),
    trial + ": an array unasked for");
  options.InsertLayer = true;
  Report report("layer " + trial);
  const Outcome with = RunAndJudge(mesh, surface, options, report);
  Wrong += report.Failures();
  const int left = CountLeft(without.Case.Trimmed), now = CountLeft(with.Case.Trimmed);
  Expect(CountWarned(with, "try InsertLayer") == 0, trial + ": a layer is advised though it is on");
  const bool taken = Number(with.Case.Trimmed, "InsertedElements") > 0;
  Expect(left > 0 || !taken, trial + ": a layer where no node was left off");
  Expect(taken || now == left, trial + ": another trim without a layer");
  const double volume = VolumeInside(mesh, surface);
  const double gained = Number(with.Case.Trimmed, "Volume") - volume;
  Expect(!taken || std::abs(gained) < largestError * volume,
    trial + ": a volume wrong by " + std::to_string(gained));
  tally.Left += left;
  tally.LeftWithLayer += now;
  tally.Taken += taken;
}

struct Cut
{
  std::string Kind;
  double Lean;
  double LargestError; ///< of the volume; chords cost more where the cut is round
};

void TestAslant()
{
  Tally tally;
  for (const std::string name : { "block", "bar" })
  {
    const Mesh mesh = MakeMesh(name);
    for (const Cut& cut :
      std::initializer_list<Cut>{ { "plane", 0.35, 0.006 }, { "plane", 0.6, 0.006 },
        { "wavy", 0.35, 0.006 }, { "wavy", 0.6, 0.008 }, { "cylinder", 0.6, 0.05 } })
    {
      for (const bool reversed : { false, true })
      {
        Placement at;
        at.Angle = 0.7;
        at.Lean = cut.Lean;
        at.Size = 0.55;
        at.Reversed = reversed;
        Compare(
          name + " " + cut.Kind + " " + std::to_string(cut.Lean) + (reversed ? " reversed" : ""),
          mesh, MakeSurface(cut.Kind, mesh.Box, at), cut.LargestError, tally);
      }
    }
  }
  std::printf("left off without %d, with a layer %d, taken %d times\n", tally.Left,
    tally.LeftWithLayer, tally.Taken);
  Expect(tally.Taken > 16, "hardly a layer was taken");
  Expect(tally.LeftWithLayer < 0.06 * tally.Left, "too many nodes are left with a layer");
}

Placement At(double x, double y, double angle, double lean, double size)
{
  Placement place;
  place.X = x;
  place.Y = y;
  place.Angle = angle;
  place.Lean = lean;
  place.Size = size;
  return place;
}

/// Sections with inner edges, where a layer has room only if other elements stay beneath it.
void TestInnerEdges()
{
  struct Trial
  {
    std::string Mesh, Kind;
    Placement At;
  };
  Tally tally;
  for (const Trial& trial :
    std::initializer_list<Trial>{ { "angle", "slot", At(0.342, -0.324, 5.176, 0.59, 0.431) },
      { "angle", "scurve", At(0.098, -0.213, 5.313, 0.463, 0.422) },
      { "tee", "slot", At(-0.073, 0.391, 1.629, 0.716, 0.35) } })
  {
    const Mesh mesh = MakeMesh(trial.Mesh);
    Compare(trial.Mesh + " " + trial.Kind, mesh, MakeSurface(trial.Kind, mesh.Box, trial.At), 0.05,
      tally);
  }
  std::printf("inner edges: left off without %d, with a layer %d, taken %d times\n", tally.Left,
    tally.LeftWithLayer, tally.Taken);
  Expect(tally.Taken == 3, "no layer at an inner edge");
  Expect(tally.LeftWithLayer == 0, "nodes are left at inner edges");
}

/// A ball of bent elements, where faces of the cut are nearly of one direction, and a rod with a
/// skin of plane facets: neither is a ridge.
void TestBent()
{
  Tally tally;
  const Mesh ball = MakeMesh("ball");
  Compare("ball rectangle", ball,
    MakeSurface("rectangle", ball.Box, At(-0.1, -0.179, 1.505, 0.46, 0.345)), 0.05, tally);
  Expect(tally.Taken == 1 && tally.LeftWithLayer == 0, "nodes left off in the ball");
  const Mesh bar = MakeMesh("bar");
  Compare("bar rectangle", bar,
    MakeSurface("rectangle", bar.Box, At(-0.697, -0.126, 3.06, 0.27, 0.59)), 0.05, tally);
  Expect(tally.Taken == 2 && tally.LeftWithLayer == 0, "nodes left off in the rod");
}

/// A plane along the diagonal of the elements: each has a corner with three facets at the cut.
void TestDiagonal()
{
  const Mesh mesh = MakeMesh("block");
  Placement at;
  at.Angle = std::atan(1.0);
  at.Lean = std::atan(std::sqrt(0.5));
  const Surface plane = MakeSurface("plane", mesh.Box, at);
  TrimOptions options;
  const Outcome without = RunTrim(mesh, plane, options);
  Expect(CountLeft(without.Case.Trimmed) > 20, "the diagonal plane is no trouble without a layer");
  options.InsertLayer = true;
  Report report("layer diagonal");
  const Outcome with = RunAndJudge(mesh, plane, options, report);
  Wrong += report.Failures();
  Expect(CountLeft(with.Case.Trimmed) == 0, "nodes left off the diagonal plane");
  Expect(Number(with.Case.Trimmed, "MinimumScaledJacobian") > 0.4,
    "the diagonal plane's elements are worth " +
      std::to_string(Number(with.Case.Trimmed, "MinimumScaledJacobian")));
}

/// The sine-like determinant of the corner that a plane makes with each pair of a box's sides, the
/// smallest of three.
double NarrowestCorner(const Vec3& normal)
{
  double narrowest = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = normal[axis], b = normal[(axis + 1) % 3], c = normal[(axis + 2) % 3];
    narrowest = std::min(narrowest, a * a / (std::hypot(a, b) * std::hypot(a, c)));
  }
  return narrowest;
}

/// Planes aslant to a block of cubes, as long as they leave its ridges under such angles that an
/// element may have them: with a layer all of their nodes are on them.
void TestTilted()
{
  constexpr int Size = 12;
  MeshOptions plain;
  plain.Data = false;
  const Mesh block = Block(Size, Size, Size, plain);
  int planes = 0, left = 0;
  for (int i = 0; planes < 12; ++i)
  {
    const auto spread = [i](double step) { return std::fmod(0.5 + i * step, 1.0); };
    const Vec3 normal =
      Vec3(0.3 + spread(0.8191725134), 0.3 + spread(0.6710436067), 0.3 + spread(0.5497004779))
        .normalized();
    if (NarrowestCorner(normal) < 0.25)
    {
      continue;
    }
    TrimOptions options;
    options.InsertLayer = true;
    Report report("layer tilted " + std::to_string(i));
    const Outcome outcome = RunAndJudge(block,
      PlaneThrough(
        block.Box.Centre + Vec3(spread(0.38), spread(0.29), spread(0.73)), normal, 10 * Size),
      options, report);
    Wrong += report.Failures();
    ++planes;
    left += CountLeft(outcome.Case.Trimmed);
  }
  std::printf("tilted: %d left off by %d planes\n", left, planes);
  Expect(left <= 3, "nodes left off tilted planes");
}

/// Hexahedra that are divided tetrahedra, in a cube and in a body with a curved skin: no plane is
/// along any of their facets, and hundreds of the layer's elements begin poor or inverted.
void TestDivided()
{
  struct Trial
  {
    double Bulge;
    Vec3 Normal;
    double Offset;
  };
  int left = 0, planes = 0;
  for (const auto& [bulge, normal, offset] : { Trial{ 0, Vec3(1, 0.3, 0.2), 0.3 },
         Trial{ 0, Vec3(1, 0.8, 0.6), 0.4 }, Trial{ 0, Vec3(0.2, 1, 0.1), -0.4 },
         Trial{ 0.2, Vec3(1, 0.3, 0.2), 0.3 }, Trial{ 0.2, Vec3(0.1, 1, -0.4), 0.6 } })
  {
    const Mesh mesh = DividedTetrahedra(4, bulge);
    TrimOptions options;
    options.InsertLayer = true;
    Report report("layer divided " + std::to_string(planes));
    const Vec3 unit = normal.normalized();
    const Outcome outcome =
      RunAndJudge(mesh, PlaneThrough(mesh.Box.Centre + offset * unit, unit, 40), options, report);
    Wrong += report.Failures();
    ++planes;
    left += CountLeft(outcome.Case.Trimmed);
    Expect(Number(outcome.Case.Trimmed, "MinimumScaledJacobian") > 0.25,
      "divided: elements are worth " +
        std::to_string(Number(outcome.Case.Trimmed, "MinimumScaledJacobian")));
    Expect(Number(outcome.Case.Trimmed, "InsertedElements") > 20, "divided: no layer");
  }
  std::printf("divided tetrahedra: %d left off by %d planes\n", left, planes);
  Expect(left == 0, "nodes left off divided tetrahedra");
}

/// A node behind the cut that slid to the surface, on a twisted skin that the layer divides: it
/// goes back to the skin along the surface.
void TestBehindCut()
{
  const Mesh twist = MakeMesh("twist");
  Placement place = At(-0.138, -0.670, 4.217, 0, 0.544);
  place.Seed = 269838;
  TrimOptions options;
  options.CorrectionType = 3;
  options.Optimization = 1;
  options.InsertLayer = true;
  Report report("layer behind the cut");
  RunAndJudge(twist, MakeSurface("roundrect", twist.Box, place), options, report);
  Wrong += report.Failures();
}

/// Columns that go though hardly any of them lies beyond the surface, so that the layer has room.
void TestFates()
{
  const Mesh sheet = Sheet(5, 5, 3, Vec3(1, 1, 1));
  const Vec3 corner(sheet.Grid->GetPoint(0));
  TrimOptions options;
  options.InsertLayer = true;
  const Outcome outcome = RunTrim(sheet, SphereAt(corner + Vec3(4.8, 2.6, 0.3), 2.8), options);
  Expect(Number(outcome.Case.Trimmed, "InsertedElements") > 0, "fates: no layer");
  vtkCellData* cells = outcome.Case.Whole->GetCellData();
  vtkDataArray* ids = outcome.Case.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
  std::set<vtkIdType> stays;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    stays.insert(static_cast<vtkIdType>(ids->GetComponent(i, 0)));
  }
  const Model model(sheet.Grid);
  const auto columnOf = [&](vtkIdType c)
  {
    const Vec3 low = model.Corners(c)[0] - corner;
    return std::make_pair(std::lround(low[0]), std::lround(low[1]));
  };
  std::map<std::pair<long, long>, double> beyond; // of each column, in elements
  for (vtkIdType c = 0; c < outcome.Case.Whole->GetNumberOfCells(); ++c)
  {
    beyond[columnOf(c)] += cells->GetArray("EliminatedFraction")->GetComponent(c, 0);
  }
  int gone = 0;
  for (vtkIdType c = 0; c < outcome.Case.Whole->GetNumberOfCells(); ++c)
  {
    if (stays.count(c) == 0 && beyond[columnOf(c)] < 0.3)
    {
      ++gone;
      Expect(cells->GetArray("Rescue")->GetComponent(c, 0) > 0,
        "fates: cell " + std::to_string(c) + " went without a word");
    }
  }
  Expect(gone > 0, "fates: all columns went by their volume");
}

/// Elements of the layer stay below the floor whatever is left: more and more of it made others of
/// them so, and ten nodes stayed off the surface.
void TestFewest()
{
  const Mesh block = Sheet(4, 5, 7, Vec3(1, 1, 1));
  const Vec3 middle = Vec3(block.Grid->GetCenter());
  TrimOptions options;
  options.InsertLayer = true;
  options.MinimumScaledJacobian = 0.5;
  Report report("layer with the fewest faulty elements");
  const Outcome outcome = RunAndJudge(block,
    PlaneThrough(middle + Vec3(-0.23, -0.1, 0.05), Vec3(-0.88, 0.66, 0.9), 40), options, report);
  Wrong += report.Failures();
  const int left = CountLeft(outcome.Case.Trimmed);
  Expect(left <= 5, "fewest: " + std::to_string(left) + " nodes left off");
}

/// Values that are linear in space stay so where they are mapped; else what was inserted has those
/// of what it stands on.
void TestValues()
{
  Mesh mesh = MakeMesh("block");
  const auto field = [](const Vec3& p) { return 1 + 0.3 * p[0] - 0.2 * p[1] + 0.7 * p[2]; };
  const Model model(mesh.Grid);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Linear");
  for (const Vec3& point : model.Points)
  {
    values->InsertNextValue(field(point));
  }
  mesh.Grid->GetPointData()->AddArray(values);
  Placement at;
  at.Angle = 0.7;
  at.Lean = 0.6;
  const Surface plane = MakeSurface("plane", mesh.Box, at);
  for (const bool map : { false, true })
  {
    TrimOptions options;
    options.InsertLayer = true;
    options.MapValues = map;
    const Outcome outcome = RunTrim(mesh, plane, options);
    const Model out(outcome.Case.Trimmed);
    vtkDataArray* own = outcome.Case.Trimmed->GetPointData()->GetArray("Linear");
    vtkDataArray* ids = outcome.Case.Trimmed->GetPointData()->GetArray("vtkOriginalPointIds");
    vtkDataArray* inserted = outcome.Case.Trimmed->GetPointData()->GetArray("Inserted");
    int checked = 0;
    for (std::size_t i = 0; i < out.Points.size(); ++i)
    {
      checked += inserted->GetComponent(i, 0) > 0;
      const double wanted =
        map ? field(out.Points[i]) : values->GetValue(static_cast<Id>(ids->GetComponent(i, 0)));
      Expect(std::abs(own->GetComponent(i, 0) - wanted) < 1e-9, "a node has another value");
    }
    Expect(checked > 20, "hardly a node was inserted");
  }
}

/// The result is the input of the next trim.
void TestSequence()
{
  const Mesh mesh = MakeMesh("block");
  Placement at;
  at.Angle = 0.7;
  at.Lean = 0.6;
  TrimOptions options;
  options.InsertLayer = true;
  Mesh next = mesh;
  next.Grid = RunTrim(mesh, MakeSurface("plane", mesh.Box, at), options).Case.Trimmed;
  at.Angle = 2.8;
  at.X = -0.2;
  const Outcome outcome = RunTrim(next, MakeSurface("plane", mesh.Box, at), options);
  Expect(outcome.Clean(), "an error at the second trim");
  Expect(Number(outcome.Case.Trimmed, "CertifiedElements") ==
      Number(outcome.Case.Trimmed, "TouchedElements"),
    "the second trim is not certified");
}

/// A layer may put nodes beyond the surface, beneath others that are left off it: they are told of,
/// though the relaxation leaves them where the layer has them.
void TestBeneathNodesLeft()
{
  const Mesh block = Sheet(6, 6, 6, Vec3(1, 1, 1));
  struct Ball
  {
    Vec3 Centre;
    double Radius;
  };
  for (const auto& [at, radius] :
    { Ball{ Vec3(0.9, 1.3, 6.5), 6.6 }, Ball{ Vec3(1.5, 2.0, 3.4), 3.8 } })
  {
    const Vec3 centre = Vec3(block.Grid->GetPoint(0)) + at;
    TrimOptions options;
    options.InsertLayer = true;
    const Outcome outcome = RunTrim(block, SphereAt(centre, radius), options);
    vtkUnstructuredGrid* trimmed = outcome.Case.Trimmed;
    vtkPointData* points = trimmed->GetPointData();
    int beneath = 0;
    for (vtkIdType i = 0; i < trimmed->GetNumberOfPoints(); ++i)
    {
      const double beyond = (Vec3(trimmed->GetPoint(i)) - centre).norm() - radius;
      if (beyond > 1e-6)
      {
        beneath += points->GetArray("Inserted")->GetComponent(i, 0) > 0;
        Expect(points->GetArray("DistanceLeft")->GetComponent(i, 0) > 0,
          "a node " + std::to_string(beyond) + " beyond the surface is not told of");
      }
    }
    Expect(beneath > 0, "no inserted node beyond the surface");
  }
}

// A layer is thin from the start, and is not to be pressed to a twentieth of that.
void TestThickness()
{
  const Mesh mesh = MakeMesh("angle");
  Placement at;
  at.X = 0.146;
  at.Y = -0.053;
  at.Angle = 0.325;
  at.Size = 0.615;
  at.Seed = 407514;
  TrimOptions options;
  options.Optimization = 1;
  options.InvertSide = true;
  options.InsertLayer = true;
  const Outcome outcome = RunTrim(mesh, MakeSurface("roundrect", mesh.Box, at), options);
  Expect(Number(outcome.Case.Trimmed, "InsertedElements") > 20, "thickness: no layer is inserted");
  Expect(CountWarned(outcome, "less than a twentieth") == 0, "thickness: a layer has none");
}
}

int main(int argc, char** argv)
{
  const std::vector<std::pair<std::string, void (*)()>> trials = { { "aslant", &TestAslant },
    { "edges", &TestInnerEdges }, { "bent", &TestBent }, { "diagonal", &TestDiagonal },
    { "tilted", &TestTilted }, { "divided", &TestDivided }, { "behind", &TestBehindCut },
    { "fates", &TestFates }, { "fewest", &TestFewest }, { "values", &TestValues },
    { "sequence", &TestSequence }, { "beneath", &TestBeneathNodesLeft },
    { "thickness", &TestThickness } };
  const std::string chosen = argc > 1 ? argv[1] : "all";
  int run = 0;
  for (const auto& [name, trial] : trials)
  {
    if (chosen == "all" || chosen == name)
    {
      trial();
      ++run;
    }
  }
  Expect(run > 0, "there is no trial " + chosen);
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
