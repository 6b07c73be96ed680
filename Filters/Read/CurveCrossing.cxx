#include "CurveCrossing.h"

#include "CurveEvaluation.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

namespace nurbs
{
namespace
{
/// A stretch of a line between two samples, seen along the direction.
struct Segment
{
  size_t Line, Index;
  double U1, U2;
  Vec2 P1, P2;

  /// Of the curve, which bulges beyond the chord.
  Eigen::AlignedBox2d Box() const
  {
    const Vec2 slack = Vec2::Constant(0.05 * (this->P2 - this->P1).norm());
    return { this->P1.cwiseMin(this->P2) - slack, this->P1.cwiseMax(this->P2) + slack };
  }
};

class CrossingFinder
{
public:
  CrossingFinder(const std::vector<TrimLine>& lines, const Vec3& direction)
    : Lines(lines)
    , Across(direction.unitOrthogonal())
    , Up(direction.cross(Across))
  {
    for (size_t line = 0; line < lines.size(); ++line)
    {
      const std::vector<CurveSample> samples = SampleCurve(lines[line].Curve);
      for (size_t i = 0; i + 1 < samples.size(); ++i)
      {
        this->Segments.push_back({ line, i, samples[i].U, samples[i + 1].U,
          this->Flat(samples[i].Point), this->Flat(samples[i + 1].Point) });
        this->Box.extend(this->Segments.back().P1);
        this->Box.extend(this->Segments.back().P2);
      }
      this->Counts.push_back(samples.size() - 1);
    }
  }

  CurveCrossing Find()
  {
    CurveCrossing result = this->FindTurn();
    if (result.Found)
    {
      return result;
    }
    this->BuildBoxes();
    this->CrossWithin(1, 1, result);
    return result;
  }

private:
  Vec2 Flat(const Vec3& p) const { return Vec2(p.dot(this->Across), p.dot(this->Up)); }

  bool Adjacent(const Segment& a, const Segment& b) const
  {
    const size_t count = this->Counts[a.Line];
    return a.Line == b.Line &&
      (a.Index + 1 == b.Index || b.Index + 1 == a.Index ||
        (this->Lines[a.Line].Closed &&
          (a.Index + b.Index == count - 1 && std::min(a.Index, b.Index) == 0)));
  }

  /// Places where one segment turns back onto the one before.
  CurveCrossing FindTurn() const
  {
    CurveCrossing result;
    size_t start = 0;
    for (size_t line = 0; line < this->Lines.size(); start += this->Counts[line], ++line)
    {
      const size_t count = this->Counts[line];
      for (size_t i = 0; i + !this->Lines[line].Closed < count; ++i)
      {
        const Segment& a = this->Segments[start + i];
        const Segment& b = this->Segments[start + (i + 1) % count];
        const Vec2 along = a.P2 - a.P1, next = b.P2 - b.P1;
        if (along.dot(next) < (1e-10 - 1.0) * along.norm() * next.norm())
        {
          result.Found = result.TurnsBack = true;
          result.First = result.Second = line;
          result.Place = EvaluateCurve(this->Lines[line].Curve, a.U2);
          return result;
        }
      }
    }
    return result;
  }

  /// Boxes of the segments, of every two that follow each other, and so on: box k is that of 2k and
  /// 2k + 1, box 1 that of all.
  void BuildBoxes()
  {
    while (this->Leaves < this->Segments.size())
    {
      this->Leaves *= 2;
    }
    this->Boxes.resize(2 * this->Leaves);
    for (size_t i = 0; i < this->Segments.size(); ++i)
    {
      this->Boxes[this->Leaves + i] = this->Segments[i].Box();
    }
    for (size_t k = this->Leaves - 1; k > 0; --k)
    {
      this->Boxes[k] = this->Boxes[2 * k].merged(this->Boxes[2 * k + 1]);
    }
  }

  /// Looks for a crossing between the segments of two boxes of the same size, or within one.
  bool CrossWithin(size_t k, size_t l, CurveCrossing& result) const
  {
    if (!this->Boxes[k].intersects(this->Boxes[l]))
    {
      return false;
    }
    if (k >= this->Leaves)
    {
      return k != l &&
        this->Cross(this->Segments[k - this->Leaves], this->Segments[l - this->Leaves], result);
    }
    return this->CrossWithin(2 * k, 2 * l, result) || this->CrossWithin(2 * k, 2 * l + 1, result) ||
      (k != l && this->CrossWithin(2 * k + 1, 2 * l, result)) ||
      this->CrossWithin(2 * k + 1, 2 * l + 1, result);
  }

  bool Cross(const Segment& a, const Segment& b, CurveCrossing& result) const
  {
    if (this->Adjacent(a, b))
    {
      return false;
    }
    Eigen::Matrix2d slopes;
    slopes.col(0) = a.P2 - a.P1;
    slopes.col(1) = b.P1 - b.P2;
    Vec2 share = slopes.fullPivLu().solve(b.P1 - a.P1);
    if ((share.array() < -0.1).any() || (share.array() > 1.1).any())
    {
      return false;
    }
    double u = a.U1 + share[0] * (a.U2 - a.U1);
    double v = b.U1 + share[1] * (b.U2 - b.U1);
    if (!this->Refine(a, b, u, v))
    {
      return false;
    }
    result.Found = true;
    result.First = a.Line;
    result.Second = b.Line;
    result.Place = EvaluateCurve(this->Lines[a.Line].Curve, u);
    return true;
  }

  /// Newton's method on the curves; false if they do not meet near there.
  bool Refine(const Segment& a, const Segment& b, double& u, double& v) const
  {
    const ConvertedCurve& first = this->Lines[a.Line].Curve;
    const ConvertedCurve& second = this->Lines[b.Line].Curve;
    const double size = this->Box.diagonal().norm();
    for (int step = 0; step < 30; ++step)
    {
      u = std::clamp(u, a.U1, a.U2);
      v = std::clamp(v, b.U1, b.U2);
      Vec3 slopeU, slopeV;
      const Vec2 gap =
        this->Flat(EvaluateCurve(second, v, &slopeV) - EvaluateCurve(first, u, &slopeU));
      if (gap.norm() <= 1e-10 * size)
      {
        return true;
      }
      Eigen::Matrix2d slopes;
      slopes.col(0) = this->Flat(slopeU);
      slopes.col(1) = -this->Flat(slopeV);
      const Vec2 move = slopes.fullPivLu().solve(gap);
      u += move[0];
      v += move[1];
    }
    return false;
  }

  const std::vector<TrimLine>& Lines;
  Vec3 Across, Up;
  std::vector<Segment> Segments;
  std::vector<size_t> Counts; ///< segments of each line
  Eigen::AlignedBox2d Box;
  std::vector<Eigen::AlignedBox2d> Boxes;
  size_t Leaves = 1; ///< the number of the first segment's box
};
}

//------------------------------------------------------------------------------
CurveCrossing FindCrossing(const std::vector<TrimLine>& lines, const Vec3& direction)
{
  return CrossingFinder(lines, direction).Find();
}
}
