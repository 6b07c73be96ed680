/**
 * @file KeptSide.h
 * @brief Which side of the surface is kept: on which one a point lies, and how to turn round what
 * the classification has found.
 */
#ifndef KeptSide_h
#define KeptSide_h

#include "NodeClassification.h"

namespace trim
{

/**
 * Whether a point lies beyond the surface: by projection near it, where the sign is certain, else
 * on the side that one comes to on the way from the nearest node, whose status was carried along
 * the mesh. Collective.
 */
bool LiesBeyond(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const NodeClassification& nodes, const Vec3& point);

/// Turns the sides of nodes and clusters round, and all that was found of the surface at them.
void TurnStatuses(NodeClassification& nodes);

/// Turns the surface round for a scope, if it is to be turned.
class Turned
{
public:
  Turned(nurbs::TrimmingSurface& surface, bool turn)
    : Surface(surface)
    , Turn(turn)
  {
    this->Flip();
  }
  ~Turned() { this->Flip(); }
  Turned(const Turned&) = delete;
  void operator=(const Turned&) = delete;

private:
  void Flip()
  {
    if (this->Turn)
    {
      this->Surface.Flip();
    }
  }
  nurbs::TrimmingSurface& Surface;
  bool Turn;
};

}

#endif
