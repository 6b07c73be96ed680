/**
 * @file Remembered.h
 * @brief Values that are worked out once for each of many items, when somebody asks for them.
 */
#ifndef Remembered_h
#define Remembered_h

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

namespace trim
{

/// What does not change once it is known. Any thread may ask for any item.
template <typename Value>
class Remembered
{
public:
  explicit Remembered(std::size_t count)
    : Known(count)
  {
  }
  ~Remembered()
  {
    for (auto& known : this->Known)
    {
      delete known.load(std::memory_order_relaxed);
    }
  }
  Remembered(const Remembered&) = delete;
  Remembered& operator=(const Remembered&) = delete;

  /// @param find works the value out; it depends on the item alone.
  template <typename Find>
  const Value& At(std::size_t item, const Find& find) const
  {
    auto& known = this->Known[item];
    if (const Value* value = known.load(std::memory_order_acquire))
    {
      return *value;
    }
    auto found = std::make_unique<const Value>(find());
    const Value* other = nullptr;
    // Where two threads ask at once the first one's is taken, which is the same.
    if (!known.compare_exchange_strong(
          other, found.get(), std::memory_order_acq_rel, std::memory_order_acquire))
    {
      return *other;
    }
    return *found.release();
  }

private:
  mutable std::vector<std::atomic<const Value*>> Known;
};

}

#endif
