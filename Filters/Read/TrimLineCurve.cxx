#include "TrimLineCurve.h"

#include "SurfaceConstruction.h"

#include "vtkNew.h"
#include "vtkParametricSpline.h"
#include "vtkPoints.h"

#include <Eigen/Geometry>

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
std::vector<double> ChordLengths(const TrimLine& line)
{
  std::vector<double> lengths(1, 0.0);
  for (size_t i = 1; i < line.Points.size(); ++i)
  {
    lengths.push_back(lengths.back() + (line.Points[i] - line.Points[i - 1]).norm());
  }
  if (line.Closed)
  {
    lengths.push_back(lengths.back() + (line.Points.front() - line.Points.back()).norm());
  }
  return lengths;
}

/// Four places of a cubic determine it; so no spline is solved here that could differ from VTK's.
std::vector<CubicPiece> SamplePieces(const TrimLine& line, const std::vector<double>& lengths)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& point : line.Points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkParametricSpline> spline;
  spline->SetPoints(points);
  spline->SetClosed(line.Closed);
  const auto at = [&](double length)
  {
    double u[3] = { length / lengths.back(), 0.0, 0.0 };
    double unused[9];
    Vec3 point;
    spline->Evaluate(u, point.data(), unused);
    return point;
  };
  std::vector<CubicPiece> pieces;
  for (size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const double first = lengths[i], last = lengths[i + 1], third = (last - first) / 3.0;
    const Vec3 f0 = line.Points[i], f3 = line.Points[(i + 1) % line.Points.size()];
    const Vec3 f1 = at(first + third), f2 = at(last - third);
    pieces.push_back({ first, last,
      { f0, (-5.0 * f0 + 18.0 * f1 - 9.0 * f2 + 2.0 * f3) / 6.0,
        (2.0 * f0 - 9.0 * f1 + 18.0 * f2 - 5.0 * f3) / 6.0, f3 } });
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

/// Area that a closed polygon encloses, seen along the unit vector, which it turns round
/// right-handed.
double EnclosedArea(const std::vector<Vec3>& polygon, const Vec3& direction)
{
  Vec3 area = Vec3::Zero();
  for (size_t i = 2; i < polygon.size(); ++i)
  {
    area += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return area.dot(direction);
}

/// Points along the pieces, close enough for the sense in which they turn.
std::vector<Vec3> MakePolygon(const std::vector<CubicPiece>& pieces)
{
  constexpr int Places = 16;
  std::vector<Vec3> polygon;
  for (const CubicPiece& piece : pieces)
  {
    for (int i = 0; i < Places; ++i)
    {
      const double t = piece.First + piece.Size() * i / Places;
      polygon.push_back(piece.Blossom(t, t, t));
    }
  }
  return polygon;
}

std::string FindSweepDefect(const TrimLine& line)
{
  if (!line.Direction.allFinite() || line.Direction.norm() == 0.0)
  {
    return "Direction is zero or not finite; give the direction in which the line is swept, for "
           "a sheet its normal";
  }
  if (!std::isfinite(line.Length) || line.Length <= 0.0)
  {
    std::ostringstream text;
    text << "Length is " << line.Length
         << "; it must be positive, and large enough to pass through the part";
    return text.str();
  }
  return {};
}
}

//------------------------------------------------------------------------------
std::string FindDefect(const TrimLine& line)
{
  const std::string sweep = FindSweepDefect(line);
  if (!sweep.empty())
  {
    return sweep;
  }
  std::ostringstream text;
  const size_t count = line.Points.size(), least = line.Closed ? 3 : 2;
  if (count < least)
  {
    text << "it has " << count << " points; " << (line.Closed ? "a closed" : "an open")
         << " line needs at least " << least;
    return text.str();
  }
  for (size_t i = 0; i < count; ++i)
  {
    if (!line.Points[i].allFinite())
    {
      text << "point " << i << " is not finite; correct or remove it";
      return text.str();
    }
  }
  const std::vector<double> lengths = ChordLengths(line);
  const Vec3 direction = line.Direction.stableNormalized();
  for (size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const size_t next = (i + 1) % count;
    const Vec3 chord = line.Points[next] - line.Points[i];
    if (!(chord.norm() > Negligible * lengths.back()))
    {
      text << "points " << i << " and " << next << " coincide; remove one of them";
      return text.str();
    }
    if (chord.cross(direction).norm() <= Negligible * chord.norm())
    {
      text << "Direction is along the line from point " << i << " to point " << next
           << "; give a direction across the line";
      return text.str();
    }
  }
  const double area = EnclosedArea(line.Points, direction);
  if (line.Closed && std::abs(area) <= Negligible * lengths.back() * lengths.back())
  {
    return "the closed line encloses no area, seen along Direction, or crosses itself; move its "
           "points or change Direction";
  }
  return {};
}

//------------------------------------------------------------------------------
NurbsSurface SweepTrimLine(const TrimLine& line)
{
  const std::vector<double> lengths = ChordLengths(line);
  const std::vector<CubicPiece> pieces = SamplePieces(line, lengths);
  const Vec3 direction = line.Direction.stableNormalized();
  const NurbsSurface surface =
    Extrude(JoinPieces(pieces, lengths, line.Closed), direction, -line.Length, line.Length).Surface;
  // C' x direction points out of what a right-handed turn encloses.
  const bool outwards = line.Closed && EnclosedArea(MakePolygon(pieces), direction) > 0.0;
  return outwards ? ReverseU(surface) : surface;
}
}
