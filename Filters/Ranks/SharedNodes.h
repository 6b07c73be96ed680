/**
 * @file SharedNodes.h
 * @brief Which nodes of a piece of the mesh belong to other ranks' pieces as well.
 *
 * Nodes are one node if they have the same global id, or, where the input has none, if they lie
 * at the same place, bit for bit. Only nodes on the border of a piece are asked, and of these
 * only those in a part of space that another piece has a border in too.
 */
#ifndef SharedNodes_h
#define SharedNodes_h

#include "HexMesh.h"
#include "Ranks.h"

#include <string>
#include <vector>

namespace trim
{
struct MeshBlocks;

struct SharedNodes
{
  std::vector<Id> Local;         ///< nodes of this piece that others have too, ascending
  std::vector<Id> Number;        ///< of each of them, the same on all ranks: 0 .. Total()-1
  std::vector<Id> LocalByNumber; ///< of every shared number; -1: not in this piece

  /// Shared nodes of all ranks.
  Id Total() const { return static_cast<Id>(this->LocalByNumber.size()); }
  /// Shared number of a node of this piece, or -1.
  Id NumberOf(Id local) const;
};

/**
 * Finds the shared nodes; collective.
 *
 * @param blocks of this rank's piece, before ShareBounds.
 * @param globalIds of each point of the piece; null: told apart by their places. The same
 * on all ranks that have points.
 * @return false with an error, the same on all ranks, where nodes of one piece lie at one place
 * or one global id stands for two places.
 */
bool FindSharedNodes(const HexMesh& mesh, const MeshBlocks& blocks, const Id* globalIds,
  const Ranks& ranks, SharedNodes& shared, std::string& error);

/// The piece of the mesh that this rank has among those of the others.
struct Piece
{
  const Ranks& All;
  const SharedNodes& Shared;
  const std::vector<Id>& InputCells; ///< ids in the input of the mesh's cells; empty: the same
  const Id* GlobalIds = nullptr; ///< what tells nodes of several pieces apart; null: their places

  Id InputCell(Id cell) const { return this->InputCells.empty() ? cell : this->InputCells[cell]; }
};

}

#endif
