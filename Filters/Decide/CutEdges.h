/**
 * @file CutEdges.h
 * @brief Where the surface crosses the edges of the tetrahedra that elements are divided into.
 *
 * Neighbours have most of these edges in common, so each is crossed once.
 */
#ifndef CutEdges_h
#define CutEdges_h

#include "Band.h"
#include "TrimmingSurface.h"

namespace trim
{

using Tetrahedron = std::array<int, 4>; ///< places in NodesFromFirst

/// The nodes of an element from that which is the first one of the band on, in a positive order:
/// into which tetrahedra an element is divided must not depend on how it is numbered.
std::array<int, 8> NodesFromFirst(const BandElement& element);

/// Six tetrahedra round the diagonal 0-6, and three in a wedge; positive in VTK's node order.
constexpr std::array<Tetrahedron, 6> HexahedronTetrahedra = { { { 0, 1, 2, 6 }, { 0, 2, 3, 6 },
  { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 }, { 0, 5, 1, 6 } } };
constexpr std::array<Tetrahedron, 3> WedgeTetrahedra = { { { 0, 1, 2, 5 }, { 0, 1, 5, 4 },
  { 0, 4, 5, 3 } } };

class CutEdges
{
public:
  /**
   * @param band must outlive it.
   * @param gap see CrossEdge.
   */
  CutEdges(const Band& band, const nurbs::TrimmingSurface& surface, double gap);

  /// Share of the edge from an eliminated node to one that is not, which lies beyond.
  double Beyond(int eliminated, int other) const;

  /// The first edge that joins eliminated and kept nodes without meeting the surface, which shows
  /// that the surface ends there; -1: there is none.
  std::array<int, 2> FindMissed() const;

private:
  void ListEdges(const Band& band);
  void Cross(const Band& band, const nurbs::TrimmingSurface& surface, double gap);

  const std::vector<unsigned char>& Status;
  std::vector<std::array<int, 2>> Edges; ///< eliminated and kept node, ascending
  std::vector<int> First;                ///< of the edges of each node, and the end of the last's
  std::vector<double> Shares;            ///< of each edge; Missed: it does not meet the surface
};

}

#endif
