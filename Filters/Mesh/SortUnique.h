/// @file SortUnique.h
/// @brief Lists as sets: ascending, each item once.
#ifndef SortUnique_h
#define SortUnique_h

#include <algorithm>
#include <vector>

namespace trim
{

template <typename Item>
void SortUnique(std::vector<Item>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}

#endif
