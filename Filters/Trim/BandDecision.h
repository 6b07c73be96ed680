/**
 * @file BandDecision.h
 * @brief Trims the band of elements round the cut: by whole columns, or, where that leaves nodes
 * far off the surface, by single elements.
 */
#ifndef BandDecision_h
#define BandDecision_h

#include "LadderOptions.h"
#include "Progress.h"
#include "TrimBand.h"
#include "TrimmingSurface.h"
#include "ValidityLadder.h"

#include <memory>

namespace trim
{

/// How the band is to be trimmed.
struct BandOptions
{
  LadderOptions Ladder;
  bool ProduceOffcut = false;
  bool InsertLayer = false; ///< where nodes would be left off the surface

  /// The offcut would have to have a layer of its own.
  bool MayInsert() const { return this->InsertLayer && !this->ProduceOffcut; }

  /// The same, with all nodes inside the mesh.
  BandOptions StayingInside() const
  {
    BandOptions other = *this;
    other.Ladder.StaysInside = true;
    return other;
  }
};

/// What a band is trimmed by, and how; all of it outlives the trim.
struct BandTask
{
  const nurbs::TrimmingSurface& Surface;
  double Precision; ///< absolute distance up to which a node is on the surface
  const BandOptions& Options;
};

/**
 * Kept part and, if it is asked for, offcut, of a stretch of the band.
 *
 * @param progress where it ends the work, the result is of no use.
 * @param[in,out] near with structure and shares; both are others where these leave nodes far off,
 * and the mesh has a layer where one was inserted.
 */
void DecideBand(TrimBand& near, const BandTask& task, const Progress& progress);

/// Kept part and offcut by the structure and shares of a band; what TakeCloser and FollowCreases
/// do is left to them.
/// @param memory of the band, its structure and the surface; null: there is none.
/// @param promises see ClimbLadder; not asked where the offcut is asked for.
void ClimbBand(TrimBand& near, const BandTask& task, const Progress& progress,
  std::shared_ptr<MoverMemory> memory = nullptr, const ClimbPromises& promises = {});

/// Finds what FindCloser does for the climb that was made, and takes it where all in all it leaves
/// nodes less far off the surface.
void TakeCloser(TrimBand& near, const BandTask& task, const Progress& progress);

/// Completes the climb that was made: takes nodes to the sharp edges of the surface.
void FollowCreases(TrimBand& near, const BandTask& task, const Progress& progress);

}

#endif
