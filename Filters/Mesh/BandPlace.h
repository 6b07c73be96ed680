/**
 * @file BandPlace.h
 * @brief In which element of the band, as the mesh came, a point lies, and where in it.
 */
#ifndef BandPlace_h
#define BandPlace_h

#include "Band.h"

#include <limits>

namespace trim
{

struct BandPlace
{
  int Element = -1;               ///< -1: none was found
  Vec3 Parameters = Vec3::Zero(); ///< see ElementMap.h
  bool Inside = false;            ///< the element holds the point
  bool Beyond = false;            ///< the mesh ends there, a visible way from the point
  double Outside = std::numeric_limits<double>::infinity(); ///< how far, in parameters
};

/**
 * Walks from an element through facets to the one that holds a point, within its part of the mesh:
 * another part may lie at the same place. Of a point outside of the mesh the place in the element
 * that the walk came nearest to it in.
 */
BandPlace FindBandPlace(const Band& band, int start, const Vec3& point);

/// Whether a point near a node sticks out of the mesh as it came, to be seen.
bool LiesOutside(const Band& band, int node, const Vec3& point);

}

#endif
