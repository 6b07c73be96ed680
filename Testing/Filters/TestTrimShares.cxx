/**
 * @file TestTrimShares.cxx
 * @brief V^e of elements in which the surface has a sharp edge, or bends strongly, against samples;
 * and which go by it.
 */
#include "Expect.h"
#include "HalvedShare.h"
#include "Jacobian.h"
#include "RandomPlaces.h"
#include "RunTrim.h"
#include "SampleSurfaces.h"

#include <vtkCellData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

using namespace judge;
using trim::ElementPoints;

namespace
{
constexpr double Far = 50.0; // surfaces go on to there
constexpr double Limit = 0.02;
constexpr double Unlikely = 0.123; // as a share by tetrahedra
using Side = std::function<bool(const Vec3&)>;

ElementPoints Cube(const Vec3& size)
{
  ElementPoints points;
  for (int i = 0; i < 8; ++i)
  {
    const Vec3 corner((i + 1) / 2 % 2, i / 2 % 2, i / 4);
    points[i] = size.cwiseProduct(corner - Vec3(0.5, 0.5, 0.5));
  }
  return points;
}

ElementPoints Distorted(ElementPoints points, const Vec3& size)
{
  for (Vec3& point : points)
  {
    point += 0.15 * size.cwiseProduct(samples::RandomVector());
  }
  return points;
}

ElementPoints Wedge(const Vec3& size)
{
  const ElementPoints cube = Cube(size);
  return { cube[0], cube[1], cube[3], cube[4], cube[5], cube[7] };
}

double SampledShare(const ElementPoints& points, int count, const Side& isBeyond)
{
  constexpr int n = 40;
  double all = 0.0, beyond = 0.0;
  for (int i = 0; i < n * n * n; ++i)
  {
    const Vec3 at = (Vec3(i % n, i / n % n, i / n / n) + Vec3(0.5, 0.5, 0.5)) / n;
    if (count == 8 || at[0] + at[1] < 1.0)
    {
      const double volume = std::abs(trim::MapDerivative(points, count, at).determinant());
      all += volume;
      beyond += isBeyond(trim::MapToSpace(points, count, at)) ? volume : 0.0;
    }
  }
  return beyond / all;
}

void ExpectShare(const std::string& name, const ElementPoints& points, int count,
  const nurbs::TrimmingSurface& surface, const Side& isBeyond)
{
  const auto share = trim::HalveForShare(points, count, surface, Unlikely);
  const double sampled = SampledShare(points, count, isBeyond);
  Expect(share && std::abs(*share - sampled) < Limit,
    name + ": a share of " + std::to_string(share.value_or(-1.0)) + " for " +
      std::to_string(sampled));
}

/// Two half planes from a line through a place on; what is not between them goes.
struct Roof
{
  Roof(const Vec3& at, double angle)
    : At(at)
    , Along(samples::RandomVector().normalized())
    , Middle(this->Along.cross(samples::RandomVector()).normalized())
    , Cosine(std::cos(0.5 * angle))
    , Surface({ this->Slope(0.5 * angle), this->Slope(-0.5 * angle) }, 1e-6)
  {
    if (this->Surface.ClosestPoint(at + 0.1 * this->Middle).SignedDistance > 0.0)
    {
      this->Surface.Flip();
    }
  }

  bool IsBeyond(const Vec3& p) const
  {
    Vec3 way = p - this->At;
    way -= way.dot(this->Along) * this->Along;
    return way.dot(this->Middle) < this->Cosine * way.norm();
  }

  nurbs::NurbsSurface Slope(double turn) const
  {
    const Vec3 down =
      std::cos(turn) * this->Middle + std::sin(turn) * this->Along.cross(this->Middle);
    return samples::Plane(this->At - Far * this->Along, 2 * Far * this->Along, Far * down);
  }

  Vec3 At, Along, Middle;
  double Cosine;
  nurbs::TrimmingSurface Surface;
};

void TestRoofs()
{
  samples::Random.seed(51);
  int bent = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const Vec3 size = trial % 4 == 0 ? Vec3(1, 1, 0.05) : Vec3(1, 0.8, 1.3);
    const int count = trial % 3 == 0 ? 6 : 8;
    const ElementPoints points = count == 6 ? Wedge(size) : Distorted(Cube(size), size);
    const Roof roof(0.3 * size.cwiseProduct(samples::RandomVector()), samples::Uniform(0.3, 2.5));
    const Vec3 normal = roof.Surface.ClosestPoint(points[0]).Normal;
    bent += !trim::IsNearlyPlane(points, count, roof.Surface, normal);
    ExpectShare("roof " + std::to_string(trial), points, count, roof.Surface,
      [&roof](const Vec3& p) { return roof.IsBeyond(p); });
  }
  Expect(bent == 200, "roofs: only " + std::to_string(bent) + " are no planes");
}

void TestOtherShapes()
{
  samples::Random.seed(52);
  for (int trial = 0; trial < 20; ++trial)
  {
    const ElementPoints points = Distorted(Cube(Vec3(1, 1, 1)), Vec3(1, 1, 1));
    const double width = samples::Uniform(0.1, 0.3), z = samples::Uniform(-0.3, 0.3);
    const nurbs::TrimmingSurface strip(
      samples::BoxShell(Vec3(-Far, -Far, z), Vec3(Far, Far, z + width)), 1e-6);
    ExpectShare("strip " + std::to_string(trial), points, 8, strip,
      [&](const Vec3& p) { return p.z() < z || p.z() > z + width; });
    const double radius = samples::Uniform(0.3, 0.8);
    const nurbs::TrimmingSurface ball({ samples::Sphere(radius) }, 1e-6);
    const bool outwards = ball.ClosestPoint(Vec3(0, 0, 2 * radius)).SignedDistance > 0.0;
    ExpectShare("ball " + std::to_string(trial), points, 8, ball,
      [&](const Vec3& p) { return (p.norm() > radius) == outwards; });
  }
}

// Tetrahedra measure what a plane leaves, to the last bit; of one that ends nothing is known.
void TestPlanes()
{
  samples::Random.seed(53);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Vec3 size = trial % 2 == 0 ? Vec3(1, 1, 0.05) : Vec3(1, 0.8, 1.3);
    const ElementPoints points = Distorted(Cube(size), size);
    const Vec3 u = samples::RandomVector().normalized();
    const Vec3 normal = u.cross(samples::RandomVector()).normalized();
    const auto plane = [&](double from)
    {
      return nurbs::TrimmingSurface({ samples::Plane(from * u - Far * normal.cross(u),
                                      (Far - from) * u, 2 * Far * normal.cross(u)) },
        1e-6);
    };
    const nurbs::TrimmingSurface whole = plane(-Far), half = plane(0.0);
    const std::string name = "plane " + std::to_string(trial);
    Expect(trim::IsNearlyPlane(points, 8, whole, normal), name + ": is not known as one");
    const auto share = trim::HalveForShare(points, 8, whole, Unlikely);
    Expect(share && *share == Unlikely, name + ": another share than by tetrahedra");
    Expect(!trim::HalveForShare(points, 8, half, Unlikely), name + ": a side where it ends");
  }
}

/// Of all elements that the surface cuts.
void ExpectShares(const std::string& name, vtkUnstructuredGrid* whole, const Surface& surface)
{
  vtkDataArray* shares = whole->GetCellData()->GetArray("EliminatedFraction");
  vtkDataArray* statuses = whole->GetCellData()->GetArray("ElementStatus");
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    if (statuses->GetComponent(c, 0) != 2)
    {
      continue;
    }
    ElementPoints points;
    for (int i = 0; i < 8; ++i)
    {
      points[i] = Vec3(whole->GetPoint(whole->GetCell(c)->GetPointId(i)));
    }
    const double share = shares->GetComponent(c, 0);
    const double sampled =
      SampledShare(points, 8, [&](const Vec3& p) { return surface.Signed(p) > 0.0; });
    Expect(std::abs(share - sampled) < Limit,
      name + ", element " + std::to_string(c) + ": a share of " + std::to_string(share) + " for " +
        std::to_string(sampled));
  }
}

// Of a window that goes square through a sheet, sharp corners lie within elements.
void TestWindow()
{
  const Mesh sheet = Sheet(12, 12, 1, Vec3(1, 1, 0.4));
  for (int degrees = 0; degrees < 90; degrees += 9)
  {
    Placement at;
    at.X = 0.01 * degrees;
    at.Y = -0.06;
    at.Angle = std::acos(-1.0) / 180.0 * degrees;
    at.Size = 0.35;
    const Surface window = MakeSurface("rectangle", sheet.Box, at);
    ExpectShares(
      "window at " + std::to_string(degrees), RunTrim(sheet, window, {}).Case.Whole, window);
  }
}

// With type I no node moves, and each element of a block goes by its own share: nothing is decided
// by columns along the cut.
void TestBlockOfTypeI()
{
  const Mesh block = Block(8, 8, 8);
  TrimOptions stepped;
  stepped.CorrectionType = 1;
  int cut = 0;
  for (int i = 0; i < 12; ++i)
  {
    Placement at;
    at.Angle = 0.03 + 0.02 * i;
    at.Lean = 0.02 * i;
    at.X = 0.007 * i;
    const Trial trial = RunTrim(block, MakeSurface("plane", block.Box, at), stepped).Case;
    vtkDataArray* shares = trial.Whole->GetCellData()->GetArray("EliminatedFraction");
    vtkDataArray* ids = trial.Trimmed->GetCellData()->GetArray("vtkOriginalCellIds");
    std::vector<char> kept(trial.Whole->GetNumberOfCells(), 0);
    for (vtkIdType c = 0; c < ids->GetNumberOfTuples(); ++c)
    {
      kept[static_cast<std::size_t>(ids->GetComponent(c, 0))] = 1;
    }
    for (std::size_t c = 0; c < kept.size(); ++c)
    {
      const double share = shares->GetComponent(static_cast<vtkIdType>(c), 0);
      cut += share > 0.0 && share < 1.0;
      Expect(kept[c] == (share <= 0.5),
        "block " + std::to_string(i) + ", type I: element " + std::to_string(c) +
          " with a share of " + std::to_string(share));
    }
  }
  Expect(cut > 500, "hardly an element is cut: " + std::to_string(cut));
}

}

int main()
{
  TestBlockOfTypeI();
  TestPlanes();
  TestRoofs();
  TestOtherShapes();
  TestWindow();
  std::printf("%d failures\n", Wrong);
  return Wrong == 0 ? 0 : 1;
}
