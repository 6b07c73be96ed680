/**
 * @file TestTreatmentParts.cxx
 * @brief What the ladder relies on, by itself: a decision that is taken again, a climb that does
 * not pay, or is told to end, the bound of the scaled Jacobian, the step of least squares, the
 * worth of an element, the way to a sharp edge, nodes that lie near each other, what movers
 * remember, edges that slip through gaps, facets without area, thousands of wedges round an axis,
 * the gravest of several shortfalls.
 */
#include "CutBlock.h"
#include "EdgeCrossing.h"
#include "ElementTetrahedra.h"
#include "ElementWorth.h"
#include "ElementsAstray.h"
#include "Expect.h"
#include "Facet.h"
#include "FindingArrays.h"
#include "Jacobian.h"
#include "LeastSquaresStep.h"
#include "Manifold.h"
#include "MoverMemory.h"
#include "NodeGrid.h"
#include "NodeMover.h"
#include "SampleSurfaces.h"
#include "Status.h"
#include "TrimBand.h"
#include "ValidityLadder.h"

#include <Eigen/LU>

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <string>

using namespace judge;
using namespace trim;

namespace
{
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

// Who presses the red x does not wait for what relaxes hundreds of elements.
void CheckAbort()
{
  const CutBlock block;
  for (const bool stop : { false, true })
  {
    TrimCase given = block.Case();
    given.Tell = [stop](double) { return stop; };
    const LadderOptions options;
    LadderPosition foot;
    ColumnChoices choices(given, options, foot);
    const TrimmedBand made = choices.Trial.Make(choices.At.Set, choices.Aimed);
    Expect((made.NodeMoves.Position != made.Unrelaxed.Position) != stop,
      stop ? "abort: the trial goes on relaxing" : "abort: nothing to relax in the block");
  }
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

// Where columns end within a solid, three edges may hold a node that has no face to slide on.
void CheckCornerWithoutFaces()
{
  const CutBlock block;
  const NodeMover mover = block.MoverWith(std::make_shared<MoverMemory>(block.Mesh));
  NodeFreedom corner;
  corner.Constraint.Kind = ConstraintKind::Fixed;
  for (const bool onCut : { true, false })
  {
    Vec3 place = Vec3::Zero();
    Expect(!mover.Constrained(0, corner, block.Mesh.Point[0], onCut, place), "a corner stays");
  }
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

/// Wedges round an axis from node 0 to node 1, as a band of one ring.
Band WedgesRoundAxis(int count)
{
  constexpr double turn = 6.283185307179586;
  BandCells cells;
  const auto add = [&cells](double x, double y, double z)
  {
    BandCells::Node node;
    node.Global = static_cast<Id>(cells.Nodes.size());
    node.Point = Vec3(x, y, z);
    cells.Nodes.push_back(node);
  };
  add(0, 0, 0);
  add(0, 0, 1);
  for (int k = 0; k < 2 * count; ++k)
  {
    add(std::cos(turn * (k / 2) / count), std::sin(turn * (k / 2) / count), k % 2);
  }
  for (int k = 0; k < count; ++k)
  {
    const int own = 2 + 2 * k, next = 2 + 2 * ((k + 1) % count);
    BandCells::Cell cell;
    cell.Global = k;
    cell.Count = 6;
    cell.Node = { 0, own, next, 1, own + 1, next + 1, -1, -1 };
    cells.Cells.push_back(cell);
  }
  return Band(std::move(cells), 1, false);
}

/// An element whose faces are warped, and which is kept as it is, has no volume too much or too
/// little, whatever its six tetrahedra have.
void CheckExcess()
{
  BandCells cells;
  for (int i = 0; i < 8; ++i)
  {
    BandCells::Node node;
    node.Global = i;
    node.Point = Vec3(i % 4 == 1 || i % 4 == 2, i % 4 > 1, i / 4);
    cells.Nodes.push_back(node);
  }
  cells.Nodes[6].Point += Vec3(0.3, 0.2, 0.4);
  BandCells::Cell cell;
  cell.Global = 0;
  cell.Count = 8;
  std::iota(cell.Node.begin(), cell.Node.end(), 0);
  cells.Cells.push_back(cell);
  TrimBand near(Band(std::move(cells), 1, false));
  const Band& band = near.Mesh;
  const auto order = OrderForTetrahedra(band.Elements[0]);
  double six = 0.0;
  for (const Tetrahedron& t : HexahedronTetrahedra)
  {
    const auto at = [&](int i) -> const Vec3& { return band.Point[order[t[i]]]; };
    six += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
  }
  Expect(std::abs(six - VolumeBefore(band, 0)) > 0.01, "excess: the faces are not warped enough");
  near.Shares.Volume = { six };
  near.Shares.Element = { 0.0 };
  near.Trimmed.Kept = { 1 };
  near.Trimmed.NodeMoves.Position = band.Point;
  for (const Correction applied : { Correction::None, Correction::Project })
  {
    near.Trimmed.NodeMoves.Applied.assign(8, applied);
    Expect(std::abs(ExcessOf(near, 0, VolumeBefore(band, 0))) < 1e-12,
      "excess of a warped element: " + std::to_string(ExcessOf(near, 0, VolumeBefore(band, 0))));
  }
}

/// What is kept of thousands of wedges round an axis is a manifold there if it is one sector, which
/// takes hardly any time to be found.
void CheckAxis()
{
  constexpr int count = 4000;
  const Band band = WedgesRoundAxis(count);
  const int low = static_cast<int>(
    std::find(band.GlobalNode.begin(), band.GlobalNode.end(), 0) - band.GlobalNode.begin());
  const int high = static_cast<int>(
    std::find(band.GlobalNode.begin(), band.GlobalNode.end(), 1) - band.GlobalNode.begin());
  const auto keep = [&band](const auto& test)
  {
    std::vector<char> kept(band.NumberOfElements());
    std::transform(band.Elements.begin(), band.Elements.end(), kept.begin(),
      [&test](const BandElement& e)
      { return static_cast<char>(test(static_cast<int>(e.Global))); });
    return kept;
  };
  const auto sector = keep([](int k) { return k >= 100 && k < 2000; });
  const auto sectors = keep([](int k) { return (k >= 100 && k < 2000) || k >= 3000; });
  const auto touching = keep([](int k) { return k % 1000 < 999; });
  for (int again = 0; again < 1000; ++again) // a decision asks as often
  {
    Expect(IsManifoldAt(band, sector, low) && IsManifoldAt(band, sector, high) &&
        !IsManifoldAt(band, sectors, low) && !IsManifoldAt(band, touching, high),
      "manifold at an axis");
  }
  Expect(IsManifoldAt(band, keep([](int) { return true; }), low) &&
      IsManifoldAt(band, keep([](int) { return false; }), low),
    "manifold at an axis: all or nothing kept");
  Expect(FindPinchedEdgesAt(band, sectors, low) == std::vector<int>{ high } &&
      FindPinchedEdgesAt(band, sector, low).empty(),
    "pinched edges at an axis");
}

/// No place is inside a facet that has no area: two corners are one, or all lie on a line, as in
/// meshes with flat elements.
void CheckFlatFacets()
{
  const std::vector<Vec3> places{ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0) };
  BandFace face;
  for (const std::array<int, 4>& nodes : { std::array<int, 4>{ 0, 1, 3, -1 },
         std::array<int, 4>{ 0, 1, 2, -1 }, std::array<int, 4>{ 0, 0, 0, -1 },
         std::array<int, 4>{ 0, 1, 2, 3 }, std::array<int, 4>{ 0, 1, 0, 1 } })
  {
    face.Node = nodes;
    face.Count = nodes[3] < 0 ? 3 : 4;
    Vec3 place;
    Expect(!FacetSearch(Facet(places, face)).FindInside(Vec3(0.3, 5, 7), 1e-9, place),
      "a place is inside a facet without area");
  }
}

}

int main()
{
  CheckFlatFacets();
  CheckAxis();
  CheckExcess();
  CheckNodeGrid();
  CheckDecisionAgain();
  CheckPromise();
  CheckAbort();
  CheckBound();
  CheckStep();
  CheckBudget();
  CheckWorth();
  CheckCrease();
  CheckCornerWithoutFaces();
  CheckSlidingMatters();
  CheckGap();
  CheckShortfalls();
  CheckParameters();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
