/**
 * @file MovingNodes.h
 * @brief Which nodes the border between what stays and what goes has (paper, section 2.3).
 */
#ifndef MovingNodes_h
#define MovingNodes_h

#include "Band.h"
#include "Columns.h"
#include "LastAsked.h"

#include <utility>
#include <vector>

namespace trim
{

/**
 * Nodes that have to lie on the new boundary: those that kept and eliminated elements share,
 * on either side of the surface, and eliminated nodes of kept elements, but for those in a cut-out
 * of a sheet that is not opened.
 */
class MovingNodes
{
public:
  /// Both must outlive it.
  MovingNodes(const Band& band, const Columns& columns)
    : TheBand(band)
    , TheColumns(columns)
  {
  }

  /// Asked again and again, mostly about what was kept the last time.
  /// @param kept by element.
  /// @return by node, until the next call.
  const std::vector<char>& Find(const std::vector<char>& kept);

private:
  std::vector<char> FindAnew(const std::vector<char>& kept);
  bool AnyIsShut(const std::vector<char>& touchesEliminated) const;
  void FindCutOuts();
  std::vector<char> FindShut(const std::vector<char>& touchesEliminated);

  const Band& TheBand;
  const Columns& TheColumns;
  /// By node beyond the surface: one node of the cut-out that it is in, if that holds no whole
  /// element and no border; else -1. If none of its nodes goes, nor any beside it, there is no
  /// border that they could lie on, and moving them would spoil the elements for nothing. Empty:
  /// not asked for yet.
  std::vector<int> CutOut;
  std::vector<std::pair<int, int>> AtCutOuts;            ///< elements with nodes of one
  LastAsked<std::vector<char>, std::vector<char>> Found; ///< by what is kept
};

/// A face between a kept element and an eliminated one.
inline bool IsCutFace(const BandFace& face, const std::vector<char>& kept)
{
  return face.Element[1] >= 0 && kept[face.Element[0]] != kept[face.Element[1]];
}

/// The nodes of the faces between kept and eliminated elements.
std::vector<char> FindCutNodes(const Band& band, const std::vector<char>& kept);

}

#endif
