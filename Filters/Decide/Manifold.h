/**
 * @file Manifold.h
 * @brief Whether the boundary of the kept elements is a manifold at a node.
 */
#ifndef Manifold_h
#define Manifold_h

#include "Band.h"

#include <vector>

namespace trim
{

/**
 * True if the boundary facets of the kept elements at this node form one closed fan (or none):
 * every edge has two of them or none, and all are joined by edges at the node.
 */
bool IsManifoldAt(const Band& band, const std::vector<char>& kept, int node);

/// The other ends of edges at this node with more than two boundary facets of the kept elements,
/// which are joined there alone; ascending.
std::vector<int> FindPinchedEdgesAt(const Band& band, const std::vector<char>& kept, int node);

}

#endif
