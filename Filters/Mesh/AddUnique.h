/**
 * @file AddUnique.h
 * @brief Short lists without repetition, in the order in which they came.
 */
#ifndef AddUnique_h
#define AddUnique_h

#include <algorithm>
#include <vector>

namespace trim
{

template <typename Value>
void AddUnique(std::vector<Value>& list, const Value& value)
{
  if (std::find(list.begin(), list.end(), value) == list.end())
  {
    list.push_back(value);
  }
}

}

#endif
