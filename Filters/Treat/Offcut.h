/**
 * @file Offcut.h
 * @brief The part that is cut away, as a mesh that fits the kept part node by node.
 *
 * Both parts share the nodes of the cut at the same positions, and the facets there. A kept
 * element that became a wedge dropped its edge A-B: the offcut takes the rest of it, the wedge
 * between A-B and the new facet, so that A-B is a node inside the offcut and free to move.
 * Elements with a corner that the cut flattens are divided into two wedges at that corner. Nodes
 * of the kept part never move for the offcut here.
 */
#ifndef Offcut_h
#define Offcut_h

#include "BandQuality.h"
#include "TrimCase.h"
#include "TrimmedBand.h"

#include <vector>

namespace trim
{

/// One element of the offcut, within an element of the band.
struct OffcutElement
{
  int Element = -1;
  int Count = 0; ///< 8 or 6
  std::array<int, 8> Node;

  const int* begin() const { return this->Node.data(); }
  const int* end() const { return this->Node.data() + this->Count; }
};

struct Offcut
{
  Moves NodeMoves;                     ///< of the nodes that the offcut uses
  std::vector<OffcutElement> Elements; ///< by ascending element of the band, some of them twice
  std::vector<int> BelowFloor;         ///< elements of the band
  std::vector<int> Invalid;
};

/// The nodes of one of the offcut's elements at their final places.
ElementPoints PointsOf(const Offcut& offcut, const OffcutElement& element);

/// True if one of its nodes moved, or it is a part of the element that it lies in.
bool IsTouched(const Band& band, const Offcut& offcut, const OffcutElement& element);

/// Whether the offcut uses each node of the band.
std::vector<char> FindUsed(const Band& band, const Offcut& offcut);

/// @param goal scaled Jacobian that the elements at the cut should reach.
Offcut FitOffcut(const TrimCase& given, const NodeMover& mover, const TrimmedBand& trimmed,
  const BandQuality& quality, double goal);

}

#endif
