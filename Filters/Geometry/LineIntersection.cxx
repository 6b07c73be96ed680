#include "LineIntersection.h"

#include "BezierEvaluation.h"
#include "BezierRestriction.h"
#include "BoxHalving.h"
#include "Neighbourhood.h"
#include "PartAlong.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>

namespace nurbs
{
namespace
{

/// How far from the line a meeting may be, in widths of the gap between the patches there. More
/// than one: it is put on its border along a parameter line, which may be oblique.
constexpr double MostOfGap = 10.0;
/// Slope along a touching line, against that across it, that is none.
constexpr double LeastSlope = 1e-9;
/// Sine of the angle between line and surface up to which it touches.
constexpr double TouchSine = 1e-5;
/// How far beyond a small box a touch is looked for, in sizes of the box.
constexpr double ApproachRange = 8.0;

class LineSearch
{
public:
  LineSearch(const SurfaceModel& model, const Vec3& a, const Vec3& d, double low, double high,
    std::vector<LineMeeting>& meetings)
    : Model(model)
    , A(a)
    , D(d)
    , Low(low)
    , High(high)
    , Tolerance(model.Resolution)
    , Meetings(meetings)
  {
    this->E1 = d.unitOrthogonal();
    this->E2 = d.cross(this->E1);
  }

  void Run();

private:
  struct Solution
  {
    double S, T;
    Vec3 Point;
    double Distance; ///< from the line
    bool Converged;
  };

  void VisitLeaf(int boxIndex);
  bool MeetsBox(const LeafBox& box) const;
  void SearchLeaf(int index);
  bool SearchBox(
    const BezierPatch& patch, int index, const PartDomain& box, PartDomain* halves, bool& touch);
  void MeasurePart(const BezierPatch& patch, const PartDomain& box, PartAlong& part) const;
  bool IsDecided(const BezierPatch& patch, int index, const PartDomain& box, const PartAlong& part,
    double tolerance);
  bool MayGape(const BezierPatch& patch, const std::array<bool, 4>& at) const;
  bool FindTouch(const BezierPatch& patch, int index, const PartDomain& box);
  Solution Solve(const BezierPatch& patch, double s, double t, const PartDomain& box) const;
  double SquaredDistance(const Vec3& point) const;
  bool StepTowards(const SurfaceJet& jet, double damping, Vec2& step) const;
  Solution Approach(const BezierPatch& patch, double s, double t, const PartDomain& box) const;
  bool IsInBox(const Solution& solution, const PartDomain& box) const;
  bool IsTangent(const BezierPatch& patch, const Solution& solution) const;
  bool IsBesidePatch(const Solution& solution, const PartDomain& box) const;
  struct Prediction
  {
    double S, T, ReachS, ReachT; ///< a root is this near, if the leaf has one
    bool MayLieIn(const PartDomain& box) const;
  };
  Prediction Predict(const Leaf& leaf, double s, double t, const Vec3& point, double slope) const;
  bool FindStart(const Leaf& leaf, const PartDomain& box, double slope, Prediction& start) const;
  bool IsSolved(int patch, const Solution& solution, const PartDomain& box);
  bool Report(int patch, const Solution& solution, bool touch);

  const SurfaceModel& Model;
  const Vec3 A, D;
  const double Low, High, Tolerance;
  Vec3 E1, E2;
  std::vector<LineMeeting>& Meetings;
};

/// Separating axes of the segment and the boxes, four at a time.
void LineSearch::Run()
{
  const Vec3 middle = this->A + 0.5 * (this->Low + this->High) * this->D;
  const Vec3 half = 0.5 * (this->High - this->Low) * this->D;
  const float slack =
    static_cast<float>(1e-6 * (middle.cwiseAbs().maxCoeff() + half.cwiseAbs().maxCoeff()) +
      this->Tolerance + this->Model.Gap);
  const Eigen::Vector3f m = middle.cast<float>(), e = half.cast<float>();
  const auto meetsBoxes = [&](const TreeNode& node)
  {
    Eigen::Array4f c[3], h[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      c[axis] = m[axis] - 0.5f * (node.Low[axis] + node.High[axis]);
      h[axis] = 0.5f * (node.High[axis] - node.Low[axis]) + slack;
    }
    Eigen::Array<bool, 4, 1> meets = c[0].abs() <= h[0] + std::abs(e[0]);
    meets = meets && (c[1].abs() <= h[1] + std::abs(e[1]));
    meets = meets && (c[2].abs() <= h[2] + std::abs(e[2]));
    for (int axis = 0; axis < 3; ++axis)
    {
      const int j = (axis + 1) % 3, k = (axis + 2) % 3;
      meets = meets &&
        ((c[j] * e[k] - c[k] * e[j]).abs() <= h[j] * std::abs(e[k]) + h[k] * std::abs(e[j]));
    }
    return meets;
  };
  ForItemsPassing(this->Model.Nodes, meetsBoxes,
    [this](int leaf)
    {
      this->VisitLeaf(leaf);
      return true;
    });
}

bool LineSearch::MeetsBox(const LeafBox& box) const
{
  const Vec3 x = box.X.cast<double>(), y = box.Y.cast<double>(), z = x.cross(y);
  const Vec3 base = this->A - box.Center.cast<double>();
  const Vec3 a(x.dot(base), y.dot(base), z.dot(base));
  const Vec3 d(x.dot(this->D), y.dot(this->D), z.dot(this->D));
  const double radius = (box.High - box.Low).sum();
  double low = this->Low - this->Tolerance, high = this->High + this->Tolerance;
  const double slack = this->Tolerance + this->Model.Gap + 1e-6 * radius;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double boxLow = box.Low[axis] - slack, boxHigh = box.High[axis] + slack;
    if (std::abs(d[axis]) < 1e-12)
    {
      // Parallel to a pair of sides up to the rounding of the float axes.
      const double drift = 1e-6 * radius;
      if (a[axis] < boxLow - drift || a[axis] > boxHigh + drift)
      {
        return false;
      }
      continue;
    }
    double near = (boxLow - a[axis]) / d[axis], far = (boxHigh - a[axis]) / d[axis];
    if (near > far)
    {
      std::swap(near, far);
    }
    low = std::max(low, near);
    high = std::min(high, far);
  }
  return low <= high;
}

/// Newton on eqs. 12-14 with k eliminated: the two distances from the line, unbounded steps.
LineSearch::Solution LineSearch::Solve(
  const BezierPatch& patch, double s, double t, const PartDomain& box) const
{
  const Vec4* net = this->Model.Net(patch);
  const double marginS = 0.5 * (box.S1 - box.S0), marginT = 0.5 * (box.T1 - box.T0);
  Solution x{ std::clamp(s, box.S0, box.S1), std::clamp(t, box.T0, box.T1), Vec3::Zero(), 0,
    false };
  double before = 1;
  for (int i = 0; i < 25; ++i)
  {
    SurfaceJet jet;
    EvaluateBezier(patch, net, x.S, x.T, jet);
    const Vec3 r = jet.S - this->A;
    const double g1 = this->E1.dot(r), g2 = this->E2.dot(r);
    const double a = this->E1.dot(jet.Su), b = this->E1.dot(jet.Sv);
    const double c = this->E2.dot(jet.Su), d = this->E2.dot(jet.Sv);
    const double det = a * d - b * c;
    if (!(std::abs(det) > 1e-14 * (std::abs(a * d) + std::abs(b * c))))
    {
      return x;
    }
    const double ds = (b * g2 - d * g1) / det, dt = (c * g1 - a * g2) / det;
    const double length = std::max(std::abs(ds), std::abs(dt));
    const double s1 = std::clamp(x.S + ds, box.S0 - marginS, box.S1 + marginS);
    const double t1 = std::clamp(x.T + dt, box.T0 - marginT, box.T1 + marginT);
    if (length < 1e-9 && (length < 0.1 * before || length < 1e-13))
    {
      x.S = s1;
      x.T = t1;
      x.Converged = true;
      return x;
    }
    if (s1 == x.S && t1 == x.T)
    {
      return x; // held at the margin of the box
    }
    before = length;
    x.S = s1;
    x.T = t1;
  }
  return x;
}

double LineSearch::SquaredDistance(const Vec3& point) const
{
  const Vec3 r = point - this->A;
  return std::pow(this->E1.dot(r), 2) + std::pow(this->E2.dot(r), 2);
}

/// One damped Newton step towards the least distance from the line; false if there is none.
bool LineSearch::StepTowards(const SurfaceJet& jet, double damping, Vec2& step) const
{
  const Vec3 r = jet.S - this->A;
  const Vec2 g(this->E1.dot(r), this->E2.dot(r));
  const Vec3 away = g[0] * this->E1 + g[1] * this->E2;
  Eigen::Matrix2d jacobian, bend;
  jacobian << this->E1.dot(jet.Su), this->E1.dot(jet.Sv), this->E2.dot(jet.Su),
    this->E2.dot(jet.Sv);
  bend << away.dot(jet.Suu), away.dot(jet.Suv), away.dot(jet.Suv), away.dot(jet.Svv);
  // Full Hessian of half the squared distance, along and across the valley that leads to a touch:
  // in s and t rounding would hide how shallow it is.
  const Eigen::JacobiSVD<Eigen::Matrix2d> axes(jacobian, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec2 slopes = axes.singularValues();
  const Eigen::Matrix2d squares = slopes.cwiseAbs2().asDiagonal();
  Eigen::Matrix2d h = axes.matrixV().transpose() * bend * axes.matrixV() + squares;
  if (!(h(0, 0) > 0 && h(1, 1) > 0 && h.determinant() > 0))
  {
    h = squares;
  }
  h.diagonal() *= 1 + damping;
  if (!(h(0, 0) > 0))
  {
    return false;
  }
  const Vec2 slope = slopes.cwiseProduct(axes.matrixU().transpose() * g);
  Vec2 steps = h.inverse() * slope;
  if (slopes[1] < LeastSlope * slopes[0])
  {
    steps = Vec2(slope[0] / h(0, 0), 0.0); // the line lies within the surface
  }
  step = axes.matrixV() * steps;
  return true;
}

/// Least distance from the line in the box or near it (Newton, damped): beside a touch there are
/// too many boxes with a point near the line to wait for the one that holds it.
LineSearch::Solution LineSearch::Approach(
  const BezierPatch& patch, double s, double t, const PartDomain& box) const
{
  const double aroundS = ApproachRange * (box.S1 - box.S0);
  const double aroundT = ApproachRange * (box.T1 - box.T0);
  const Vec4* net = this->Model.Net(patch);
  Solution x{ s, t, Vec3::Zero(), 0, false };
  SurfaceJet jet;
  EvaluateBezier(patch, net, s, t, jet);
  double value = this->SquaredDistance(jet.S);
  double damping = 1e-12;
  Vec2 step;
  for (int i = 0; i < 60 && this->StepTowards(jet, damping, step); ++i)
  {
    const double s1 =
      std::clamp(x.S - step[0], std::max(0.0, box.S0 - aroundS), std::min(1.0, box.S1 + aroundS));
    const double t1 =
      std::clamp(x.T - step[1], std::max(0.0, box.T0 - aroundT), std::min(1.0, box.T1 + aroundT));
    if (s1 == x.S && t1 == x.T)
    {
      break;
    }
    SurfaceJet next;
    EvaluateBezier(patch, net, s1, t1, next);
    const double nextValue = this->SquaredDistance(next.S);
    if (nextValue < value)
    {
      const double gain = value - nextValue;
      jet = next;
      value = nextValue;
      x.S = s1;
      x.T = t1;
      damping = std::max(damping * 0.1, 1e-14);
      if (gain < 1e-16 * value)
      {
        break;
      }
    }
    else
    {
      damping *= 100;
      if (damping > 1e6)
      {
        break;
      }
    }
  }
  return x;
}

/// True if the solution lies in this part of the patch; at its rim two parts report it.
bool LineSearch::IsInBox(const Solution& solution, const PartDomain& box) const
{
  const double rimS = 1e-6 * (box.S1 - box.S0) + 1e-12, rimT = 1e-6 * (box.T1 - box.T0) + 1e-12;
  return solution.S >= box.S0 - rimS && solution.S <= box.S1 + rimS &&
    solution.T >= box.T0 - rimT && solution.T <= box.T1 + rimT;
}

/// Whether the line lies in the tangent plane of a solution.
bool LineSearch::IsTangent(const BezierPatch& patch, const Solution& solution) const
{
  SurfaceJet jet;
  EvaluateBezier(patch, this->Model.Net(patch), solution.S, solution.T, jet);
  return std::abs(jet.Su.cross(jet.Sv).normalized().dot(this->D)) < TouchSine;
}

/// A solution beside the patch, which no other part will report: Report decides whether it counts.
bool LineSearch::IsBesidePatch(const Solution& solution, const PartDomain& box) const
{
  return (solution.S < 0 && box.S0 == 0) || (solution.S > 1 && box.S1 == 1) ||
    (solution.T < 0 && box.T0 == 0) || (solution.T > 1 && box.T1 == 1);
}

/// Puts the solution into the patch and keeps it if it still lies on the line and segment.
bool LineSearch::Report(int index, const Solution& solution, bool touch)
{
  const BezierPatch& patch = this->Model.Patches[index];
  LineMeeting meeting;
  meeting.Patch = index;
  meeting.S = std::clamp(solution.S, 0.0, 1.0);
  meeting.T = std::clamp(solution.T, 0.0, 1.0);
  meeting.Point = BezierPoint(patch, this->Model.Net(patch), meeting.S, meeting.T);
  meeting.Touch = touch;
  const Vec3 r = meeting.Point - this->A;
  meeting.K = this->D.dot(r);
  const double away = (r - meeting.K * this->D).norm();
  const double slack = this->Tolerance + 1e-14 * std::abs(meeting.K);
  const bool clamped = meeting.S != solution.S || meeting.T != solution.T;
  if (away > (clamped ? std::max(slack, this->Model.Gap) : 2 * slack) ||
    meeting.K < this->Low - slack || meeting.K > this->High + slack)
  {
    return false;
  }
  // Beside the patch: through the gap between two faces, or past the free border. Where nothing
  // gapes, as at a knot, the next patch is met on the line or there is no meeting.
  if (away > 2 * slack)
  {
    if (!this->MayGape(patch, { solution.S<0, solution.S> 1, solution.T<0, solution.T> 1 }))
    {
      return false;
    }
    const Neighbourhood around = ExamineNeighbourhood(this->Model, meeting.Point);
    if (around.Border || away > MostOfGap * around.Gap)
    {
      return false;
    }
  }
  meeting.Away = away;
  this->Meetings.push_back(meeting);
  return true;
}

/// Reports a solution where the box has no other; false if it has to be searched.
bool LineSearch::IsSolved(int index, const Solution& solution, const PartDomain& box)
{
  if (!solution.Converged)
  {
    return false;
  }
  const bool inside = this->IsInBox(solution, box);
  return (inside || this->IsBesidePatch(solution, box)) &&
    (this->Report(index, solution, false) || inside);
}

/**
 * Where the leaf's root is, if it has one. From a point of the leaf one step with the mean
 * derivatives ends within c / (1 - c) of its length of any root, c = Deviation / slope.
 */
LineSearch::Prediction LineSearch::Predict(
  const Leaf& leaf, double s, double t, const Vec3& point, double slope) const
{
  const Vec3 normal = leaf.Z.cast<double>();
  const Vec3 r = this->A - point;
  const Vec3 d = r - (normal.dot(r) / normal.dot(this->D)) * this->D;
  const double x = leaf.X.cast<double>().dot(d), y = leaf.Y.cast<double>().dot(d);
  const double c = leaf.Deviation / slope;
  // With weights the step is scaled by a weight that is known to about c as well.
  const double factor = (this->Model.Patches[leaf.Patch].Rational ? 3.0 : 1.01) * c / (1 - c);
  const double radius = factor * std::sqrt(x * x + y * y) + this->Model.Gap;
  const float* m = leaf.Inverse;
  return { s + m[0] * x + m[1] * y, t + m[2] * x + m[3] * y,
    radius * std::sqrt(double(m[0]) * m[0] + double(m[1]) * m[1]),
    radius * std::sqrt(double(m[2]) * m[2] + double(m[3]) * m[3]) };
}

bool LineSearch::Prediction::MayLieIn(const PartDomain& box) const
{
  return this->S >= box.S0 - this->ReachS && this->S <= box.S1 + this->ReachS &&
    this->T >= box.T0 - this->ReachT && this->T <= box.T1 + this->ReachT;
}

/**
 * False if the leaf certainly has no root; else where to look for it. The reach grows with the
 * distance from the point that the prediction is made from, so in a long narrow leaf a root beside
 * it is told from one in it only by the point of the leaf that is nearest to it.
 */
bool LineSearch::FindStart(
  const Leaf& leaf, const PartDomain& box, double slope, Prediction& start) const
{
  const BezierPatch& patch = this->Model.Patches[leaf.Patch];
  double s = 0.5 * (box.S0 + box.S1), t = 0.5 * (box.T0 + box.T1);
  Vec3 point = leaf.Center;
  for (int step = 0; step < 3; ++step)
  {
    start = this->Predict(leaf, s, t, point, slope);
    if (!start.MayLieIn(box))
    {
      return false;
    }
    s = std::clamp(start.S, box.S0, box.S1);
    t = std::clamp(start.T, box.T0, box.T1);
    if (s == start.S && t == start.T)
    {
      return true;
    }
    point = BezierPoint(patch, this->Model.Net(patch), s, t);
  }
  return true;
}

void LineSearch::VisitLeaf(int boxIndex)
{
  const LeafBox& oriented = this->Model.BoxAt(boxIndex);
  if (!this->MeetsBox(oriented))
  {
    return;
  }
  const int index = oriented.Leaf();
  const Leaf& leaf = this->Model.Leaves[index];
  const BezierPatch& patch = this->Model.Patches[leaf.Patch];
  if (patch.Curve)
  {
    return;
  }
  const PartDomain box = DomainOf(patch, index);
  const double slope = std::abs(leaf.Z.cast<double>().dot(this->D));
  // The map to the plane across the line is then a contraction away from an affine one.
  if (leaf.Deviation < 0.3 * slope)
  {
    Prediction start;
    if (!this->FindStart(leaf, box, slope, start))
    {
      return;
    }
    const Solution solution = this->Solve(patch, start.S, start.T, box);
    if (this->IsSolved(leaf.Patch, solution, box))
    {
      return;
    }
    const double s = std::clamp(solution.S, box.S0, box.S1);
    const double t = std::clamp(solution.T, box.T0, box.T1);
    const Vec3 point = BezierPoint(patch, this->Model.Net(patch), s, t);
    if (!this->Predict(leaf, s, t, point, slope).MayLieIn(box))
    {
      return;
    }
  }
  this->SearchLeaf(index);
}

void LineSearch::SearchLeaf(int index)
{
  const int patchIndex = this->Model.Leaves[index].Patch;
  const BezierPatch& patch = this->Model.Patches[patchIndex];
  int touches = 0;
  int budget = 8192;
  VisitHalves(DomainOf(patch, index), budget,
    [&](const PartDomain& box, PartDomain* halves)
    {
      bool touch = false;
      const bool halved = this->SearchBox(patch, patchIndex, box, halves, touch);
      if (touch)
      {
        // A line within the surface touches everywhere: after some touches the rest is let go.
        budget = std::min(budget, 512 / ++touches);
      }
      return halved;
    });
}

/// Restricts the net to the box and measures it against the line.
void LineSearch::MeasurePart(const BezierPatch& patch, const PartDomain& box, PartAlong& part) const
{
  RestrictNet(patch, this->Model.Net(patch), box.S0, box.S1, box.T0, box.T1, part.Net);
  part.P = patch.DegreeU;
  part.Q = patch.DegreeV;
  for (int i = 0; i < (part.P + 1) * (part.Q + 1); ++i)
  {
    const double w = part.Net[i].w();
    const Vec3 r = part.Net[i].head<3>() - w * this->A;
    part.Across[i] = Vec2(this->E1.dot(r), this->E2.dot(r));
    part.Low = part.Low.cwiseMin(part.Across[i] / w);
    part.High = part.High.cwiseMax(part.Across[i] / w);
    part.First = std::min(part.First, this->D.dot(r) / w);
    part.Last = std::max(part.Last, this->D.dot(r) / w);
  }
}

/// True if the mean gradients prove that the box has no meeting, or one that Newton found.
bool LineSearch::IsDecided(const BezierPatch& patch, int index, const PartDomain& box,
  const PartAlong& part, double tolerance)
{
  const Eigen::Matrix2d m = part.MeanGradients();
  if (!(std::abs(m.determinant()) > 1e-10 * m.col(0).norm() * m.col(1).norm()))
  {
    return false;
  }
  const Eigen::Matrix2d inverse = m.inverse();
  if (part.IsPassed(inverse, tolerance))
  {
    return true;
  }
  return part.MeasureDeviation(inverse) < 0.3 &&
    this->IsSolved(
      index, this->Solve(patch, 0.5 * (box.S0 + box.S1), 0.5 * (box.T0 + box.T1), box), box);
}

/// Looks for a touch from the middle of the box.
bool LineSearch::FindTouch(const BezierPatch& patch, int index, const PartDomain& box)
{
  const Solution solution =
    this->Approach(patch, 0.5 * (box.S0 + box.S1), 0.5 * (box.T0 + box.T1), box);
  const Vec3 r = BezierPoint(patch, this->Model.Net(patch), solution.S, solution.T) - this->A;
  return (r - this->D.dot(r) * this->D).norm() <= this->Tolerance &&
    (this->IsInBox(solution, box) || this->IsTangent(patch, solution)) &&
    this->Report(index, solution, true);
}

/// Whether there may be a gap to the next face beside one of the sides. At a knot there is none,
/// unless a loop runs along it.
bool LineSearch::MayGape(const BezierPatch& patch, const std::array<bool, 4>& at) const
{
  const bool isTrimmed = !this->Model.Data[patch.Face].Loops.Empty();
  for (int side = 0; side < 4; ++side)
  {
    if (at[side] && (isTrimmed || patch.Sides[side] == SideKind::Border))
    {
      return true;
    }
  }
  return false;
}

/// False if the box is decided; else its two halves.
bool LineSearch::SearchBox(
  const BezierPatch& patch, int index, const PartDomain& box, PartDomain* halves, bool& touch)
{
  PartAlong part;
  this->MeasurePart(patch, box, part);
  const bool gapes = this->MayGape(patch, { box.S0 == 0, box.S1 == 1, box.T0 == 0, box.T1 == 1 });
  const double tolerance = gapes ? this->Tolerance + this->Model.Gap : this->Tolerance;
  if ((part.Low.array() > tolerance).any() || (part.High.array() < -tolerance).any() ||
    part.First > this->High + this->Tolerance || part.Last < this->Low - this->Tolerance ||
    this->IsDecided(patch, index, box, part, tolerance))
  {
    return false;
  }
  const double extent = std::max((part.High - part.Low).norm(), part.Last - part.First);
  // Off the line, only within the gap of a border: Newton has had its chance at this size.
  const bool onLine =
    (part.Low.array() <= this->Tolerance).all() && (part.High.array() >= -this->Tolerance).all();
  if (!onLine && extent < this->Model.Gap)
  {
    return false;
  }
  // Small enough for a touch; or flat against the line everywhere.
  if (extent < 1e-5 * this->Model.Scale || (part.High - part.Low).minCoeff() < this->Tolerance)
  {
    touch = this->FindTouch(patch, index, box);
    if (touch || extent < 1e-9 * this->Model.Scale)
    {
      return false;
    }
  }
  const Vec2 sides = MeasureSides(part.P, part.Q, part.Net);
  HalveBox(box, sides.x() >= sides.y(), false, halves);
  return true;
}

}

void FindMeetings(const SurfaceModel& model, const Vec3& a, const Vec3& d, double low, double high,
  std::vector<LineMeeting>& meetings)
{
  LineSearch(model, a, d, low, high, meetings).Run();
}

}
