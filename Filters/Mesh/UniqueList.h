/**
 * @file UniqueList.h
 * @brief Lists without repetition, in the order in which they came, which may become long: at an
 * axis thousands of faces have one node.
 */
#ifndef UniqueList_h
#define UniqueList_h

#include <algorithm>
#include <unordered_set>
#include <utility>
#include <vector>

namespace trim
{

class UniqueList
{
public:
  /// @param items without repetition.
  explicit UniqueList(std::vector<int> items)
    : Items(std::move(items))
  {
  }

  bool Has(int item)
  {
    // Most lists are short, and searched sooner than a set.
    if (this->Items.size() <= Short)
    {
      return std::find(this->Items.begin(), this->Items.end(), item) != this->Items.end();
    }
    if (this->Known.empty())
    {
      this->Known.insert(this->Items.begin(), this->Items.end());
    }
    return this->Known.count(item) > 0;
  }

  /// One that it has not.
  void Add(int item)
  {
    this->Items.push_back(item);
    if (!this->Known.empty())
    {
      this->Known.insert(item);
    }
  }

  std::vector<int> Take() { return std::move(this->Items); }

private:
  static constexpr std::size_t Short = 64;

  std::vector<int> Items;
  std::unordered_set<int> Known; ///< those of a long list, once it was asked
};

}

#endif
