/**
 * @file SortFour.h
 * @brief Sorts four numbers, as the nodes of a face are.
 */
#ifndef SortFour_h
#define SortFour_h

#include <algorithm>
#include <array>

namespace trim
{

/// Ascending, by a sorting network: std::sort takes longer than all else that is done with a face.
inline void SortFour(std::array<int, 4>& numbers)
{
  constexpr int network[5][2] = { { 0, 1 }, { 2, 3 }, { 0, 2 }, { 1, 3 }, { 1, 2 } };
  for (const auto& [low, high] : network)
  {
    const int least = std::min(numbers[low], numbers[high]);
    numbers[high] = std::max(numbers[low], numbers[high]);
    numbers[low] = least;
  }
}

}

#endif
