/**
 * @file SplineData.h
 * @brief NURBS surfaces as the tests write them: plain data put on poly data by the rules of
 * CONTRACT.md, with an evaluation of their own (no code of the kernel under test).
 */
#ifndef SplineData_h
#define SplineData_h

#include "Model.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace judge
{
struct SplineSurface
{
  int DegreeU = 1, DegreeV = 1, CountU = 0, CountV = 0;
  std::vector<double> KnotsU, KnotsV;
  std::vector<Eigen::Vector4d> Control; ///< x y z w, u running fastest
  std::vector<std::vector<Vec2>> Loops;
};

/// Clamped knots with equal spans over [0, 1].
std::vector<double> UniformKnots(int count, int degree);

/// Averages of degree successive knots: control values there reproduce linear functions.
std::vector<double> GrevilleAbscissae(const std::vector<double>& knots, int degree);

/// Values of all `count` basis functions at t (Cox-de Boor, eq. 2).
std::vector<double> Basis(const std::vector<double>& knots, int degree, int count, double t);

/// S(u, v) by eq. 1.
Vec3 EvaluateAt(const SplineSurface& surface, double u, double v);

/// Of degree 1: upright on a line of points in the plane of an origin, 9 to either side of it along
/// z.
SplineSurface Wall(const std::vector<Vec2>& line, const Vec3& origin = Vec3::Zero());

/// The field data of CONTRACT.md and a coarse tessellation.
vtkSmartPointer<vtkPolyData> ToPolyData(const SplineSurface& surface);

/// The same surface with u running backwards: its normal is turned round.
SplineSurface ReversedU(const SplineSurface& surface);

/// The same surface with u and v exchanged: its normal is turned round.
SplineSurface Transposed(const SplineSurface& surface);

}

#endif
