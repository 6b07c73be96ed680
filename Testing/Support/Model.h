/**
 * @file Model.h
 * @brief A mesh of hexahedra and wedges as plain data, and the geometry of its elements.
 *
 * The judge of the trim filter computes everything from here with code of its own, so that a
 * mistake in the filter's geometry is not repeated in its test.
 */
#ifndef Model_h
#define Model_h

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

class vtkUnstructuredGrid;

namespace judge
{
using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Id = std::int64_t;

/// A hexahedron (8 nodes) or a wedge (6); node order is VTK's.
struct Element
{
  int Size = 0;
  std::array<Id, 8> Node{};
};

/// A facet: four nodes, or three and Node[3] = -1. Ordered to point out of its element.
struct Facet
{
  std::array<Id, 4> Node{ { -1, -1, -1, -1 } };
  Id Owner = -1;
  int Size() const { return this->Node[3] < 0 ? 3 : 4; }
};

struct Model
{
  std::vector<Vec3> Points;
  std::vector<Element> Elements;
  Id BadCell = -1; ///< first cell that is neither hexahedron nor wedge; -1: none

  explicit Model(vtkUnstructuredGrid* grid);
  double Diagonal() const;
  /// Corner positions of element e; the last two are unused for a wedge.
  std::array<Vec3, 8> Corners(Id e) const;
};

/// Facets of one element.
std::vector<Facet> FacetsOf(const Element& element, Id owner);

/// Sorted nodes: the same key for the same facet seen from either side.
std::array<Id, 4> FacetKey(const Facet& facet);

/// Position at natural coordinates in [0, 1]^3 (wedge: the first two in the unit triangle).
Vec3 PositionAt(const std::array<Vec3, 8>& corners, int size, const Vec3& natural);

/// Determinant of the Jacobian with respect to the natural coordinates in [0, 1].
double JacobianAt(const std::array<Vec3, 8>& corners, int size, const Vec3& natural);

/// Exact: the determinant is a polynomial that the Gauss points integrate exactly.
double VolumeOf(const std::array<Vec3, 8>& corners, int size);

/// Of all its elements.
double VolumeOf(const Model& model);

/// Determinants at 2x2x2 Gauss points (hexahedron) or at 3 x 2 points (wedge).
std::vector<double> IntegrationPointJacobians(const std::array<Vec3, 8>& corners, int size);

/**
 * Bernstein coefficients of the Jacobian determinant: 27 for a hexahedron (degree 2 in each
 * direction), 9 for a wedge (linear over the triangle, quadratic across). All positive: the
 * element is valid everywhere (Johnen, Weill, Remacle 2017).
 */
std::vector<double> BezierJacobians(const std::array<Vec3, 8>& corners, int size);

}

#endif
