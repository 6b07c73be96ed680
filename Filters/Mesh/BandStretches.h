/**
 * @file BandStretches.h
 * @brief The band cut into stretches that have no node in common, as round two holes.
 *
 * Nothing that is done to one reaches another, so that each can be trimmed by itself: what it
 * becomes does not depend on how much else is cut.
 */
#ifndef BandStretches_h
#define BandStretches_h

#include "Band.h"

#include <vector>

namespace trim
{

/// Where nodes and elements of a stretch are in the whole band, both ascending.
struct BandStretch
{
  std::vector<int> Nodes, Elements;
};

/// By their first elements.
std::vector<BandStretch> FindStretches(const Band& band);

/// The stretches as bands of their own; nodes and elements keep their order.
std::vector<Band> ExtractStretches(const Band& band, const std::vector<BandStretch>& stretches);

/**
 * The whole band with the layers that were inserted into some of its stretches.
 *
 * @param bands of the stretches, with a layer or as they were.
 * @param whole what the stretches were taken from; BeforeLayer of the result.
 * @param[in,out] stretches where the stretches are in `whole`, afterwards in the result.
 */
Band JoinLayers(
  const std::vector<const Band*>& bands, Band whole, std::vector<BandStretch>& stretches);

}

#endif
