#include "CornerShape.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>

namespace trim
{

double PositiveDeterminant::Root(double determinant) const
{
  return std::sqrt(this->Epsilon * this->Epsilon + determinant * determinant);
}

double PositiveDeterminant::operator()(double determinant) const
{
  // The sum of both would lose all its digits below zero.
  const double root = this->Root(determinant);
  return determinant > 0.0 ? 0.5 * (determinant + root)
                           : 0.5 * this->Epsilon * this->Epsilon / (root - determinant);
}

Eigen::Matrix3d ScaleOfCorner(const Vec3& lengths, int count)
{
  Eigen::Matrix3d edges = lengths.asDiagonal();
  if (count == 6)
  {
    edges.col(1) = lengths[1] * Vec3(0.5, std::sqrt(0.75), 0.0);
  }
  return edges.inverse();
}

CornerEnergy::CornerEnergy(
  const Corner& corner, const Eigen::Matrix3d& edges, int node, double factor)
  : Factor(factor)
  , Square(edges.squaredNorm())
{
  Vec3 weights = -corner.Scale.colwise().sum().transpose();
  for (int k = 0; k < 3; ++k)
  {
    if (corner.Node[k + 1] == node)
    {
      weights = corner.Scale.row(k).transpose();
    }
  }
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = edges.col(1).cross(edges.col(2));
  cofactors.col(1) = edges.col(2).cross(edges.col(0));
  cofactors.col(2) = edges.col(0).cross(edges.col(1));
  this->Weight = weights.squaredNorm();
  this->Determinant = edges.col(0).dot(cofactors.col(0));
  this->Slope = edges * weights;
  this->Growth = cofactors * weights;
}

double CornerEnergy::After(const Vec3& step, const PositiveDeterminant& positive) const
{
  const double square =
    this->Square + 2.0 * this->Slope.dot(step) + this->Weight * step.squaredNorm();
  return this->Factor * square * std::sqrt(square) /
    positive(this->Determinant + this->Growth.dot(step));
}

void CornerEnergy::AddDerivatives(const PositiveDeterminant& positive, Derivatives& sum) const
{
  const double epsilon = positive.GetEpsilon();
  const double root = positive.Root(this->Determinant);
  const double value = positive(this->Determinant);
  const double factor = this->Factor * std::sqrt(this->Square) / value;
  const double bend = 0.5 * epsilon * epsilon / (root * root * root * value);
  const Vec3 growth = this->Growth / root;
  const Eigen::Matrix3d mixed = this->Slope * growth.transpose();
  sum.Gradient += factor * (3.0 * this->Slope - this->Square * growth);
  sum.Hessian += factor *
    (3.0 * this->Weight * Eigen::Matrix3d::Identity() +
      3.0 / this->Square * this->Slope * this->Slope.transpose() -
      3.0 * (mixed + mixed.transpose()) +
      this->Square *
        (2.0 * growth * growth.transpose() - bend * this->Growth * this->Growth.transpose()));
}

}
