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

struct Shortcomings
{
  std::size_t Elements = 0; ///< invalid or below the floor
  double Squares = 0.0;  ///< sum of those of the distances of nodes left off the surface, in edges
  double Farthest = 0.0; ///< of these distances

  bool operator<(const Shortcomings& other) const
  {
    return std::tie(this->Elements, this->Squares) < std::tie(other.Elements, other.Squares);
  }
};

Shortcomings MeasureLeft(const TrimBand& near);

/// The same, where an element short of what is aimed at counts as a node left by two edges.
Shortcomings MeasureShortcomings(const TrimBand& near, const LadderOptions& options);

}

#endif
