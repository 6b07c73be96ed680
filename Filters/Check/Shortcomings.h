/**
 * @file Shortcomings.h
 * @brief What a trim of the band could not do, so that the best of several can be taken.
 */
#ifndef Shortcomings_h
#define Shortcomings_h

#include "LadderOptions.h"
#include "TrimBand.h"

#include <cstddef>
#include <tuple>

namespace trim
{

/// Among squares of distances in edges, a whole element counts as a node left by two of them.
constexpr double SquaresOfElement = 4.0;

struct Shortcomings
{
  std::size_t Elements = 0; ///< invalid, or of the kept part below the floor
  /// Sum of those of the distances of nodes left off the surface, in edges. The ladder leaves none
  /// for elements of the offcut below the floor, which count here for as much as a few nodes.
  double Squares = 0.0;
  double Farthest = 0.0; ///< of these distances

  bool operator<(const Shortcomings& other) const
  {
    return std::tie(this->Elements, this->Squares) < std::tie(other.Elements, other.Squares);
  }
};

Shortcomings MeasureLeft(const TrimBand& near);

/// The same, and SquaresOfElement for each element that is valid but short of what is aimed at.
Shortcomings MeasureShortcomings(const TrimBand& near, const LadderOptions& options);

}

#endif
