/**
 * @file LastAsked.h
 * @brief A value that depends on a key alone, and is asked for mostly with the key of the last
 * time.
 */
#ifndef LastAsked_h
#define LastAsked_h

#include <optional>
#include <utility>

namespace trim
{

/// For one thread at a time; see RememberedLast for many items and all threads.
template <typename Key, typename Value>
class LastAsked
{
public:
  /// @param find works the value out.
  /// @return until the next call.
  template <typename Find>
  const Value& At(const Key& key, const Find& find)
  {
    if (!this->Known || this->Known->first != key)
    {
      Value found = find();
      this->Known.emplace(key, std::move(found));
    }
    return this->Known->second;
  }

private:
  std::optional<std::pair<Key, Value>> Known;
};

}

#endif
