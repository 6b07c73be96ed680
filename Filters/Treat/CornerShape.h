/**
 * @file CornerShape.h
 * @brief How far the edges from a corner of an element are from what they are to be, as a smooth
 * energy, and how it changes as one of their ends moves.
 *
 * The energy is the norm of the edges' matrix to the third power over its determinant, least where
 * they are at right angles and as long as they are to be (P. Knupp, Algebraic mesh quality metrics,
 * 2001). What is small and positive stands for a determinant that is not positive, so that a
 * descent leads out of inverted elements (J.M. Escobar et al., Simultaneous untangling and
 * smoothing of tetrahedral meshes, 2003). As a function of the place of one node the energy of a
 * valid corner is convex.
 */
#ifndef CornerShape_h
#define CornerShape_h

#include "ElementMap.h"

#include <Eigen/Core>

#include <array>

namespace trim
{

/// Replaces determinants: what is added to them, about, where they are not positive. With 0 the
/// energy of corners that are not valid is infinite.
class PositiveDeterminant
{
public:
  explicit PositiveDeterminant(double epsilon = 0.0)
    : Epsilon(epsilon)
  {
  }

  double GetEpsilon() const { return this->Epsilon; }

  /// The root that it is made with.
  double Root(double determinant) const;

  double operator()(double determinant) const;

private:
  double Epsilon;
};

/// Edges from a corner of an element.
struct Corner
{
  std::array<int, 4> Node; ///< the corner's own, and the other ends
  int Element;
  Eigen::Matrix3d Scale; ///< the edges as columns, times it, are the unit matrix in a perfect shape
};

/// @param lengths of the edges in a perfect shape: at right angles, for a wedge (count 6) the first
/// two at 60 degrees.
Eigen::Matrix3d ScaleOfCorner(const Vec3& lengths, int count);

/// The edges of a corner, scaled; positions by node.
template <typename Positions>
Eigen::Matrix3d EdgesOf(const Corner& corner, const Positions& at)
{
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
  {
    edges.col(k) = at[corner.Node[k + 1]] - at[corner.Node[0]];
  }
  return edges * corner.Scale;
}

/// The first and second derivatives by the place of a node.
struct Derivatives
{
  Vec3 Gradient = Vec3::Zero();
  Eigen::Matrix3d Hessian = Eigen::Matrix3d::Zero();
};

/// The energy of one corner as a function of the step s of one of its nodes: the squared norm of
/// the edges is Square + 2 Slope s + Weight s s, their determinant is Determinant + Growth s.
class CornerEnergy
{
public:
  /// @param edges of the corner, scaled.
  /// @param factor that the energy is multiplied with.
  CornerEnergy(const Corner& corner, const Eigen::Matrix3d& edges, int node, double factor);

  double After(const Vec3& step, const PositiveDeterminant& positive) const;

  /// Where the step is zero.
  void AddDerivatives(const PositiveDeterminant& positive, Derivatives& sum) const;

private:
  double Factor, Square, Weight, Determinant;
  Vec3 Slope, Growth;
};

}

#endif
