/**
 * @file TrimBand.h
 * @brief The band of elements round the cut, how it is trimmed, and what was found on it.
 */
#ifndef TrimBand_h
#define TrimBand_h

#include "Band.h"
#include "Columns.h"
#include "Findings.h"
#include "Offcut.h"
#include "TrimmedBand.h"
#include "VolumeShares.h"

#include <memory>
#include <utility>
#include <vector>

namespace trim
{

struct ClimbMade;

/// How the band is trimmed.
struct BandTrim
{
  Columns Structure;
  VolumeShares Shares;
  TrimmedBand Trimmed;
  Offcut Rest;                                  ///< empty unless it is asked for
  std::vector<std::pair<int, float>> NodesLeft; ///< by ascending node, see DistancesLeft
  std::shared_ptr<const ClimbMade> Made;        ///< null: it is completed
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
  std::vector<std::pair<int, Shortfall>> Shortfalls; ///< see FindShortfalls
  std::vector<std::pair<int, float>> NodesBeside;    ///< see FindNodesBeside

  // What follows is empty unless the offcut is asked for.
  std::vector<std::pair<int, Shortfall>> ShortfallsOfRest;
  std::vector<int> CornersLost; ///< see FindCornersLost
  double Missing = 0.0;         ///< see MeasureMissing
};

}

#endif
