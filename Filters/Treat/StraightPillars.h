/**
 * @file StraightPillars.h
 * @brief Pillars of a sheet whose nodes the relaxation took different ways come together again.
 *
 * A pillar is relaxed as a whole where that raises the elements at it, else node by node, and all
 * nodes round a bad element may take a step of least squares. What that gains is little where
 * elements are good, and leaves the layers of a sheet sheared against each other.
 */
#ifndef StraightPillars_h
#define StraightPillars_h

#include "GuardedMesh.h"

#include <vector>

namespace trim
{

/// Nodes of a pillar from skin to skin, with the edges to two pillars beside it.
struct Stack
{
  std::vector<int> Nodes;
  std::vector<Eigen::Matrix<double, 3, 2>> Edges; ///< as they came, by node
};

/// Pillars with relaxed nodes that went different ways, in shares of the edges.
std::vector<Stack> FindBentPillars(
  const Band& band, const Columns& columns, const NodeMover& mover, const Moves& moves);

/**
 * Takes the nodes of bent pillars to the same place between the pillars beside them, in shares
 * of the edges to those; where the elements do not stand that, as at a leaning cut, to places that
 * change evenly from skin to skin, or half-way.
 *
 * No element loses more than 0.04 of its scaled Jacobian, counted from 0.6 down, or falls below
 * 0.5, 0.55 or the least of `given`.
 *
 * @param given nodes that are moved get Correction::Relax; pillars with fixed nodes, or such that
 * were left off the surface, stay.
 */
void StraightenPillars(const GuardedCase& given, std::vector<Stack> bent);

}

#endif
