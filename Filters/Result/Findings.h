/**
 * @file Findings.h
 * @brief What a trim has to say of single elements and nodes: where the surface breaks an
 * assumption of the method, and where the result is not as asked.
 */
#ifndef Findings_h
#define Findings_h

#include "HexMesh.h"

#include <utility>
#include <vector>

namespace trim
{

/// The values of the cell array Feasibility: the gravest for each element.
enum class Feasibility : unsigned char
{
  Fine = 0,
  /// The surface bends with a radius below two element sizes, or between nodes that had to go far
  /// apart (see BorderChords.h), or has an edge that no node is on.
  Curved = 1,
  Inclined = 2, ///< the surface and the skin meet under less than 45 degrees
  Narrow = 3,   ///< a hole or slot narrower than three elements
  /// The surface crosses an edge or face of the element more than once, or against the sides of its
  /// nodes (see CrossedEdges.h), or leaves too narrow a strip there (see PartedStrips.h).
  CrossedTwice = 4,
  NotOpened = 5, ///< a cut-out that is too small to be opened: the element stays whole
  OpenSeam = 6   ///< a face of the element lies on another without common nodes
};

/// The values of the cell array Shortfall: the gravest for each kept element. All come before a
/// node left off, as DistanceLeft tells of that too.
enum class Shortfall : unsigned char
{
  None = 0,
  BelowFloor = 1,  ///< valid, but below MinimumScaledJacobian
  LeftOff = 2,     ///< has a node that was left off the surface
  Invalid = 3,     ///< distorted beyond repair
  CameInvalid = 4, ///< inside out or without volume, as it was before the trim
  ShortEdge = 5,   ///< an edge has hardly any of its length left, which a time step follows
  LoosePart = 6    ///< of a shred that nothing joins to the rest (LooseParts.h, OffcutHinges.h)
};

inline bool IsGraver(Shortfall a, Shortfall b)
{
  constexpr int gravity[] = { 0, 4, 1, 5, 6, 2, 3 };
  return gravity[static_cast<int>(a)] > gravity[static_cast<int>(b)];
}

/// By element, or place, and the gravest of each first.
template <typename Index>
bool ComesBefore(const std::pair<Index, Shortfall>& a, const std::pair<Index, Shortfall>& b)
{
  return a.first != b.first ? a.first < b.first : IsGraver(a.second, b.second);
}

/// Lists by ascending id in the input; whoever is not listed has the value zero.
struct Findings
{
  std::vector<std::pair<Id, Feasibility>> Feasibilities;
  /// Distance to the surface of the nodes that should lie on it and were left off.
  std::vector<std::pair<Id, float>> DistancesLeft;
  /// Nodes of the new boundary.
  std::vector<Id> NewBoundary;
  /// Nodes at which kept part and offcut do not add up, see FindCornersLost; none if no offcut is
  /// asked for.
  std::vector<Id> CornersLost;
};

}

#endif
