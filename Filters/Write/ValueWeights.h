/**
 * @file ValueWeights.h
 * @brief Of which old values, at nodes and in elements of the band, the new ones are made where a
 * node moved or an element changed its shape.
 *
 * A node's value is that of the mesh as it came at the node's new place, by the shape functions of
 * the element there. An element's value is the mean over its new shape, where the old elements have
 * fields that are linear in each, with the old value as mean and a gradient by least squares from
 * the neighbours (T.J. Barth, D.C. Jespersen, The design and application of upwind schemes on
 * unstructured meshes, 1989; as a way to remap J.K. Dukowicz, J.W. Kodis, 1987). Both are exact
 * where the values are linear in space.
 */
#ifndef ValueWeights_h
#define ValueWeights_h

#include "PartQuality.h"
#include "StatusArrays.h"

#include <utility>
#include <vector>

namespace trim
{

/// A new value as a sum of old ones.
struct ValueRow
{
  int Target = -1;                             ///< whose value it is
  std::vector<std::pair<int, double>> Sources; ///< by ascending index; their weights add up to one
};

/// Of nodes of the band; those whose place was not found are left out.
std::vector<ValueRow> WeightsOfNodes(const MovedNodes& moved);

/// Of the elements of a part, by GridPart::InBand, from elements of the band; without those that
/// are as the mesh had them.
std::vector<ValueRow> WeightsOfElements(const Band& band, const BandShapes& shapes);

}

#endif
