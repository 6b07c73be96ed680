/**
 * @file NodeOrdering.h
 * @brief Node numbers that minimise the largest difference within an element (paper, section 2.4).
 *
 * A bandwidth problem: no ordering gets below ceil((N - 1) / diameter of the node graph). Cheap
 * candidates are tried and the best is kept: the numbers as they came, sorts along the axes of
 * the part (longest outermost, thickness innermost), and where these do not reach the bound the
 * reverse Cuthill-McKee ordering from more than one start. The result is never worse than any.
 */
#ifndef NodeOrdering_h
#define NodeOrdering_h

#include "HexMesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace trim
{

/// The elements of a mesh by their nodes, in two flat arrays.
struct NodeGraph
{
  int NumberOfNodes = 0;
  PageVector<int> Offset;       ///< number of elements + 1
  PageVector<int> Connectivity; ///< node numbers as they came
  int Bandwidth = 0;            ///< largest difference of these within an element

  /// The nodes of an element; returns their number, 8 or 6.
  int NodesOf(Id element, std::array<Id, 8>& nodes) const
  {
    const int* const first = this->Connectivity.data() + this->Offset[element];
    const int count = this->Offset[element + 1] - this->Offset[element];
    if (count == 8) // most are: a copy of known length needs no call
    {
      std::copy_n(first, 8, nodes.begin());
    }
    else
    {
      std::copy_n(first, count, nodes.begin());
    }
    return count;
  }
};

/// Whether so many elements can be ordered: their nodes and those round each are counted by int.
inline bool CanOrderNodes(Id numberOfElements)
{
  constexpr Id MostNeighbours = 27; // in a block
  return numberOfElements <= std::numeric_limits<int>::max() / MostNeighbours;
}

/// Where the nodes of a graph are.
class NodePlaces
{
public:
  /// @param ids of each node, in the mesh.
  /// @param places of each node, or empty: where the mesh has them.
  NodePlaces(const HexMesh& mesh, const Id* ids, std::vector<Vec3> places)
    : Mesh(mesh)
    , Ids(ids)
    , Places(std::move(places))
  {
  }
  Vec3 operator()(int node) const
  {
    return this->Places.empty() ? this->Mesh.Point(this->Ids[node]) : this->Places[node];
  }

private:
  const HexMesh& Mesh;
  const Id* Ids;
  std::vector<Vec3> Places;
};

/// Largest difference of node numbers within an element, under number[node].
int NodeBandwidth(const NodeGraph& graph, const PageVector<int>& number);

/// The frame of one element's edges: the rows of a regular mesh that lies askew.
Eigen::Matrix3d ElementAxes(const NodeGraph& graph, const NodePlaces& position);

/**
 * New number of each node.
 *
 * @param position of each node; neighbours in a row of a regular mesh should have equal
 * coordinates, so the positions before the correction serve better than those after.
 */
PageVector<int> OrderNodes(
  const NodeGraph& graph, const NodePlaces& position, const std::function<bool()>& aborted);

}

#endif
