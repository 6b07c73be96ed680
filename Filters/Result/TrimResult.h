/**
 * @file TrimResult.h
 * @brief What a trim makes of a mesh: the fate of every element and node, before it is written.
 */
#ifndef TrimResult_h
#define TrimResult_h

#include "Findings.h"
#include "NodeClassification.h"
#include "TrimBand.h"

#include <memory>
#include <string>
#include <vector>

namespace trim
{

struct TrimResult
{
  NodeClassification Nodes;
  UnsetVector<unsigned char> ElementStatus; ///< of every cell
  UnsetVector<char> Kept;                   ///< final fate of every cell
  std::unique_ptr<TrimBand> Near;           ///< null if the surface touches nothing
  Findings Found;
  std::vector<std::string> Warnings;
  std::string Error; ///< not empty: there is no result
  bool Aborted = false;
};

}

#endif
