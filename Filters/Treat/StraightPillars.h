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

namespace trim
{

/**
 * Takes the nodes of relaxed pillars to the same place between the pillars beside them, in shares
 * of the edges to those; where the elements do not stand that, as at a leaning cut, to places that
 * change evenly from skin to skin, or half-way.
 *
 * No element loses more than 0.04 of its scaled Jacobian, counted from 0.6 down, or falls below
 * 0.5, 0.55 or the least of `given`.
 *
 * @param given nodes that are moved get Correction::Relax; pillars with fixed nodes, or such that
 * were left off the surface, stay.
 */
void StraightenPillars(const GuardedCase& given, const Columns& columns);

}

#endif
