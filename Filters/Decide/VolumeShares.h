/**
 * @file VolumeShares.h
 * @brief How much of each element and column lies beyond the surface (paper, section 2.3).
 */
#ifndef VolumeShares_h
#define VolumeShares_h

#include "Band.h"
#include "Columns.h"
#include "TrimmingSurface.h"

#include <array>
#include <vector>

namespace trim
{

struct VolumeShares
{
  std::vector<double> Volume;  ///< of each band element
  std::vector<double> Element; ///< V^e of each band element
  std::vector<double> Column;  ///< share of the column of each band element
};

/**
 * V^e of all band elements and the shares of their columns.
 *
 * @param gap see CrossEdge.
 * @return false if an edge joins kept and eliminated nodes without meeting the surface;
 * missedEdge then holds its band nodes.
 */
bool MeasureShares(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface,
  double gap, VolumeShares& shares, std::array<int, 2>& missedEdge);

/// The shares of other columns, from what is known of the elements.
void MeasureColumnShares(const Columns& columns, VolumeShares& shares);

}

#endif
