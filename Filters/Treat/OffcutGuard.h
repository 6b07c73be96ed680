/**
 * @file OffcutGuard.h
 * @brief What the offcut says of nodes that it shares with the kept part while these move.
 */
#ifndef OffcutGuard_h
#define OffcutGuard_h

#include "Offcut.h"

#include <vector>

namespace trim
{

class OffcutGuard
{
public:
  /// @param kept the part whose nodes move, and offcut that fits it; all must outlive the guard.
  OffcutGuard(
    const Band& band, const BandQuality& quality, const TrimmedBand& kept, Offcut& offcut);

  /// Whether no element of the offcut becomes invalid by where a node of the kept part lies now, or
  /// falls below the floor, or farther below.
  bool Stands(int node) const;

  /// Takes the nodes of the kept part to where they lie now.
  void Follow();

private:
  bool Stands(const OffcutElement& element) const;

  const Band& TheBand;
  const BandQuality& Quality;
  const TrimmedBand& Kept;
  Offcut& Rest;
  const std::vector<int> Users; ///< how many elements of the kept part have each node
};

}

#endif
