/**
 * @file RelaxedMesh.h
 * @brief The elements at the cut while their nodes are moved for the sake of quality: which nodes
 * may move, where to, and how good the elements are.
 */
#ifndef RelaxedMesh_h
#define RelaxedMesh_h

#include "ElementWorth.h"
#include "Moves.h"
#include "Progress.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace trim
{

/// A kept element as it will be written.
struct RelaxedElement
{
  int Count = 0; ///< 0: not kept
  std::array<int, 8> Node;

  const int* begin() const { return this->Node.data(); }
  const int* end() const { return this->Node.data() + this->Count; }
};

/// What there is to relax. All of it must outlive the relaxation.
struct RelaxationCase
{
  const Band& TheBand;
  const NodeMover& Mover;
  const std::vector<RelaxedElement>& Elements; ///< of the band, with degenerated ones as wedges
  const std::vector<char>& Fixed;              ///< nodes that must not move
  const std::vector<char>& OnCut;              ///< nodes of the new boundary
  const AbortCheck& Aborted;
};

/// Rings of nodes round the elements below the goal that may move.
constexpr int RelaxedRings = 3;
/// Elements are raised to a little above the goal, so that rounding does not undo it.
constexpr double GoalMargin = 1.02;
class RelaxedMesh
{
public:
  /// @param[in,out] moves positions; nodes that are moved get Correction::Relax.
  RelaxedMesh(const RelaxationCase& given, Moves& moves)
    : TheBand(given.TheBand)
    , Mover(given.Mover)
    , Elements(given.Elements)
    , OnCut(given.OnCut)
    , Aborted(given.Aborted)
    , TheMoves(moves)
    , Fixed(given.Fixed)
    , Freedoms(given.TheBand.NumberOfNodes())
  {
  }

  const Band& TheBand;
  const NodeMover& Mover;
  const std::vector<RelaxedElement>& Elements;
  const std::vector<char>& OnCut;
  const AbortCheck& Aborted;
  Moves& TheMoves;

  ElementPoints PointsOf(int element) const;

  /// Scaled Jacobian of an element.
  double Quality(int element) const;

  /// The same, or less where an edge that can change vanishes; see ElementWorth.h.
  /// @param limit what is below need not be exact, but below.
  double Worth(int element, double limit = -std::numeric_limits<double>::infinity()) const;

  /// What an element has to be worth to be about as good as it came, if that was so poor that it
  /// need not reach a goal; infinite for others.
  double EnoughFor(int element, double goal) const;

  /// How much of its length that edge of an element has left which lost most.
  double ShortestEdgeShare(int element) const;

  /// The share that its edges are to keep: what they have, but no more than little.
  double EdgeShareToKeep(int element) const
  {
    return std::min(LeastEdgeShare, this->ShortestEdgeShare(element));
  }

  bool Uses(int element, int node) const;

  /// Kept elements that use one of the nodes, ascending.
  std::vector<int> ElementsAt(const std::vector<int>& nodes) const;

  /// Movable nodes of elements and of rings round them, nearest first.
  std::vector<int> NodesRound(const std::vector<int>& elements, int rings) const;

  /// Nodes parted into those that are joined by elements at them, edges or pillars, in their
  /// order.
  std::vector<std::vector<int>> PartsOf(const std::vector<int>& nodes) const;

  /// To be asked for different nodes by different threads.
  NodeFreedom& FreedomOf(int node);

  /// To be told of a node that comes to the cut, or leaves it.
  void ForgetFreedom(int node) { this->Freedoms[node].reset(); }

  /// Whether a node may be anywhere.
  bool IsFree(int node)
  {
    const NodeFreedom& freedom = this->FreedomOf(node);
    return !this->OnCut[node] && freedom.Constraint.Kind == ConstraintKind::Free;
  }

  /// To the nearest neighbour within the layer.
  double ShortestEdge(int node) const;

  /// The metric in which the edges at a node are of length one, more or less.
  Eigen::Matrix3d EdgeMetric(int node) const;

  std::vector<Vec3> PositionsOf(const std::vector<int>& nodes) const;
  void Place(const std::vector<int>& nodes, const std::vector<Vec3>& positions);

  /// Takes each node to the nearest place where it may be; false if one has none.
  bool Settle(const std::vector<int>& nodes);

  /// Sets Applied of nodes that have got their places.
  void TellMoved(const std::vector<int>& nodes);

private:
  bool IsMovable(int node) const;
  void TellStart(int node);

  const std::vector<char>& Fixed;
  std::vector<std::unique_ptr<NodeFreedom>> Freedoms; ///< by node, once asked for
};

}

#endif
