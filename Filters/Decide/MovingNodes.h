/**
 * @file MovingNodes.h
 * @brief Which nodes the border between what stays and what goes has (paper, section 2.3).
 */
#ifndef MovingNodes_h
#define MovingNodes_h

#include "Band.h"
#include "Columns.h"

#include <vector>

namespace trim
{

/**
 * Nodes that have to lie on the new boundary: those that kept and eliminated elements share,
 * on either side of the surface, and eliminated nodes of kept elements, but for those in a cut-out
 * of a sheet that is not opened.
 */
std::vector<char> FindMovingNodes(
  const Band& band, const Columns& columns, const std::vector<char>& kept);

/// A face between a kept element and an eliminated one.
inline bool IsCutFace(const BandFace& face, const std::vector<char>& kept)
{
  return face.Element[1] >= 0 && kept[face.Element[0]] != kept[face.Element[1]];
}

/// The nodes of the faces between kept and eliminated elements.
std::vector<char> FindCutNodes(const Band& band, const std::vector<char>& kept);

}

#endif
