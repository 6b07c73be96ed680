/**
 * @file TestTreatmentParts.cxx
 * @brief What the ladder relies on, by itself: a decision that is taken again, a climb that does
 * not pay, the bound of the scaled Jacobian, the step of least squares, the worth of an element,
 * the way to a sharp edge, the way behind several planes, nodes that lie near each other, tasks in
 * turn, threads that stay, what movers remember, edges that slip through gaps, the gravest of
 * several shortfalls.
 */
#include "Decision.h"
#include "DirectionBehind.h"
#include "EdgeCrossing.h"
#include "ElementWorth.h"
#include "Expect.h"
#include "FindingArrays.h"
#include "Jacobian.h"
#include "LeastSquaresStep.h"
#include "Manifold.h"
#include "MoverMemory.h"
#include "NodeGrid.h"
#include "NodeMover.h"
#include "Remembered.h"
#include "RememberedLast.h"
#include "SampleSurfaces.h"
#include "Status.h"
#include "Team.h"
#include "ValidityLadder.h"
#include "Wavefront.h"

#include <Eigen/LU>

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>
#include <vtkUnsignedCharArray.h>

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <thread>

using namespace judge;
using namespace trim;

namespace
{
constexpr int Side = 6; // elements along an edge of the block

/// A block of unit cubes, cut by a leaning plane.
class CutBlock
{
public:
  CutBlock()
    : Mesh(CellsOfBlock(), 4, false)
    , Surface({ samples::Plane(
                Vec3(Middle, Middle, Middle) - 20 * (AlongU + AlongV), 40 * AlongU, 40 * AlongV) },
        0.0)
    , Structure(NoColumns(this->Mesh, {}))
  {
    std::array<int, 2> missed;
    Expect(MeasureShares(this->Mesh, this->Structure, this->Surface, 0.0, this->Shares, missed),
      "the plane cuts the block");
  }

  Decision NewDecision() const
  {
    return Decision(this->Mesh, this->Structure, this->Shares, this->Surface, 0.5, true);
  }

  NodeMover MoverTo(const nurbs::TrimmingSurface& surface) const
  {
    return NodeMover(this->Mesh, this->Structure, surface, 1e-8);
  }

  NodeMover MoverWith(const std::shared_ptr<MoverMemory>& memory) const
  {
    return NodeMover(this->Mesh, this->Structure, this->Surface, 1e-8, false, memory);
  }

  bool SlidingMatters(const MoverMemory& memory) const
  {
    return trim::SlidingMatters(this->Mesh, this->Structure, memory);
  }

  TrimmedBand Climb(const Promise& promises) const
  {
    const TrimCase given{ this->Mesh, this->Structure, this->Shares, this->Surface, 1e-8 };
    LadderPosition position;
    return ClimbLadder(
      given, LadderOptions(), [](double) { return false; }, position, { promises, {} });
  }

  const Band Mesh;

private:
  static constexpr double Middle = 0.5 * Side + 0.07;
  static inline const Vec3 Normal = Vec3(0.8, 0.48, 0.36), AlongU = Vec3(-0.6, 0.64, 0.48),
                           AlongV = Vec3(0.0, -0.6, 0.8);

  static unsigned char StatusAt(const Vec3& p)
  {
    return Normal.dot(p - Vec3(Middle, Middle, Middle)) > 0.0 ? NodeEliminate : NodeKeep;
  }

  static BandCells CellsOfBlock()
  {
    BandCells cells;
    const auto node = [](int i, int j, int k) { return i + (Side + 1) * (j + (Side + 1) * k); };
    for (int n = 0; n < node(0, 0, Side + 1); ++n)
    {
      const Vec3 p(n % (Side + 1), n / (Side + 1) % (Side + 1), n / (Side + 1) / (Side + 1));
      cells.Nodes.push_back({ n, p, StatusAt(p) });
    }
    for (int c = 0; c < Side * Side * Side; ++c)
    {
      const int i = c % Side, j = c / Side % Side, k = c / Side / Side;
      BandCells::Cell cell;
      cell.Global = c;
      cell.Count = 8;
      cell.Node = { node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
        node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
        node(i, j + 1, k + 1) };
      unsigned char status[8];
      std::transform(cell.Node.begin(), cell.Node.end(), status,
        [&cells](int n) { return cells.Nodes[n].Status; });
      cell.Status = StatusOfElement(status, 8);
      cell.Ring = cell.Status == ElementToTreat ? 0 : 1;
      cells.Cells.push_back(cell);
    }
    return cells;
  }

  const nurbs::TrimmingSurface Surface;
  const Columns Structure;
  VolumeShares Shares;
};

/// What an earlier decision found out must not change a later one.
void CheckDecisionAgain()
{
  const CutBlock block;
  Decision again = block.NewDecision();
  std::mt19937 random(1);
  std::vector<Fate> fate(block.Mesh.NumberOfElements(), Fate::ByVolume);
  const std::vector<char> first = again.Take(fate);
  int changed = 0, mended = 0, pinched = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    for (int e = 0; e < block.Mesh.NumberOfElements(); ++e)
    {
      const bool near = block.Mesh.Elements[e].Ring == 0;
      const unsigned drawn = random() % 6;
      fate[e] = near && drawn == 0 ? Fate::Keep
        : near && drawn == 1       ? Fate::Eliminate
                                   : Fate::ByVolume;
    }
    const std::vector<char> kept = again.Take(fate);
    Expect(kept == block.NewDecision().Take(fate),
      "trial " + std::to_string(trial) + ": the same as of a decision that was never taken");
    changed += kept != first;
    for (int e = 0; e < block.Mesh.NumberOfElements(); ++e)
    {
      mended += (fate[e] == Fate::Keep && !kept[e]) || (fate[e] == Fate::Eliminate && kept[e]);
    }
    for (int n = 0; n < block.Mesh.NumberOfNodes(); ++n)
    {
      pinched += !IsManifoldAt(block.Mesh, kept, n);
    }
  }
  Expect(changed == 200, "every trial changes what is kept");
  Expect(mended > 200, "and fates are mended: " + std::to_string(mended));
  Expect(pinched == 0, "what is kept hangs by " + std::to_string(pinched) + " nodes or edges");
  fate.assign(fate.size(), Fate::ByVolume);
  Expect(again.Take(fate) == first, "the first fates give the first decision again");
}

/// The way to the floor is not gone where it does not pay; its end is what tells of rungs.
void CheckPromise()
{
  const CutBlock block;
  int asked = 0;
  const auto climb = [&](bool pays)
  {
    return block.Climb(
      [&](const TrimmedBand& trimmed)
      {
        ++asked;
        Expect(trimmed.Invalid.empty(), "asked when all is valid");
        return pays;
      });
  };
  Expect(climb(false).RescuedBy.empty() && asked == 1, "the climb ends where it does not pay");
  const TrimmedBand whole = climb(true), unasked = block.Climb({});
  Expect(asked == 2 && !whole.RescuedBy.empty(), "it goes on where it does");
  Expect(whole.NodeMoves.Position == unasked.NodeMoves.Position && whole.Kept == unasked.Kept,
    "to the same end");
}

ElementPoints RandomElement(int count, std::mt19937& random)
{
  std::uniform_real_distribution<double> any(-0.3, 0.3);
  ElementPoints points;
  points.fill(Vec3::Zero());
  for (int i = 0; i < count; ++i)
  {
    const int layer = count == 8 ? i / 4 : i / 3, at = count == 8 ? i % 4 : i % 3;
    points[i] = Vec3(at == 1 || (count == 8 && at == 2), at == 2 || at == 3, layer) +
      Vec3(any(random), any(random), any(random));
  }
  return points;
}

/// No place of the moving nodes gives more than the bound, and some give as much.
void CheckBound()
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-0.3, 0.3);
  for (const int count : { 8, 6 })
  {
    int reached = 0;
    for (int trial = 0; trial < 2000; ++trial)
    {
      ElementPoints points = RandomElement(count, random);
      const unsigned moving = 1u << random() % count | 1u << random() % count;
      const double bound = ScaledJacobianBound(points, count, moving);
      double highest = -1.0;
      for (int place = 0; place < 20; ++place)
      {
        for (int i = 0; i < count; ++i)
        {
          points[i] +=
            moving >> i & 1u ? Vec3(any(random), any(random), any(random)) : Vec3::Zero();
        }
        highest = std::max(highest, ScaledJacobian(points, count));
      }
      Expect(highest <= bound + 1e-12, "no place of some nodes gives more than the bound");
      reached += highest > bound - 1e-12;
    }
    Expect(reached > 200, "and often that much: " + std::to_string(reached));
    const ElementPoints points = RandomElement(count, random);
    Expect(ScaledJacobianBound(points, count, 0) >= ScaledJacobian(points, count) - 1e-12,
      "of an element that stays it is what its corners have");
    Expect(std::isinf(ScaledJacobianBound(points, count, (1u << count) - 1)),
      "where all nodes move there is none");
  }
}

void CheckNear(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const std::string& what)
{
  Expect((a - b).norm() < 1e-9 * (1.0 + b.norm()), what);
}

/// The step, whatever demands it begins with.
Eigen::VectorXd StepFor(const std::vector<StepDemand>& demands, int variables, double damping)
{
  std::vector<int> missed, all(demands.size()), first{ 0 };
  std::iota(all.begin(), all.end(), 0);
  SolvingBudget budget{ 1e9 };
  const Eigen::VectorXd step = FindLeastSquaresStep(demands, variables, damping, budget, missed);
  for (std::vector<int> begin : { missed, all, first })
  {
    CheckNear(
      FindLeastSquaresStep(demands, variables, damping, budget, begin), step, "begun elsewhere");
    Expect(begin == missed, "the same demands are missed");
  }
  return step;
}

/// Where the budget is spent the step is that of the demands that missed before it.
void CheckBudget()
{
  const Slope up{ 0, 1.0 }, down{ 0, -1.0 };
  const std::vector<StepDemand> demands{ { 0.0, 1.0, &up, &up + 1 },
    { 1.1, 1.0, &down, &down + 1 } };
  std::vector<int> missed;
  SolvingBudget budget{ 0.1 };
  CheckNear(FindLeastSquaresStep(demands, 1, 0.25, budget, missed),
    Eigen::VectorXd::Constant(1, 1.0 / 1.25), "a step without repetition");
  Expect(budget.IsSpent(), "one equation spends a third of a multiplication");
  Expect(missed == std::vector<int>({ 0, 1 }), "what that one misses is told");
  CheckNear(StepFor(demands, 1, 0.25), Eigen::VectorXd::Constant(1, 1.1 / 2.25), "with repetition");
}

void CheckStep()
{
  const Slope up{ 0, 1.0 }, down{ 0, -1.0 }, steep{ 0, 2.0 };
  CheckNear(StepFor({ { 0.0, 1.0, &steep, &steep + 1 } }, 1, 0.5),
    Eigen::VectorXd::Constant(1, 2.0 / 4.5), "one value, damped");
  CheckNear(StepFor({ { 2.0, 1.0, &up, &up + 1 } }, 3, 0.5), Eigen::VectorXd::Zero(3),
    "what is reached asks for nothing");
  // The step for the first makes the second miss: between the two.
  CheckNear(StepFor({ { 0.0, 1.0, &up, &up + 1 }, { 0.6, 0.2, &down, &down + 1 } }, 1, 0.01),
    Eigen::VectorXd::Constant(1, 1.4 / 2.01), "a value that the step makes miss is heard");

  // Targets that no step reaches, so that all miss, against the dense normal equations.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 100; ++trial)
  {
    const int variables = 3 + random() % 20, count = 1 + random() % 15;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, variables);
    Eigen::VectorXd misses(count);
    std::vector<std::vector<Slope>> slopes(count);
    std::vector<StepDemand> demands;
    for (int i = 0; i < count; ++i)
    {
      for (int v = random() % 3; v < variables; v += 1 + random() % 3)
      {
        slopes[i].push_back({ v, any(random) });
        dense(i, v) = slopes[i].back().By;
      }
      std::shuffle(slopes[i].begin(), slopes[i].end(), random);
      misses[i] = 10.0 + any(random);
      demands.push_back(
        { 1.0 - misses[i], 1.0, slopes[i].data(), slopes[i].data() + slopes[i].size() });
    }
    const double damping = 100.0;
    const Eigen::MatrixXd normal =
      dense.transpose() * dense + damping * Eigen::MatrixXd::Identity(variables, variables);
    CheckNear(StepFor(demands, variables, damping),
      normal.fullPivLu().solve(dense.transpose() * misses), "as by dense normal equations");
  }
}

/// An element whose edges along one direction shrink keeps its shape, but not its worth.
void CheckWorth()
{
  const CutBlock block;
  const BandElement& element = block.Mesh.Elements.front();
  ElementPoints points;
  const Vec3& corner = block.Mesh.Point[element.Node[0]];
  for (const double share : { 1.0, 0.2, 0.1, 0.01 })
  {
    for (int i = 0; i < 8; ++i)
    {
      points[i] = block.Mesh.Point[element.Node[i]];
      points[i][0] = corner[0] + share * (points[i][0] - corner[0]);
    }
    const double worth = std::min(1.0, EdgeWorth * share);
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-12; };
    Expect(near(ShortestEdgeShare(block.Mesh, element.Node, points, 8), share), "share of an edge");
    Expect(near(ScaledJacobian(points, 8), 1.0), "the shape is as good as ever");
    Expect(near(WorthOf(block.Mesh, element.Node, points, 8), worth), "worth by its edges");
    const auto withLimit = [&](double limit)
    { return WorthOf(block.Mesh, element.Node, points, 8, nullptr, limit); };
    Expect(near(withLimit(worth - 1e-3), worth), "what is above a limit is exact");
    Expect(withLimit(worth + 1e-3) < worth + 1e-3, "what is below a limit is below it");
    std::vector<char> fixed(block.Mesh.NumberOfNodes(), 1);
    Expect(near(WorthOf(block.Mesh, element.Node, points, 8, &fixed), 1.0),
      "edges that cannot change do not count");
    fixed[element.Node[0]] = 0;
    Expect(near(WorthOf(block.Mesh, element.Node, points, 8, &fixed), worth), "others do");
  }
  std::swap(points[0], points[1]);
  Expect(WorthOf(block.Mesh, element.Node, points, 8) < 0.0, "what is inside out is worth nothing");
}

/// The rim of a can, and the side of a tube, where there is no edge.
void CheckCrease()
{
  constexpr double radius = 4.0, top = 3.3;
  const CutBlock block;
  const nurbs::TrimmingSurface can(
    { samples::Revolve(
      1, { 0, 0, 0.5, 1, 1 }, { Vec3(radius, -9, 1), Vec3(radius, top, 1), Vec3(0, top, 1) }) },
    0.0, 0.01);
  const NodeMover mover = block.MoverTo(can);
  int met = 0;
  for (int n = 0; n < block.Mesh.NumberOfNodes(); ++n)
  {
    const Vec3& from = block.Mesh.Point[n];
    const double r = std::hypot(from[0], from[1]);
    NodeFreedom freedom = mover.FreedomOf(n);
    if (freedom.Constraint.Kind != ConstraintKind::Free || std::abs(r - radius) > 0.8 ||
      std::abs(from[2] - top) > 0.8)
    {
      continue;
    }
    // The neighbour is a little farther round the rim.
    const Vec3 out = Vec3(from[0], from[1], 0) / r, round = Vec3(-out[1], out[0], 0);
    const auto side = can.ClosestPoint((radius + 0.1) * out - 0.5 * round + Vec3(0, 0, top - 0.7));
    const auto lid = can.ClosestPoint((radius - 0.6) * out + 0.3 * round + Vec3(0, 0, top + 0.1));
    Vec3 place = from;
    Expect(mover.MeetCrease(n, freedom, side, lid, place), "a node meets the rim");
    Expect(std::abs(std::hypot(place[0], place[1]) - radius) < 1e-8, "on the side of the can");
    Expect(std::abs(place[2] - top) < 1e-8, "and on its lid");
    Expect((place - from).norm() < 1.2 * std::hypot(r - radius, from[2] - top) + 0.05,
      "not far round it");
    ++met;
    const auto beside = can.ClosestPoint(radius * (out + 0.5 * round) + Vec3(0, 0, top - 0.7));
    place = from;
    Expect(side.Normal.dot(beside.Normal) < CreaseCosine, "the side turns");
    Expect(!mover.MeetCrease(n, freedom, side, beside, place), "but has no edge");
  }
  Expect(met > 5, "there are nodes near the rim: " + std::to_string(met));
}

/// No direction of many leads farther behind the planes.
void CheckDirectionBehind()
{
  constexpr double Turn = 0.785;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const auto behind = [&](const std::vector<Vec3>& normals, const std::vector<Vec3>& held)
  { return FindDirectionBehind(normals, held, Turn); };
  Expect((behind({ x }, {}).Direction + x).norm() < 1e-12, "behind one plane");
  Expect(std::abs(behind({ x, y, z }, {}).Sine - std::sqrt(1.0 / 3.0)) < 1e-12, "behind a corner");
  Expect(behind({ x, y, -y, z }, {}).Sine == 0.0, "no way between planes that face each other");
  Expect((behind({ x, Vec3(x + z).normalized() }, { z }).Direction + x).norm() < 1e-12,
    "along the skin");
  // A skin that bends by 20 degrees holds in one direction, a ridge in two.
  const Vec3 bent(0.0, std::sin(0.35), std::cos(0.35));
  Expect(behind({ y }, { z, bent }).Sine > 0.9, "along a bent skin");
  Expect(behind({ y }, { z, y }).Sine == 0.0, "off a ridge");
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  const auto direction = [&] { return Vec3(any(random), any(random), any(random)).normalized(); };
  int found = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    std::vector<Vec3> normals;
    for (int i = 0; i < 2 + trial % 5; ++i)
    {
      normals.push_back((direction() + 0.8 * x).normalized());
    }
    const auto leastOf = [&normals](const Vec3& d)
    {
      double least = 1.0;
      for (const Vec3& normal : normals)
      {
        least = std::min(least, -normal.dot(d));
      }
      return least;
    };
    const DirectionBehind best = behind(normals, {});
    found += best.Sine > 0.0;
    Expect(best.Sine == 0.0 || std::abs(leastOf(best.Direction) - best.Sine) < 1e-6,
      "the sine is that of the direction");
    for (int i = 0; i < 300; ++i)
    {
      Expect(leastOf(direction()) < best.Sine + 1e-6, "another direction leads farther behind");
    }
  }
  Expect(found > 100, "there mostly is a way: " + std::to_string(found));
}

// Nodes that move, some of them far and to where the indices of cells are negative, are found by
// the places where they are, by as many as looking at each of them finds.
void CheckNodeGrid()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  std::vector<Vec3> at(200);
  NodeGrid grid(static_cast<int>(at.size()), 0.7);
  int found = 0;
  for (int step = 0; step < 4000; ++step)
  {
    const int moved = step % static_cast<int>(at.size());
    at[moved] = Vec3(any(random), any(random), any(random));
    grid.Put(moved, at[moved]);
    const Vec3 place(any(random), any(random), any(random));
    const double reach = 0.4;
    std::vector<int> seen;
    grid.AnyNear(place, reach,
      [&](int node)
      {
        if ((at[node] - place).norm() < reach)
        {
          seen.push_back(node);
        }
        return false;
      });
    // Cells may share a bucket: then its nodes are tested for each of them.
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    std::vector<int> expected;
    for (int node = 0; node < std::min<int>(step + 1, static_cast<int>(at.size())); ++node)
    {
      if ((at[node] - place).norm() < reach)
      {
        expected.push_back(node);
      }
    }
    Expect(seen == expected, "nodes near a place, step " + std::to_string(step));
    found += !expected.empty();
  }
  Expect(found > 500, "places with nodes near them: " + std::to_string(found));
  const Vec3 nowhere(50.0, 0.0, 0.0);
  grid.Put(3, nowhere);
  const auto isThere = [](int node) { return node == 3; };
  Expect(grid.AnyNear(nowhere, 0.1, isThere), "a node where it went");
  Expect(!grid.AnyNear(at[3], 0.1, isThere), "a node where it was");
}

// Each task adds up what those that it meets have, and would have something else in another order.
void CheckWavefront()
{
  constexpr int count = 2000;
  const Band::Lists met = BuildLists(count,
    [&](auto&& add)
    {
      std::mt19937 same(5);
      for (int task = 1; task < count; ++task)
      {
        for (int k = 0; k < 4; ++k)
        {
          add(task, std::max(0, task - 1 - static_cast<int>(same() % 60)));
        }
      }
    });
  const auto add = [&met](std::vector<double>& sums, int task)
  {
    sums[task] = 1.0 + 1e-3 * task;
    for (const int* other = met.begin(task); other != met.end(task); ++other)
    {
      sums[task] += 0.3 * sums[*other];
    }
  };
  std::vector<double> expected(count, 0.0);
  for (int task = 0; task < count; ++task)
  {
    add(expected, task);
  }
  const Wavefront wavefront(met);
  for (const char* backend : { "Sequential", "STDThread" })
  {
    vtkSMPTools::SetBackend(backend);
    for (const int threads : { 1, 2, 5 })
    {
      vtkSMPTools::Initialize(threads);
      std::vector<double> sums(count, 0.0);
      wavefront.Run([&](int task) { add(sums, task); });
      const std::string name = std::string(backend) + ", " + std::to_string(threads) + " threads";
      Expect(sums == expected, "tasks in turn: " + name);
      const Team team(Team::SizeForBackend());
      std::fill(sums.begin(), sums.end(), 0.0);
      wavefront.Run([&](int task) { add(sums, task); });
      Expect(sums == expected, "tasks in turn by a team: " + name);
    }
  }
  vtkSMPTools::SetBackend("Sequential");
}

/// So many runs that a thread was held up before matters no more.
void TakeTurnsAgain()
{
  const Wavefront one(BuildLists(1, [](auto&&) {}));
  for (int run = 0; run < 100; ++run)
  {
    one.Run([](int) {});
  }
}

/// Whether another thread than the caller's takes tasks that wait for no other, if it can.
bool TakesTwoThreads()
{
  const Wavefront apart(BuildLists(64, [](auto&&) {}));
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> came{ false };
  std::atomic<int> waited{ 0 }; // milliseconds
  apart.Run(
    [&](int)
    {
      came = came || std::this_thread::get_id() != caller;
      while (!came && waited++ < 500)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  return came;
}

// Where a thread was kept within a task for long, the next runs are the caller's alone.
void CheckHeldUp()
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  {
    const Team team(Team::SizeForBackend());
    const Wavefront chain(BuildLists(64,
      [](auto&& add)
      {
        for (int task = 1; task < 64; ++task)
        {
          add(task, task - 1);
        }
      }));
    // On a busy machine the runs themselves may be held up.
    bool before = false, alone = false, after = false;
    for (int attempt = 0; attempt < 20 && !(before && alone && after); ++attempt)
    {
      TakeTurnsAgain();
      before = TakesTwoThreads();
      chain.Run(
        [](int task)
        {
          if (task == 3)
          {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
          }
        });
      alone = !TakesTwoThreads();
      TakeTurnsAgain();
      after = TakesTwoThreads();
    }
    Expect(before, "two threads take tasks in turn");
    Expect(alone, "one thread after one was held up");
    Expect(after, "two threads again, later");
  }
  vtkSMPTools::SetBackend("Sequential");
}

// A task that throws ends the others, also those that wait for what its thread had before it.
void CheckFailureInTurn()
{
  constexpr int count = 64;
  const Band::Lists met = BuildLists(count, [](auto&& add) { add(count - 1, 1); });
  const Wavefront wavefront(met);
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  const Team team(2);
  TakeTurnsAgain();
  std::atomic<bool> waits{ false };
  bool caught = false;
  try
  {
    wavefront.Run(
      [&](int task)
      {
        waits = waits || task == count - 2;
        while (task == 0 && !waits)
        {
          std::this_thread::yield();
        }
        if (task == 0)
        {
          throw std::bad_alloc();
        }
      });
  }
  catch (const std::bad_alloc&)
  {
    caught = true;
  }
  Expect(caught, "tasks in turn: a failure is lost");
  vtkSMPTools::SetBackend("Sequential");
}

// Each item once, whatever the pieces, and the caller does not sleep.
void CheckLoopsOfTeam()
{
  const Team team(3);
  constexpr Id count = 1003;
  for (const Id grain : { 0, 1, 10, 1002, 1003, 5000 })
  {
    std::vector<std::atomic<int>> visits(count);
    ParallelFor(3, count, grain,
      [&](Id begin, Id end)
      { std::for_each(&visits[begin], &visits[0] + end, [](auto& n) { ++n; }); });
    bool once = true;
    for (Id i = 0; i < count; ++i)
    {
      once &= visits[i] == (i < 3 ? 0 : 1);
    }
    Expect(once, "team: an item is left out or comes twice, grain " + std::to_string(grain));
  }
  ParallelFor(5, 5, 1, [](Id, Id) { Expect(false, "team: an empty range is not"); });

  const auto caller = std::this_thread::get_id();
  std::mutex lock;
  std::set<std::thread::id> seen;
  bool apart = false;
  for (int loop = 0; loop < 50; ++loop)
  {
    ParallelFor(0, 300, 1,
      [&](Id, Id)
      {
        const auto own = std::this_thread::get_id();
        const std::lock_guard<std::mutex> locked(lock);
        seen.insert(own);
        ParallelFor(0, 300, 1, [&](Id, Id) { apart |= own != std::this_thread::get_id(); });
      });
  }
  Expect(seen.count(caller) == 1, "team: the caller has no part in its loops");
  Expect(seen.size() <= 3, "team: its threads do not stay");
  Expect(!apart, "team: a loop within a loop is given to other threads");
}

// The caller looks now and then, also within a piece of a loop and while it waits for the others.
void CheckLookOfTeam()
{
  const auto caller = std::this_thread::get_id();
  Team team(2);
  std::atomic<int> looks{ 0 };
  bool apart = false;
  team.SetLook(
    [&]
    {
      ++looks;
      apart |= caller != std::this_thread::get_id();
    });
  // The other thread ends when the caller has looked once more than it does for the loop itself.
  const auto waitFor = [](const std::atomic<int>& number, int count)
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (number < count && std::chrono::steady_clock::now() < end)
    {
      std::this_thread::yield();
    }
    return number >= count;
  };
  std::atomic<bool> waited{ true };
  std::atomic<int> inside{ 0 };
  ParallelFor(0, 2, 1,
    [&](Id, Id)
    {
      ++inside;
      waitFor(inside, 2);
      if (std::this_thread::get_id() == caller)
      {
        ParallelFor(0, 10, 1, [](Id, Id) {});
        return;
      }
      waited =
        waitFor(looks, 5); // the loop, its piece, the loop within it, and twice while it waits
    });
  Expect(waited, "team: the caller does not look while it waits");
  Expect(!apart, "team: another thread than the caller looks");
  team.SetLook({});
  const int before = looks;
  ParallelFor(0, 100, 1, [](Id, Id) {});
  Expect(looks == before, "team: the caller still looks");
}

// What one of the others throws comes to the caller; VTK's threads would end the process.
void CheckFailureInTeam()
{
  const auto caller = std::this_thread::get_id();
  const Team team(3);
  for (int loop = 0; loop < 20; ++loop)
  {
    std::atomic<bool> thrown{ false };
    bool caught = false;
    try
    {
      ParallelFor(0, 3, 1,
        [&](Id, Id)
        {
          if (std::this_thread::get_id() != caller)
          {
            thrown = true;
            throw std::bad_alloc();
          }
          const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
          while (!thrown && std::chrono::steady_clock::now() < end)
          {
            std::this_thread::yield();
          }
        });
    }
    catch (const std::bad_alloc&)
    {
      caught = true;
    }
    Expect(caught, "team: what one of its threads throws does not come to the caller");
  }
}

// The system may have no threads left, here as none has a stack so large: the caller does the work.
void CheckTeamWithoutThreads()
{
  pthread_attr_t usual, huge;
  pthread_getattr_default_np(&usual);
  pthread_attr_init(&huge);
  pthread_attr_setstacksize(&huge, std::size_t{ 1 } << 47);
  pthread_setattr_default_np(&huge);
  try
  {
    const Team team(3);
    std::atomic<Id> sum{ 0 };
    ParallelFor(0, 100, 1, [&sum](Id begin, Id) { sum += begin; });
    Expect(sum == 4950, "team: without threads some of the work is not done");
  }
  catch (const std::exception& failure)
  {
    Expect(false, std::string("team: not made without threads: ") + failure.what());
  }
  pthread_setattr_default_np(&usual);
  pthread_attr_destroy(&huge);
  pthread_attr_destroy(&usual);
}

// Where VTK would start threads for each loop, and only there.
void CheckSizeOfTeam()
{
  vtkSMPTools::SetBackend("Sequential");
  Expect(Team::SizeForBackend() == 1 && !Team::Current(), "team: against the sequential backend");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  const int size = Team::SizeForBackend();
  Expect(size == vtkSMPTools::GetEstimatedNumberOfThreads(), "team: not VTK's number of threads");
  std::atomic<int> within{ 1 };
  vtkSMPTools::For(
    0, 2, 1, [&within](Id, Id) { within = std::max<int>(within, Team::SizeForBackend()); });
  Expect(within == 1, "team: within a loop of VTK's");
  {
    const Team team(2);
    Expect(Team::Current() == &team, "team: it is not that of its thread");
  }
  Expect(!Team::Current(), "team: it is still there");
  vtkSMPTools::SetBackend("Sequential");
}

// Each value is worked out once, and all that ask get the same.
void CheckRemembered()
{
  const int count = 1000;
  const Remembered<std::vector<int>> squares(count);
  std::vector<std::atomic<int>> found(count);
  std::vector<std::atomic<int>> wrong(count);
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int i = 0; i < count; ++i)
    {
      const std::vector<int>& square = squares.At(i,
        [&]
        {
          ++found[i];
          return std::vector<int>{ i * i };
        });
      wrong[i] += square.front() != i * i;
    }
  }
  Expect(std::all_of(found.begin(), found.end(), [](const auto& n) { return n == 1; }),
    "what is remembered is worked out once");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(5);
  const Remembered<int> doubles(1);
  vtkSMPTools::For(0, count, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        wrong[i] += doubles.At(0, [] { return 2; }) != 2;
      }
    });
  vtkSMPTools::SetBackend("Sequential");
  Expect(std::all_of(wrong.begin(), wrong.end(), [](const auto& n) { return n == 0; }),
    "what is remembered is the same for all");
}

// Of the last key the value is known, of another one it is worked out; for all threads.
void CheckRememberedLast()
{
  const RememberedLast<int, int> products(3);
  int found = 0;
  const auto product = [&](int item, int key)
  {
    return products.At(item, key,
      [&]
      {
        ++found;
        return item * key;
      });
  };
  Expect(product(2, 5) == 10 && product(2, 5) == 10 && found == 1, "the last key is not known");
  Expect(product(1, 5) == 5 && found == 2, "the key of another item is taken");
  Expect(product(2, 7) == 14 && product(2, 5) == 10 && found == 4, "another key is taken");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(5);
  std::atomic<int> wrong{ 0 };
  vtkSMPTools::For(0, 1000, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const int key = static_cast<int>(i % 2);
        wrong += products.At(0, key, [key] { return 3 + key; }) != 3 + key;
      }
    });
  vtkSMPTools::SetBackend("Sequential");
  Expect(wrong == 0, "what is remembered of a key is that of another one");
}

// Sliding behind the cut is another trim only where the border beyond the surface is asked for.
void CheckSlidingMatters()
{
  const CutBlock block;
  const Band& mesh = block.Mesh;
  const auto memory = std::make_shared<MoverMemory>(mesh);
  const NodeMover mover = block.MoverWith(memory);
  const auto allAre = [&](int n, unsigned char status)
  {
    const auto faces = mesh.FacesOfNode(n);
    return std::all_of(faces.begin(), faces.end(),
      [&](int f)
      {
        return std::all_of(mesh.Faces[f].begin(), mesh.Faces[f].end(),
          [&](int other) { return mesh.NodeStatus[other] == status; });
      });
  };
  const auto isExterior = [&](int n)
  {
    const auto faces = mesh.FacesOfNode(n);
    return std::any_of(faces.begin(), faces.end(), [&](int f) { return mesh.Faces[f].Exterior; });
  };
  int asked = 0, beyond = -1;
  for (int n = 0; n < mesh.NumberOfNodes(); ++n)
  {
    if (allAre(n, NodeKeep))
    {
      mover.FreedomOf(n, false);
      ++asked;
    }
    beyond = isExterior(n) && allAre(n, NodeEliminate) ? n : beyond;
  }
  Expect(asked > 0 && beyond >= 0, "the block has nodes on both sides");
  mover.FreedomOf(beyond, true);
  Expect(!block.SlidingMatters(*memory), "nothing slides on the kept side");
  mover.FreedomOf(beyond, false);
  Expect(block.SlidingMatters(*memory), "the border beyond the surface may hold");
}

/// An edge slips through a gap between faces that counts as closed, and through no other.
void CheckGap()
{
  const auto wall = [](double y)
  { return samples::Plane(Vec3(0, y, -5), Vec3(0, 4, 0), Vec3(0, 0, 10)); };
  const nurbs::TrimmingSurface surface({ wall(0.0), wall(4.02) }, 1e-4, 0.1);
  const Vec3 beyond(0.5, 4.01, 0), kept(-0.5, 4.01, 0);
  const auto crossed = CrossEdge(surface, beyond, kept, 0.1);
  Expect(crossed && std::abs(crossed->Beyond - 0.5) < 0.05,
    "an edge through a gap that counts as closed");
  Expect(!CrossEdge(surface, beyond, kept, 1e-3), "an edge through a wider gap");
}

/// Places in an element are found there, though the map of a distorted one folds beside it: of one
/// that three trims have left.
void CheckParameters()
{
  const ElementPoints points = { Vec3(3.202, 15.8181, -0.4), Vec3(3.9806, 16.3985, -0.4),
    Vec3(4.0133, 16.4498, -0.4), Vec3(3, 17, -0.4), Vec3(3.3839, 15.89, -0.0893),
    Vec3(3.8829, 16.1356, 0.1043), Vec3(3.9614, 16.3251, 0.0566), Vec3(3, 17, 0) };
  Expect(MeasureJacobian(points, 8).Bezier > 0.0, "the element is not valid: choose another");
  constexpr int steps = 40;
  int lost = 0;
  for (int i = 0; i < (steps + 1) * (steps + 1) * (steps + 1); ++i)
  {
    const Vec3 at =
      Vec3(i % (steps + 1), i / (steps + 1) % (steps + 1), i / (steps + 1) / (steps + 1)) / steps;
    Vec3 found;
    lost +=
      !(FindParameters(points, 8, MapToSpace(points, 8, at), found) && (found - at).norm() < 1e-9);
  }
  Expect(lost == 0, std::to_string(lost) + " places in an element are found elsewhere");
}

/// Of several shortfalls at one place the gravest counts, in whatever order they come.
void CheckShortfalls()
{
  vtkNew<vtkCellData> data;
  AddShortfalls({ { 3, Shortfall::LeftOff }, { 3, Shortfall::Invalid }, { -1, Shortfall::Invalid },
                  { 3, Shortfall::BelowFloor }, { 5, Shortfall::BelowFloor } },
    7, data);
  auto* const array = vtkUnsignedCharArray::SafeDownCast(data->GetArray("Shortfall"));
  Expect(array && array->GetNumberOfTuples() == 7 &&
      array->GetValue(3) == static_cast<unsigned char>(Shortfall::Invalid) &&
      array->GetValue(5) == static_cast<unsigned char>(Shortfall::BelowFloor) &&
      array->GetValue(0) == 0 && array->GetValue(6) == 0,
    "the gravest shortfall of each cell");
}

}

int main()
{
  CheckNodeGrid();
  CheckWavefront();
  CheckHeldUp();
  CheckFailureInTurn();
  CheckLoopsOfTeam();
  CheckLookOfTeam();
  CheckFailureInTeam();
  CheckTeamWithoutThreads();
  CheckSizeOfTeam();
  CheckDirectionBehind();
  CheckDecisionAgain();
  CheckPromise();
  CheckBound();
  CheckStep();
  CheckBudget();
  CheckWorth();
  CheckCrease();
  CheckRemembered();
  CheckRememberedLast();
  CheckSlidingMatters();
  CheckGap();
  CheckShortfalls();
  CheckParameters();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
