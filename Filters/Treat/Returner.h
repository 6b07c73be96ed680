/**
 * @file Returner.h
 * @brief Takes nodes that were left off the surface to it, or nearer to it, as far as the elements
 * round them stand it.
 */
#ifndef Returner_h
#define Returner_h

#include "GuardedMesh.h"

#include <optional>
#include <vector>

namespace trim
{

class Returner : private GuardedMesh
{
public:
  using GuardedMesh::State;

  /// @param failures in and out; null: nothing is tried again.
  Returner(const GuardedCase& given, FailedReturns* failures)
    : GuardedMesh(given)
    , Failures(failures)
    , Limit(given.Least)
  {
  }
  /// @param same see GuardedMesh.
  Returner(const GuardedCase& given, const Returner& same)
    : GuardedMesh(given, same)
    , Failures(same.Failures)
    , Limit(same.Limit)
  {
  }

  /// Nodes go to the surface, and nothing else moves; false if none does.
  bool Run(const std::vector<int>& left);

  /// What becomes of a node when the nodes round it are relaxed.
  struct Outcome
  {
    std::optional<State> Moved; ///< where they come to, the node as the last one; none: it fails
    int Relaxations = 0;        ///< places that room was looked for
  };

  /// Leaves everything as it is.
  /// @param most Relaxations.
  Outcome Foresee(int node, int most);

  /// Makes what was foreseen so.
  void Take(const State& moved);

  /// Asks the mover for what was asked of it where this node was foreseen by others: it remembers.
  void Ask(int node) const { this->RoundLeft(node, this->ElementsAt({ node })); }

  /// Takes nodes as near to the surface as they can come; false if none comes nearer.
  bool Approach(const std::vector<int>& left);

private:
  struct Place
  {
    Vec3 At = Vec3::Zero();
    Correction By = Correction::None;
  };

  /// Tries each of the nodes and forgets those that returned; false if there were none.
  bool Sweep(std::vector<int>& nodes, bool (Returner::*attempt)(int));

  bool OthersStand(const std::vector<int>& nodes) const;

  /// Where a node may come to the surface.
  std::vector<Place> PlacesFor(int node);

  /// Where the way to the surface leaves a block a node may still come to lie between those beside
  /// it on the cut; for one on the skin, those on the skin.
  NodeMove BetweenNeighbours(int node) const;

  bool Return(int node);

  /// Moves a node to the place nearest to the surface that the elements stand; false if that is
  /// where it was.
  bool ComeNearer(int node, const std::vector<int>& left);

  /// Moves a node whose border ends right before the surface to that end, together with the others
  /// left in its pillar, as one alone would twist a thin element. False if it is there, or the
  /// elements do not stand it.
  bool ComeToCorner(int node, const std::vector<int>& left);

  /// Where a node comes to on the longest part of a way that the elements stand; it stays.
  /// @param elements those at the node, with what they are to keep.
  Vec3 GoTowards(int node, const Vec3& goal, const std::vector<int>& elements,
    const std::vector<Standard>& before);

  void Put(int node, const Place& place);
  void TellReturned(int node);
  void SetOnCut(int node, char onCut);

  /// The nodes that may make room for one that is left, and itself.
  /// @param at elements at it.
  std::vector<int> RoundLeft(int node, const std::vector<int>& at) const;

  /// Whether a node finds room where it was put.
  /// @param at elements at it.
  /// @param before the node, as the last one, and all that may make room, as they were.
  /// @param standards of the elements at these.
  bool MakesRoom(int node, const std::vector<int>& at, const State& before,
    const std::vector<Standard>& standards);

  /// The standards are those of the places before.
  FailedReturns::Key KeyOf(int node, const std::vector<int>& at, const State& before) const;

  /// Whether all edges at a corner of an element lie in one plane of the surface: there is no
  /// corner then, wherever its nodes go along it.
  bool IsFlat(int e) const;

  FailedReturns* Failures;
  double Limit; ///< elements that are above it do not fall below
};

}

#endif
