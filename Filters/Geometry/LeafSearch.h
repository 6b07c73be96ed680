/**
 * @file LeafSearch.h
 * @brief Which leaves of a surface's hierarchy a box in space meets.
 */
#ifndef LeafSearch_h
#define LeafSearch_h

#include "SurfaceModel.h"

namespace nurbs
{

/**
 * Visits the leaves whose oriented boxes meet a box, until it is told to stop.
 *
 * @param gap how far from the box they count all the same.
 * @param visit takes the index of a leaf box and returns false to stop.
 * @return false if it was stopped.
 */
template <typename Visit>
bool ForLeavesMeeting(const SurfaceModel& model, const Box3& box, double gap, const Visit& visit)
{
  if (box.isEmpty())
  {
    return true;
  }
  const Vec3 center = box.center() - model.Origin, half = 0.5 * box.sizes();
  const double slack = 2e-7 * (center.cwiseAbs().maxCoeff() + half.maxCoeff()) + gap;
  const Eigen::AlignedBox3f grown(((center - half).array() - slack).matrix().cast<float>(),
    ((center + half).array() + slack).matrix().cast<float>());
  return ForItemsMeeting(model.Nodes, grown,
    [&](int index)
    {
      // Separating axes of the leaf's oriented box.
      const LeafBox& leaf = model.BoxAt(index);
      const Eigen::Vector3f d = (center - leaf.Center.cast<double>()).cast<float>();
      const Eigen::Vector3f h = half.cast<float>();
      const float rim = 1e-6f * (d.cwiseAbs().sum() + h.sum()) + static_cast<float>(slack);
      const auto apart = [&](const Eigen::Vector3f& axis, int k)
      {
        const float x = axis.dot(d), reach = axis.cwiseAbs().dot(h) + rim;
        return x - reach > leaf.High[k] || x + reach < leaf.Low[k];
      };
      return apart(leaf.X.cross(leaf.Y), 2) || apart(leaf.X, 0) || apart(leaf.Y, 1) || visit(index);
    });
}

}

#endif
