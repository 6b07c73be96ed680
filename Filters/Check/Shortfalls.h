/**
 * @file Shortfalls.h
 * @brief Where the result is not as asked: nodes left off the surface, elements below the quality
 * floor or invalid.
 */
#ifndef Shortfalls_h
#define Shortfalls_h

#include "TrimBand.h"
#include "TrimmingSurface.h"

namespace trim
{

/// Band nodes that should lie on the surface and do not, with their distance; ascending.
std::vector<std::pair<int, float>> FindNodesLeft(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision);

/**
 * Nodes of the new boundary that count as on the surface, for the tolerance asked for, though they
 * lie a good part of an element beside it; with their distance, ascending.
 */
std::vector<std::pair<int, float>> FindNodesBeside(
  const TrimBand& near, const nurbs::TrimmingSurface& surface);

/**
 * By ascending band element; of those of one element the gravest first, and behind it what nothing
 * else tells of.
 *
 * @param left the nodes found before.
 * @param loose see FindLooseParts.
 * @param hasFloor whether a quality was asked for: else edges may have any length.
 */
std::vector<std::pair<int, Shortfall>> FindShortfalls(const TrimBand& near,
  const std::vector<std::pair<int, float>>& left, const std::vector<int>& loose, bool hasFloor);

/// The same for the elements of the offcut, whose short edges are not told of, and of loose parts
/// those that hang by an edge or a node; none where it was not asked for.
std::vector<std::pair<int, Shortfall>> FindShortfallsOfOffcut(
  const TrimBand& near, const std::vector<std::pair<int, float>>& left);

/// How much less volume than the whole kept part and offcut have together, in cut elements.
double MeasureMissing(const TrimBand& near);

/**
 * Nodes at which kept part and offcut do not add up to the whole: corners that moved for the kept
 * part, and nodes that left the model's border or a fold of its skin, or slid past a bend of it;
 * past one of the skin only where half an element or more is missing. If none did where that much
 * is, those that it goes past by the farthest. Ascending band nodes.
 *
 * @param missing see MeasureMissing.
 */
std::vector<int> FindCornersLost(const TrimBand& near, double missing);

}

#endif
