/**
 * @file TrimWarnings.h
 * @brief One warning for each kind of finding: how many, what, what to do, and the first place.
 */
#ifndef TrimWarnings_h
#define TrimWarnings_h

#include "TrimPipeline.h"

namespace trim
{

/// Appends to result.Warnings what its findings call for.
void AddWarnings(const HexMesh& mesh, TrimResult& result);

}

#endif
