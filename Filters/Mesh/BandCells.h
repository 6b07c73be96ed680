/**
 * @file BandCells.h
 * @brief The cells round the cut, ring by ring, and the one order that a band has.
 */
#ifndef BandCells_h
#define BandCells_h

#include "HexMesh.h"

#include <array>
#include <functional>
#include <vector>

namespace trim
{

/// What a node or element was in the band before a layer was inserted.
struct Origin
{
  int Index = -1; ///< of an inserted one: the node in whose place it is, the element it stands on
  bool Inserted = false; ///< the mesh does not have it
};

/// Cells near the cut with their nodes and statuses.
struct BandCells
{
  struct Node
  {
    Id Global = -1;            ///< id in the mesh; -1: it has none here
    Vec3 Point = Vec3::Zero(); ///< original position
    unsigned char Status = 0;  ///< NodeStatus
    Origin From = {};          ///< see Band::NodeOrigins
  };
  struct Cell
  {
    Id Global = -1; ///< id in the mesh; -1: it is no cell of this mesh
    int Count = 0;  ///< 8 or 6
    int Ring = 0;   ///< 0: meets the surface
    unsigned char Status = 0;
    std::array<int, 8> Node; ///< places in Nodes
    Origin From = {};        ///< see Band::ElementOrigins

    const int* begin() const { return this->Node.data(); }
    const int* end() const { return this->Node.data() + this->Count; }
  };
  std::vector<Node> Nodes;
  std::vector<Cell> Cells;
};

/// Told which nodes of the mesh a ring has reached, adds those that it reached elsewhere.
using SpreadRing = std::function<void(std::vector<Id>& nodes)>;

/**
 * The cells of ring 0 and so many rings of cells round them, joined by nodes.
 *
 * @param seeds cells of ring 0, ascending.
 * @param near cells among which all rings are found, ascending (a superset of the band).
 * @param spread called once for each ring; may be empty.
 */
BandCells CollectBandCells(const HexMesh& mesh, const std::vector<Id>& seeds,
  const std::vector<Id>& near, int rings, const UnsetVector<unsigned char>& nodeStatus,
  const UnsetVector<unsigned char>& elementStatus, const SpreadRing& spread);

/// The order of places: by x, then y, then z.
inline bool LiesBefore(const Vec3& a, const Vec3& b)
{
  return a[0] != b[0] ? a[0] < b[0] : a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

/**
 * Puts nodes and cells in the order of their places, so that a trim does not depend on how the
 * mesh is numbered: nodes by LiesBefore; cells by their sorted nodes. Nodes at one place
 * are told apart by the cells round them; only where these are the same the given order decides.
 */
void SortByPlace(BandCells& band);

}

#endif
