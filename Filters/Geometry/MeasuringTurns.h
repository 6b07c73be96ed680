/**
 * @file MeasuringTurns.h
 * @brief Items of long lists that are measured when first asked for, as most of a large surface
 * never is: by the thread that comes first, while others wait for it.
 */
#ifndef MeasuringTurns_h
#define MeasuringTurns_h

#include <array>
#include <atomic>
#include <mutex>

namespace nurbs
{

class MeasuringTurns
{
public:
  /**
   * @param known of the item: zero or false until it is measured.
   * @param index of the item in its list.
   * @param measure does it, and returns what is known then.
   */
  template <typename Known, typename Action>
  void Measure(std::atomic<Known>& known, int index, const Action& measure) const
  {
    if (known.load(std::memory_order_acquire))
    {
      return;
    }
    const std::lock_guard<std::mutex> lock(this->Locks[index % this->Locks.size()]);
    if (!known.load(std::memory_order_relaxed)) // no other thread was faster
    {
      known.store(measure(), std::memory_order_release);
    }
  }

private:
  mutable std::array<std::mutex, 64> Locks;
};

}

#endif
