/**
 * @file BoxHalving.h
 * @brief Search of a patch by boxes of its parameters that are halved until each is decided.
 */
#ifndef BoxHalving_h
#define BoxHalving_h

#include "PatchTree.h"

namespace nurbs
{
/**
 * Visits a box, then the halves it is given for it, the first of them and all its parts first.
 *
 * @param budget how many boxes may be visited; what is left of it after that.
 * @param visit takes a box and room for two halves; returns false if the box is decided.
 */
template <typename Visit>
void VisitHalves(const PartDomain& whole, int& budget, const Visit& visit)
{
  constexpr int StackSize = 128;
  PartDomain stack[StackSize];
  int size = 0;
  stack[size++] = whole;
  for (; size > 0 && budget > 0; --budget)
  {
    const PartDomain box = stack[--size];
    PartDomain halves[2];
    if (size + 2 <= StackSize && visit(box, halves))
    {
      stack[size++] = halves[1];
      stack[size++] = halves[0];
    }
  }
}

/// Halves a box across s or across t; which half comes first.
void HalveBox(const PartDomain& box, bool acrossS, bool highFirst, PartDomain* halves);

/// The longer of the two distances between corners of a net, along s and along t.
Vec2 MeasureSides(int p, int q, const Vec4* net);

}

#endif
