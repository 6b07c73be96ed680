/**
 * @file RememberedLast.h
 * @brief Values of many items that depend on a key each: that of the last key is known.
 */
#ifndef RememberedLast_h
#define RememberedLast_h

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace trim
{

/// For what is asked of an item again and again with mostly the same key. Any thread may ask for
/// any item.
template <typename Key, typename Value>
class RememberedLast
{
public:
  explicit RememberedLast(std::size_t count)
    : Known(count)
  {
  }

  /// @param find works the value out; it depends on item and key alone.
  template <typename Find>
  Value At(std::size_t item, const Key& key, const Find& find) const
  {
    std::mutex& lock = this->Locks[item % this->Locks.size()];
    {
      const std::lock_guard<std::mutex> locked(lock);
      const auto& known = this->Known[item];
      if (known && known->first == key)
      {
        return known->second;
      }
    }
    auto found = std::make_unique<const std::pair<Key, Value>>(key, find());
    const Value value = found->second;
    const std::lock_guard<std::mutex> locked(lock);
    this->Known[item] = std::move(found);
    return value;
  }

private:
  mutable std::vector<std::unique_ptr<const std::pair<Key, Value>>> Known;
  mutable std::array<std::mutex, 64> Locks; ///< each of every 64th item
};

}

#endif
