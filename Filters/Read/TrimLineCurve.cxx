#include "TrimLineCurve.h"

#include "vtkCardinalSpline.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace nurbs
{
namespace
{
/// Below this share of the lengths involved points coincide, directions are parallel.
constexpr double Negligible = 1e-9;
/// The same for points that were written with some digits only.
constexpr double WrittenShare = 1e-5;
/// A line whose ends are nearer to each other than this share of its length is meant to be closed;
/// up to the larger one if it would go straight on.
constexpr double ClosedShare = 1e-3;
constexpr double OpenShare = 0.02;
constexpr double StraightOnCosine = 0.5;

/// A cubic over [First, Last] in Bezier form.
struct CubicPiece
{
  double First, Last;
  std::array<Vec3, 4> B;

  double Size() const { return this->Last - this->First; }

  /// The polar form f(a, b, c), f(t, t, t) being the point at t. (de Casteljau's algorithm with
  /// an argument of its own at each level)
  Vec3 Blossom(double a, double b, double c) const
  {
    std::array<Vec3, 4> points = this->B;
    int count = 3;
    for (double t : { a, b, c })
    {
      const double s = (t - this->First) / this->Size();
      for (int i = 0; i < count; ++i)
      {
        points[i] = (1.0 - s) * points[i] + s * points[i + 1];
      }
      --count;
    }
    return points[0];
  }
};

/// The parameters of the points, a closed line's first one at the end again.
std::vector<double> ChordLengths(const std::vector<Vec3>& points, bool closed)
{
  std::vector<double> lengths(1, 0.0);
  for (size_t i = 1; i < points.size(); ++i)
  {
    lengths.push_back(lengths.back() + (points[i] - points[i - 1]).norm());
  }
  if (closed)
  {
    lengths.push_back(lengths.back() + (points.front() - points.back()).norm());
  }
  return lengths;
}

/// The equations of VTK's splines, so that no spline is solved here that could differ from
/// vtkParametricSpline. That itself takes the points one by one, the longer the more there are.
class SplineFit : public vtkCardinalSpline
{
public:
  static SplineFit* New();
  vtkTypeMacro(SplineFit, vtkCardinalSpline);

  /// Coefficients of the powers of the length from each point on.
  ///
  /// @param values at the lengths; of a closed line the first one at the end again.
  std::vector<std::array<double, 4>> Fit(
    std::vector<double> lengths, std::vector<double> values, bool closed)
  {
    const int count = static_cast<int>(lengths.size());
    std::vector<double> work(lengths.size());
    std::vector<std::array<double, 4>> cubics(lengths.size());
    const auto coefficients = reinterpret_cast<double(*)[4]>(cubics.data());
    if (closed)
    {
      this->FitClosed1D(count, lengths.data(), values.data(), work.data(), coefficients);
    }
    else
    {
      // The first derivative is zero at both ends.
      this->Fit1D(count, lengths.data(), values.data(), work.data(), coefficients, 1, 0.0, 1, 0.0);
    }
    return cubics;
  }
};
vtkStandardNewMacro(SplineFit);

std::vector<CubicPiece> FitPieces(
  const std::vector<Vec3>& points, bool closed, const std::vector<double>& lengths)
{
  vtkNew<SplineFit> spline;
  std::array<std::vector<std::array<double, 4>>, 3> cubics;
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> values;
    for (size_t i = 0; i < lengths.size(); ++i)
    {
      values.push_back(points[i % points.size()][axis]);
    }
    cubics[axis] = spline->Fit(lengths, values, closed);
  }
  std::vector<CubicPiece> pieces;
  for (size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const double size = lengths[i + 1] - lengths[i];
    const auto power = [&](int k) -> Vec3
    { return std::pow(size, k) * Vec3(cubics[0][i][k], cubics[1][i][k], cubics[2][i][k]); };
    const Vec3 first = points[i], slope = power(1) / 3.0, bend = power(2) / 3.0;
    pieces.push_back({ lengths[i], lengths[i + 1],
      { first, first + slope, first + 2.0 * slope + bend, points[(i + 1) % points.size()] } });
  }
  return pieces;
}

/// The pieces join with continuous second derivatives: a B-spline with simple inner knots.
ConvertedCurve JoinPieces(
  const std::vector<CubicPiece>& pieces, const std::vector<double>& lengths, bool closed)
{
  ConvertedCurve curve;
  curve.Degree = 3;
  curve.Knots.assign(3, lengths.front());
  curve.Knots.insert(curve.Knots.end(), lengths.begin(), lengths.end());
  curve.Knots.insert(curve.Knots.end(), 3, lengths.back());
  const int last = static_cast<int>(pieces.size()) - 1;
  for (int i = 0; i < last + 4; ++i)
  {
    // Control point i is the polar form at the knots i+1, i+2, i+3 of any piece that they touch
    // (Ramshaw 1989). The pieces around the middle one extrapolate least, of them the longer.
    const int right = std::clamp(i - 1, 0, last), left = std::clamp(i - 2, 0, last);
    const CubicPiece& piece =
      pieces[left].Size() > pieces[right].Size() ? pieces[left] : pieces[right];
    const Vec3 p = piece.Blossom(curve.Knots[i + 1], curve.Knots[i + 2], curve.Knots[i + 3]);
    curve.Points.emplace_back(p.x(), p.y(), p.z(), 1.0);
  }
  if (!closed)
  {
    // The first derivative is zero at open ends: exactly, lest rounding gives it a direction.
    curve.Points[1] = curve.Points.front();
    curve.Points[curve.Points.size() - 2] = curve.Points.back();
  }
  return curve;
}

/// Whether the way from the end of an open line back to its beginning goes on as the line does at
/// one of the two: round a slot it goes across.
bool GoesOn(const std::vector<Vec3>& points)
{
  const Vec3 way = (points.front() - points.back()).normalized();
  const Vec3 last = (points.back() - points[points.size() - 2]).normalized();
  const Vec3 first = (points[1] - points[0]).normalized();
  return std::max(way.dot(last), way.dot(first)) > StraightOnCosine;
}

/// What is cut off along a line that is meant to be closed, but is not, goes by the sense in which
/// it was drawn.
std::string FindNearlyClosedDefect(const std::vector<Vec3>& points, double length)
{
  const double gap = (points.back() - points.front()).norm();
  if (points.size() < 3 || gap > OpenShare * length ||
    (gap > ClosedShare * length && !GoesOn(points)))
  {
    return {};
  }
  if (!(gap > Negligible * length))
  {
    return "it ends where it begins; set Closed and remove the last point";
  }
  std::ostringstream text;
  text << "it ends " << gap
       << " from where it begins, and is open; set Closed, or let its ends lie "
       << "farther apart, outside of the part";
  return text.str();
}

}

//------------------------------------------------------------------------------
bool EndsWhereItBegins(const std::vector<Vec3>& points)
{
  const double gap = (points.back() - points.front()).norm();
  return gap <= WrittenShare * ChordLengths(points, false).back();
}

//------------------------------------------------------------------------------
std::string FindPointDefect(const std::vector<Vec3>& points, bool closed)
{
  const size_t count = points.size();
  std::ostringstream text;
  if (count < (closed ? 3u : 2u))
  {
    text << "it has " << count << " points; give x, y, z of at least " << (closed ? 3 : 2);
    return text.str();
  }
  for (size_t i = 0; i < count; ++i)
  {
    if (!points[i].allFinite())
    {
      text << "point " << i << " is not finite; give finite coordinates";
      return text.str();
    }
  }
  const std::vector<double> lengths = ChordLengths(points, closed);
  for (size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const size_t next = (i + 1) % count;
    if (!((points[next] - points[i]).norm() > Negligible * lengths.back()))
    {
      text << "points " << i << " and " << next << " coincide; remove one of them";
      return text.str();
    }
  }
  return closed ? std::string() : FindNearlyClosedDefect(points, lengths.back());
}

//------------------------------------------------------------------------------
TrimLine MakeSpline(const std::vector<Vec3>& points, bool closed)
{
  const std::vector<double> lengths = ChordLengths(points, closed);
  const std::vector<CubicPiece> pieces = FitPieces(points, closed, lengths);
  return { JoinPieces(pieces, lengths, closed), closed, {} };
}

//------------------------------------------------------------------------------
TrimLine MakePolyline(const std::vector<Vec3>& points, bool closed)
{
  const std::vector<double> lengths = ChordLengths(points, closed);
  ConvertedCurve curve;
  curve.Knots.push_back(lengths.front());
  curve.Knots.insert(curve.Knots.end(), lengths.begin(), lengths.end());
  curve.Knots.push_back(lengths.back());
  for (size_t i = 0; i < lengths.size(); ++i)
  {
    const Vec3& p = points[i % points.size()];
    curve.Points.emplace_back(p.x(), p.y(), p.z(), 1.0);
  }
  return { curve, closed, {} };
}
}
