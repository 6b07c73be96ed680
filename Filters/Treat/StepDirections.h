/**
 * @file StepDirections.h
 * @brief Directions in which nodes take steps together, as long as the edges there.
 */
#ifndef StepDirections_h
#define StepDirections_h

#include "RelaxedMesh.h"

#include <unordered_map>
#include <vector>

namespace trim
{

class StepDirections
{
public:
  /// @param mesh must outlive it.
  explicit StepDirections(RelaxedMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// Tangents in which the edges at a node are of length one, so that a step is as easy along long
  /// edges as across.
  const Eigen::Matrix3Xd& At(int node);

  /// To be told when RelaxedMesh::TellMoved was.
  void TellMoved(const std::vector<int>& nodes);

private:
  /// Found once for a place: few nodes are moved by a step, and those that may go anywhere have the
  /// same directions everywhere.
  struct Known
  {
    Vec3 Place;
    Eigen::Matrix3Xd Directions;
  };

  Eigen::Matrix3Xd Find(int node);

  RelaxedMesh& Mesh;
  std::unordered_map<int, Known> ByNode;
};

}

#endif
