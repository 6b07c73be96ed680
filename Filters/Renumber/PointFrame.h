/**
 * @file PointFrame.h
 * @brief Frames along which a part is sorted.
 */
#ifndef PointFrame_h
#define PointFrame_h

#include "NurbsSurface.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <limits>

namespace trim
{

/// The columns of a frame in the order of the extent of points along them, longest first.
/// @param position (i) of each of so many points.
template <typename Position>
Eigen::Matrix3d ByExtent(const Eigen::Matrix3d& frame, int count, const Position& position)
{
  using nurbs::Vec3;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 p = frame.transpose() * position(i);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 extent = high - low;
  std::array<int, 3> order{ 0, 1, 2 };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return extent[a] > extent[b]; });
  Eigen::Matrix3d sorted;
  for (int i = 0; i < 3; ++i)
  {
    sorted.col(i) = frame.col(order[i]);
  }
  return sorted;
}

/// The principal axes of points.
template <typename Position>
Eigen::Matrix3d PrincipalAxes(int count, const Position& position)
{
  using nurbs::Vec3;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < count; ++i)
  {
    mean += position(i);
  }
  mean /= count;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); // its lower half: the solver reads no other
  for (int i = 0; i < count; ++i)
  {
    const Vec3 d = position(i) - mean;
    for (int k = 0; k < 3; ++k)
    {
      for (int row = k; row < 3; ++row)
      {
        spread(row, k) += d[row] * d[k];
      }
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

}

#endif
