#include "Jacobian.h"

#include "ElementTopology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

double Determinant(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return a.cross(b).dot(c);
}

/// Blends of four vectors for each pair of parameters: the first leads from at00 to at10.
template <std::size_t N>
std::array<std::array<Vec3, N>, N> Blend(const std::array<double, N>& parameters, const Vec3& at00,
  const Vec3& at10, const Vec3& at01, const Vec3& at11)
{
  std::array<std::array<Vec3, N>, N> blends;
  for (std::size_t i = 0; i < N; ++i)
  {
    const double x = parameters[i];
    const Vec3 at0 = (1.0 - x) * at00 + x * at10;
    const Vec3 at1 = (1.0 - x) * at01 + x * at11;
    for (std::size_t j = 0; j < N; ++j)
    {
      blends[i][j] = (1.0 - parameters[j]) * at0 + parameters[j] * at1;
    }
  }
  return blends;
}

/// Determinants of a hexahedron wherever all three parameters are of a list, in [0, 1]. The
/// derivative by each of them depends on the other two only.
template <std::size_t N>
std::array<std::array<std::array<double, N>, N>, N> HexahedronLattice(
  const ElementPoints& p, const std::array<double, N>& parameters)
{
  const auto dr = Blend(parameters, p[1] - p[0], p[2] - p[3], p[5] - p[4], p[6] - p[7]);
  const auto ds = Blend(parameters, p[3] - p[0], p[2] - p[1], p[7] - p[4], p[6] - p[5]);
  const auto dt = Blend(parameters, p[4] - p[0], p[5] - p[1], p[7] - p[3], p[6] - p[2]);
  std::array<std::array<std::array<double, N>, N>, N> determinants;
  for (std::size_t i = 0; i < N; ++i)
  {
    for (std::size_t j = 0; j < N; ++j)
    {
      for (std::size_t k = 0; k < N; ++k)
      {
        determinants[i][j][k] = Determinant(dr[j][k], ds[i][k], dt[i][j]);
      }
    }
  }
  return determinants;
}

/// Determinant of a wedge at (r, s) of the triangle and t of the axis.
double WedgeAt(const ElementPoints& p, double r, double s, double t)
{
  const auto [dr, ds, dt] = WedgeDerivatives(p, r, s, t);
  return Determinant(dr, ds, dt);
}

/// The middle Bezier coefficient of a quadratic from its values at 0, 1/2 and 1.
double MiddleCoefficient(double at0, double atHalf, double at1)
{
  return 2.0 * atHalf - 0.5 * (at0 + at1);
}

double SmallestHexahedronCoefficient(const ElementPoints& p)
{
  auto b = HexahedronLattice<3>(p, { 0.0, 0.5, 1.0 });
  // From values on the lattice to coefficients, one direction after the other.
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      b[i][j][1] = MiddleCoefficient(b[i][j][0], b[i][j][1], b[i][j][2]);
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      b[i][1][k] = MiddleCoefficient(b[i][0][k], b[i][1][k], b[i][2][k]);
    }
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (int j = 0; j < 3; ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      b[1][j][k] = MiddleCoefficient(b[0][j][k], b[1][j][k], b[2][j][k]);
      smallest = std::min({ smallest, b[0][j][k], b[1][j][k], b[2][j][k] });
    }
  }
  return smallest;
}

double SmallestWedgeCoefficient(const ElementPoints& p)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int corner = 0; corner < 3; ++corner)
  {
    const double r = corner == 1 ? 1.0 : 0.0;
    const double s = corner == 2 ? 1.0 : 0.0;
    const double bottom = WedgeAt(p, r, s, 0.0);
    const double top = WedgeAt(p, r, s, 1.0);
    smallest =
      std::min({ smallest, bottom, top, MiddleCoefficient(bottom, WedgeAt(p, r, s, 0.5), top) });
  }
  return smallest;
}

/// Vectors of four edges of a hexahedron at a time.
struct FourEdges
{
  std::array<Eigen::Array4d, 3> Way; ///< by coordinate

  Eigen::Array4d Squares() const
  {
    return this->Way[0] * this->Way[0] + this->Way[1] * this->Way[1] + this->Way[2] * this->Way[2];
  }
};

Eigen::Array4d Determinants(const FourEdges& a, const FourEdges& b, const FourEdges& c)
{
  const auto cross = [&](int i, int j) -> Eigen::Array4d
  { return a.Way[i] * b.Way[j] - a.Way[j] * b.Way[i]; };
  return cross(1, 2) * c.Way[0] + cross(2, 0) * c.Way[1] + cross(0, 1) * c.Way[2];
}

/// The edges at the corners of a hexahedron, the four corners at either end of its last axis at
/// once.
struct CornerEdges
{
  explicit CornerEdges(const ElementPoints& p);

  std::array<FourEdges, 2> R, S; ///< by end
  FourEdges T;
};

CornerEdges::CornerEdges(const ElementPoints& p)
{
  for (int c = 0; c < 3; ++c)
  {
    const auto way = [&p, c](int from, int to) { return p[to][c] - p[from][c]; };
    for (int end = 0; end < 2; ++end)
    {
      const int o = 4 * end;
      const double r0 = way(o, o + 1), r1 = way(o + 3, o + 2);
      const double s0 = way(o, o + 3), s1 = way(o + 1, o + 2);
      this->R[end].Way[c] << r0, r0, r1, r1;
      this->S[end].Way[c] << s0, s1, s0, s1;
    }
    this->T.Way[c] << way(0, 4), way(1, 5), way(3, 7), way(2, 6);
  }
}

/// A determinant of unit vectors is surely below a limit if its square is so by more than rounding.
constexpr double SurelyBelow = 1.0 - 1e-9;

/// The smallest determinant of unit vectors over the corners of a hexahedron.
/// @param limit what is below need not be exact, but below.
/// @param[out] squares of the edges' lengths, if asked for.
double SmallestHexahedronCorner(const ElementPoints& p, double limit, EdgeSquares* squares)
{
  const CornerEdges edges(p);
  const Eigen::Array4d last = edges.T.Squares();
  const double least = limit > 0.0 ? SurelyBelow * limit * limit : 0.0;
  std::array<Eigen::Array4d, 2> first, second, determinants;
  for (int end = 0; end < 2; ++end)
  {
    first[end] = edges.R[end].Squares();
    second[end] = edges.S[end].Squares();
    determinants[end] = Determinants(edges.R[end], edges.S[end], edges.T);
    // Most of what is asked for fails, and needs no root to do so.
    if (limit > 0.0 &&
      (determinants[end] <= 0.0 ||
        determinants[end] * determinants[end] < least * (first[end] * second[end] * last))
        .any())
    {
      return -1.0;
    }
  }
  double smallest = std::numeric_limits<double>::infinity();
  const Eigen::Array4d lastLengths = last.sqrt();
  for (int end = 0; end < 2 && smallest >= limit; ++end)
  {
    const Eigen::Array4d lengths = first[end].sqrt() * second[end].sqrt() * lastLengths;
    for (int i = 0; i < 4; ++i)
    {
      smallest = std::min(smallest, lengths[i] > 0.0 ? determinants[end][i] / lengths[i] : 0.0);
    }
  }
  if (squares)
  {
    *squares = { last, first[0], first[1], second[0], second[1] };
  }
  return smallest;
}

double UnitDeterminant(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0.0 ? Determinant(a, b, c) / lengths : 0.0;
}

double SmallestWedgeCorner(const ElementPoints& p)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i)
  {
    const int* corner = CornerEnds(i, 6);
    smallest = std::min(
      smallest, UnitDeterminant(p[corner[0]] - p[i], p[corner[1]] - p[i], p[corner[2]] - p[i]));
  }
  return smallest;
}

/// An ideal wedge has the scaled Jacobian 1.
const double WedgeScale = 2.0 / std::sqrt(3.0);

/// Which end of each axis of a hexahedron its nodes are at.
constexpr double AxisSide[3][8] = { { -1, 1, 1, -1, -1, 1, 1, -1 }, { -1, -1, 1, 1, -1, -1, 1, 1 },
  { -1, -1, -1, -1, 1, 1, 1, 1 } };

/// Sums of the edges along each axis of a hexahedron.
std::array<Vec3, 3> PrincipalAxes(const ElementPoints& p)
{
  return { p[1] + p[2] + p[5] + p[6] - p[0] - p[3] - p[4] - p[7],
    p[2] + p[3] + p[6] + p[7] - p[0] - p[1] - p[4] - p[5],
    p[4] + p[5] + p[6] + p[7] - p[0] - p[1] - p[2] - p[3] };
}

/// By each of three edges, of their unit vectors' determinant; zero where an edge has no length.
std::array<Vec3, 3> UnitDeterminantGradient(const std::array<Vec3, 3>& edge, double determinant)
{
  std::array<Vec3, 3> by{ Vec3::Zero(), Vec3::Zero(), Vec3::Zero() };
  const double lengths = edge[0].norm() * edge[1].norm() * edge[2].norm();
  if (lengths == 0.0)
  {
    return by;
  }
  for (int k = 0; k < 3; ++k)
  {
    by[k] = edge[(k + 1) % 3].cross(edge[(k + 2) % 3]) / lengths -
      determinant / edge[k].squaredNorm() * edge[k];
  }
  return by;
}

/// Calls take(value) with the determinant at each integration point; returns their number.
template <typename Take>
int ForDeterminants(const ElementPoints& points, int count, const Take& take)
{
  const std::array<double, 2> gauss = { 0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0) };
  if (count == 8)
  {
    const auto determinants = HexahedronLattice(points, gauss);
    for (int i = 0; i < 8; ++i)
    {
      take(determinants[i & 1][(i >> 1) & 1][i >> 2]);
    }
    return 8;
  }
  for (int i = 0; i < 6; ++i)
  {
    take(WedgeAt(points, i % 3 == 1 ? 2.0 / 3.0 : 1.0 / 6.0, i % 3 == 2 ? 2.0 / 3.0 : 1.0 / 6.0,
      gauss[i / 3]));
  }
  return 6;
}

}

JacobianRange MeasureAtIntegrationPoints(const ElementPoints& points, int count)
{
  JacobianRange range;
  range.IntegrationPoint = std::numeric_limits<double>::infinity();
  const int samples = ForDeterminants(points, count,
    [&range](double value)
    {
      range.IntegrationPoint = std::min(range.IntegrationPoint, value);
      range.Mean += value;
    });
  range.Mean /= samples;
  return range;
}

JacobianRange MeasureJacobian(const ElementPoints& points, int count)
{
  JacobianRange range = MeasureAtIntegrationPoints(points, count);
  range.Bezier =
    count == 8 ? SmallestHexahedronCoefficient(points) : SmallestWedgeCoefficient(points);
  return range;
}

double VolumeOf(const ElementPoints& p, int count)
{
  if (count == 8)
  {
    return HexahedronVolume(p, Determinant);
  }
  double sum = 0.0;
  const int samples = ForDeterminants(p, count, [&sum](double value) { sum += value; });
  return 0.5 * sum / samples;
}

bool IsInsideOut(const ElementPoints& p)
{
  // A corner that is opened to a straight angle has none but for rounding.
  constexpr double rounding = 1e-12;
  const CornerEdges edges(p);
  double least = 0.0, largest = 0.0;
  for (int end = 0; end < 2; ++end)
  {
    const Eigen::Array4d determinants = Determinants(edges.R[end], edges.S[end], edges.T);
    least = std::min(least, determinants.minCoeff());
    largest = std::max(largest, determinants.maxCoeff());
  }
  return largest <= -rounding * least && VolumeOf(p, 8) < 0.0;
}

EdgeSquares SquaresOfEdges(const ElementPoints& p)
{
  const CornerEdges edges(p);
  return { edges.T.Squares(), edges.R[0].Squares(), edges.R[1].Squares(), edges.S[0].Squares(),
    edges.S[1].Squares() };
}

double ScaledJacobian(const ElementPoints& p, int count, double limit, EdgeSquares* squares)
{
  if (count == 6)
  {
    return std::min(1.0, SmallestWedgeCorner(p) * WedgeScale);
  }
  const double smallest = SmallestHexahedronCorner(p, limit, squares);
  if (smallest < limit)
  {
    return smallest;
  }
  const auto [r, s, t] = PrincipalAxes(p);
  return std::min(smallest, UnitDeterminant(r, s, t));
}

double ScaledJacobianBound(const ElementPoints& p, int count, unsigned moving)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i)
  {
    const int* corner = CornerEnds(i, count);
    const unsigned part = 1u << i | 1u << corner[0] | 1u << corner[1] | 1u << corner[2];
    if (!(moving & part))
    {
      smallest = std::min(
        smallest, UnitDeterminant(p[corner[0]] - p[i], p[corner[1]] - p[i], p[corner[2]] - p[i]));
    }
  }
  return count == 8 ? smallest : smallest * WedgeScale;
}

ScaledDeterminants::ScaledDeterminants(const ElementPoints& p, int count, double limit)
{
  const double scale = count == 8 ? 1.0 : WedgeScale;
  const auto find = [&](const std::array<Vec3, 3>& edge, const auto& addTo)
  {
    const double value = UnitDeterminant(edge[0], edge[1], edge[2]);
    if (value * scale >= limit)
    {
      return;
    }
    ScaledDeterminant& at = this->Found[this->Count++];
    at.Value = value * scale;
    at.Gradient.fill(Vec3::Zero());
    const auto by = UnitDeterminantGradient(edge, value);
    for (int k = 0; k < 3; ++k)
    {
      addTo(at.Gradient, k, by[k]);
    }
    for (int i = 0; count == 6 && i < count; ++i)
    {
      at.Gradient[i] *= scale;
    }
  };
  for (int i = 0; i < count; ++i)
  {
    const int* corner = CornerEnds(i, count);
    find({ p[corner[0]] - p[i], p[corner[1]] - p[i], p[corner[2]] - p[i] },
      [&](auto& gradient, int k, const Vec3& by)
      {
        gradient[corner[k]] += by;
        gradient[i] -= by;
      });
  }
  if (count == 8)
  {
    find(PrincipalAxes(p),
      [](auto& gradient, int k, const Vec3& by)
      {
        for (int i = 0; i < 8; ++i)
        {
          gradient[i] += AxisSide[k][i] * by;
        }
      });
  }
}

}
