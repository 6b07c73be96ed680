/**
 * @file BandTrim.h
 * @brief The band of elements round the cut and how it is trimmed: by whole columns, or, where that
 * leaves nodes far off the surface, by single elements.
 */
#ifndef BandTrim_h
#define BandTrim_h

#include "Band.h"
#include "BothParts.h"
#include "Columns.h"
#include "Decision.h"
#include "Findings.h"
#include "Progress.h"
#include "TrimmingSurface.h"

#include <utility>
#include <vector>

namespace trim
{

/// How the band is trimmed.
struct BandTrim
{
  Columns Structure;
  VolumeShares Shares;
  TrimmedBand Trimmed;
  Offcut Rest;                                  ///< empty unless it is asked for
  std::vector<std::pair<int, float>> NodesLeft; ///< by ascending node, see DistancesLeft
};

/// The band and everything found on it.
struct TrimBand : BandTrim
{
  TrimBand(Band band)
    : Mesh(std::move(band))
  {
  }
  Band Mesh;
  /// Thickness axis of each element as the mesh has it, -1: none; also where the surface leans so
  /// far that the sheet is treated as a block.
  std::vector<signed char> SheetAxis;
  std::vector<std::pair<int, Shortfall>> Shortfalls; ///< by ascending element

  // What follows is empty unless the offcut is asked for.
  std::vector<std::pair<int, Shortfall>> ShortfallsOfRest;
  std::vector<std::pair<int, bool>> CornersLost; ///< see FindCornersLost
};

/**
 * Kept part and, if it is asked for, offcut.
 *
 * @param precision absolute distance up to which a node is on the surface.
 * @param progress where it ends the work, the result is of no use.
 * @param[in,out] near with structure and shares; both are others where these leave nodes far off.
 */
void DecideBand(TrimBand& near, const nurbs::TrimmingSurface& surface, double precision,
  const LadderOptions& options, bool produceOffcut, const Progress& progress);

}

#endif
