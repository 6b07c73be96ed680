/**
 * @file TrimWarnings.h
 * @brief One warning for each kind of finding: how many, what, what to do, and the first place.
 */
#ifndef TrimWarnings_h
#define TrimWarnings_h

#include "BandDecision.h"
#include "SharedNodes.h"
#include "TrimResult.h"

namespace trim
{

/// Appends to result.Warnings what the findings of all ranks call for; collective.
/// @param unitsHint see UnitsHint.
void AddWarnings(const HexMesh& mesh, const Piece& piece, const BandOptions& options,
  const std::string& unitsHint, TrimResult& result);

}

#endif
