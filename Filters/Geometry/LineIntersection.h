/**
 * @file LineIntersection.h
 * @brief All meetings of a line segment with the patches (eqs. 12-14).
 */
#ifndef LineIntersection_h
#define LineIntersection_h

#include "SurfaceModel.h"

#include <vector>

namespace nurbs
{
struct LineMeeting
{
  double K = 0; ///< distance along the unit direction
  int Patch = -1;
  double S = 0, T = 0;
  Vec3 Point = Vec3::Zero(); ///< on the surface, about the local origin
  bool Touch = false;        ///< found as a tangency: its place is good to the root of rounding
  double Away = 0;           ///< from the line; up to the gap where it slips between two faces
};

/**
 * Meetings of a + k d (d of unit length, local coordinates) for low <= k <= high, in no order,
 * those on borders of patches repeated.
 */
void FindMeetings(const SurfaceModel& model, const Vec3& a, const Vec3& d, double low, double high,
  std::vector<LineMeeting>& meetings);

}

#endif
