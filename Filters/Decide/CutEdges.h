/**
 * @file CutEdges.h
 * @brief Where the surface crosses the edges of the tetrahedra that elements are divided into.
 *
 * Neighbours have most of these edges in common, so each is crossed once.
 */
#ifndef CutEdges_h
#define CutEdges_h

#include "Band.h"
#include "ElementTetrahedra.h"
#include "TrimmingSurface.h"

namespace trim
{

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

  /// Of the surface where it crosses that edge; where it does so more than once, of one place.
  const Vec3& Normal(int eliminated, int kept) const;

  /// The first edge that joins eliminated and kept nodes without meeting the surface, which shows
  /// that the surface ends there; -1: there is none.
  std::array<int, 2> FindMissed() const;

private:
  void ListEdges(const Band& band);
  void Cross(const Band& band, const nurbs::TrimmingSurface& surface, double gap);
  std::size_t Find(int eliminated, int kept) const;

  const std::vector<unsigned char>& Status;
  std::vector<std::array<int, 2>> Edges; ///< eliminated and kept node, ascending
  std::vector<int> First;                ///< of the edges of each node, and the end of the last's
  std::vector<double> Shares;            ///< of each edge; Missed: it does not meet the surface
  std::vector<Vec3> Normals;             ///< of the surface, at each edge
};

}

#endif
