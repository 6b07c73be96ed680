/**
 * @file Shortfalls.h
 * @brief Where the result is not as asked: nodes left off the surface, elements below the quality
 * floor or invalid.
 */
#ifndef Shortfalls_h
#define Shortfalls_h

#include "Findings.h"
#include "TrimPipeline.h"

namespace trim
{

/// Nodes that should lie on the surface and do not, with their distance; ascending.
std::vector<std::pair<Id, float>> FindNodesLeft(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision);

/// By ascending cell. @param left the nodes found before.
std::vector<std::pair<Id, Shortfall>> FindShortfalls(
  const TrimBand& near, const std::vector<std::pair<Id, float>>& left);

}

#endif
