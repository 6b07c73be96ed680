#include "IgesConics.h"

#include "NurbsSurface.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <IGESData_IGESEntity.hxx>
#include <IGESGeom_ConicArc.hxx>
#include <IGESGeom_TransformationMatrix.hxx>
#include <Interface_InterfaceModel.hxx>
#include <TColStd_HArray2OfReal.hxx>
#include <gp_GTrsf.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_XY.hxx>

#include <cmath>

namespace nurbs
{
namespace
{
/// Entity use flag of curves in the parameters of a surface.
constexpr int InParameters = 5;

/// A conic in axes of its own: Q x^2 + R y^2 + L x + F = 0.
struct PrincipalConic
{
  double Q = 0.0, R = 0.0, L = 0.0, F = -1.0;
  Vec2 Origin = Vec2::Zero();
  Vec2 AxisX = Vec2::UnitX();

  Vec2 AxisY() const { return Vec2(-this->AxisX.y(), this->AxisX.x()); }
  Vec2 ToLocal(const Vec2& p) const
  {
    return Vec2((p - this->Origin).dot(this->AxisX), (p - this->Origin).dot(this->AxisY()));
  }
};

/// Ellipses with the longer axis along x, hyperbolas that open along x: about their centre.
bool CentreConic(const Eigen::Matrix2d& quadratic, const Vec2& linear, double constant,
  const Vec2& start, PrincipalConic& result)
{
  result.Origin = -0.5 * quadratic.inverse() * linear;
  const double level = constant + 0.5 * linear.dot(result.Origin);
  if (level == 0.0)
  {
    return false;
  }
  // Scaled so that the constant is -1, the axis along x has the smallest positive value.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(quadratic / -level);
  const int along = solver.eigenvalues()[0] > 0.0 ? 0 : 1;
  result.Q = solver.eigenvalues()[along];
  result.R = solver.eigenvalues()[1 - along];
  result.AxisX = solver.eigenvectors().col(along);
  if (result.ToLocal(start).x() < 0.0)
  {
    result.AxisX = -result.AxisX;
  }
  return result.Q > 0.0 && result.R != 0.0;
}

/// A parabola that opens along x: y^2 + L x = 0 with negative L.
bool Parabola(
  const Eigen::Matrix2d& quadratic, const Vec2& linear, double constant, PrincipalConic& result)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(quadratic);
  const int bent = std::abs(solver.eigenvalues()[1]) > std::abs(solver.eigenvalues()[0]) ? 1 : 0;
  const double scale = solver.eigenvalues()[bent];
  const Vec2 across = solver.eigenvectors().col(bent);
  Vec2 along(across.y(), -across.x());
  if (linear.dot(along) / scale > 0.0)
  {
    along = -along;
  }
  const double slope = linear.dot(along) / scale;
  if (scale == 0.0 || !(slope < 0.0))
  {
    return false;
  }
  // y^2 + m y + slope x + c = 0 in these axes.
  const double m = linear.dot(across) / scale;
  const double y = -0.5 * m;
  const double x = (0.25 * m * m - constant / scale) / slope;
  result.Origin = x * along + y * across;
  result.AxisX = along;
  result.Q = 0.0;
  result.R = 1.0;
  result.L = slope;
  result.F = 0.0;
  return true;
}

bool Straighten(const IGESGeom_ConicArc& arc, PrincipalConic& result)
{
  double a, b, c, d, e, f;
  arc.Equation(a, b, c, d, e, f);
  Eigen::Matrix2d quadratic;
  quadratic << a, 0.5 * b, 0.5 * b, c;
  const Vec2 start(arc.StartPoint().X(), arc.StartPoint().Y());
  return arc.ComputedFormNumber() == 3
    ? Parabola(quadratic, Vec2(d, e), f, result)
    : arc.ComputedFormNumber() != 0 && CentreConic(quadratic, Vec2(d, e), f, start, result);
}

/// The matrix of the entity after the turn out of the principal axes.
Handle(IGESGeom_TransformationMatrix)
  MakeMatrix(const IGESGeom_ConicArc& arc, const PrincipalConic& conic)
{
  gp_GTrsf turn;
  const Vec2 y = conic.AxisY();
  turn.SetVectorialPart(
    gp_Mat(conic.AxisX.x(), y.x(), 0.0, conic.AxisX.y(), y.y(), 0.0, 0.0, 0.0, 1.0));
  turn.SetTranslationPart(gp_XYZ(conic.Origin.x(), conic.Origin.y(), 0.0));
  const gp_GTrsf whole = arc.Location().Multiplied(turn);
  Handle(TColStd_HArray2OfReal) values = new TColStd_HArray2OfReal(1, 3, 1, 4);
  for (int row = 1; row <= 3; ++row)
  {
    for (int column = 1; column <= 4; ++column)
    {
      values->SetValue(row, column, whole.Value(row, column));
    }
  }
  Handle(IGESGeom_TransformationMatrix) matrix = new IGESGeom_TransformationMatrix;
  matrix->Init(values);
  return matrix;
}
}

//------------------------------------------------------------------------------
void StraightenIgesConics(const Handle(Interface_InterfaceModel) & model)
{
  for (int i = 1; i <= model->NbEntities(); ++i)
  {
    const auto arc = Handle(IGESGeom_ConicArc)::DownCast(model->Value(i));
    PrincipalConic conic;
    if (arc.IsNull() || arc->UseFlag() == InParameters || !Straighten(*arc, conic))
    {
      continue;
    }
    const auto local = [&conic](const gp_Pnt2d& p)
    {
      const Vec2 q = conic.ToLocal(Vec2(p.X(), p.Y()));
      return gp_XY(q.x(), q.y());
    };
    const Handle(IGESGeom_TransformationMatrix) matrix = MakeMatrix(*arc, conic);
    arc->Init(conic.Q, 0.0, conic.R, conic.L, 0.0, conic.F, arc->ZPlane(), local(arc->StartPoint()),
      local(arc->EndPoint()));
    arc->InitTransf(matrix);
  }
}
}
