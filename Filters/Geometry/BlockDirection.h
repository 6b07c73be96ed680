/**
 * @file BlockDirection.h
 * @brief How the knot spans of one direction of a face are divided into blocks, or joined to some.
 */
#ifndef BlockDirection_h
#define BlockDirection_h

#include "KnotSpans.h"

#include <vector>

namespace nurbs
{

/// What blocks may be.
struct BlockLimits
{
  double Flatness; ///< a block bends by at most so much (about radians)
  double Slender;  ///< a block is at most so many times as long as wide
  int Least;       ///< a direction has at least about so many blocks
  int MostSpans;   ///< a block holds at most so many spans of a direction
};

class BlockDirection
{
public:
  explicit BlockDirection(const KnotSpans& spans);

  std::vector<double> Bend;   ///< of each span, the largest over the other direction
  std::vector<double> Length; ///< of each span, in the mean over the other direction

  /// Divides spans that bend too much for a block, and joins neighbours that make one together.
  void Divide(const BlockLimits& limits);

  /// Raises the bend of spans that are long against the blocks of the other direction, so that
  /// blocks are not too slender.
  void BendSlender(const BlockLimits& limits, double width);

  // The result of Divide:
  std::vector<int> First;     ///< of each span, its block or the first of them
  std::vector<int> Divisions; ///< blocks in the span; 1 where one holds many spans
  std::vector<double> Breaks; ///< where blocks begin, and the end

  int NumberOfSpans() const { return static_cast<int>(this->Bend.size()); }
  int NumberOfBlocks() const { return static_cast<int>(this->Breaks.size()) - 1; }
  double LengthOfBlocks() const; ///< in the mean

private:
  const KnotSpans& Spans;
};

}

#endif
