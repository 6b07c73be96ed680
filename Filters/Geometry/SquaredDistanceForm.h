/**
 * @file SquaredDistanceForm.h
 * @brief The squared distance to a rational patch as a polynomial with Bernstein coefficients.
 *
 * F(s, t) = |A - w p|^2 - d^2 w^2 is below zero exactly where the surface A / w is closer to p
 * than d. Its coefficients bound it over the patch, however far p is and whatever the curvature.
 */
#ifndef SquaredDistanceForm_h
#define SquaredDistanceForm_h

#include "NurbsSurface.h"

#include <algorithm>

namespace nurbs
{
class SquaredDistanceForm
{
public:
  /// @param net (p+1) x (q+1) homogeneous points about the point that the distance is from.
  void Set(int p, int q, const Vec4* net, double squaredDistance);

  double Minimum() const
  {
    return *std::min_element(this->F, this->F + this->CountU * this->CountV);
  }

  /// True if F is certainly convex over the patch.
  bool IsConvex() const;

  /**
   * How the distance changes over the whole patch: +1 if it rises with s (t), -1 if it falls,
   * 0 if that is not certain.
   * @param net as given to Set.
   */
  void FindSlopes(const Vec4* net, int& slopeS, int& slopeT) const;

private:
  static constexpr int Size = (2 * MaximumDegree + 1) * (2 * MaximumDegree + 1);
  int CountU = 0, CountV = 0;
  double F[Size];
};

}

#endif
