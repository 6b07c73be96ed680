#include "SurfaceConstruction.h"

#include "KnotVector.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
Vec4 Weighted(const Vec3& point, double weight)
{
  return Vec4(point.x(), point.y(), point.z(), weight);
}

/// Cartesian with weight to homogeneous, and back.
Vec4 Homogeneous(const Vec4& p)
{
  return Vec4(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
}
Vec4 Cartesian(const Vec4& p)
{
  return Vec4(p[0] / p[3], p[1] / p[3], p[2] / p[3], p[3]);
}

/// Where the pieces of a conic end, none longer than `longest`.
std::vector<double> PieceEnds(double first, double last, double longest)
{
  const int pieces =
    std::max(1, static_cast<int>(std::ceil((last - first) / longest * (1.0 - 1e-12))));
  std::vector<double> ends;
  for (int i = 0; i < pieces; ++i)
  {
    ends.push_back(first + (last - first) * i / pieces);
  }
  ends.push_back(last);
  return ends;
}

/// Knots of quadratic pieces, each end twice, clamped.
std::vector<double> QuadraticKnots(const std::vector<double>& ends)
{
  std::vector<double> knots{ ends.front() };
  for (double end : ends)
  {
    knots.insert(knots.end(), 2, end);
  }
  knots.push_back(ends.back());
  return knots;
}

/// Quadratic pieces of a conic from its points and the middle control point of each piece.
template <typename PointAt, typename MiddleOf>
ConvertedCurve MakeConic(
  std::vector<double> ends, ParameterMap::Law law, const PointAt& pointAt, const MiddleOf& middleOf)
{
  ConvertedCurve curve;
  curve.Degree = 2;
  curve.Knots = QuadraticKnots(ends);
  curve.Points.push_back(Weighted(pointAt(ends[0]), 1.0));
  for (size_t i = 0; i + 1 < ends.size(); ++i)
  {
    curve.Points.push_back(middleOf(ends[i], ends[i + 1]));
    curve.Points.push_back(Weighted(pointAt(ends[i + 1]), 1.0));
  }
  curve.Map = ParameterMap(law, std::move(ends));
  return curve;
}

/// A bound of the part wanted, moved onto a border or knot that it all but equals.
double Snap(const std::vector<double>& knots, int degree, int count, double t)
{
  const double slack = 1e-9 * (knots[count] - knots[degree]);
  double snapped = std::clamp(t, knots[degree], knots[count]);
  for (int k = degree; k <= count; ++k)
  {
    if (std::abs(knots[k] - t) <= slack)
    {
      snapped = knots[k];
    }
  }
  return snapped;
}

/// Inserts the knot t once into all columns of control points (The NURBS Book, A5.1 and 5.2).
void InsertKnot(std::vector<double>& knots, int degree, std::vector<std::vector<Vec4>>& columns,
  double t, int multiplicity)
{
  const int k = LastKnotNotAbove(knots, t);
  for (std::vector<Vec4>& column : columns)
  {
    std::vector<Vec4> fresh;
    fresh.reserve(column.size() + 1);
    for (int i = 0; i <= static_cast<int>(column.size()); ++i)
    {
      if (i <= k - degree)
      {
        fresh.push_back(column[i]);
      }
      else if (i > k - multiplicity)
      {
        fresh.push_back(column[i - 1]);
      }
      else
      {
        const double alpha = (t - knots[i]) / (knots[i + degree] - knots[i]);
        fresh.push_back((1.0 - alpha) * column[i - 1] + alpha * column[i]);
      }
    }
    column.swap(fresh);
  }
  knots.insert(knots.begin() + k + 1, t);
}

/// Cuts the columns of homogeneous points to [first, last] and clamps the knots there.
void RestrictColumns(std::vector<double>& knots, int degree,
  std::vector<std::vector<Vec4>>& columns, double first, double last)
{
  for (double t : { first, last })
  {
    int multiplicity = static_cast<int>(std::count(knots.begin(), knots.end(), t));
    for (; multiplicity < degree; ++multiplicity)
    {
      InsertKnot(knots, degree, columns, t, multiplicity);
    }
  }
  // The control point where a knot of multiplicity p begins is interpolated there.
  const auto firstOf = std::upper_bound(knots.begin(), knots.end(), first);
  const auto lastOf = std::lower_bound(knots.begin(), knots.end(), last);
  const std::ptrdiff_t from = firstOf - knots.begin() - degree - 1;
  const std::ptrdiff_t to = lastOf - knots.begin() - 1;
  for (std::vector<Vec4>& column : columns)
  {
    column = std::vector<Vec4>(
      column.begin() + std::max<std::ptrdiff_t>(0, from), column.begin() + to + 1);
  }
  std::vector<double> cut(degree + 1, first);
  cut.insert(cut.end(), firstOf, lastOf);
  cut.insert(cut.end(), degree + 1, last);
  knots.swap(cut);
}

NurbsSurface RestrictU(const NurbsSurface& surface, double first, double last)
{
  first = Snap(surface.KnotsU, surface.DegreeU, surface.CountU, first);
  last = Snap(surface.KnotsU, surface.DegreeU, surface.CountU, last);
  std::vector<std::vector<Vec4>> columns(surface.CountV);
  for (int j = 0; j < surface.CountV; ++j)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      columns[j].push_back(Homogeneous(surface.ControlPoints[i + j * surface.CountU]));
    }
  }
  NurbsSurface result = surface;
  RestrictColumns(result.KnotsU, result.DegreeU, columns, first, last);
  result.CountU = static_cast<int>(columns[0].size());
  result.ControlPoints.clear();
  for (const std::vector<Vec4>& column : columns)
  {
    std::transform(
      column.begin(), column.end(), std::back_inserter(result.ControlPoints), Cartesian);
  }
  return result;
}

bool IsClamped(const std::vector<double>& knots, int degree, int count)
{
  return knots[0] == knots[degree] && knots[count] == knots[count + degree];
}
}

//------------------------------------------------------------------------------
double ParameterMap::operator()(double t) const
{
  if (this->Kind == Law::Identity || t <= this->Ends.front() || t >= this->Ends.back())
  {
    return t;
  }
  const int span = LastKnotNotAbove(this->Ends, t);
  const double first = this->Ends[span];
  const double last = this->Ends[span + 1];
  const double middle = 0.5 * (first + last);
  const double ratio = this->Kind == Law::Circular
    ? std::tan(0.5 * (t - middle)) / std::tan(0.25 * (last - first))
    : std::tanh(0.5 * (t - middle)) / std::tanh(0.25 * (last - first));
  return middle + 0.5 * (last - first) * ratio;
}

//------------------------------------------------------------------------------
ConvertedCurve MakeLine(const Vec3& origin, const Vec3& direction, double first, double last)
{
  ConvertedCurve curve;
  curve.Knots = { first, first, last, last };
  curve.Points = { Weighted(origin + first * direction, 1.0),
    Weighted(origin + last * direction, 1.0) };
  return curve;
}

//------------------------------------------------------------------------------
ConvertedCurve MakeEllipse(
  const Vec3& centre, const Vec3& a, const Vec3& b, double first, double last)
{
  auto pointAt = [&](double t) { return Vec3(centre + std::cos(t) * a + std::sin(t) * b); };
  auto middleOf = [&](double t1, double t2)
  {
    const double t = 0.5 * (t1 + t2);
    const double weight = std::cos(0.5 * (t2 - t1));
    return Weighted(centre + (std::cos(t) * a + std::sin(t) * b) / weight, weight);
  };
  ConvertedCurve curve =
    MakeConic(PieceEnds(first, last, 0.5 * M_PI), ParameterMap::Law::Circular, pointAt, middleOf);
  // A whole turn closes to the last bit.
  if (std::abs(last - first - 2.0 * M_PI) < 1e-12)
  {
    curve.Points.back() = curve.Points.front();
  }
  return curve;
}

//------------------------------------------------------------------------------
ConvertedCurve MakeHyperbola(
  const Vec3& centre, const Vec3& a, const Vec3& b, double first, double last)
{
  auto pointAt = [&](double t) { return Vec3(centre + std::cosh(t) * a + std::sinh(t) * b); };
  auto middleOf = [&](double t1, double t2)
  {
    const double t = 0.5 * (t1 + t2);
    const double weight = std::cosh(0.5 * (t2 - t1));
    return Weighted(centre + (std::cosh(t) * a + std::sinh(t) * b) / weight, weight);
  };
  return MakeConic(PieceEnds(first, last, 1.0), ParameterMap::Law::Hyperbolic, pointAt, middleOf);
}

//------------------------------------------------------------------------------
ConvertedCurve MakeParabola(
  const Vec3& vertex, const Vec3& a, const Vec3& b, double first, double last)
{
  ConvertedCurve curve;
  curve.Degree = 2;
  curve.Knots = { first, first, first, last, last, last };
  // The blossom of t^2 and t.
  for (auto t : { Vec2(first, first), Vec2(first, last), Vec2(last, last) })
  {
    curve.Points.push_back(Weighted(vertex + t.x() * t.y() * a + 0.5 * (t.x() + t.y()) * b, 1.0));
  }
  return curve;
}

//------------------------------------------------------------------------------
ConvertedCurve ElevateDegree(const ConvertedCurve& curve, int degree)
{
  return degree > curve.Degree ? WithBezierKnots(curve, degree) : curve;
}

//------------------------------------------------------------------------------
ConvertedCurve WithBezierKnots(const ConvertedCurve& curve, int degree)
{
  std::vector<double> knots = curve.Knots;
  std::vector<std::vector<Vec4>> columns(1);
  std::transform(
    curve.Points.begin(), curve.Points.end(), std::back_inserter(columns[0]), Homogeneous);
  std::vector<double> ends(knots.begin() + curve.Degree, knots.end() - curve.Degree);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (size_t i = 1; i + 1 < ends.size(); ++i)
  {
    int multiplicity = static_cast<int>(std::count(knots.begin(), knots.end(), ends[i]));
    for (; multiplicity < curve.Degree; ++multiplicity)
    {
      InsertKnot(knots, curve.Degree, columns, ends[i], multiplicity);
    }
  }
  ConvertedCurve result;
  result.Degree = degree;
  result.Map = curve.Map;
  result.Knots.assign(degree + 1, ends.front());
  result.Points.push_back(curve.Points.front());
  for (size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const auto first = columns[0].begin() + static_cast<std::ptrdiff_t>(i) * curve.Degree;
    std::vector<Vec4> piece(first, first + curve.Degree + 1);
    while (static_cast<int>(piece.size()) <= degree)
    {
      const size_t count = piece.size();
      piece.push_back(piece.back());
      for (size_t k = count - 1; k > 0; --k)
      {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        piece[k] = share * piece[k - 1] + (1.0 - share) * piece[k];
      }
    }
    std::transform(piece.begin() + 1, piece.end(), std::back_inserter(result.Points), Cartesian);
    result.Knots.insert(result.Knots.end(), degree, ends[i + 1]);
  }
  result.Knots.push_back(ends.back());
  result.Points.back() = curve.Points.back();
  return result;
}

//------------------------------------------------------------------------------
ConvertedSurface Extrude(
  const ConvertedCurve& curve, const Vec3& direction, double firstV, double lastV)
{
  ConvertedSurface result;
  NurbsSurface& surface = result.Surface;
  surface.DegreeU = curve.Degree;
  surface.CountU = static_cast<int>(curve.Points.size());
  surface.CountV = 2;
  surface.KnotsU = curve.Knots;
  surface.KnotsV = { firstV, firstV, lastV, lastV };
  for (double v : { firstV, lastV })
  {
    for (const Vec4& point : curve.Points)
    {
      surface.ControlPoints.push_back(Weighted(point.head<3>() + v * direction, point[3]));
    }
  }
  result.MapU = curve.Map;
  return result;
}

//------------------------------------------------------------------------------
ConvertedSurface Revolve(
  const ConvertedCurve& curve, const Vec3& origin, const Vec3& axis, double firstU, double lastU)
{
  ConvertedSurface result;
  NurbsSurface& surface = result.Surface;
  surface.DegreeU = 2;
  surface.DegreeV = curve.Degree;
  surface.CountV = static_cast<int>(curve.Points.size());
  surface.KnotsV = curve.Knots;
  result.MapV = curve.Map;
  for (const Vec4& point : curve.Points)
  {
    const Vec3 arm = point.head<3>() - origin;
    const Vec3 centre = origin + arm.dot(axis) * axis;
    const Vec3 radial = point.head<3>() - centre;
    const ConvertedCurve circle = MakeEllipse(centre, radial, axis.cross(radial), firstU, lastU);
    for (const Vec4& turned : circle.Points)
    {
      surface.ControlPoints.push_back(Weighted(turned.head<3>(), turned[3] * point[3]));
    }
    surface.CountU = static_cast<int>(circle.Points.size());
    surface.KnotsU = circle.Knots;
    result.MapU = circle.Map;
  }
  return result;
}

//------------------------------------------------------------------------------
NurbsSurface Restrict(
  const NurbsSurface& surface, double firstU, double lastU, double firstV, double lastV)
{
  // Untouched to the last bit where nothing is cut.
  NurbsSurface result = surface;
  for (int axis : { 0, 1 })
  {
    const double first = axis == 0 ? firstU : firstV;
    const double last = axis == 0 ? lastU : lastV;
    const double slack = 1e-9 * (result.LastU() - result.FirstU());
    if (!IsClamped(result.KnotsU, result.DegreeU, result.CountU) ||
      first > result.FirstU() + slack || last < result.LastU() - slack)
    {
      result = RestrictU(result, first, last);
    }
    result = Transpose(result);
  }
  return result;
}

//------------------------------------------------------------------------------
NurbsSurface RepeatU(const NurbsSurface& surface)
{
  NurbsSurface result = surface;
  const double period = surface.LastU() - surface.FirstU();
  result.CountU = 2 * surface.CountU - 1;
  result.KnotsU.assign(
    surface.KnotsU.begin(), surface.KnotsU.begin() + surface.CountU + surface.DegreeU);
  for (size_t i = surface.DegreeU + 1; i < surface.KnotsU.size(); ++i)
  {
    result.KnotsU.push_back(surface.KnotsU[i] + period);
  }
  result.ControlPoints.clear();
  for (int j = 0; j < surface.CountV; ++j)
  {
    const auto row = surface.ControlPoints.begin() + j * surface.CountU;
    result.ControlPoints.insert(result.ControlPoints.end(), row, row + surface.CountU);
    result.ControlPoints.insert(result.ControlPoints.end(), row + 1, row + surface.CountU);
  }
  return result;
}

//------------------------------------------------------------------------------
NurbsSurface Transpose(const NurbsSurface& surface)
{
  NurbsSurface result = surface;
  std::swap(result.DegreeU, result.DegreeV);
  std::swap(result.CountU, result.CountV);
  std::swap(result.KnotsU, result.KnotsV);
  for (int j = 0; j < surface.CountV; ++j)
  {
    for (int i = 0; i < surface.CountU; ++i)
    {
      result.ControlPoints[j + i * surface.CountV] = surface.ControlPoints[i + j * surface.CountU];
    }
  }
  for (std::vector<Vec2>& loop : result.TrimLoops)
  {
    for (Vec2& uv : loop)
    {
      std::swap(uv.x(), uv.y());
    }
  }
  return result;
}

//------------------------------------------------------------------------------
NurbsSurface ReverseU(const NurbsSurface& surface)
{
  NurbsSurface result = surface;
  const double sum = surface.FirstU() + surface.LastU();
  std::transform(surface.KnotsU.rbegin(), surface.KnotsU.rend(), result.KnotsU.begin(),
    [sum](double knot) { return sum - knot; });
  for (int j = 0; j < surface.CountV; ++j)
  {
    const auto row = result.ControlPoints.begin() + j * surface.CountU;
    std::reverse(row, row + surface.CountU);
  }
  for (std::vector<Vec2>& loop : result.TrimLoops)
  {
    for (Vec2& uv : loop)
    {
      uv.x() = sum - uv.x();
    }
  }
  return result;
}
}
