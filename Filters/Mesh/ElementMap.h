/**
 * @file ElementMap.h
 * @brief The map from the parameters of a trilinear hexahedron or a linear wedge to space, its
 * inverse, and integration over the element.
 *
 * All three parameters of a hexahedron run from 0 to 1. Those of a wedge are (r, s) over the
 * triangle, r + s at most 1, and t along the axis. Nodes are in the order of ElementTopology.h.
 */
#ifndef ElementMap_h
#define ElementMap_h

#include "NurbsSurface.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>

namespace trim
{
using nurbs::Vec3;

using ElementPoints = std::array<Vec3, 8>; ///< the first 6 of them for a wedge

/// The weights of an element's nodes at a place in it; they add up to one.
using NodeWeights = std::array<double, 8>;
NodeWeights ShapeFunctions(int count, const Vec3& parameters);

/// The place of the map at some parameters.
Vec3 MapToSpace(const ElementPoints& points, int count, const Vec3& parameters);

/// The derivatives by the three parameters, of a wedge; inline, as its determinant is asked often.
inline std::array<Vec3, 3> WedgeDerivatives(const ElementPoints& p, double r, double s, double t)
{
  const double c = 1.0 - t;
  return { c * (p[1] - p[0]) + t * (p[4] - p[3]), c * (p[2] - p[0]) + t * (p[5] - p[3]),
    (1.0 - r - s) * (p[3] - p[0]) + r * (p[4] - p[1]) + s * (p[5] - p[2]) };
}

/// The columns are the derivatives by the three parameters.
Eigen::Matrix3d MapDerivative(const ElementPoints& points, int count, const Vec3& parameters);

/**
 * The parameters of a place in or round an element, by Newton's method.
 * @return false if the iteration leads nowhere, as in elements without volume and far off others.
 */
bool FindParameters(const ElementPoints& points, int count, const Vec3& place, Vec3& parameters);

/// How far parameters lie outside of each facet, by the slots of ElementTopology; negative: inside.
std::array<double, 6> Outside(int count, const Vec3& parameters);

/// Parameters of the element itself near those given.
Vec3 ClampToElement(int count, const Vec3& parameters);

/// Calls visit(parameters, weight) for the points of a Gauss rule of N in each direction; the
/// weights add up to the volume of the parameters' domain. Exact for degree 2 N - 1 in each
/// parameter, less one over the triangle of a wedge, which is a collapsed square.
template <int N, typename Visit>
void ForIntegrationPoints(int count, const Visit& visit)
{
  static_assert(N == 2 || N == 3, "the rules that are needed");
  constexpr double at2 = 0.28867513459481287, at3 = 0.3872983346207417;
  const std::array<double, 3> place = N == 2 ? std::array<double, 3>{ 0.5 - at2, 0.5 + at2, 0.0 }
                                             : std::array<double, 3>{ 0.5 - at3, 0.5, 0.5 + at3 };
  const std::array<double, 3> weight = N == 2
    ? std::array<double, 3>{ 0.5, 0.5, 0.0 }
    : std::array<double, 3>{ 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
  for (int i = 0; i < N; ++i)
  {
    for (int j = 0; j < N; ++j)
    {
      const double narrow = count == 8 ? 1.0 : 1.0 - place[i];
      for (int k = 0; k < N; ++k)
      {
        visit(
          Vec3(place[i], narrow * place[j], place[k]), narrow * weight[i] * weight[j] * weight[k]);
      }
    }
  }
}

/// Calls visit(place, volume) for the points of a Gauss rule in an element.
template <int N, typename Visit>
void ForVolumes(const ElementPoints& points, int count, const Visit& visit)
{
  ForIntegrationPoints<N>(count,
    [&](const Vec3& parameters, double weight)
    {
      visit(MapToSpace(points, count, parameters),
        weight * MapDerivative(points, count, parameters).determinant());
    });
}

}

#endif
