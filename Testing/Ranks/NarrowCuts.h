/**
 * @file NarrowCuts.h
 * @brief Random cuts that ask for more than the elements can do: tongues, notches, chevrons, combs
 * and slots of about an element, grooves along the skin, and faces that are there twice.
 */
#ifndef NarrowCuts_h
#define NarrowCuts_h

#include "Draws.h"

namespace judge
{
/// One of them, or two.
Cut DrawNarrow(Dice& dice, const Frame& box);
}

#endif
