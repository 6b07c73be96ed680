/**
 * @file PieceTracing.h
 * @brief The pieces of a cell that trim loops cut, by their borders.
 */
#ifndef PieceTracing_h
#define PieceTracing_h

#include <vector>

namespace nurbs
{

/// A stretch of a loop or of a cell's border, from crossing to crossing, as point indices.
using Chain = std::vector<int>;

/**
 * Joins arcs and chains, which meet at the crossings, to closed pieces.
 *
 * @param arcs stretches of the cell's border that are inside, counter-clockwise round the cell.
 * @param chains of the loops within the cell, either way.
 * @return counter-clockwise, each point once.
 */
std::vector<Chain> TracePieces(const std::vector<Chain>& arcs, const std::vector<Chain>& chains);

}

#endif
