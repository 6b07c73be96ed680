// Surface evaluation (eqs. 1-5): closed forms, finite differences, OpenCASCADE, invariances,
// and the validity check.
#include "Check.h"
#include "OpenCascadeSurface.h"
#include "RandomPlaces.h"
#include "SampleSurfaces.h"

#include <cmath>
#include <limits>

using namespace nurbs;
using samples::Uniform;

namespace
{

void TestFiniteDifferences(const samples::Named& sample)
{
  const NurbsSurface& s = sample.Surface;
  const double sizeU = s.LastU() - s.FirstU(), sizeV = s.LastV() - s.FirstV();
  for (int k = 0; k < 300; ++k)
  {
    const double u = s.FirstU() + sizeU * Uniform(0.001, 0.999);
    const double v = s.FirstV() + sizeV * Uniform(0.001, 0.999);
    const double hu = 1e-6 * sizeU, hv = 1e-6 * sizeV;
    bool knotNear = false; // a difference across a crease tells nothing
    for (double knot : s.KnotsU)
    {
      knotNear = knotNear || std::abs(knot - u) < 2 * hu;
    }
    for (double knot : s.KnotsV)
    {
      knotNear = knotNear || std::abs(knot - v) < 2 * hv;
    }
    if (knotNear)
    {
      continue;
    }
    const SurfaceJet jet = EvaluateJet(s, u, v);
    const SurfaceJet a = EvaluateJet(s, u - hu, v), b = EvaluateJet(s, u + hu, v);
    const SurfaceJet c = EvaluateJet(s, u, v - hv), d = EvaluateJet(s, u, v + hv);
    const auto close = [&](
                         const Vec3& exact, const Vec3& difference, double scale, const char* what)
    {
      check::That((exact - difference).norm() <= 1e-5 * (scale + exact.norm()),
        sample.Name + " " + what + " against differences");
    };
    const double first = jet.Su.norm() + jet.Sv.norm();
    close(jet.Su, (b.S - a.S) / (2 * hu), first, "Su");
    close(jet.Sv, (d.S - c.S) / (2 * hv), first, "Sv");
    const double second = jet.Suu.norm() + jet.Suv.norm() + jet.Svv.norm() + first;
    close(jet.Suu, (b.Su - a.Su) / (2 * hu), second, "Suu");
    close(jet.Suv, (d.Su - c.Su) / (2 * hv), second, "Suv");
    close(jet.Svv, (d.Sv - c.Sv) / (2 * hv), second, "Svv");
    check::That((jet.S - Evaluate(s, u, v)).norm() <= 1e-14, sample.Name + " Evaluate");
  }
}

void TestAgainstOpenCascade(const samples::Named& sample)
{
  const NurbsSurface& s = sample.Surface;
  if (sample.Name == "jump")
  {
    return; // Geom_BSplineSurface takes no knots of multiplicity p + 1
  }
  const Handle(Geom_BSplineSurface) other = occ::Convert(s);
  for (int k = 0; k < 500; ++k)
  {
    const double u = Uniform(s.FirstU(), s.LastU()), v = Uniform(s.FirstV(), s.LastV());
    const SurfaceJet jet = EvaluateJet(s, u, v);
    gp_Pnt p;
    gp_Vec du, dv, duu, dvv, duv;
    other->D2(u, v, p, du, dv, duu, dvv, duv);
    const auto close = [&](const Vec3& x, const gp_XYZ& y, const char* what)
    {
      check::Near((x - Vec3(y.X(), y.Y(), y.Z())).norm(), 0,
        2e-11 * (1 + jet.Suu.norm() + jet.Svv.norm() + jet.Su.squaredNorm() + jet.Sv.squaredNorm()),
        sample.Name + " " + what + " against OpenCASCADE");
    };
    close(jet.S, p.XYZ(), "S");
    close(jet.Su, du.XYZ(), "Su");
    close(jet.Sv, dv.XYZ(), "Sv");
    close(jet.Suu, duu.XYZ(), "Suu");
    close(jet.Suv, duv.XYZ(), "Suv");
    close(jet.Svv, dvv.XYZ(), "Svv");
  }
}

void TestClosedForms()
{
  const NurbsSurface cylinder = samples::Cylinder(2, 3), sphere = samples::Sphere(1.5);
  const NurbsSurface torus = samples::Torus(1, 0.4);
  const NurbsSurface plane = samples::Plane(Vec3(1, 2, 3), Vec3(1, 0, 1), Vec3(0, 2, 0));
  for (int k = 0; k < 300; ++k)
  {
    const double u = Uniform(0, 4), v = Uniform(0, 1), t = Uniform(0, 4);
    const Vec3 c = Evaluate(cylinder, u, v);
    check::Near(std::hypot(c.x(), c.y()), 2, 1e-14, "radius of the cylinder");
    check::Near(c.z(), 3 * v, 1e-14, "height on the cylinder");
    check::Near(Evaluate(sphere, u, 2 * v).norm(), 1.5, 1e-14, "radius of the sphere");
    const Vec3 x = Evaluate(torus, u, t);
    check::Near(std::hypot(std::hypot(x.x(), x.y()) - 1, x.z()), 0.4, 1e-14, "torus");
    const SurfaceJet jet = EvaluateJet(plane, v, 1 - v);
    check::That((jet.S - Vec3(1 + v, 2 + 2 * (1 - v), 3 + v)).norm() < 1e-14, "plane");
    check::That(jet.Suu.norm() + jet.Svv.norm() + jet.Suv.norm() < 1e-13, "plane is flat");
    const SurfaceJet ball = EvaluateJet(sphere, u, Uniform(0.1, 1.9));
    check::Near(ball.S.dot(ball.Su), 0, 1e-12, "tangent of the sphere");
    check::Near(ball.S.dot(ball.Suu) + ball.Su.squaredNorm(), 0, 1e-11, "curvature of the sphere");
  }
}

/// Boehm's knot insertion in u, on homogeneous points (NURBS Book, A5.1 for one knot).
NurbsSurface InsertKnotU(const NurbsSurface& s, double u)
{
  NurbsSurface result = s;
  int k = s.DegreeU;
  while (k + 1 < s.CountU && s.KnotsU[k + 1] <= u)
  {
    ++k;
  }
  result.KnotsU.insert(result.KnotsU.begin() + k + 1, u);
  result.CountU = s.CountU + 1;
  result.ControlPoints.assign(static_cast<std::size_t>(result.CountU) * s.CountV, Vec4::Zero());
  for (int j = 0; j < s.CountV; ++j)
  {
    const auto homogeneous = [&](int i) -> Vec4
    {
      Vec4 x = s.ControlPoints[i + j * s.CountU];
      x.head<3>() *= x.w();
      return x;
    };
    for (int i = 0; i < result.CountU; ++i)
    {
      double a = i <= k - s.DegreeU ? 1.0 : 0.0;
      if (i > k - s.DegreeU && i <= k)
      {
        a = (u - s.KnotsU[i]) / (s.KnotsU[i + s.DegreeU] - s.KnotsU[i]);
      }
      Vec4 x = Vec4::Zero();
      if (a > 0)
      {
        x += a * homogeneous(i);
      }
      if (a < 1)
      {
        x += (1 - a) * homogeneous(i - 1);
      }
      x.head<3>() /= x.w();
      result.ControlPoints[i + j * result.CountU] = x;
    }
  }
  return result;
}

void TestInvariances(const samples::Named& sample)
{
  const NurbsSurface& s = sample.Surface;
  Eigen::Matrix3d linear;
  linear << 1.2, 0.3, -0.1, 0.2, 0.8, 0.4, -0.3, 0.1, 1.1;
  const Vec3 shift(3, -2, 5);
  const NurbsSurface moved = samples::Transformed(s, linear, shift);
  const NurbsSurface reversed = samples::ReversedU(s);
  const NurbsSurface finer =
    InsertKnotU(InsertKnotU(s, s.FirstU() + 0.37 * (s.LastU() - s.FirstU())),
      s.FirstU() + 0.61 * (s.LastU() - s.FirstU()));
  check::That(FindDefect(finer).empty(), sample.Name + " with knots inserted is valid");
  for (int k = 0; k < 100; ++k)
  {
    const double u = Uniform(s.FirstU(), s.LastU()), v = Uniform(s.FirstV(), s.LastV());
    const SurfaceJet jet = EvaluateJet(s, u, v);
    const SurfaceJet image = EvaluateJet(moved, u, v);
    const double scale = 1 + jet.Suu.norm() + jet.Svv.norm() + jet.Suv.norm();
    check::That((linear * jet.S + shift - image.S).norm() < 1e-13 * scale &&
        (linear * jet.Suv - image.Suv).norm() < 1e-11 * scale,
      sample.Name + " under an affine map");
    const SurfaceJet back = EvaluateJet(reversed, s.FirstU() + s.LastU() - u, v);
    check::That((back.S - jet.S).norm() < 1e-12 * scale &&
        (back.Su + jet.Su).norm() < 1e-10 * scale && (back.Suu - jet.Suu).norm() < 1e-9 * scale,
      sample.Name + " reversed");
    const SurfaceJet refined = EvaluateJet(finer, u, v);
    check::That(
      (refined.S - jet.S).norm() < 1e-13 * scale && (refined.Suu - jet.Suu).norm() < 1e-9 * scale,
      sample.Name + " with knots inserted");
  }
}

void TestDefects()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [](const char* what, const char* word, const auto& spoil)
  {
    NurbsSurface s = samples::Wavy();
    spoil(s);
    const std::string text = FindDefect(s);
    check::That(text.find(word) != std::string::npos,
      std::string(what) + " is reported with \"" + word + "\", not: " + text);
  };
  check::That(FindDefect(samples::Wavy()).empty(), "a valid surface has no defect");
  expect("degree 0", "degree U", [](NurbsSurface& s) { s.DegreeU = 0; });
  expect("degree 26", "degree V", [](NurbsSurface& s) { s.DegreeV = 26; });
  expect("few points", "too few", [](NurbsSurface& s) { s.CountV = 3; });
  expect("negative count", "too few", [](NurbsSurface& s) { s.CountU = -1; });
  expect("missing knot", "knot vector U", [](NurbsSurface& s) { s.KnotsU.pop_back(); });
  expect("no knots", "knot vector V", [](NurbsSurface& s) { s.KnotsV.clear(); });
  expect("knot NaN", "knot V[5]", [=](NurbsSurface& s) { s.KnotsV[5] = nan; });
  expect("knot decreases", "knot U[6]", [](NurbsSurface& s) { s.KnotsU[6] = 0.1; });
  expect("empty domain", "empty",
    [](NurbsSurface& s) { std::fill(s.KnotsU.begin(), s.KnotsU.end(), 0.5); });
  expect("knot repeated", "repeated",
    [](NurbsSurface& s)
    {
      std::fill(s.KnotsU.begin() + 4, s.KnotsU.begin() + 9, 0.5);
      s.KnotsU[9] = 0.75;
      s.KnotsU[10] = 1;
    });
  expect("missing point", "control net", [](NurbsSurface& s) { s.ControlPoints.pop_back(); });
  expect("point infinite", "(3, 2)",
    [](NurbsSurface& s)
    { s.ControlPoints[3 + 2 * 8].y() = std::numeric_limits<double>::infinity(); });
  expect("weight 0", "weight", [](NurbsSurface& s) { s.ControlPoints[5].w() = 0; });
  expect("weight negative", "(5, 0)", [](NurbsSurface& s) { s.ControlPoints[5].w() = -1; });
  expect("weight NaN", "weight", [=](NurbsSurface& s) { s.ControlPoints[5].w() = nan; });
  expect("short loop", "trim loop 0",
    [](NurbsSurface& s) {
      s.TrimLoops = { { Vec2(0, 0), Vec2(1, 1) } };
    });
  const Vec2 twice(0.5, 0.5);
  expect("loop of one point", "trim loop 1 has 1 different points",
    [&](NurbsSurface& s) {
      s.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1) }, { twice, twice, twice } };
    });
  expect("loop of two points", "trim loop 0 has 2 different points",
    [&](NurbsSurface& s) {
      s.TrimLoops = { { twice, Vec2(1, 1), twice, Vec2(1, 1), twice } };
    });
  expect("loop NaN", "point 1",
    [=](NurbsSurface& s) {
      s.TrimLoops = { { Vec2(0, 0), Vec2(1, nan), Vec2(1, 1) } };
    });
  expect("loop beyond the domain", "point 2 of trim loop 0",
    [](NurbsSurface& s) {
      s.TrimLoops = { { Vec2(0, 0), Vec2(1, 0), Vec2(1, 1.00001) } };
    });
}

void TestHighestDegree()
{
  // A degree-elevated parabola stays a parabola; degree 25 is the limit.
  const NurbsSurface s =
    samples::FromNet(MaximumDegree, MaximumDegree, MaximumDegree + 1, MaximumDegree + 1,
      [](double u, double v)
      {
        const double n = MaximumDegree;
        const double uu = u * (n * u - 1) / (n - 1); // Bernstein coefficients of u^2
        return Vec4(u, v, uu + v, 2);
      });
  check::That(FindDefect(s).empty(), "degree 25 is valid");
  for (int k = 0; k < 100; ++k)
  {
    const double u = Uniform(0, 1), v = Uniform(0, 1);
    const SurfaceJet jet = EvaluateJet(s, u, v);
    check::That((jet.S - Vec3(u, v, u * u + v)).norm() < 1e-13 &&
        (jet.Su - Vec3(1, 0, 2 * u)).norm() < 1e-12 && (jet.Suu - Vec3(0, 0, 2)).norm() < 1e-10,
      "parabola of degree 25");
  }
}

}

int main()
{
  samples::Random.seed(7);
  for (const samples::Named& sample : samples::All())
  {
    check::That(FindDefect(sample.Surface).empty(), sample.Name + " is valid");
    TestFiniteDifferences(sample);
    TestAgainstOpenCascade(sample);
    TestInvariances(sample);
  }
  TestClosedForms();
  TestHighestDegree();
  TestDefects();
  return check::Result();
}
