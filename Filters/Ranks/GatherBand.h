/**
 * @file GatherBand.h
 * @brief The whole band on every rank.
 *
 * What follows the classification works on the few elements round the cut and cannot be divided:
 * each decision may depend on the ones before it. So every rank gets the whole band, does the same
 * with it, and takes what belongs to its own piece. There no element lacks a neighbour that it has
 * in the whole mesh, so that faces between pieces are inner ones.
 */
#ifndef GatherBand_h
#define GatherBand_h

#include "BandCells.h"
#include "SharedNodes.h"

namespace trim
{

/// Rings grow on across the borders of the pieces; empty on one rank alone.
SpreadRing SpreadAcrossPieces(const Piece& piece);

/**
 * Replaces a rank's own part of the band by the whole; collective.
 *
 * @return false with an error, the same on all ranks, if two ranks have the same cell.
 */
bool GatherBandCells(const HexMesh& mesh, const Piece& piece, BandCells& band, std::string& error);

}

#endif
