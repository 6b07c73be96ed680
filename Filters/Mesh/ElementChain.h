/**
 * @file ElementChain.h
 * @brief The row of elements through opposite faces, along one axis of an element.
 */
#ifndef ElementChain_h
#define ElementChain_h

#include "Band.h"

#include <array>

namespace trim
{

/// How much shorter than any other the chains of a thickness axis have to be; of 1 to 1.5 exactly,
/// which rounding must not decide, they are.
constexpr double ThicknessRatio = 1.5 * (1.0 - 1e-6);

struct Chain
{
  int Count = 1;      ///< elements
  double Length = 0;  ///< of a ring: infinite
  bool Closed = true; ///< ends at the exterior on both sides: a ring does not, nor one of too many
  std::array<int, 2> EndFace{ -1, -1 }; ///< face of the band at which each way ends
};

Chain MeasureChain(const Band& band, int element, int axis);

/// The axis of an element that is parallel to the edge between two of its nodes, or -1.
int AxisOfEdge(const BandElement& element, int a, int b);

}

#endif
