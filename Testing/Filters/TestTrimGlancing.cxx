/**
 * @file TestTrimGlancing.cxx
 * @brief Bent parts that are cut at small angles to their walls: what becomes of their skin, and
 * what is told where that does not keep its volume.
 */
#include "Expect.h"
#include "WarnedFindings.h"

#include <Eigen/Geometry>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <set>

using namespace judge;

namespace
{
/// A generator of its own for each trial.
class Draws
{
public:
  explicit Draws(unsigned number)
    : Engine(number)
  {
  }
  double Between(double low, double high)
  {
    return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(this->Engine);
  }
  int AnyOf(int count) { return static_cast<int>(this->Between(0, count)); }

private:
  std::mt19937 Engine;
};

/// Along the middle of a bent wall: where it is, and its outward normal, in a plane.
struct Bend
{
  Vec3 Place, Normal;
};

/// A piece of a tube, or two legs with a round bottom.
Bend WallAt(bool hasLegs, double radius, double angle, double share)
{
  const auto onCircle = [radius](double a) -> Bend
  {
    const Vec3 normal(std::cos(a), std::sin(a), 0);
    return { radius * normal, normal };
  };
  if (!hasLegs)
  {
    return onCircle(share * angle);
  }
  const double leg = 1.5 * radius, way = share * (2 * leg + M_PI * radius);
  if (way < leg)
  {
    return { Vec3(-radius, leg - way, 0), Vec3(-1, 0, 0) };
  }
  return way < leg + M_PI * radius
    ? onCircle(M_PI + (way - leg) / radius)
    : Bend{ Vec3(radius, way - leg - M_PI * radius, 0), Vec3(1, 0, 0) };
}

/// Bent in one direction, straight or tapered in the other.
Mesh BentWall(Draws& draws)
{
  const bool hasLegs = draws.AnyOf(3) == 0;
  const int layers = 1 + draws.AnyOf(3), around = 10 + draws.AnyOf(18), along = 8 + draws.AnyOf(8);
  const double radius = draws.Between(2.5, 6), thickness = draws.Between(0.25, 1);
  const double angle = draws.Between(1, 6), taper = hasLegs ? 0 : draws.Between(-0.4, 0.4);
  const double edge = radius * (hasLegs ? 3 + M_PI : angle) / around;
  RawMesh raw;
  for (int k = 0; k <= layers; ++k)
  {
    for (int j = 0; j <= along; ++j)
    {
      for (int i = 0; i <= around; ++i)
      {
        const double wide = 1 + taper * (static_cast<double>(j) / along - 0.5);
        const Bend at = WallAt(hasLegs, wide * radius, angle, static_cast<double>(i) / around);
        raw.Points.push_back(at.Place + thickness * k / layers * at.Normal + Vec3(0, 0, j * edge));
      }
    }
  }
  const auto node = [&](int i, int j, int k)
  { return static_cast<Id>((k * (along + 1) + j) * (around + 1) + i); };
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < along; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        raw.Add(8,
          { node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
            node(i, j + 1, k + 1) });
      }
    }
  }
  MeshOptions options;
  options.Data = false;
  Mesh mesh = Finish("bent wall", raw, BoxOf(raw, edge), options);
  mesh.Flat = false;
  return mesh;
}

/// A plane or a sphere that crosses the wall under 5 to 35 degrees, in the middle of some element.
Surface GlancingSurface(const Mesh& mesh, Draws& draws)
{
  const Model model(mesh.Grid);
  const auto p = model.Corners(draws.AnyOf(static_cast<int>(model.Elements.size())));
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : p)
  {
    middle += corner / 8;
  }
  const Vec3 out = (p[4] + p[5] + p[6] + p[7] - p[0] - p[1] - p[2] - p[3]).normalized();
  const Vec3 u = (p[1] + p[2] - p[0] - p[3]).normalized();
  const double turn = draws.Between(0, 2 * M_PI), lean = draws.Between(5, 35) * M_PI / 180;
  const Vec3 along = std::cos(turn) * u + std::sin(turn) * out.cross(u);
  const Vec3 normal = std::cos(lean) * out + std::sin(lean) * along;
  const double radius = draws.Between(1.5, 15);
  return draws.AnyOf(3) == 0 ? PlaneThrough(middle, normal, 60)
                             : SphereAt(middle + radius * normal, radius);
}

/// What the exterior of a mesh is far from.
class Border
{
public:
  explicit Border(const Mesh& mesh)
  {
    const Model model(mesh.Grid);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : model.Points)
    {
      points->InsertNextPoint(p.data());
    }
    vtkNew<vtkCellArray> triangles;
    for (const Facet& facet : FacetTable(model).Exterior)
    {
      for (const auto& corner : { std::array<int, 3>{ 0, 1, 2 }, std::array<int, 3>{ 0, 2, 3 } })
      {
        triangles->InsertNextCell(3);
        for (const int i : corner)
        {
          triangles->InsertCellPoint(facet.Node[i]);
        }
      }
    }
    this->Skin->SetPoints(points);
    this->Skin->SetPolys(triangles);
    this->Locator->SetDataSet(this->Skin);
    this->Locator->BuildLocator();
  }

  double Distance(const Vec3& p)
  {
    double on[3], squared = 0;
    vtkIdType cell = -1;
    int part = 0;
    this->Locator->FindClosestPoint(p.data(), on, cell, part, squared);
    return std::sqrt(squared);
  }

private:
  vtkNew<vtkPolyData> Skin;
  vtkNew<vtkStaticCellLocator> Locator;
};

double LongestEdge(const Model& model, Id c)
{
  double longest = 0;
  for (const Facet& facet : FacetsOf(model.Elements[c], c))
  {
    for (int i = 0; i < facet.Size(); ++i)
    {
      const Vec3 &a = model.Points[facet.Node[i]],
                 &b = model.Points[facet.Node[(i + 1) % facet.Size()]];
      longest = std::max(longest, (b - a).norm());
    }
  }
  return longest;
}

/// Facets of the exterior whose middle is off both the border and the surface by a quarter of an
/// edge, and of which nothing is told. Those with a node left off the surface are another matter.
int CountSilentBridges(const Mesh& mesh, const Surface& surface, const Outcome& outcome, int& found)
{
  const Model whole(mesh.Grid), kept(outcome.Case.Trimmed);
  Border border(mesh);
  vtkCellData* const cells = outcome.Case.Trimmed->GetCellData();
  vtkDataArray* const ids = cells->GetArray("vtkOriginalCellIds");
  vtkDataArray* const told = cells->GetArray("Feasibility");
  vtkDataArray* const left = outcome.Case.Trimmed->GetPointData()->GetArray("DistanceLeft");
  int silent = 0;
  for (const Facet& facet : FacetTable(kept).Exterior)
  {
    Vec3 middle = Vec3::Zero();
    bool hasLeft = false;
    for (int i = 0; i < facet.Size(); ++i)
    {
      hasLeft |= left->GetComponent(facet.Node[i], 0) > 0;
      middle += kept.Points[facet.Node[i]] / facet.Size();
    }
    const Id c = static_cast<Id>(ids->GetComponent(facet.Owner, 0));
    const double gap = 0.25 * LongestEdge(whole, c);
    if (!hasLeft && border.Distance(middle) > gap && std::abs(surface.Signed(middle)) > gap)
    {
      ++found;
      silent += told->GetComponent(facet.Owner, 0) == 0;
    }
  }
  return silent;
}

void TestBentWalls(unsigned first, unsigned count)
{
  int lacking = 0, forNothing = 0, bridges = 0;
  for (unsigned number = first; number < first + count; ++number)
  {
    Draws draws(number);
    const Mesh mesh = BentWall(draws);
    const Surface surface = GlancingSurface(mesh, draws);
    TrimOptions options;
    options.ProduceOffcut = true;
    options.InvertSide = draws.AnyOf(2) == 0;
    options.CorrectionType = 2 + draws.AnyOf(2);
    options.Optimization = std::min(2, draws.AnyOf(4));
    const Outcome outcome = RunTrim(mesh, surface, options);
    const std::string wall = "bent wall " + std::to_string(number);
    Expect(
      outcome.Clean() && CountWarned(outcome, "distorted beyond repair") == 0, wall + ": invalid");
    if (!outcome.Clean())
    {
      continue;
    }
    const double missing = MeasureMissing(mesh, outcome);
    const bool told = CountWarned(outcome, CornerPhrase) > 0;
    const std::string name = wall + ", missing " + std::to_string(missing);
    lacking += std::abs(missing) > 0.55;
    forNothing += told && std::abs(missing) < 0.05;
    Expect(told || std::abs(missing) < 0.55, name + ": nothing is told");
    Expect(!told || std::abs(ToldMissing(outcome) - missing) < 0.01 + 0.06 * std::abs(missing),
      name + ": told " + std::to_string(ToldMissing(outcome)));
    const int silent = CountSilentBridges(mesh, surface, outcome, bridges);
    Expect(silent == 0, name + ": facets across a bend " + std::to_string(silent));
  }
  std::printf("%u bent walls: volume is missing in %d, told of for nothing in %d; %d facets across "
              "bends\n",
    count, lacking, forNothing, bridges);
  Expect(lacking > 0, "bent walls: no volume is missing anywhere");
  Expect(10 * forNothing <= static_cast<int>(count), "bent walls: too much is told");
}

// At a sharp corner of the surface that comes to lie along the wall of a tube: going there the
// node took those behind it along, which filled the tube by a tenth of the part.
void TestCornerOnTube()
{
  const Mesh tube = MakePart("tube");
  Placement at;
  at.X = -0.054;
  at.Y = -0.221;
  at.Angle = 0.010;
  at.Size = 0.554;
  at.Reversed = true;
  TrimOptions options;
  options.InvertSide = true;
  options.ProduceOffcut = true;
  Report report("corner on a tube");
  const Surface surface = MakeSurface("rectangle", tube.Box, at);
  const Outcome outcome = RunAndJudge(tube, surface, options, report);
  const double missing = MeasureMissing(tube, outcome);
  Wrong += report.Failures();
  Expect(std::abs(missing) < 1, "corner on a tube: missing " + std::to_string(missing));
}

/// Elements with a point at which no facets that have it join them to most of the elements there;
/// pieces of one element count once.
std::set<Id> FindHinging(const Model& model, vtkDataArray* elementOf)
{
  std::map<Id, std::vector<Id>> cellsAt;
  for (Id c = 0; c < static_cast<Id>(model.Elements.size()); ++c)
  {
    const Element& element = model.Elements[c];
    std::for_each(element.Node.begin(), element.Node.begin() + element.Size,
      [&](Id p) { cellsAt[p].push_back(c); });
  }
  std::set<Id> hinging;
  for (const auto& [point, cells] : cellsAt)
  {
    std::map<Id, Id> part; // by cell, the least one of its part
    std::map<std::array<Id, 4>, Id> owners;
    for (const Id c : cells)
    {
      part[c] = c;
    }
    for (const Id c : cells)
    {
      for (const Facet& facet : FacetsOf(model.Elements[c], c))
      {
        if (std::count(facet.Node.begin(), facet.Node.end(), point) == 0)
        {
          continue;
        }
        const Id other = part[owners.emplace(FacetKey(facet), c).first->second];
        const Id own = part[c];
        for (auto& item : part)
        {
          item.second = item.second == own ? other : item.second;
        }
      }
    }
    std::map<Id, int> sizes;
    for (const auto& item : part)
    {
      ++sizes[item.second];
    }
    const auto largest = std::max_element(sizes.begin(), sizes.end(),
      [](const auto& one, const auto& other) { return one.second < other.second; });
    for (const auto& item : part)
    {
      if (item.second != largest->first)
      {
        hinging.insert(static_cast<Id>(elementOf->GetComponent(item.first, 0)));
      }
    }
  }
  return hinging;
}

/// All that hang are told of, whatever else their elements are.
void ExpectHinges(
  const std::string& name, const Mesh& sheet, const Surface& surface, const TrimOptions& options)
{
  const Outcome outcome = RunTrim(sheet, surface, options);
  vtkCellData* const cells = outcome.Offcut->GetCellData();
  const std::set<Id> hinging =
    FindHinging(Model(outcome.Offcut), cells->GetArray("vtkOriginalCellIds"));
  vtkDataArray* const told = cells->GetArray("Shortfall");
  std::set<Id> elements; // some are in two pieces
  for (vtkIdType c = 0; c < told->GetNumberOfTuples(); ++c)
  {
    if (told->GetComponent(c, 0) == 6)
    {
      elements.insert(static_cast<Id>(cells->GetArray("vtkOriginalCellIds")->GetComponent(c, 0)));
    }
  }
  const char* const phrase = "of the offcut hang";
  const int beside = CountBesideGraver(outcome, phrase);
  Expect(!hinging.empty() && CountWarned(outcome, phrase) == static_cast<int>(hinging.size()) &&
      elements.size() + beside == hinging.size(),
    name + ": of " + std::to_string(hinging.size()) + " told of " +
      std::to_string(CountWarned(outcome, phrase)) + ", in the array " +
      std::to_string(elements.size()));
}

// Where three elements meet at the border two of them may come to hang on the rest of the offcut by
// an edge.
void TestHinges()
{
  const Mesh sheet = MakeMesh("irregular");
  const Placement along{ 0.095, 0.380, 3.632, 0.106, 0.627, 764339 };
  TrimOptions options;
  options.Optimization = 1;
  options.MinimumScaledJacobian = 0;
  options.EliminationFraction = 0.709;
  options.InvertSide = true;
  options.ProduceOffcut = true;
  ExpectHinges("hinges", sheet, MakeSurface("scurve", sheet.Box, along), options);
  // All of them are below the floor as well.
  const Placement about{ 0.65416738727866419, 0.31951888415069685, 1.6352089169925486,
    0.15152881569682466, 0.60651034268603077, 210 };
  TrimOptions simple;
  simple.Optimization = 0;
  simple.ProduceOffcut = true;
  ExpectHinges("hinges below the floor", sheet, MakeSurface("cone", sheet.Box, about), simple);
}
}

int main(int argc, char* argv[])
{
  const unsigned first = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 1;
  const unsigned count = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 40;
  TestCornerOnTube();
  TestHinges();
  TestBentWalls(first, count);
  // Many nodes past each of which there is little: nothing was told.
  TestBentWalls(187, 1);
  TestBentWalls(259, 1);
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
