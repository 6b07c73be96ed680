/**
 * @file Jacobian.h
 * @brief The Jacobian determinant of hexahedra and wedges: at integration points, at corners,
 * and as Bezier coefficients that bound it in the whole element.
 *
 * The determinant of a trilinear hexahedron is a polynomial of degree two in each of its three
 * parameters, that of a wedge of degree one over the triangle and two along the axis. With all
 * Bezier coefficients positive it is positive everywhere in the element (A. Johnen, J.-C. Weill,
 * J.-F. Remacle, Robust and efficient validation of the linear hexahedral element, 2017).
 */
#ifndef Jacobian_h
#define Jacobian_h

#include "ElementMap.h"

#include <array>
#include <limits>

namespace trim
{

struct JacobianRange
{
  double Mean = 0;             ///< over the integration points
  double IntegrationPoint = 0; ///< smallest over 2x2x2 Gauss points, 3x2 for a wedge
  double Bezier = 0;           ///< smallest Bezier coefficient: a lower bound everywhere
};

/// All three of one element of `count` (8 or 6) nodes in VTK's order.
JacobianRange MeasureJacobian(const ElementPoints& points, int count);

/// The first two only.
JacobianRange MeasureAtIntegrationPoints(const ElementPoints& points, int count);

/// Volume, exact for trilinear hexahedra (J. Grandy, Efficient computation of volume of hexahedral
/// cells, 1997) and for wedges.
double VolumeOf(const ElementPoints& points, int count);

/// The same of a hexahedron, for points of any kind that can be added and subtracted.
template <typename Points, typename Determinant>
EIGEN_ALWAYS_INLINE auto HexahedronVolume(const Points& p, const Determinant& determinant)
{
  // No expression of Eigen is to outlive what it refers to.
  using Value = decltype(determinant(p[0], p[1], p[2]));
  return Value((determinant(p[3] - p[1] + p[7] - p[2], p[6] - p[3], p[2] - p[0]) +
                 determinant(p[4] - p[3] + p[5] - p[7], p[6] - p[4], p[7] - p[0]) +
                 determinant(p[1] - p[4] + p[2] - p[5], p[6] - p[1], p[5] - p[0])) /
    12.0);
}

/// Whether a hexahedron has its nodes in the other order, as a mirrored one: its volume is below
/// zero, and no corner's determinant above it.
bool IsInsideOut(const ElementPoints& points);

/// Squares of the lengths of a hexahedron's edges, four at a time, some of them twice.
using EdgeSquares = std::array<Eigen::Array4d, 5>;
EdgeSquares SquaresOfEdges(const ElementPoints& points);

/**
 * Verdict's scaled Jacobian: the smallest determinant of unit edge vectors over the corners,
 * for hexahedra also over the centre's; for wedges scaled so that the ideal one has 1.
 *
 * @param limit what is below need not be exact, but below.
 * @param[out] squares of the edges of a hexahedron that is not below it, if asked for.
 */
double ScaledJacobian(const ElementPoints& points, int count,
  double limit = -std::numeric_limits<double>::infinity(), EdgeSquares* squares = nullptr);

/// What the scaled Jacobian cannot exceed wherever some of the nodes go: the smallest determinant
/// over the corners that they have no part in.
/// @param moving one bit for each node, the lowest for the first.
double ScaledJacobianBound(const ElementPoints& points, int count, unsigned moving);

/// One of the determinants that the scaled Jacobian is the smallest of, and how it changes with
/// the element's nodes.
struct ScaledDeterminant
{
  double Value;
  std::array<Vec3, 8> Gradient; ///< by node
};

/// Those below a limit: of the corners, for hexahedra also of the centre.
class ScaledDeterminants
{
public:
  ScaledDeterminants(const ElementPoints& points, int count, double limit);

  const ScaledDeterminant* begin() const { return this->Found.data(); }
  const ScaledDeterminant* end() const { return this->Found.data() + this->Count; }

private:
  std::array<ScaledDeterminant, 9> Found;
  int Count = 0;
};

}

#endif
