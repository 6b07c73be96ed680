/**
 * @file SampleSurfaces.h
 * @brief Surfaces whose shape is known, and nasty ones, for the tests of the kernel.
 */
#ifndef SampleSurfaces_h
#define SampleSurfaces_h

#include "NurbsSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace samples
{
using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec3;
using nurbs::Vec4;

/// Clamped knots with equal spans over [0, 1].
std::vector<double> UniformKnots(int degree, int count);

/// A surface of the degrees given over a net of points (u, v in [0, 1] to x y z w).
NurbsSurface FromNet(
  int p, int q, int countU, int countV, const std::function<Vec4(double u, double v)>& point);

NurbsSurface Wavy(int count = 8, double height = 0.15);
NurbsSurface Plane(const Vec3& origin, const Vec3& u, const Vec3& v);
NurbsSurface Bilinear();
/// Rational quadratic arcs of 90 degrees each; u along the arc, v along the axis (z).
NurbsSurface Cylinder(double radius, double height, int quarters = 4);
/// Revolves a rational profile (x, z, w) about z by full turns of 90 degrees; v along it.
NurbsSurface Revolve(int degree, const std::vector<double>& knots,
  const std::vector<Eigen::Vector3d>& profile, int quarters = 4);
NurbsSurface Sphere(double radius);
NurbsSurface Torus(double major, double minor);
NurbsSurface Cone(double radius, double height); ///< apex on z at height
NurbsSurface HighDegree(int p, int q);
NurbsSurface Creased();  ///< repeated interior knots, C0 creases
NurbsSurface Weighted(); ///< weights from 0.01 to 100
NurbsSurface Unclamped();
NurbsSurface Curled();      ///< a strongly curved S
NurbsSurface Slit();        ///< two banks a thin slit apart
NurbsSurface Linear();      ///< degree 1, a folded net
NurbsSurface Jump();        ///< a C^-1 knot: two separate sheets in one surface
NurbsSurface LeaningTube(); ///< its patches are long and far from right angles

struct Named
{
  std::string Name;
  NurbsSurface Surface;
};
std::vector<Named> All();

/// The same surface, moved.
NurbsSurface Transformed(NurbsSurface surface, const Eigen::Matrix3d& linear, const Vec3& shift);
/// u runs backwards.
NurbsSurface ReversedU(const NurbsSurface& surface);
/// A box of six planes, normals outwards; a shell with rounded vertical edges.
std::vector<NurbsSurface> BoxShell(const Vec3& low, const Vec3& high);
std::vector<NurbsSurface> RoundedShell(double a, double b, double radius, double height);

}

#endif
