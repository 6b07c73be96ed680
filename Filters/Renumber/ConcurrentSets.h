/**
 * @file ConcurrentSets.h
 * @brief Union-find that several threads may unite in at the same time; the root of a set is its
 * smallest member, so that the sets do not depend on who came first.
 */
#ifndef ConcurrentSets_h
#define ConcurrentSets_h

#include "PageVector.h"

#include <algorithm>
#include <atomic>

namespace trim
{

class ConcurrentSets
{
public:
  /// @param alone whether one thread unites: it needs no locked instructions.
  ConcurrentSets(int count, bool alone)
    : Back(count)
    , Alone(alone)
  {
  }

  bool IsRoot(int i) const { return this->Parent(i) == i; }

  int Find(int i)
  {
    for (int parent = this->Parent(i); parent != i; parent = this->Parent(i))
    {
      // Whoever halves the path meanwhile leads it to an ancestor as well.
      const int next = this->Parent(parent);
      this->Back[i].store(i - next, std::memory_order_relaxed);
      i = next;
    }
    return i;
  }

  void Unite(int a, int b)
  {
    if (this->Parent(a) == this->Parent(b))
    {
      return; // most are united already
    }
    while ((a = this->Find(a)) != (b = this->Find(b)))
    {
      const int large = std::max(a, b);
      const int back = large - std::min(a, b);
      int none = 0;
      if (this->Alone)
      {
        this->Back[large].store(back, std::memory_order_relaxed);
        return;
      }
      if (this->Back[large].compare_exchange_strong(none, back, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

private:
  int Parent(int i) const { return i - this->Back[i].load(std::memory_order_relaxed); }

  nurbs::PageVector<std::atomic<int>> Back; ///< from a member to its parent; 0: a root
  bool Alone;
};

}

#endif
