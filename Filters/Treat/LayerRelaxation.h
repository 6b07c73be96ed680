/**
 * @file LayerRelaxation.h
 * @brief Better elements of an inserted layer where the mesh came, before any correction.
 */
#ifndef LayerRelaxation_h
#define LayerRelaxation_h

#include "BandQuality.h"
#include "NodeMover.h"
#include "Progress.h"

namespace trim
{

/**
 * Moves inserted nodes until the elements at them have a scaled Jacobian, as far as that can be: an
 * element whose nodes have to be left where they are is held to the quality floor too. None is
 * spoiled for it.
 *
 * @param layered the band with its layer.
 * @param mover of it.
 * @param quality what spoils an element of it.
 * @param goal scaled Jacobian.
 * @param bare see InsertLayer.
 * @param[in,out] cells what the band was made of; the inserted nodes get their places.
 * @return false if none moved.
 */
bool RelaxLayer(const Band& layered, const NodeMover& mover, const BandQuality& quality,
  double goal, const std::vector<char>& bare, const AbortCheck& aborted, BandCells& cells);

}

#endif
