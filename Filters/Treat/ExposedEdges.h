/**
 * @file ExposedEdges.h
 * @brief The edges A-B at which an element shows two adjacent facets to the new boundary (paper,
 * Fig. 7), and which of them are treated together.
 */
#ifndef ExposedEdges_h
#define ExposedEdges_h

#include "Band.h"
#include "Columns.h"

#include <array>
#include <vector>

namespace trim
{

/// One edge A-B of one element: position k of the axis ends.
struct ExposedEdge
{
  int Element;
  int Axis;
  int Corner;
};

/// A and B: at the first and the second end of the axis.
std::array<int, 2> EndsOf(const Band& band, const ExposedEdge& edge);

/// Exposed edges that are treated together.
struct ExposedPillar
{
  int Node = -1; ///< the smallest of the pillar
  std::vector<ExposedEdge> Edges;
  bool Droppable = true; ///< without its nodes the mesh still conforms
};

/**
 * The exposed edges of the kept hexahedra: in a sheet by the pillars of its columns, in a block by
 * chains of edges that follow each other. Ascending by the smallest node.
 *
 * @param lostSides whether sides on the border of the mesh that lie beyond the surface count as
 * facets of the new boundary, too.
 */
std::vector<ExposedPillar> FindExposedPillars(
  const Band& band, const Columns& columns, const std::vector<char>& kept, bool lostSides);

}

#endif
