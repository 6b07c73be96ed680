/**
 * @file Pentahedra.h
 * @brief Elements that became pentahedra (paper, section 2.4, Fig. 7): distributed or degenerated.
 *
 * Where the staircase of kept elements steps, an element shows two adjacent facets to the new
 * boundary, and the edge A-B between them belongs to no other kept element. A facet on the border
 * of the mesh that lies beyond the surface counts as one of the new boundary. Once all its nodes
 * lie on the surface the corner at A is nearly a straight angle. *Distribute* puts A and B in
 * the middle of their neighbours along the surface, *degenerate* drops them: a wedge is left.
 */
#ifndef Pentahedra_h
#define Pentahedra_h

#include "ExposedEdges.h"
#include "Moves.h"

#include <array>
#include <vector>

namespace trim
{

enum class Optimization : unsigned char
{
  None = 0,
  Distribute = 1,
  Degenerate = 2
};

/// What the validity ladder has set for the pentahedra of a pillar against what was asked.
enum class TreatmentChoice : unsigned char
{
  AsAsked,
  LeaveCorner,
  Distribute,
  Degenerate
};

/// An element whose nodes were replaced: a wedge instead of a hexahedron.
struct ReplacedElement
{
  int Element = -1;
  std::array<int, 8> Node; ///< of each triangle: next to the dropped one, opposite, before it
  std::array<int, 2> Dropped{ -1, -1 }; ///< beside the first and the second triangle
};

/// The nodes of the facet that a wedge has where it dropped an edge, in turn.
inline std::array<int, 4> OpenedFacet(const ReplacedElement& wedge)
{
  return { wedge.Node[0], wedge.Node[2], wedge.Node[5], wedge.Node[3] };
}

struct Pentahedra
{
  int Count = 0;                       ///< elements found
  std::vector<ReplacedElement> Wedges; ///< by ascending element
  std::vector<char> Exposed;           ///< columns (smallest element) that have such an edge
  std::vector<char> FlatCorner;        ///< elements left with a straight corner
};

/// The wedge that an element became, or null.
const ReplacedElement* FindWedge(const Pentahedra& treated, int element);

/// What becomes of the pentahedra.
struct Treatments
{
  Optimization Asked;
  const std::vector<TreatmentChoice>& Choice; ///< by pillar (index: smallest node of the pillar)
};

/**
 * Treats the pentahedra of the kept elements; moves is changed where nodes are distributed.
 *
 * @param exposed the pillars of their edges A-B.
 */
Pentahedra TreatPentahedra(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<ExposedPillar>& exposed, const Treatments& treatments, Moves& moves);

/// The wedges that would be left without an edge A-B that was not treated, pillar by pillar.
std::vector<std::vector<ReplacedElement>> FindDroppable(const Band& band, const Columns& columns,
  const std::vector<char>& kept, const Pentahedra& treated);

/// Drops edges; false if an element of theirs has become a wedge meanwhile.
bool DropEdges(const std::vector<ReplacedElement>& wedges, Pentahedra& treated);

}

#endif
