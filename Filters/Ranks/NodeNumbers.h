/**
 * @file NodeNumbers.h
 * @brief Numbers of the nodes of all ranks: first the shared ones, then the others rank by rank.
 */
#ifndef NodeNumbers_h
#define NodeNumbers_h

#include "SharedNodes.h"

namespace trim
{

class NodeNumbers
{
public:
  /// Collective.
  NodeNumbers(const HexMesh& mesh, const Piece& piece)
    : Shared(piece.Shared)
    , First(piece.Shared.Total())
    , Count(mesh.NumberOfPoints)
  {
    const auto counts = piece.All.Gather(std::vector<Id>{ mesh.NumberOfPoints });
    for (int rank = 0; rank < piece.All.Rank(); ++rank)
    {
      this->First += counts[rank];
    }
  }

  Id NumberOf(Id local) const
  {
    const Id shared = this->Shared.NumberOf(local);
    return shared >= 0 ? shared : this->First + local;
  }

  bool IsShared(Id number) const { return number < this->Shared.Total(); }

  /// -1: this piece does not have the node.
  Id LocalOf(Id number) const
  {
    if (this->IsShared(number))
    {
      return this->Shared.LocalByNumber[number];
    }
    return number >= this->First && number < this->First + this->Count ? number - this->First : -1;
  }

private:
  const SharedNodes& Shared;
  Id First, Count;
};

}

#endif
