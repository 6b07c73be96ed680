/**
 * @file BandTrim.h
 * @brief Trims the band of elements round the cut: by whole columns, or, where that leaves nodes
 * far off the surface, by single elements.
 */
#ifndef BandTrim_h
#define BandTrim_h

#include "Progress.h"
#include "TrialTrim.h"
#include "TrimBand.h"
#include "TrimmingSurface.h"

namespace trim
{

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
