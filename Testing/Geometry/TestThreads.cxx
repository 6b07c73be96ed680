/**
 * @file TestThreads.cxx
 * @brief Queries of one surface from several threads at a time give what one thread gives, to
 * the last bit. Under ThreadSanitizer (Testing/run-sanitizers.sh) it also shows data races.
 */
#include "Check.h"
#include "Curvature.h"
#include "SampleSurfaces.h"

#include "TrimmingSurface.h"

#include <cmath>
#include <thread>

using nurbs::Foot;
using nurbs::LineHit;
using nurbs::TrimmingSurface;
using nurbs::Vec3;

namespace
{
constexpr int Points = 300;
constexpr int Threads = 5;

/// What all queries at one place give, as plain numbers.
std::vector<double> Ask(const TrimmingSurface& surface, const Vec3& p, const Vec3& q)
{
  std::vector<double> answers;
  const Foot foot = surface.ClosestPoint(p);
  const Foot near = surface.ClosestPoint(q, foot, (q - p).norm());
  for (const Foot& f : { foot, near })
  {
    answers.insert(answers.end(),
      { f.Point.x(), f.Point.y(), f.Point.z(), f.Normal.sum(), f.SignedDistance, f.U, f.V });
  }
  answers.push_back(nurbs::RadiusOfCurvature(surface, foot));
  for (const LineHit& hit : surface.Intersect(p, q))
  {
    answers.insert(answers.end(), { hit.K, hit.Point.sum(), hit.Normal.sum() });
  }
  answers.push_back(surface.MayIntersect(nurbs::Box3(p.cwiseMin(q), p.cwiseMax(q))));
  return answers;
}

/// Places in and round the box of the surface, by a sequence of low discrepancy.
Vec3 Place(const TrimmingSurface& surface, int i)
{
  const Vec3 share(std::fmod(0.5 + 0.7549 * i, 1.0), std::fmod(0.5 + 0.5698 * i, 1.0),
    std::fmod(0.5 + 0.4302 * i, 1.0));
  const nurbs::Box3& box = surface.Bounds();
  const Vec3 size = box.sizes().array() + 0.1 * box.diagonal().norm();
  return box.center() + (share.array() - 0.5).matrix().cwiseProduct(1.2 * size);
}

void TestSurface(const std::string& name, const std::vector<nurbs::NurbsSurface>& faces)
{
  const TrimmingSurface first(faces, 1e-9);
  std::vector<std::vector<double>> alone(Points);
  for (int i = 0; i < Points; ++i)
  {
    alone[i] = Ask(first, Place(first, i), Place(first, i + 1));
  }
  // Every thread asks for all places, each from another one on, of a surface that nobody has asked
  // before: it finds out much of what it knows only then.
  const TrimmingSurface surface(faces, 1e-9);
  const auto ask = [&surface](int i)
  { return Ask(surface, Place(surface, i), Place(surface, i + 1)); };
  std::vector<std::thread> threads;
  std::vector<int> different(Threads, 0);
  for (int t = 0; t < Threads; ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (int k = 0; k < Points; ++k)
        {
          const int i = (k + t * Points / Threads) % Points;
          const std::vector<double> answers = ask(i);
          bool same = answers.size() == alone[i].size();
          for (std::size_t j = 0; same && j < answers.size(); ++j)
          {
            same = answers[j] == alone[i][j] || (std::isnan(answers[j]) && std::isnan(alone[i][j]));
          }
          different[t] += same ? 0 : 1;
        }
      });
  }
  for (int t = 0; t < Threads; ++t)
  {
    threads[t].join();
    check::That(different[t] == 0,
      name + ": thread " + std::to_string(t) + " differs at " + std::to_string(different[t]) +
        " places");
  }
}
}

int main()
{
  for (const samples::Named& sample : samples::All())
  {
    TestSurface(sample.Name, { sample.Surface });
  }
  TestSurface("fine", { samples::Wavy(40) });
  TestSurface("shell", samples::RoundedShell(3, 2, 0.5, 1));
  nurbs::NurbsSurface trimmed = samples::Wavy();
  trimmed.TrimLoops = { { { 0.1, 0.1 }, { 0.9, 0.2 }, { 0.8, 0.9 }, { 0.2, 0.8 } },
    { { 0.4, 0.4 }, { 0.6, 0.4 }, { 0.5, 0.6 } } };
  TestSurface("trimmed", { trimmed });
  return check::Result();
}
