/**
 * @file Moves.h
 * @brief The correction stage over all moving nodes of the band (paper, Fig. 5 d-f).
 */
#ifndef Moves_h
#define Moves_h

#include "NodeMover.h"

#include <vector>

namespace trim
{

/// What the validity ladder has set for a pillar of nodes against the asked correction.
enum class CorrectionChoice : unsigned char
{
  AsAsked,
  Other, ///< type III for type II and the reverse
  Leave, ///< the pillar is left off the surface
  Inside ///< the pillar, which is not at the cut, goes wherever the elements round it are good
};

/// The choice for a pillar, and how much of its way a pillar that is left goes all the same.
struct PillarChoice
{
  CorrectionChoice Correction = CorrectionChoice::AsAsked;
  double Way = 0.0; ///< 0: it stays where it was, 1 would be the surface
  /// Nodes that find no place may go to a corner of the model right beside the surface.
  bool MayEndAtCorner = false;
};

struct Moves
{
  /// Of every band node, moved or not; in a mesh of floats as it will be stored.
  std::vector<Vec3> Position;
  std::vector<Correction> Applied; ///< None: not moved
  std::vector<char> Failed;        ///< nodes that should have moved and could not
  std::vector<char> Left;          ///< nodes that should have moved to the surface and did not
};

/// A position as the mesh stores it: what is checked has to be what is written.
inline Vec3 AsStored(const Band& band, const Vec3& p)
{
  if (!band.SinglePrecision)
  {
    return p;
  }
  // Volatile: GCC 12 at -O3 vectorises the conversion to float and back away.
  volatile float x = static_cast<float>(p.x());
  volatile float y = static_cast<float>(p.y());
  volatile float z = static_cast<float>(p.z());
  return Vec3(x, y, z);
}

/**
 * Moves the nodes onto the surface.
 *
 * @param moving see MovingNodes.
 * @param asked Project or Slide.
 * @param choice by pillar (index: smallest node of the pillar).
 */
Moves MoveNodes(const Band& band, const NodeMover& mover, const std::vector<char>& moving,
  Correction asked, const std::vector<PillarChoice>& choice);

}

#endif
