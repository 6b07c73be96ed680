/**
 * @file GuardedMesh.h
 * @brief The elements at the cut while nodes are put elsewhere: what the elements are held to, and
 * the way back.
 */
#ifndef GuardedMesh_h
#define GuardedMesh_h

#include "BandQuality.h"
#include "FailedReturns.h"
#include "NodeGrid.h"
#include "RelaxedMesh.h"

#include <functional>
#include <vector>

namespace trim
{

/// Nodes that are to be put elsewhere, and what that must not cost. All that it refers to must
/// outlive the work.
struct GuardedCase
{
  RelaxationCase ToRelax;            ///< with the Fixed and OnCut below
  const BandQuality& Quality;        ///< says which elements are invalid
  double Least;                      ///< scaled Jacobian that no element falls below
  std::vector<char>& Fixed;          ///< in and out: nodes that must not move
  std::vector<char>& OnCut;          ///< in and out: nodes of the new boundary
  Moves& NodeMoves;                  ///< in and out
  FailedReturns* Failures = nullptr; ///< in and out, of earlier climbs with the same band
  /// Whether what else has a node stands it where it lies now; null: nothing else has any.
  std::function<bool(int)> OthersStand{};
};

class GuardedMesh : public RelaxedMesh
{
public:
  /// @param given must outlive it.
  explicit GuardedMesh(const GuardedCase& given);
  /// @param same another one, of which the nodes are where they are in this case.
  GuardedMesh(const GuardedCase& given, const GuardedMesh& same);

  /// What an element is not to fall below.
  struct Standard
  {
    double Quality;
    double EdgeShare;  ///< see ShortestEdgeShare: a good shape may still have an edge of no length
    bool LeavesBorder; ///< it may, as it did before
  };

  /// @param quality not to fall below.
  Standard StandardOf(int element, double quality) const
  {
    return { quality, this->EdgeShareToKeep(element), this->LeavesBorder(element) };
  }

  /// What elements have, but no more than a scaled Jacobian, and than little of their edges.
  std::vector<Standard> StandardsOf(const std::vector<int>& elements, double limit) const;

  /// The lowest of elements, -1 if one is invalid or below its standard.
  double LowestOf(const std::vector<int>& elements, const std::vector<Standard>& standards) const;

  /// Whether a node lies where another one is. Those that were moved are found where they were
  /// told of.
  bool IsCoincident(int node) const;

  /// Tells that nodes stay where they are now.
  void TellPlaced(const std::vector<int>& nodes);

  /// What a relaxation changes.
  struct State
  {
    std::vector<int> Nodes;
    std::vector<Vec3> Position;
    std::vector<Correction> Applied;
  };

  State StateOf(const std::vector<int>& nodes) const;
  void Restore(const State& state);

  /// Whether a node that moved coincides with another one. Tells where they are.
  bool HasCoincident(const State& before);

protected:
  const GuardedCase& Given;

private:
  bool LeavesBorder(int element) const;

  NodeGrid Used; ///< the nodes of the elements
};

}

#endif
