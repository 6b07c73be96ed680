/**
 * @file LostVolume.h
 * @brief Volume on the kept side that is lost, or beyond the surface that stays, of which no
 * finding tells.
 */
#ifndef LostVolume_h
#define LostVolume_h

#include "TrimBand.h"

#include <vector>

namespace trim
{

struct LostVolume
{
  double Elements = 0.0;   ///< how much, in cut elements
  int Most = -1;           ///< the cut element with most of it; -1: nothing is lost
  bool IsOfPlaces = false; ///< by single places, while the whole has what it should
};

/**
 * Looks at the whole cut, and at each place that no border reaches: there a strip or an island is
 * lost (or stays), however long the cut is elsewhere.
 *
 * @param told elements of the band of whose volume a finding tells; nothing is said of these and of
 * those that share a node with them.
 * @param share of the cut elements that the whole may miss.
 */
LostVolume FindLostVolume(const TrimBand& near, const std::vector<int>& told, double share);

}

#endif
