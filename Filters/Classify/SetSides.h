/**
 * @file SetSides.h
 * @brief The side of each set of nodes, by its root.
 */
#ifndef SetSides_h
#define SetSides_h

#include "HexMesh.h"
#include "Status.h"

namespace trim
{

/// Few of all that could be a root are one: the others take neither time nor memory.
class SetSides
{
public:
  explicit SetSides(Id count)
    : BeforeUnknown(count)
  {
  }

  unsigned char Of(Id root) const
  {
    return static_cast<unsigned char>(NodeUnknown - this->BeforeUnknown[root]);
  }
  void Set(Id root, unsigned char side)
  {
    this->BeforeUnknown[root] = static_cast<unsigned char>(NodeUnknown - side);
  }

private:
  nurbs::SparseVector<unsigned char> BeforeUnknown; ///< how far a status is; 0: it is unknown
};

}

#endif
