/**
 * @file InsertedLayer.h
 * @brief A layer of new elements between what is kept and what is eliminated.
 *
 * Where an element has faces of the cut on all sides of a corner, no place of its nodes makes it
 * valid with that corner on a smooth surface: in a block that is cut aslant to all its axes there
 * always are such elements. With a layer between (pillowing; S.A. Mitchell, T.J. Tautges, Pillowing
 * doublets, 1995) every element at the cut has one face there and no more.
 */
#ifndef InsertedLayer_h
#define InsertedLayer_h

#include "NodeMover.h"

#include <vector>

namespace trim
{

/// Whether a way leads from a node behind all faces of the cut at it, along the skin that it is on;
/// true for one that is not on the cut.
bool HasRoomForLayer(const Band& band, const std::vector<char>& kept, int node);

/**
 * The band with an element on each face between kept and eliminated elements, on the side of the
 * kept ones, whose nodes at the faces give way: a share of their elements' depth, on the border of
 * the model along it. The model has the shape that it had.
 *
 * @param mover of the band.
 * @param bare nodes, by node, where there is to be no layer: the elements on faces with such a node
 * are without volume, as it stays where it is, and are to be eliminated.
 * @param[out] cells made anew; status, rings and ids as in the band, of inserted nodes and cells
 * their Origin: the node whose place was taken, the kept element on whose face it stands.
 * @return the nodes of the cut where there is no room for it; empty: it stands.
 */
std::vector<int> InsertLayer(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& kept, const std::vector<char>& bare, BandCells& cells);

/// Whether an element is one that has to be eliminated, as a node on which it stands is bare.
bool IsOnBareNode(const Band& layered, const std::vector<char>& bare, int element);

}

#endif
