/**
 * @file TrimCase.h
 * @brief What the steps from the decision on are given, whatever they choose.
 */
#ifndef TrimCase_h
#define TrimCase_h

#include "Band.h"
#include "Columns.h"
#include "Progress.h"
#include "TrimmingSurface.h"
#include "VolumeShares.h"

#include <memory>

namespace trim
{

struct MoverMemory;

/// A band that is to be trimmed. All that it refers to must outlive the trim.
struct TrimCase
{
  const Band& TheBand; ///< with the statuses of its nodes and elements
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const nurbs::TrimmingSurface& Surface;
  double Precision; ///< absolute distance up to which a node is on the surface
  /// Of other trials of the same band, columns and surface; null: there are none.
  std::shared_ptr<MoverMemory> Memory = nullptr;
  Progress Tell = NobodyAsks; ///< where it ends the work, the result is of no use
};

}

#endif
