/**
 * @file ElementWorth.h
 * @brief What an element of the trim is worth: its scaled Jacobian, or less where an edge vanishes,
 * which the scaled Jacobian does not see and an explicit solver's time step does.
 */
#ifndef ElementWorth_h
#define ElementWorth_h

#include "Band.h"
#include "Jacobian.h"

#include <array>
#include <limits>
#include <vector>

namespace trim
{

/// What an edge is worth that has its whole length, as a scaled Jacobian.
constexpr double EdgeWorth = 6.0;
/// No edge is to become shorter than this share of what it was.
constexpr double LeastEdgeShare = 0.05;
/// What an element keeps that came with it, though below the floor. Elements that came below it
/// need not become better: of drawn-out ones hardly any could, and all nodes round them would be
/// tried in vain.
constexpr double PoorQuality = 0.2;
/// All but this share of what it had is about as much.
constexpr double QualitySlack = 0.02;

/// How much of its length that edge of an element has left which lost most.
/// @param node the element's `count` nodes, in VTK's order, which had the band's places.
/// @param points where they are now.
double ShortestEdgeShare(
  const Band& band, const std::array<int, 8>& node, const ElementPoints& points, int count);

/// The scaled Jacobian of an element, or EdgeWorth times its shortest edge's share if that is less.
/// @param fixed by node, if given: edges between two such do not count.
/// @param limit what is below need not be exact, but below.
/// @param before of the same hexahedron, if known: it is done faster.
double WorthOf(const Band& band, const std::array<int, 8>& node, const ElementPoints& points,
  int count, const std::vector<char>* fixed = nullptr,
  double limit = -std::numeric_limits<double>::infinity(), const EdgeSquares* before = nullptr);

}

#endif
