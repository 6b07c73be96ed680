/**
 * @file PieceSides.h
 * @brief Carries the sides of nodes across the borders of the pieces.
 *
 * Each rank classifies the nodes of its own piece; what a node that several pieces share has got
 * from one of them holds on all. Nothing of the far mesh is sent but, for each shared node, which
 * set of nodes it belongs to on its rank. All functions are collective, and do nothing on one
 * rank alone.
 */
#ifndef PieceSides_h
#define PieceSides_h

#include "NodeClassification.h"
#include "Place.h"
#include "SetSides.h"
#include "SharedNodes.h"

#include <functional>
#include <limits>
#include <vector>

namespace trim
{

/// What an edge that the surface crosses says of the side of one of its ends.
struct SideVote
{
  double Distance = std::numeric_limits<double>::infinity(); ///< of the crossing from the node
  Place OtherEnd{};
  unsigned char Side = NodeUnknown;

  /// Of several edges the one crossed nearest to the node decides.
  bool Outvotes(const SideVote& other) const
  {
    return this->Distance != other.Distance ? this->Distance < other.Distance
                                            : this->OtherEnd < other.OtherEnd;
  }
};

/// A vote for a node of this piece.
struct NodeVote
{
  Id Node = -1;
  SideVote Vote;
};

/// What the projections of one rank say of a shared node, all others get.
void ShareProjections(const Piece& piece, NodeClassification& nodes);

/// Adds the votes that other ranks have for nodes of this piece.
void ShareVotes(const Piece& piece, std::vector<NodeVote>& votes);

/// The outermost nodes of a part of the mesh: whatever order they are added in, and whoever has
/// them, the same ones.
class OutermostNodes
{
public:
  static constexpr int Count = 6;

  void Add(const Place& p);
  void Add(const OutermostNodes& other);
  const std::array<Place, Count>& Places() const { return this->Most; }

private:
  std::array<Place, Count> Most{};
  bool Empty = true;
};

/// Sets of nodes that lie on one side, joined across the pieces.
class JoinedSets
{
public:
  /**
   * Joins the sets of all ranks that have shared nodes in common.
   *
   * @param rootOf the set (its root) of a node of this piece.
   * @param[in,out] ofRoot the side of each set by its root; sets joined get the side that one of
   * them has, NodeOnBothSides where they have different ones.
   * @return false, on all ranks, if joined sets have different sides.
   */
  bool Join(const Piece& piece, const std::function<Id(Id)>& rootOf, SetSides& ofRoot);

  /// Number of a set among the joined ones, the same on all ranks; -1: it is no other rank's.
  Id PartOf(Id root) const;

  /// Completes the outermost nodes of the joined sets, by PartOf.
  void ShareOutermost(const Piece& piece, std::vector<std::pair<Id, OutermostNodes>>& parts) const;

private:
  std::vector<std::pair<Id, Id>> Parts; ///< root and number, ascending
};

}

#endif
